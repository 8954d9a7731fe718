#pragma once

#include "state_validity/FootprintChecker.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace parking
{
    /** \brief CheckCounts to which several threads add concurrently.

        Threads write to separate cache lines, so counting takes a few nanoseconds with any number of threads. A sum
        read during concurrent counting is consistent for each tier, but not across tiers. */
    class TierCounters
    {
    public:
        /** \brief Adds the counts of each tier. */
        void add(const CheckCounts &counts)
        {
            Line &line = lines_[lineOfThisThread()];
            add(line.states, counts.states);
            add(line.byField, counts.byField);
            add(line.byCircles, counts.byCircles);
            add(line.byEdges, counts.byEdges);
            add(line.byContactTest, counts.byContactTest);
        }

        /** \brief Sum of the counts of all threads. */
        CheckCounts sum() const
        {
            CheckCounts counts;
            for (const Line &line : lines_)
                counts += CheckCounts{
                    line.states.load(std::memory_order_relaxed), line.byField.load(std::memory_order_relaxed),
                    line.byCircles.load(std::memory_order_relaxed), line.byEdges.load(std::memory_order_relaxed),
                    line.byContactTest.load(std::memory_order_relaxed)};
            return counts;
        }

        /** \brief Resets all counts to zero. Concurrent additions may be lost in part. */
        void reset()
        {
            for (Line &line : lines_)
                for (Counter *counter :
                     {&line.states, &line.byField, &line.byCircles, &line.byEdges, &line.byContactTest})
                    counter->store(0, std::memory_order_relaxed);
        }

    private:
        using Counter = std::atomic<std::uint64_t>;

        struct alignas(64) Line
        {
            Counter states{0}, byField{0}, byCircles{0}, byEdges{0}, byContactTest{0};
        };

        static constexpr std::size_t LINES = 16;

        static void add(Counter &counter, std::uint64_t count)
        {
            if (count != 0)
                counter.fetch_add(count, std::memory_order_relaxed);
        }

        static std::size_t lineOfThisThread()
        {
            static std::atomic<std::size_t> threads{0};
            thread_local const std::size_t line = threads.fetch_add(1, std::memory_order_relaxed) % LINES;
            return line;
        }

        std::array<Line, LINES> lines_;
    };
}  // namespace parking

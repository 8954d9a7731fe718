#pragma once

#include "state_validity/FootprintChecker.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace parking
{
    /** \brief CheckCounts that several threads add to at once.

        Threads write to separate cache lines, so that counting costs a few nanoseconds whatever their number. Sums read
        while others count are those of some moment for each tier, not of one moment for all. */
    class TierCounters
    {
    public:
        /** \brief Adds to what was counted so far, tier by tier. */
        void add(const CheckCounts &counts)
        {
            Line &line = lines_[lineOfThisThread()];
            add(line.states, counts.states);
            add(line.byField, counts.byField);
            add(line.byCircles, counts.byCircles);
            add(line.byEdges, counts.byEdges);
            add(line.byContactTest, counts.byContactTest);
        }

        /** \brief What all threads have counted. */
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

        /** \brief Starts from zero. What others add meanwhile may be lost in part. */
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

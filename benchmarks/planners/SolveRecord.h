#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>
#include <vector>

namespace parking
{
    /** \brief A solution better than all previous ones. */
    struct Improvement
    {
        double time{0.0};  ///< time in seconds since solve() began
        double cost{0.0};  ///< metres
    };

    /** \brief Effort and solutions of one solve(), with their times. Thread-safe. */
    class SolveRecord
    {
    public:
        /** \brief Selects the clock that times and stops planners: the wall clock, or the processor time of all threads
            of this process.

            Processor time does not depend on the load of the machine. The clock is common to all planners and must not
            change during a run. */
        static void countProcessorTime(bool processorTime);

        /** \brief Whether processor time is counted. */
        static bool isByProcessorTime();

        /** \brief Clears the record and starts the clock. */
        void begin();

        /** \brief Stops the clock. */
        void end();

        /** \brief Records \e cost in metres, if it is finite and lower than all previous ones. */
        void note(double cost);

        /** \brief Records the cost of the final path at the time when the clock stopped, if lower than all previous
            ones. */
        void noteAtEnd(double cost);

        /** \brief Time in seconds between begin() and end(); 0 before end(). */
        double wallTime() const;

        /** \brief Processor time in seconds of all threads between begin() and end(); 0 before end(). */
        double cpuTime() const;

        /** \brief The lowest recorded cost; infinite without one. */
        double bestCost() const;

        /** \brief All recorded solutions in order of time, each of a lower cost than the previous one. */
        std::vector<Improvement> improvements() const;

        /** \brief Whether \e seconds of the clock have passed since begin().

            By processor time it is also true when the thread of begin() has slept longer than that while no thread of
            this process computed: a waiting planner would never reach its limit. Time spent waiting for a processor
            does not count. Other threads cannot detect this, nor kernels without /proc/thread-self/schedstat.

            Planners call this after every expansion or sample, but a system call for processor time takes longer than
            many of these. It is repeated only when all processors together may have reached the limit, or after 50
            ms. */
        bool isOver(double seconds);

    private:
        void add(double time, double cost);
        bool hasSleptLongerThan(double seconds) const;

        mutable std::mutex mutex_;
        double begin_{0.0};
        double cpuBegin_{0.0};
        std::thread::id thread_;  // the thread that called begin()
        std::chrono::steady_clock::time_point steadyBegin_;
        std::atomic<std::chrono::steady_clock::time_point> nextLook_;  // earliest time of the next check of the clock
        double queuedBefore_{0.0};  // seconds in which it waited for a processor before begin()
        double wallTime_{0.0};
        double cpuTime_{0.0};
        std::vector<Improvement> improvements_;
    };
}  // namespace parking

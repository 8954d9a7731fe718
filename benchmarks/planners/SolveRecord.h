#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>
#include <vector>

namespace parking
{
    /** \brief A solution that was better than all before it. */
    struct Improvement
    {
        double time{0.0};  ///< seconds since solve() began
        double cost{0.0};  ///< metres
    };

    /** \brief What one solve() took and found, and when. Safe to use from several threads. */
    class SolveRecord
    {
    public:
        /** \brief Chooses the clock that planners are timed and stopped by: the wall clock, or the processor time of
            all threads of this process, which a busy machine does not change. The same one for all planners; not to be
            changed while one of them is at work. */
        static void countProcessorTime(bool processorTime);

        /** \brief Forgets everything; the clock starts now. */
        void begin();

        /** \brief The clock stops. */
        void end();

        /** \brief Notes \e cost, in metres, if it is finite and better than all before. */
        void note(double cost);

        /** \brief The same for what came out when the clock stopped. */
        void noteAtEnd(double cost);

        /** \brief Seconds of the clock between begin() and end(); 0 before. */
        double wallTime() const;

        /** \brief Seconds of processor time of all threads between begin() and end(); 0 before. */
        double cpuTime() const;

        /** \brief The least cost noted; infinite without one. */
        double bestCost() const;

        /** \brief All that were noted, in order of time, each of a lower cost than the one before. */
        std::vector<Improvement> improvements() const;

        /** \brief Whether \e seconds of the clock have passed since begin().

            By processor time also whether the thread that called begin() has slept for longer than that, while no
            thread of this process computed: a planner that waits would not come to its limit. Time in which it had to
            wait for a processor does not count. That is not seen from other threads, nor where the kernel does not tell
            (/proc/thread-self/schedstat).

            A planner asks this after every expansion or sample, and the kernel's answer to what a process has computed
            takes longer than many of these: it is asked again only once all processors together may have got there, or
            after 50 ms. */
        bool isOver(double seconds);

    private:
        void add(double time, double cost);
        bool hasSleptLongerThan(double seconds) const;

        mutable std::mutex mutex_;
        double begin_{0.0};
        double cpuBegin_{0.0};
        std::thread::id thread_;  // that called begin()
        std::chrono::steady_clock::time_point steadyBegin_;
        std::atomic<std::chrono::steady_clock::time_point> nextLook_;  // at the clock; never over before
        double queuedBefore_{0.0};  // seconds in which it waited for a processor before begin()
        double wallTime_{0.0};
        double cpuTime_{0.0};
        std::vector<Improvement> improvements_;
    };
}  // namespace parking

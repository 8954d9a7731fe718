#pragma once

#include <ompl/base/Planner.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <ctime>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>
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
        /** \brief What planners are timed and stopped by: the wall clock, or the processor time of all threads of this
            process, which a busy machine does not change. The same one for all planners. */
        struct Clock
        {
            using duration = std::chrono::nanoseconds;          ///< in which the clock counts
            using rep = duration::rep;                          ///< counts of the above
            using period = duration::period;                    ///< seconds of a count, a ratio
            using time_point = std::chrono::time_point<Clock>;  ///< a moment of this clock
            static constexpr bool is_steady = true;             ///< it never goes back

            /** \brief This moment, by the clock that countProcessorTime() has chosen. */
            static time_point now();

            /** \brief Not while a planner is at work. */
            static void countProcessorTime(bool processorTime);
        };

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
        Clock::time_point begin_;
        double cpuBegin_{0.0};
        std::thread::id thread_;  // that called begin()
        std::chrono::steady_clock::time_point steadyBegin_;
        std::atomic<std::chrono::steady_clock::time_point> nextLook_;  // at the clock; never over before
        double queuedBefore_{0.0};  // seconds in which it waited for a processor before begin()
        double wallTime_{0.0};
        double cpuTime_{0.0};
        std::vector<Improvement> improvements_;
    };

    /** \brief Path length, noting when which length was reached.

        Every optimising planner of OMPL asks its objective whether a solution that it has just found satisfies: that is
        the moment that counts, and needs no polling from another thread. */
    class RecordingObjective final : public ompl::base::PathLengthOptimizationObjective
    {
    public:
        /** \brief \param record is told the cost of every solution that a planner asks about */
        RecordingObjective(const ompl::base::SpaceInformationPtr &si, std::shared_ptr<SolveRecord> record);

        /** \brief Notes \e cost; then what the path length says. */
        bool isSatisfied(ompl::base::Cost cost) const override;

    private:
        std::shared_ptr<SolveRecord> record_;
    };

    /** \brief What went wrong inside a planner. */
    struct PlannerFailure
    {
        /** \brief What went wrong. */
        enum class Kind
        {
            None,       ///< all went well
            Exception,  ///< it threw something other than std::bad_alloc
            Memory,     ///< there was not enough
            Nonsense    ///< an answer that nobody can read
        };
        Kind kind{Kind::None};  ///< None as long as all goes well
        std::string text;       ///< one line
    };

    /** \brief The exception that is being handled, as a failure in \e where. */
    PlannerFailure currentFailure(const std::string &where);

    /** \brief Is what a planner left as its solution a path at all: states of numbers, within a thousand kilometres?
        Whether it is a good one is the referee's matter.

        \param exact it speaks of an exact solution, so that there must be one */
    PlannerFailure failureOfAnswer(const ompl::base::ProblemDefinition &problem, bool exact);

    /** \brief What all planners made by PlannerRegistry are, beside the OMPL planner that they are. */
    class MeasuredPlanner
    {
    public:
        virtual ~MeasuredPlanner() = default;

        /** \brief Of the last solve(). */
        virtual const std::shared_ptr<SolveRecord> &record() const = 0;

        /** \brief solve() ends after this many seconds of the clock, whatever the caller's condition says.

            ompl::tools::Benchmark looks at its clock every 0.1 s only. Infinite: no limit of our own. */
        virtual void setTimeLimit(double seconds) = 0;

        /** \brief solve() also ends once \e stop is true; null: nothing to look at. */
        virtual void setStop(const std::atomic<bool> *stop) = 0;

        /** \brief Was the last solve() told to stop, since the time was up or the caller wanted it?

            A planner that was not, and comes back without a solution, has nothing left to try: this is what it did, and
            not what a clock says afterwards. */
        virtual bool wasStopped() const = 0;

        /** \brief One line on why the last solve() found nothing, from planners that tell; otherwise empty. */
        virtual std::string whyNothing() const = 0;

        /** \brief What went wrong in the planner since it was made, first. It is not thrown on: after it, solve()
           returns CRASH and there is no solution. */
        virtual const PlannerFailure &failure() const = 0;
    };

    /** \brief What templates of this project need and their users do not. */
    namespace detail
    {
        /** Has the planner a member reason()? */
        template <class Planner, class = void>
        struct TellsReason : std::false_type
        {
        };
        template <class Planner>
        struct TellsReason<Planner, std::void_t<decltype(std::string(std::declval<const Planner &>().reason()))>>
          : std::true_type
        {
        };
    }  // namespace detail

    /** \brief A planner of OMPL that measures its own solve() and keeps to the second.

        Progress properties are replaced by one, the best cost, that can be read safely from another thread: those of
        BIT* and ABIT* of OMPL 1.5 are read by the benchmark while the search changes them, and crash now and then. */
    template <class Planner>
    class Measured final : public Planner, public MeasuredPlanner
    {
    public:
        /** \brief Hands \e arguments to the planner's own constructor. */
        template <class... Arguments>
        explicit Measured(Arguments &&...arguments) : Planner(std::forward<Arguments>(arguments)...)
        {
            this->plannerProgressProperties_.clear();
            this->addPlannerProgressProperty("best cost REAL",
                                             [record = record_] { return std::to_string(record->bestCost()); });
        }

        using Planner::solve;

        /** \brief The planner's own, timed, and ended in time. CRASH when it throws or its answer is no path, see
            failure(); TIMEOUT when it speaks of an approximate solution and there is none. */
        ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition &ptc) override
        {
            record_->begin();
            if (failure_.kind != PlannerFailure::Kind::None)
                return ompl::base::PlannerStatus::CRASH;  // in clear()
            wasStopped_ = false;
            const ompl::base::PlannerTerminationCondition timeUp(
                [&]
                {
                    const bool stop = record_->isOver(timeLimit_) || ptc() ||
                                      (stop_ != nullptr && stop_->load(std::memory_order_relaxed));
                    if (stop)
                        wasStopped_ = true;
                    return stop;
                });
            ompl::base::PlannerStatus status = ompl::base::PlannerStatus::CRASH;
            guard("solve()", [&] { status = Planner::solve(timeUp); });
            record_->end();
            const bool exact = status == ompl::base::PlannerStatus::EXACT_SOLUTION;
            if (failure_.kind == PlannerFailure::Kind::None)
                failure_ = failureOfAnswer(*this->getProblemDefinition(), exact);
            if (failure_.kind != PlannerFailure::Kind::None)
            {
                this->getProblemDefinition()->clearSolutionPaths();
                return ompl::base::PlannerStatus::CRASH;
            }
            // BLIT* of OMPL 2.0.2 does so, and OMPL's benchmark throws for want of a path.
            if (!exact && status && !this->getProblemDefinition()->getSolutionPath())
                return ompl::base::PlannerStatus::TIMEOUT;
            if (exact)
                record_->noteAtEnd(this->getProblemDefinition()->getSolutionPath()->length());
            return status;
        }

        /** \brief The planner's own; what it throws becomes failure(). */
        void clear() override
        {
            guard("clear()", [this] { Planner::clear(); });
        }

        /** \brief The planner's own; what it throws becomes failure(). */
        void getPlannerData(ompl::base::PlannerData &data) const override
        {
            guard("getPlannerData()", [&] { Planner::getPlannerData(data); });
        }

        const PlannerFailure &failure() const override
        {
            return failure_;
        }

        const std::shared_ptr<SolveRecord> &record() const override
        {
            return record_;
        }

        void setTimeLimit(double seconds) override
        {
            timeLimit_ = seconds;
        }

        void setStop(const std::atomic<bool> *stop) override
        {
            stop_ = stop;
        }

        bool wasStopped() const override
        {
            return wasStopped_;
        }

        std::string whyNothing() const override
        {
            if constexpr (detail::TellsReason<Planner>::value)
                return this->reason();
            else
                return {};
        }

    private:
        template <class Work>
        void guard(const char *where, Work work) const
        {
            try
            {
                work();
            }
            catch (...)
            {
                if (failure_.kind == PlannerFailure::Kind::None)
                    failure_ = currentFailure(where);
            }
        }

        std::shared_ptr<SolveRecord> record_{std::make_shared<SolveRecord>()};
        mutable PlannerFailure failure_;
        double timeLimit_{1e9};
        const std::atomic<bool> *stop_{nullptr};
        std::atomic<bool> wasStopped_{false};  ///< planners with threads ask in each of them
    };
}  // namespace parking

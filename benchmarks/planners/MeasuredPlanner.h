#pragma once

#include "benchmarks/planners/SolveRecord.h"

#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/Planner.h>

#include <atomic>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace parking
{
    /** \brief The outcome of a run. */
    enum class PlanStatus
    {
        Exact,         ///< a path to a goal
        Approximate,   ///< a path that ends short of the goals
        Timeout,       ///< no solution within the time limit
        InvalidStart,  ///< no start is free
        InvalidGoal,   ///< no goal is free
        Infeasible,    ///< the planner ended by itself: the search is exhausted
        Exception,     ///< the planner threw
        Crash,         ///< a signal ended it, or it ended its process
        Hang,          ///< it did not return
        Memory,        ///< it exceeded the memory limit
        InvalidAnswer  ///< it reported a missing path, or states out of range
    };

    /** \brief Number of values of PlanStatus. */
    constexpr std::size_t PLAN_STATUSES = static_cast<std::size_t>(PlanStatus::InvalidAnswer) + 1;

    /** \brief Names in results: exact, approximate, timeout, invalid_start, invalid_goal, infeasible, exception, crash,
       hang, memory, invalid_answer. */
    std::string toString(PlanStatus status);

    /** \brief Whether the planner itself failed, for any problem. */
    bool isFailure(PlanStatus status);

    /** \brief A failure inside a planner. */
    struct PlannerFailure
    {
        PlanStatus status;  ///< Exception, Memory or InvalidAnswer
        std::string text;   ///< one line
    };

    /** \brief The exception that is being handled, as a failure in \e where. */
    PlannerFailure currentFailure(const std::string &where);

    /** \brief Wraps a planner of OMPL, measures solve() and ends it in time. All calls are forwarded to the wrapped
        planner.

        Its only progress property is the best cost, which other threads can read safely. OMPL's benchmark reads those
        of BIT* and ABIT* of OMPL 1.5 while the search changes them, which crashes occasionally. */
    class MeasuredPlanner final : public ompl::base::Planner
    {
    public:
        /** \brief \param planner the planner to wrap; must not be null */
        explicit MeasuredPlanner(ompl::base::PlannerPtr planner);

        /** \brief The measured planner. */
        ompl::base::Planner &wrapped() const
        {
            return *planner_;
        }

        /** \brief Sets \e problem in both planners. */
        void setProblemDefinition(const ompl::base::ProblemDefinitionPtr &problem) override;

        /** \brief Solves by the wrapped planner, timed and ended in time.

            Returns CRASH when it throws or its answer is invalid, see failure(); TIMEOUT when it reports an approximate
            solution but has none. */
        ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition &ptc) override;
        using ompl::base::Planner::solve;

        /** \brief Sets both planners up. */
        void setup() override;

        /** \brief Clears both planners; exceptions of the measured one become failure(). */
        void clear() override;

        /** \brief Throws ompl::Exception when one of the two is not ready to solve. */
        void checkValidity() override;

        /** \brief The planner's own graph; its exceptions become failure(). */
        void getPlannerData(ompl::base::PlannerData &data) const override;

        /** \brief Times and solutions of the last solve(). */
        const std::shared_ptr<SolveRecord> &record() const
        {
            return record_;
        }

        /** \brief The first failure of the planner since its construction. Its exception is not rethrown; after it,
            solve() returns CRASH without a solution. */
        const std::optional<PlannerFailure> &failure() const
        {
            return failure_;
        }

        /** \brief Ends solve() after this time in seconds, independent of the caller's condition.

            ompl::tools::Benchmark checks its clock only every 0.1 s. */
        void setTimeLimit(double seconds);

        /** \brief Sets the cost of the final path in the record; null: its length. */
        void setObjective(ompl::base::OptimizationObjectivePtr objective)
        {
            objective_ = std::move(objective);
        }

        /** \brief Ends solve() also when \e stop is true; null: not checked. */
        void setStop(const std::atomic<bool> *stop)
        {
            stop_ = stop;
        }

        /** \brief Whether the last solve() was stopped, by the time limit or by the caller.

            A planner that returns without a solution and was not stopped has exhausted its search. The planner's end
            decides, not a clock afterwards. */
        bool wasStopped() const
        {
            return wasStopped_;
        }

    private:
        template <class Work>
        void guard(const char *where, Work work) const;

        ompl::base::PlannerPtr planner_;
        std::shared_ptr<SolveRecord> record_{std::make_shared<SolveRecord>()};
        mutable std::optional<PlannerFailure> failure_;
        ompl::base::OptimizationObjectivePtr objective_;
        double timeLimit_{1e9};
        const std::atomic<bool> *stop_{nullptr};
        std::atomic<bool> wasStopped_{false};  ///< set by each of a planner's threads
    };

    /** \brief An objective that records when each cost was reached.

        Every optimising planner of OMPL passes a new solution to its objective to check whether it is good enough. That
        is the measured time; no other thread needs to poll. */
    template <class Objective>
    class RecordingObjective final : public Objective
    {
    public:
        /** \brief \param record receives the cost of every solution that a planner checks */
        RecordingObjective(const ompl::base::SpaceInformationPtr &si, std::shared_ptr<SolveRecord> record)
          : Objective(si),
            record_(std::move(record))
        {
        }

        /** \brief Records \e cost and returns the result of the objective. */
        bool isSatisfied(ompl::base::Cost cost) const override
        {
            record_->note(cost.value());
            return Objective::isSatisfied(cost);
        }

    private:
        std::shared_ptr<SolveRecord> record_;
    };
}  // namespace parking

#pragma once

#include "benchmarks/planners/SolveRecord.h"

#include <ompl/base/Planner.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>

#include <atomic>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>

namespace parking
{
    /** \brief How a run ended. */
    enum class PlanStatus
    {
        Exact,         ///< a path to a goal
        Approximate,   ///< a path that ends short of the goals
        Timeout,       ///< nothing found until the time was up
        InvalidStart,  ///< no start is free
        InvalidGoal,   ///< no goal is free
        Infeasible,    ///< the planner ended without having been stopped: there is nothing that it could still try
        Exception,     ///< the planner threw
        Crash,         ///< a signal ended it, or it ended its process
        Hang,          ///< it did not come back
        Memory,        ///< it took too much memory
        Nonsense       ///< its answer is none: no path, or states that are nowhere
    };

    /** \brief Number of values that a PlanStatus has. */
    constexpr std::size_t PLAN_STATUSES = static_cast<std::size_t>(PlanStatus::Nonsense) + 1;

    /** \brief Names as in results: exact, approximate, timeout, invalid_start, invalid_goal, infeasible, exception,
       crash, hang, memory, nonsense. */
    std::string toString(PlanStatus status);

    /** \brief Did the planner itself fail, whatever the problem? */
    bool isFailure(PlanStatus status);

    /** \brief What went wrong inside a planner. */
    struct PlannerFailure
    {
        PlanStatus status;  ///< Exception, Memory or Nonsense
        std::string text;   ///< one line
    };

    /** \brief The exception that is being handled, as a failure in \e where. */
    PlannerFailure currentFailure(const std::string &where);

    /** \brief A planner of OMPL that measures its own solve() and keeps to the second: whatever is asked of it is asked
        of the planner that it was made from.

        Of progress properties it has one, the best cost, that can be read safely from another thread: those of BIT* and
        ABIT* of OMPL 1.5 are read by the benchmark while the search changes them, and crash now and then. */
    class MeasuredPlanner final : public ompl::base::Planner
    {
    public:
        /** \param planner must not be null */
        explicit MeasuredPlanner(ompl::base::PlannerPtr planner);

        /** \brief The planner that is measured. */
        ompl::base::Planner &wrapped() const
        {
            return *planner_;
        }

        /** \brief Hands \e problem to the planner, too. */
        void setProblemDefinition(const ompl::base::ProblemDefinitionPtr &problem) override;

        /** \brief The planner's own, timed, and ended in time. CRASH when it throws or its answer is no path, see
            failure(); TIMEOUT when it speaks of an approximate solution and there is none. */
        ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition &ptc) override;
        using ompl::base::Planner::solve;

        /** \brief Sets both planners up. */
        void setup() override;

        /** \brief Clears both planners; what the measured one throws becomes failure(). */
        void clear() override;

        /** \brief Throws ompl::Exception when one of the two is not ready to solve. */
        void checkValidity() override;

        /** \brief The planner's own graph; what it throws becomes failure(). */
        void getPlannerData(ompl::base::PlannerData &data) const override;

        /** \brief Of the last solve(). */
        const std::shared_ptr<SolveRecord> &record() const
        {
            return record_;
        }

        /** \brief What went wrong in the planner since it was made, first. It is not thrown on: after it, solve()
            returns CRASH and there is no solution. */
        const std::optional<PlannerFailure> &failure() const
        {
            return failure_;
        }

        /** \brief solve() ends after this many seconds of the clock, whatever the caller's condition says.

            ompl::tools::Benchmark looks at its clock every 0.1 s only. */
        void setTimeLimit(double seconds)
        {
            timeLimit_ = seconds;
        }

        /** \brief solve() also ends once \e stop is true; null: nothing to look at. */
        void setStop(const std::atomic<bool> *stop)
        {
            stop_ = stop;
        }

        /** \brief Was the last solve() told to stop, since the time was up or the caller wanted it?

            A planner that was not, and comes back without a solution, has nothing left to try: this is what it did, and
            not what a clock says afterwards. */
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
        double timeLimit_{1e9};
        const std::atomic<bool> *stop_{nullptr};
        std::atomic<bool> wasStopped_{false};  ///< planners with threads ask in each of them
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
}  // namespace parking

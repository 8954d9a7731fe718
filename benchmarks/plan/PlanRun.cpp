#include "benchmarks/plan/PlanRun.h"

#include "ompl_improved_astar/ImprovedAStar.h"

#include <ompl/base/PlannerData.h>
#include <ompl/util/Exception.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ob = ompl::base;

namespace parking
{
    namespace
    {
        constexpr double NO_LENGTH = 1e-6;  // metres; AIT* of OMPL 1.5 returns such paths as approximate solutions

        /** What it means that nothing was found: what improved A* says itself; of others, whether they were stopped.
            Nobody knows of a planner that does not measure itself. */
        PlanStatus withoutSolution(const PreparedPlanner &prepared)
        {
            bool gaveUp = prepared.measured != nullptr && !prepared.measured->wasStopped();
            if (const auto *improved = dynamic_cast<const ompl::geometric::ImprovedAStar *>(prepared.planner.get()))
                gaveUp = improved->outcome() == search::PlanOutcome::Infeasible;
            return gaveUp ? PlanStatus::Infeasible : PlanStatus::Timeout;
        }

        PlanStatus statusOf(ob::PlannerStatus status, const PreparedPlanner &prepared)
        {
            switch (static_cast<ob::PlannerStatus::StatusType>(status))
            {
                case ob::PlannerStatus::EXACT_SOLUTION:
                    return PlanStatus::Exact;
                case ob::PlannerStatus::APPROXIMATE_SOLUTION:
                    return PlanStatus::Approximate;
                case ob::PlannerStatus::INVALID_START:
                    return PlanStatus::InvalidStart;
                case ob::PlannerStatus::INVALID_GOAL:
                    return PlanStatus::InvalidGoal;
                default:
                    return withoutSolution(prepared);
            }
        }

        SearchFigures figuresOf(const Problem &problem, const ob::Planner &planner)
        {
            SearchFigures figures;
            if (const auto *improved = dynamic_cast<const ompl::geometric::ImprovedAStar *>(&planner))
            {
                const search::SearchStatistics statistics = improved->statistics();
                figures.expanded = statistics.expanded;
                figures.generated = statistics.generated;
                figures.stateChecks = improved->checkedStates();
                figures.exactChecks = improved->exactChecks();
                figures.openListOperations = statistics.openListOperations;
                figures.openListComparisons = statistics.openListComparisons;
                return figures;
            }
            ob::PlannerData data(planner.getSpaceInformation());
            planner.getPlannerData(data);
            figures.expanded = data.numVertices();
            figures.generated = data.numEdges();
            const CheckCounts counts = problem.checkCounts();
            figures.stateChecks = counts.states;
            figures.exactChecks = counts.byContactTest;
            return figures;
        }

        double boundOf(ob::Planner &planner)
        {
            auto *improved = dynamic_cast<ompl::geometric::ImprovedAStar *>(&planner);
            const bool holds = improved != nullptr && improved->parameters().heuristicWeightFar == 1.0 &&
                               improved->parameters().heuristicWeightNear == 1.0;
            return holds ? improved->suboptimalityBound() : std::numeric_limits<double>::infinity();
        }

        double distanceToGoals(const Scenario &scenario, const Pose &pose)
        {
            double least = std::numeric_limits<double>::infinity();
            for (const Pose &goal : scenario.goals)
                least = std::min(least, positionDistance(goal, pose));
            return least;
        }
    }  // namespace

    std::string toString(PlanStatus status)
    {
        switch (status)
        {
            case PlanStatus::Exact:
                return "exact";
            case PlanStatus::Approximate:
                return "approximate";
            case PlanStatus::Timeout:
                return "timeout";
            case PlanStatus::InvalidStart:
                return "invalid_start";
            case PlanStatus::InvalidGoal:
                return "invalid_goal";
            case PlanStatus::Infeasible:
                return "infeasible";
            case PlanStatus::Exception:
                return "exception";
            case PlanStatus::Crash:
                return "crash";
            case PlanStatus::Hang:
                return "hang";
            case PlanStatus::Memory:
                return "memory";
            case PlanStatus::Nonsense:
                return "nonsense";
        }
        return "timeout";
    }

    bool isFailure(PlanStatus status)
    {
        return status >= PlanStatus::Exception;
    }

    PlanStatus statusOf(PlannerFailure::Kind failure)
    {
        switch (failure)
        {
            case PlannerFailure::Kind::Exception:
                return PlanStatus::Exception;
            case PlannerFailure::Kind::Memory:
                return PlanStatus::Memory;
            case PlannerFailure::Kind::Nonsense:
                return PlanStatus::Nonsense;
            case PlannerFailure::Kind::None:
                break;
        }
        return PlanStatus::Timeout;
    }

    PlanRun evaluateRun(const Problem &problem, const PreparedPlanner &prepared, ob::PlannerStatus status,
                        double timeLimit)
    {
        PlanRun run;
        run.planningTime = timeLimit;
        if (prepared.measured != nullptr)
        {
            const SolveRecord &record = *prepared.measured->record();
            run.planningTime = record.wallTime();
            run.cpuTime = record.cpuTime();
            const std::vector<Improvement> improvements = record.improvements();
            run.firstSolutionTime = improvements.empty() ? run.planningTime : improvements.front().time;
        }
        if (const auto *improved = dynamic_cast<const ompl::geometric::ImprovedAStar *>(prepared.planner.get()))
        {
            run.mapLoadingTime = improved->mapLoadingTime();
            run.planningTime = std::max(0.0, run.planningTime - run.mapLoadingTime);
            run.firstSolutionTime = std::max(0.0, run.firstSolutionTime - run.mapLoadingTime);
        }
        run.status = statusOf(status, prepared);
        const auto failed = [&]
        {
            if (prepared.measured == nullptr || prepared.measured->failure().kind == PlannerFailure::Kind::None)
                return false;
            run.status = statusOf(prepared.measured->failure().kind);
            run.reason = prepared.measured->failure().text;
            return true;
        };
        if (failed())
            return run;
        run.search = figuresOf(problem, *prepared.planner);
        if (failed())
            return run;
        const bool exact = run.status == PlanStatus::Exact;
        if (!exact && prepared.measured != nullptr)
            run.reason = prepared.measured->whyNothing();
        // A planner that comes near to a goal where the car cannot stand knows that it cannot, and not why.
        if (const std::string why = run.status == PlanStatus::Approximate ? problem.whyUnsolvable() : ""; !why.empty())
            run.reason += (run.reason.empty() ? "" : ": ") + why;
        if (exact)
            run.suboptimalityBound = boundOf(*prepared.planner);
        if (!exact && run.status != PlanStatus::Approximate)
            return run;
        const auto *path =
            dynamic_cast<const ompl::geometric::PathGeometric *>(prepared.problem()->getSolutionPath().get());
        if (path == nullptr || path->getStateCount() == 0)
        {
            run.status = withoutSolution(prepared);
            run.reason = "the planner speaks of a solution, but there is no path";
            return run;
        }
        PlannedPath planned = readPath(problem, *path, exact);
        if (!exact && planned.recheck.valid && planned.length < NO_LENGTH)
        {
            run.status = withoutSolution(prepared);
            return run;
        }
        run.goalDistance = distanceToGoals(problem.scenario(), planned.end);
        run.path = std::move(planned);
        if (!run.hasValidPath())
            run.reason = "the planner's path is not valid: " + run.path->recheck.reason;
        return run;
    }

    PlanRun planOnce(const Problem &problem, const PlannerEntry &entry, const PlannerSettings &settings,
                     double timeLimit, std::uint_fast32_t seed)
    {
        seedRandomNumbers(seed);
        const PreparedPlanner prepared = problem.prepare(entry, settings);
        problem.resetCounts();
        ob::PlannerStatus status = ob::PlannerStatus::CRASH;
        if (prepared.measured != nullptr)
        {
            prepared.measured->setTimeLimit(timeLimit);
            status = prepared.planner->solve(ob::plannerNonTerminatingCondition());
        }
        else
            status = prepared.planner->solve(ob::timedPlannerTerminationCondition(timeLimit));
        return evaluateRun(problem, prepared, status, timeLimit);
    }
}  // namespace parking

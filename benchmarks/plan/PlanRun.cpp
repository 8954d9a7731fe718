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

        /** The reason for a missing path: improved A* reports its own; of other planners, whether they were stopped. */
        PlanStatus withoutSolution(const PreparedPlanner &prepared)
        {
            const auto *improved = prepared.improved();
            const bool gaveUp = improved != nullptr ? improved->outcome() == search::PlanOutcome::Infeasible
                                                    : !prepared.planner->wasStopped();
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

        SearchFigures figuresOf(const Problem &problem, const PreparedPlanner &prepared)
        {
            SearchFigures figures;
            if (const auto *improved = prepared.improved())
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
            ob::PlannerData data(problem.spaceInformation());
            prepared.planner->getPlannerData(data);
            figures.expanded = data.numVertices();
            figures.generated = data.numEdges();
            const CheckCounts counts = problem.checkCounts();
            figures.stateChecks = counts.states;
            figures.exactChecks = counts.byContactTest;
            return figures;
        }

        bool isAtWeightOne(const PlannerParameters &parameters)
        {
            return parameters.heuristicWeightFar == 1.0 && parameters.heuristicWeightNear == 1.0;
        }

        double distanceToGoals(const Scenario &scenario, const Pose &pose)
        {
            double least = std::numeric_limits<double>::infinity();
            for (const Pose &goal : scenario.goals)
                least = std::min(least, positionDistance(goal, pose));
            return least;
        }
    }  // namespace

    PlanRun evaluateRun(const Problem &problem, const PreparedPlanner &prepared, ob::PlannerStatus status)
    {
        PlanRun run;
        const SolveRecord &record = *prepared.planner->record();
        run.planningTime = record.wallTime();
        run.cpuTime = record.cpuTime();
        const std::vector<Improvement> improvements = record.improvements();
        run.firstSolutionTime = improvements.empty() ? run.planningTime : improvements.front().time;
        auto *improved = prepared.improved();
        if (improved != nullptr)
        {
            run.mapLoadingTime = improved->mapLoadingTime();
            run.planningTime = std::max(0.0, run.planningTime - run.mapLoadingTime);
            run.firstSolutionTime = std::max(0.0, run.firstSolutionTime - run.mapLoadingTime);
        }
        if (!prepared.planner->failure())
            run.search = figuresOf(problem, prepared);
        if (const auto &failure = prepared.planner->failure())
        {
            run.status = failure->status;
            run.reason = failure->text;
            return run;
        }
        run.status = statusOf(status, prepared);
        const bool exact = run.status == PlanStatus::Exact;
        if (improved != nullptr)
            run.notice = improved->notice();
        if (!exact && improved != nullptr)
            run.reason = improved->reason();
        // A planner that approaches a goal in collision reports that it cannot reach it, but not why.
        if (const std::string why = run.status == PlanStatus::Approximate ? problem.whyUnsolvable() : ""; !why.empty())
            run.reason += (run.reason.empty() ? "" : ": ") + why;
        if (exact && improved != nullptr && isAtWeightOne(improved->parameters()))
            run.suboptimalityBound = improved->suboptimalityBound();
        if (!exact && run.status != PlanStatus::Approximate)
            return run;
        const auto *path =
            dynamic_cast<const ompl::geometric::PathGeometric *>(prepared.problem()->getSolutionPath().get());
        PlannedPath planned = readPath(problem, *path, exact);
        if (!exact && planned.recheck.valid && planned.length < NO_LENGTH)
        {
            run.status = withoutSolution(prepared);
            return run;
        }
        if (const auto escape = improved != nullptr ? improved->escape() : std::nullopt)
        {
            run.escapes = true;
            const Path rest = planned.path.rest(std::min(std::abs(escape->arc.length), planned.length));
            Scenario fromThere = problem.scenario();
            fromThere.start = rest.start;
            planned.recheck = Referee(fromThere).check(rest, false);
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
        prepared.planner->setTimeLimit(timeLimit);
        const ob::PlannerStatus status = prepared.planner->solve(ob::plannerNonTerminatingCondition());
        return evaluateRun(problem, prepared, status);
    }
}  // namespace parking

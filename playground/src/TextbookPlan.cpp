#include "playground/src/TextbookPlan.h"

#include "automatic_parking/Stopwatch.h"
#include "benchmarks/planners/TextbookSearch.h"
#include "ompl_improved_astar/search/planning/FootprintEnvironment.h"
#include "parking_geometry/curves/ReedsShepp.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace parking::playground
{
    namespace
    {
        bool isCurveFree(FootprintEnvironment &environment, Pose pose, const ReedsSheppCurve &curve)
        {
            for (std::size_t i = 0; i < curve.count; ++i)
            {
                const Arc &arc = curve.pieces[i];
                double length = 0.0;
                environment.freeLengths(pose, &arc, 1, 0.0, &length);
                if (length < std::abs(arc.length))
                    return false;
                pose = advance(pose, PathPiece(arc));
            }
            return true;
        }

        SearchTrace traceOf(const TextbookSearch &search, std::size_t maxNodes)
        {
            SearchTrace trace;
            const auto &nodes = search.nodes();
            for (std::size_t i = 0; i < std::min(maxNodes, nodes.size()); ++i)
            {
                TraceNode each;
                each.pose = nodes[i].pose;
                each.parent =
                    nodes[i].parent == TextbookSearch::NOBODY ? static_cast<std::uint32_t>(i) : nodes[i].parent;
                each.curvature = nodes[i].curvature;
                if (i > 0)
                    each.length = nodes[i].direction * search.parameters().motionLength;
                each.cost = static_cast<float>(nodes[i].cost);
                each.ahead = static_cast<float>(nodes[i].ahead);
                each.expanded = nodes[i].closed;
                trace.start.push_back(each);
            }
            for (std::size_t i = 0; i < search.growth().size() && search.growth()[i] <= maxNodes; ++i)
            {
                TraceStep step;
                step.expanded = i + 1;
                step.start = static_cast<std::uint32_t>(search.growth()[i]);
                trace.steps.push_back(step);
            }
            return trace;
        }
    }  // namespace

    TextbookPlan planByTextbook(const ScenarioPlanner &planner, const PlanLimits &limits, std::size_t maxNodes)
    {
        const Scenario &scenario = planner.scenario();
        FootprintEnvironment environment(planner.footprint(), scenario.bounds, FootprintEnvironment::TOLERANCE);
        TextbookPlan result;
        ScenarioPlan &plan = result.plan;
        const auto goal = std::find_if(scenario.goals.begin(), scenario.goals.end(),
                                       [&](const Pose &pose) { return environment.isFree(pose); });
        if (!environment.isFree(scenario.start) || goal == scenario.goals.end())
        {
            const bool starts = environment.isFree(scenario.start);
            plan.outcome = starts ? search::PlanOutcome::InvalidGoal : search::PlanOutcome::InvalidStart;
            plan.reason =
                starts ? "every goal is in collision or out of bounds" : "the start is in collision or out of bounds";
            return result;
        }
        const Stopwatch watch;
        const ReedsShepp curves(scenario.vehicle.minTurningRadius());
        TextbookProblem problem;
        problem.start = scenario.start;
        problem.goal = *goal;
        problem.bounds = scenario.bounds;
        problem.turningRadius = curves.turningRadius();
        problem.curveToGoal = [&](const Pose &pose)
        {
            return curves.distance(pose, *goal);
        };
        problem.isMotionFree = [&](const Pose &from, const Pose &to)
        {
            return isCurveFree(environment, from, curves.shortest(from, to));
        };
        problem.footprint = &planner.footprint();
        problem.stop = [&]
        {
            return watch.seconds() > limits.time || (limits.interrupted && limits.interrupted());
        };
        TextbookSearch search(std::move(problem), {});
        const std::vector<Pose> poses = search.run();
        plan.path.start = scenario.start;
        for (std::size_t i = 1; i < poses.size(); ++i)
        {
            const ReedsSheppCurve curve = curves.shortest(poses[i - 1], poses[i]);
            for (std::size_t k = 0; k < curve.count; ++k)
                plan.path.append(curve.pieces[k]);
        }
        plan.goal = static_cast<std::size_t>(goal - scenario.goals.begin());
        plan.statistics.expanded = search.growth().size();
        plan.statistics.generated = search.nodes().size();
        plan.checks = environment.counts();
        plan.planningTime = watch.seconds();
        if (!poses.empty())
        {
            plan.outcome = search::PlanOutcome::Solved;
            plan.cost = plan.path.length();
        }
        else if (plan.planningTime <= limits.time)
        {
            plan.outcome = search::PlanOutcome::Infeasible;
            plan.reason = "its lattice contains no path";
        }
        if (maxNodes > 0)
            result.trace = traceOf(search, maxNodes);
        return result;
    }
}  // namespace parking::playground

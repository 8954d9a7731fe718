#include "automatic_parking/scenario/SearchTrace.h"

#include "automatic_parking/Stopwatch.h"

#include <memory>
#include <utility>

namespace parking
{
    namespace
    {
        std::vector<TraceNode> nodesOf(const search::Frontier &frontier)
        {
            std::vector<TraceNode> nodes;
            nodes.reserve(frontier.nodes().size());
            for (const search::Node &node : frontier.nodes())
            {
                TraceNode each;
                each.pose = node.pose;
                each.parent = node.parent == search::NO_NODE ? static_cast<std::uint32_t>(nodes.size()) : node.parent;
                each.curvature = node.motion.curvature;
                each.length = node.motion.length;
                each.cost = static_cast<float>(node.g);
                each.ahead = node.h;
                each.expanded = node.isExpanded();
                nodes.push_back(each);
            }
            return nodes;
        }
    }  // namespace

    SearchTrace traceSearch(const ScenarioPlanner &planner, const PlannerParameters &parameters,
                            const PlanLimits &limits, std::size_t maxNodes)
    {
        checkParameters(parameters);
        const search::PlanRequest request = planner.request(parameters);
        const std::unique_ptr<search::MotionEnvironment> environment = planner.environment(parameters);
        search::PathPlanner path;
        path.begin(*environment, parameters, request.car);
        SearchTrace trace;
        bool anyStart = false, anyGoal = false;
        for (const Pose &pose : request.starts)
            if (environment->isFree(pose))
            {
                path.addStart(pose);
                anyStart = true;
            }
        for (const Pose &pose : request.goals)
            if (environment->isFree(pose))
            {
                path.addGoal(pose);
                anyGoal = true;
            }
        if (!anyStart || !anyGoal)
            return trace;
        const auto &start = std::as_const(path).search().frontier(search::Side::Start);
        const auto &goal = std::as_const(path).search().frontier(search::Side::Goal);
        const auto note = [&]
        {
            TraceStep step;
            step.expanded = path.statistics().expanded;
            step.start = static_cast<std::uint32_t>(start.nodes().size());
            step.goal = static_cast<std::uint32_t>(goal.nodes().size());
            step.solved = path.hasSolution() || !path.search().bestPath().pieces.empty();
            if (trace.steps.empty() || trace.steps.back().expanded != step.expanded)
                trace.steps.push_back(step);
            else
                trace.steps.back() = step;
            return start.nodes().size() + goal.nodes().size() >= maxNodes;
        };
        const Stopwatch watch;
        path.solve([&]
                   { return note() || watch.seconds() > limits.time || (limits.interrupted && limits.interrupted()); },
                   limits.improved);
        note();
        trace.start = nodesOf(start);
        trace.goal = nodesOf(goal);
        return trace;
    }
}  // namespace parking

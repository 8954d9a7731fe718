// What ImprovedAStar does with its searches: runs them, and hands OMPL what they found.

#include "ompl_improved_astar/ImprovedAStarQuery.h"
#include "parking_geometry/smoothing/BsplineSmoother.h"

#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/PlannerData.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/util/Console.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace ob = ompl::base;

namespace ompl::geometric
{
    namespace
    {
        using parking::Path;
        using parking::Pose;
        using parking::search::GridSearch;

        constexpr unsigned int STATES_BETWEEN_STOPS = 8;  // while smoothing

        bool isSamePose(const Pose &pose, const ob::State *state)
        {
            const Pose other = parking::poseOf(state);
            return pose.x == other.x && pose.y == other.y && std::abs(parking::wrapAngle(pose.yaw - other.yaw)) < 1e-12;
        }
    }  // namespace

    ob::Cost ImprovedAStar::costOf(const ob::PathPtr &path) const
    {
        // Not stored in the problem definition, where it would change what other planners do with it.
        if (const ob::OptimizationObjectivePtr &objective = pdef_->getOptimizationObjective())
            return path->cost(objective);
        return ob::Cost(path->length());
    }

    ob::PlannerStatus ImprovedAStar::solveCar(const ob::PlannerTerminationCondition &ptc)
    {
        const parking::StateSpacing spacing = query_->stateSpacing();
        const auto stop = [this, &ptc]
        {
            expanded_.store(query_->car.statistics().expanded, std::memory_order_relaxed);
            return ptc();
        };
        const ob::OptimizationObjectivePtr objective = pdef_->getOptimizationObjective();
        const auto improved = [&](const Path &arcs, double)
        {
            auto path = std::make_shared<PathGeometric>(si_);
            std::vector<const ob::State *> states;
            ob::ScopedState<> state(si_);
            for (const Pose &pose : parking::pathStates(arcs, spacing))
            {
                parking::setPose(state.get(), pose);
                path->append(state.get());
            }
            const ob::Cost cost = costOf(path);
            if (query_->hasArcs && !(objective ? objective->isCostBetterThan(cost, query_->bestCost)
                                               : cost.value() < query_->bestCost.value()))
                return false;
            query_->hasArcs = true;
            query_->bestArcs = arcs;
            query_->bestCost = cost;
            query_->objective = objective;
            bestCost_.store(cost.value(), std::memory_order_relaxed);
            if (const ob::ReportIntermediateSolutionFn &report = pdef_->getIntermediateSolutionCallback())
            {
                // Goal first, without the ends, as OMPL's planners do.
                for (std::size_t i = path->getStateCount(); i-- > 0;)
                    states.push_back(path->getState(i));
                report(this, states, cost);
            }
            return objective && objective->isSatisfied(cost);
        };
        if (!query_->goals.empty())
            query_->car.solve(stop, improved);
        expanded_ = query_->car.statistics().expanded;
        if (query_->hasArcs)
            return report(parking::pathStates(query_->bestArcs, spacing), false);
        Path nearest;
        const Pose target = query_->goals.empty() ? *query_->fallbackTarget : query_->goals.front();
        if (parameters_.approximate && query_->car.approximate(target, stop, nearest))
        {
            std::vector<Pose> poses = parking::pathStates(nearest, spacing);
            // Up to where the motion validator agrees. With a checker that takes long there is no time for that once
            // the planner has been told to stop.
            if (query_->footprintEnvironment || !ptc)
                for (std::size_t i = 1; i < poses.size(); ++i)
                    if (!query_->stateEnvironment->isMotionFree(poses[i - 1], poses[i]))
                        poses.resize(i);
            return report(poses, true);
        }
        return ob::PlannerStatus::TIMEOUT;
    }

    ob::PlannerStatus ImprovedAStar::solveGrid(const ob::PlannerTerminationCondition &ptc)
    {
        GridSearch &grid = query_->grid;
        const Pose target = query_->goals.empty() ? *query_->fallbackTarget : query_->goals.front();
        grid.setTarget(target.x, target.y);
        if (!query_->gridDone)
        {
            const GridSearch::Outcome outcome = grid.run(
                [this, &ptc]
                {
                    expanded_.store(query_->grid.statistics().expanded, std::memory_order_relaxed);
                    return ptc();
                });
            query_->gridDone = outcome == GridSearch::Outcome::Found;
        }
        expanded_ = grid.statistics().expanded;
        if (query_->gridDone)
            return report(smoothed(grid.path(), ptc), false);
        if (parameters_.approximate)
            if (const std::vector<Pose> poses = grid.nearestPath(target.x, target.y); !poses.empty())
                return report(smoothed(poses, ptc), true);
        return ob::PlannerStatus::TIMEOUT;
    }

    std::vector<Pose> ImprovedAStar::smoothed(const std::vector<Pose> &poses,
                                              const ob::PlannerTerminationCondition &ptc) const
    {
        if (parameters_.smoothing == "none" || ptc)
            return poses;
        std::vector<Eigen::Vector2d> points;
        for (const Pose &pose : poses)
            if (points.empty() || (points.back() - Eigen::Vector2d(pose.x, pose.y)).norm() > 1e-9)
                points.emplace_back(pose.x, pose.y);
        if (points.size() < 3)
            return poses;
        parking::FootprintQueries world;
        world.isFree = [this, &ptc, asked = 0u, stopped = false](const Pose &pose) mutable
        {
            stopped = stopped || (++asked % STATES_BETWEEN_STOPS == 0 && ptc);
            return !stopped && query_->stateEnvironment->isFree(pose);
        };
        parking::BsplineOptions options;
        options.maxCurvature = 1.0 / parameters_.turningRadius;
        // Between control points so far apart a turn to the next neighbour's direction just keeps the radius.
        double length = 0.0;
        for (std::size_t i = 1; i < points.size(); ++i)
            length += (points[i] - points[i - 1]).norm();
        const double spacing = length / static_cast<double>(points.size() - 1);
        const std::size_t usual = options.sampling;
        options.sampling = std::max(usual, static_cast<std::size_t>(std::ceil(parameters_.turningRadius / spacing)));
        parking::BsplineResult smooth = parking::bsplineSmooth(points, options, parking::Vehicle(), world);
        if (smooth.polylineSpans > 0 && options.sampling > usual)
        {
            options.sampling = usual;
            parking::BsplineResult closer = parking::bsplineSmooth(points, options, parking::Vehicle(), world);
            if (closer.polylineSpans * smooth.spans < smooth.polylineSpans * closer.spans)
                smooth = std::move(closer);
        }
        std::vector<Pose> result{poses.front()};
        for (const parking::PathState &state : smooth.path.sample(0.5 * options.step))
            result.push_back(state.pose);
        // It ends where the path does, up to rounding; what is left is to turn.
        result.back().x = poses.back().x;
        result.back().y = poses.back().y;
        result.push_back(poses.back());
        // The spline was checked at its states; the motion validator has the last word.
        for (std::size_t i = 1; i < result.size(); ++i)
            if (ptc || !query_->stateEnvironment->isMotionFree(result[i - 1], result[i]))
                return poses;
        return result;
    }

    ob::PlannerStatus ImprovedAStar::report(const std::vector<Pose> &poses, bool approximate)
    {
        auto path = std::make_shared<PathGeometric>(si_);
        ob::ScopedState<> state(si_);
        for (const Pose &pose : poses)
        {
            parking::setPose(state.get(), pose);
            path->append(state.get());
        }
        if (!approximate)
        {
            // The exact goal; the path ends there up to rounding.
            const Pose &end = poses.back();
            const auto off = [&end](const Pose &goal)
            {
                return std::hypot(goal.x - end.x, goal.y - end.y) + std::abs(parking::wrapAngle(goal.yaw - end.yaw));
            };
            const auto goal = std::min_element(query_->goals.begin(), query_->goals.end(),
                                               [&off](const Pose &a, const Pose &b) { return off(a) < off(b); });
            if (path->getStateCount() == 1)
                path->append(path->getState(0));
            parking::setPose(path->getState(path->getStateCount() - 1), *goal);
        }
        query_->solution.clear();
        for (std::size_t i = 0; i < path->getStateCount() && !approximate; ++i)
            query_->solution.push_back(parking::poseOf(path->getState(i)));
        if (!approximate && !query_->isCar())
            bestCost_ = costOf(path).value();
        double difference = 0.0;
        if (approximate)
            pdef_->getGoal()->isSatisfied(path->getState(path->getStateCount() - 1), &difference);
        ob::PlannerSolution solution(path);
        solution.setPlannerName(getName());
        if (approximate)
            solution.setApproximate(difference);
        if (const ob::OptimizationObjectivePtr objective = pdef_->getOptimizationObjective())
        {
            // Of the car's path it is known already, and takes its time on a curve space.
            const bool known = !approximate && query_->isCar() && query_->objective == objective;
            const ob::Cost cost = known ? query_->bestCost : path->cost(objective);
            solution.setOptimized(objective, cost, !approximate && objective->isSatisfied(cost));
        }
        pdef_->addSolutionPath(solution);
        OMPL_DEBUG("%s: %s path of %zu states after %llu expansions", getName().c_str(),
                   approximate ? "approximate" : "exact", path->getStateCount(),
                   static_cast<unsigned long long>(expanded_.load()));
        return approximate ? ob::PlannerStatus::APPROXIMATE_SOLUTION : ob::PlannerStatus::EXACT_SOLUTION;
    }

    void ImprovedAStar::getPlannerData(ob::PlannerData &data) const
    {
        Planner::getPlannerData(data);
        if (!query_->begun)
            return;
        // Nodes may be cheaper ones in the place of others, so that a parent may come after its child.
        struct Node
        {
            ob::State *state;
            std::uint32_t parent;
        };
        std::vector<Node> trees[2];
        const auto visit = [&](const Pose &pose, std::uint32_t parent, std::uint32_t index, bool fromStart)
        {
            std::vector<Node> &tree = trees[fromStart ? 0 : 1];
            if (tree.size() <= index)
                tree.resize(index + 1, {nullptr, GridSearch::NO_NODE});
            tree[index] = {query_->dataState(fromStart ? 0 : 1, index, pose), parent};
        };
        query_->isCar() ? query_->car.search().forEachNode(visit) : query_->grid.forEachNode(visit);

        ob::State *ends[2] = {nullptr, nullptr};
        for (int side = 0; side < 2; ++side)
            for (const Node &node : trees[side])
            {
                if (node.state == nullptr)
                    continue;
                const ob::PlannerDataVertex vertex(node.state, side + 1);
                if (node.parent == GridSearch::NO_NODE)
                {
                    side == 0 ? data.addStartVertex(vertex) : data.addGoalVertex(vertex);
                    const std::vector<Pose> &solution = query_->solution;
                    if (!solution.empty() && isSamePose(side == 0 ? solution.front() : solution.back(), node.state))
                        ends[side] = node.state;
                    continue;
                }
                const ob::PlannerDataVertex parent(trees[side][node.parent].state, side + 1);
                side == 0 ? data.addEdge(parent, vertex) : data.addEdge(vertex, parent);
            }
        // The solution itself, whose curves are in neither tree.
        if (ends[0] == nullptr || ends[1] == nullptr)
            return;
        for (std::size_t i = 1; i < query_->solution.size(); ++i)
        {
            const bool last = i + 1 == query_->solution.size();
            ob::State *next = last ? ends[1] : query_->dataState(2, i, query_->solution[i]);
            data.addEdge(ob::PlannerDataVertex(ends[0]), ob::PlannerDataVertex(next));
            ends[0] = next;
        }
    }
}  // namespace ompl::geometric

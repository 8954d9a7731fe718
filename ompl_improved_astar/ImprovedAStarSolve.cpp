// What ImprovedAStar does with its searches: runs them, and hands OMPL what they found.

#include "ompl_improved_astar/ImprovedAStarQuery.h"
#include "ompl_improved_astar/search/planning/GridSmoothing.h"
#include "state_validity/ompl/OmplCompatibility.h"

#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/PlannerData.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/util/Console.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace ob = ompl::base;

namespace ompl::geometric
{
    namespace
    {
        using parking::Path;
        using parking::Pose;
        using parking::search::PlanOutcome;

        /** Metres and radians. */
        constexpr double SAME_POSE = 1e-12;
        /** Turning radii: what ends nearer to a goal ends there, but for rounding. */
        constexpr double AT_GOAL = 1e-3;

        /** Metres and radians in one sum. */
        double deviation(const Pose &a, const Pose &b)
        {
            return parking::positionDistance(a, b) + std::abs(parking::wrapAngle(a.yaw - b.yaw));
        }
    }  // namespace

    Path ImprovedAStar::smoothed(const Path &path, const ob::PlannerTerminationCondition &ptc) const
    {
        Path result = path;
        if (query_->turnsOnTheSpot && parameters_.smoothing == "bspline")
            parking::search::smoothGridPath(result, *query_->stateEnvironment, query_->car.turningRadius,
                                            [&ptc] { return ptc(); });
        return result;
    }

    std::shared_ptr<PathGeometric> ImprovedAStar::geometricPath(const std::vector<Pose> &poses) const
    {
        auto path = std::make_shared<PathGeometric>(si_);
        ob::ScopedState<> state(si_);
        for (const Pose &pose : poses)
        {
            parking::setPose(state.get(), pose);
            path->append(state.get());
        }
        return path;
    }

    ob::Cost ImprovedAStar::costOf(const Path &path, const PathGeometric &geometric, double closeness) const
    {
        if (const ob::OptimizationObjectivePtr objective = pdef_->getOptimizationObjective())
            return geometric.cost(objective);
        // Without an objective of the problem's, room to the obstacles counts as the parameters say. No objective is
        // stored in the problem definition, where it would change what other planners do with it. On a curve space OMPL
        // would look for each piece's shortest curve to find out what is known here.
        const double length = query_->isPlain() ? geometric.length() : path.length();
        return ob::Cost(length + closeness);
    }

    void ImprovedAStar::priceAnew()
    {
        if (!query_->hasSolution || query_->objective == pdef_->getOptimizationObjective())
            return;
        query_->objective = pdef_->getOptimizationObjective();
        query_->bestCost = costOf(query_->path, *geometricPath(query_->states), query_->closeness);
        bestCost_.store(query_->bestCost.value(), std::memory_order_relaxed);
    }

    bool ImprovedAStar::takeImprovement(const Path &found, double plannedCost,
                                        const ob::PlannerTerminationCondition &ptc)
    {
        const ob::OptimizationObjectivePtr objective = pdef_->getOptimizationObjective();
        const Path path = smoothed(found, ptc);
        const std::vector<Pose> states = parking::pathStates(path, query_->stateSpacing());
        const std::shared_ptr<PathGeometric> geometric = geometricPath(states);
        const double closeness = query_->planner.proximityOfBest();
        const ob::Cost cost = costOf(path, *geometric, closeness);
        if (query_->hasSolution && !(objective ? objective->isCostBetterThan(cost, query_->bestCost)
                                               : cost.value() < query_->bestCost.value()))
            return false;
        query_->hasSolution = true;
        query_->path = path;
        query_->plannedCost = plannedCost;
        query_->closeness = closeness;
        query_->states = states;
        query_->bestCost = cost;
        query_->objective = objective;
        bestCost_.store(cost.value(), std::memory_order_relaxed);
        if (const ob::ReportIntermediateSolutionFn &report = pdef_->getIntermediateSolutionCallback())
        {
            // Goal first, without the ends, as OMPL's planners do.
            std::vector<const ob::State *> reported;
            for (std::size_t i = geometric->getStateCount(); i-- > 0;)
                reported.push_back(geometric->getState(i));
            report(this, reported, cost);
        }
        return objective && objective->isSatisfied(cost);
    }

    ob::PlannerStatus ImprovedAStar::search(const ob::PlannerTerminationCondition &ptc)
    {
        const auto stop = [this, &ptc]
        {
            expanded_.store(query_->planner.expanded(), std::memory_order_relaxed);
            return ptc();
        };
        const auto improved = [this, &ptc](const Path &path, double cost)
        {
            return takeImprovement(path, cost, ptc);
        };
        using Outcome = parking::search::PathPlanner::Outcome;
        Outcome outcome = query_->goals.empty() ? Outcome::Stopped : query_->planner.solve(stop, improved);
        // That one goal cannot be reached says nothing of those that nobody has asked for yet.
        while (outcome == Outcome::Exhausted && readAnotherGoal(ptc))
            outcome = query_->planner.solve(stop, improved);
        if (outcome == Outcome::Exhausted && mayHaveOtherGoals())
            query_->reason = "none of the " + std::to_string(query_->goals.size()) +
                             " goals that were sampled can be reached; others may be";
        else if (outcome == Outcome::Exhausted)
        {
            query_->outcome = PlanOutcome::Infeasible;
            query_->reason = parking::search::reasonOf(query_->planner.search().exhaustion(), query_->car);
        }
        else if (query_->planner.search().isFull())
            query_->reason = parking::search::outOfMemory(parameters_);
        expanded_ = query_->planner.expanded();
        if (query_->hasSolution)
        {
            query_->outcome = PlanOutcome::Solved;
            query_->reason.clear();
            return report(query_->states, false);
        }
        if (parameters_.approximate)
            if (const ob::PlannerStatus status = approach(ptc, stop))
                return status;
        return query_->outcome == PlanOutcome::Infeasible
                   ? parking::ompl_compatibility::infeasible<ob::PlannerStatus>(0)
                   : ob::PlannerStatus(ob::PlannerStatus::TIMEOUT);
    }

    ob::PlannerStatus ImprovedAStar::approach(const ob::PlannerTerminationCondition &ptc,
                                              const parking::search::StopFunction &stop)
    {
        Path nearest;
        const Pose target = query_->goals.empty() ? *query_->fallbackTarget : query_->goals.front();
        const bool hasPath = query_->planner.approximate(target, stop, nearest);
        expanded_ = query_->planner.expanded();
        if (!hasPath)
            return ob::PlannerStatus::TIMEOUT;
        std::vector<Pose> states = parking::pathStates(smoothed(nearest, ptc), query_->stateSpacing());
        // Up to where the motion validator agrees. With a checker that takes long there is no time for that once the
        // planner has been told to stop.
        if (!query_->turnsOnTheSpot && (query_->footprintEnvironment || !ptc))
            for (std::size_t i = 1; i < states.size(); ++i)
                if (!query_->stateEnvironment->isMotionFree(states[i - 1], states[i]))
                    states.resize(i);
        if (query_->outcome == PlanOutcome::Timeout)
            query_->outcome = PlanOutcome::Approximate;
        return report(states, true);
    }

    double ImprovedAStar::differenceFromGoal(const ob::State *state) const
    {
        double difference = std::numeric_limits<double>::infinity();
        const ob::Goal &goal = *pdef_->getGoal();
        if (!goal.hasType(ob::GOAL_STATE) && !goal.hasType(ob::GOAL_STATES))
        {
            goal.isSatisfied(state, &difference);
            return difference;
        }
        // Asked itself, the goal would measure the distance to all of its states, at which OMPL ends the program where
        // one is out of bounds. A yaw of just pi is.
        const std::vector<Pose> targets =
            query_->goals.empty() ? std::vector<Pose>{*query_->fallbackTarget} : query_->goals;
        ob::ScopedState<> target(si_);
        for (const Pose &pose : targets)
        {
            parking::setPose(target.get(), pose);
            si_->enforceBounds(target.get());
            difference = std::min(difference, si_->distance(state, target.get()));
        }
        return difference;
    }

    bool ImprovedAStar::isAtGoal(const Pose &pose) const
    {
        return std::any_of(query_->goals.begin(), query_->goals.end(),
                           [&](const Pose &goal) { return deviation(goal, pose) < AT_GOAL * query_->turningRadius(); });
    }

    void ImprovedAStar::endAtGoal(std::vector<Pose> &poses) const
    {
        // The exact goal; the path ends there up to rounding.
        const Pose end = poses.back();
        const Pose goal =
            *std::min_element(query_->goals.begin(), query_->goals.end(),
                              [&end](const Pose &a, const Pose &b) { return deviation(a, end) < deviation(b, end); });
        if (poses.size() == 1)
            poses.push_back(end);
        // Turns on the spot there begin at the same place. (Of a car's path the last piece may be as short, but OMPL
        // must not take it for a turn on the spot.)
        for (std::size_t i = poses.size();
             i-- > 1 && query_->turnsOnTheSpot && positionDistance(poses[i], goal) <= 1e-6;)
            poses[i] = {goal.x, goal.y, poses[i].yaw};
        poses.back() = goal;
        // With the last digits of another end.
        poses = parking::straightened(std::move(poses), *query_->space);
    }

    ob::PlannerStatus ImprovedAStar::report(std::vector<Pose> poses, bool approximate)
    {
        if (!approximate)
            endAtGoal(poses);
        const std::shared_ptr<PathGeometric> path = geometricPath(poses);
        query_->solution.clear();
        if (!approximate)
            query_->solution = std::move(poses);
        double difference = 0.0;
        if (approximate)
            difference = differenceFromGoal(path->getState(path->getStateCount() - 1));
        // OMPL would look for each piece's shortest curve to find out the length, which is known here.
        ob::PlannerSolution solution(nullptr);
        solution.path_ = path;
        solution.length_ = approximate || query_->isPlain() ? path->length() : query_->path.length();
        solution.setPlannerName(getName());
        if (approximate)
            solution.setApproximate(difference);
        if (const ob::OptimizationObjectivePtr objective = pdef_->getOptimizationObjective())
        {
            // Of a solution it is known already, and takes its time on a curve space.
            const bool known = !approximate && query_->objective == objective;
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
        std::vector<Node> frontiers[2];
        for (const std::size_t side : {std::size_t{0}, std::size_t{1}})
        {
            const parking::search::Search &search = std::as_const(query_->planner).search();
            const auto &nodes =
                search.frontier(side == 0 ? parking::search::Side::Start : parking::search::Side::Goal).nodes();
            for (std::size_t i = 0; i < nodes.size(); ++i)
                frontiers[side].push_back({query_->dataState(side, i, nodes[i].pose), nodes[i].parent});
        }

        ob::State *ends[2] = {nullptr, nullptr};
        for (int side = 0; side < 2; ++side)
            for (const Node &node : frontiers[side])
            {
                if (node.state == nullptr)
                    continue;
                const ob::PlannerDataVertex vertex(node.state, side + 1);
                if (node.parent == parking::search::NO_NODE)
                {
                    side == 0 ? data.addStartVertex(vertex) : data.addGoalVertex(vertex);
                    const std::vector<Pose> &solution = query_->solution;
                    if (!solution.empty() && parking::isSamePose(side == 0 ? solution.front() : solution.back(),
                                                                 parking::poseOf(node.state), SAME_POSE))
                        ends[side] = node.state;
                    continue;
                }
                const ob::PlannerDataVertex parent(frontiers[side][node.parent].state, side + 1);
                side == 0 ? data.addEdge(parent, vertex) : data.addEdge(vertex, parent);
            }
        // The solution itself, whose curves are in neither frontier.
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

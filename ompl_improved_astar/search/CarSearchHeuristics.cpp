// What the nodes of a search are worth, and what follows from it.

#include "ompl_improved_astar/search/CarSearch.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

namespace parking::search
{
    namespace
    {
        constexpr double INFINITE = std::numeric_limits<double>::infinity();
        // Side of a cell of the obstacle-aware heuristic in turning radii; for long ways, straight, in parts of them,
        // but then no more than so many times coarser.
        constexpr double HEURISTIC_CELL = 1.0 / 6.0;
        constexpr double CELL_OF_LONG_WAYS = 1.0 / 120.0;
        constexpr double COARSEST_CELL = 3.0;
    }  // namespace

    void CarSearch::prepareHeuristics()
    {
        for (int side = 0; side < 2; ++side)
            measureMobility(side);
        // The more confined side is the harder one to get away from. When there is little in it that is the goal's.
        confined_ = trees_[1].rootMobility <= trees_[0].rootMobility + 0.5 * reach_ ? 1 : 0;
        if (!parameters_.bidirectional)
            confined_ = parameters_.searchFromGoal && !trees_[1].roots.empty() ? 1 : 0;
        if (hasTarget_)
            aimAtTarget();
        else
            guideRoundObstacles();
        prepared_ = true;
        provenUnreachable_ = isProvenUnreachable();
        for (int side = 0; side < 2; ++side)
            prepareNodes(side);
    }

    void CarSearch::measureMobility(int side)
    {
        Tree &tree = trees_[side];
        for (const std::uint32_t root : tree.roots)
        {
            const Node &node = tree.nodes[root];
            if (node.queued)
                continue;
            motions_.clear();
            for (const double steer : {-1.0, 0.0, 1.0})
                for (const double gear : {-1.0, 1.0})
                    motions_.push_back({steer / parameters_.turningRadius, gear * steps_[0]});
            free_.resize(motions_.size());
            environment_->freeLengths(node.pose, motions_.data(), motions_.size(), free_.data());
            tree.rootMobility = std::min(tree.rootMobility, std::accumulate(free_.begin(), free_.end(), 0.0));
        }
    }

    void CarSearch::guideRoundObstacles()
    {
        // Of the side that gets most of the turns only: flooding the map from the other end, too, would cost more than
        // it spares.
        aroundObstacles_ = {false, false};
        const Tree &tree = trees_[confined_], &targets = trees_[1 - confined_];
        if (targets.roots.empty() || !parameters_.obstacleHeuristic)
            return;
        const Pose &toward =
            tree.roots.empty() ? targets.nodes[targets.roots.front()].pose : tree.nodes[tree.roots.front()].pose;
        resetObstacleHeuristic(confined_, toward);
        for (const std::uint32_t root : targets.roots)
            obstacleHeuristics_[confined_].addTarget(targets.nodes[root].pose.x, targets.nodes[root].pose.y);
    }

    double CarSearch::heuristicCell(int side) const
    {
        double farthest = 0.0;
        for (const std::uint32_t root : trees_[side].roots)
            for (const Pose &target : curveHeuristics_[side].targets())
            {
                const Pose &pose = trees_[side].nodes[root].pose;
                farthest = std::max(farthest, std::hypot(pose.x - target.x, pose.y - target.y));
            }
        const double cell = HEURISTIC_CELL * parameters_.turningRadius;
        return std::clamp(CELL_OF_LONG_WAYS * farthest, cell, COARSEST_CELL * cell);
    }

    void CarSearch::resetObstacleHeuristic(int side, const Pose &toward)
    {
        ObstacleHeuristic &heuristic = obstacleHeuristics_[side];
        aroundObstacles_[side] = true;
        heuristicCells_[side] = heuristicCell(side);
        heuristic.reset(*environment_, heuristicCells_[side], parameters_.inscribedRadius,
                        Eigen::Vector2d(toward.x, toward.y));
        if (!parameters_.eagerObstacles)
            return;
        const auto begin = std::chrono::steady_clock::now();
        heuristic.load(parameters_.low, parameters_.high, stop_);
        loadingTime_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }

    void CarSearch::aimAtTarget()
    {
        const Tree &tree = trees_[0];
        if (tree.roots.empty() || !parameters_.obstacleHeuristic)
            return;
        // Flooding from the starts finds the place to make for; the way there is then counted from that place.
        resetObstacleHeuristic(1, target_);
        for (const std::uint32_t root : tree.roots)
            obstacleHeuristics_[1].addTarget(tree.nodes[root].pose.x, tree.nodes[root].pose.y);
        const Eigen::Vector2d place = obstacleHeuristics_[1].nearestReachable({target_.x, target_.y}, stop_);
        resetObstacleHeuristic(0, tree.nodes[tree.roots.front()].pose);
        obstacleHeuristics_[0].addTarget(place.x(), place.y());
    }

    bool CarSearch::isProvenUnreachable()
    {
        // A disc inside of the car finds no way round the obstacles: neither will the car.
        const Tree &tree = trees_[confined_];
        if (!aroundObstacles_[confined_] || hasTarget_ || tree.roots.empty())
            return false;
        for (const std::uint32_t root : tree.roots)
        {
            const Pose &pose = tree.nodes[root].pose;
            if (obstacleHeuristics_[confined_].distance(pose.x, pose.y, stop_) < INFINITE || (stop_ && stop_()))
                return false;
        }
        return true;
    }

    void CarSearch::prepareNodes(int side)
    {
        Tree &tree = trees_[side];
        // Roots added later change what the nodes of the other tree are worth.
        if (tree.nodes.size() > tree.roots.size())
        {
            for (Node &node : tree.nodes)
                node.h = static_cast<float>(heuristic(side, node.pose));
            rekey(side);
        }
        for (const std::uint32_t root : tree.roots)
        {
            Node &node = tree.nodes[root];
            if (node.queued)
                continue;
            node.queued = true;
            node.h = static_cast<float>(heuristic(side, node.pose));
            tree.cells.set(cellKey(node.pose, 0), root);
            push(side, 0, root);
        }
    }

    double CarSearch::heuristic(int side, const Pose &pose)
    {
        if (hasTarget_)
        {
            const double straight = std::hypot(pose.x - target_.x, pose.y - target_.y);
            const double way = aroundObstacles_[0] ? obstacleHeuristics_[0].distance(pose.x, pose.y, stop_) : 0.0;
            return way < INFINITE ? std::max(straight, way) : straight;
        }
        double h = curveHeuristics_[side].approximate(pose);
        if (aroundObstacles_[side])
        {
            const double way = obstacleHeuristics_[side].distance(pose.x, pose.y, stop_);
            if (way < INFINITE)
                h = std::max(h, way - heuristicCells_[side]);
        }
        return h;
    }

    double CarSearch::admissibleHeuristic(int side, const Pose &pose)
    {
        double h = curveHeuristics_[side].exact(pose);
        if (aroundObstacles_[side])
            h = std::max(h, obstacleHeuristics_[side].lowerBound(pose.x, pose.y, {}));  // after run(), without its stop
        return h;
    }

    double CarSearch::priority(int side, const Node &node) const
    {
        if (hasTarget_)
            return node.g + parameters_.weights.at(node.h) * node.h;
        double nearest = INFINITE;
        for (const Pose &target : curveHeuristics_[side].targets())
            nearest = std::min(nearest, std::hypot(node.pose.x - target.x, node.pose.y - target.y));
        return node.g + parameters_.weights.at(nearest) * node.h;
    }

    void CarSearch::rekey(int side)
    {
        for (OpenList &list : trees_[side].open)
            list.rekey(
                [this, side](OpenList::Entry &entry)
                {
                    const Node &node = trees_[side].nodes[entry.node];
                    entry.f = priority(side, node);
                    return node.g + node.h < costBound_;
                });
    }

    void CarSearch::setWeights(const HeuristicWeights &weights)
    {
        parameters_.weights = weights;
        for (int side = 0; side < 2; ++side)
            rekey(side);
    }

    double CarSearch::lowerBound()
    {
        double bound = 0.0;
        for (int side = 0; side < 2; ++side)
        {
            double smallest = INFINITE;
            for (const OpenList &list : trees_[side].open)
                for (const OpenList::Entry &entry : list.entries())
                {
                    const Node &node = trees_[side].nodes[entry.node];
                    smallest = std::min(smallest, node.g + admissibleHeuristic(side, node.pose));
                }
            if (smallest < INFINITE)
                bound = std::max(bound, smallest);
        }
        return std::min(bound, costBound_);
    }
}  // namespace parking::search

// Joining the two trees by curves, and reading paths off them.

#include "ompl_improved_astar/search/CarSearch.h"

#include <algorithm>
#include <cmath>

namespace parking::search
{
    namespace
    {
        // Curves from a node that can move less than this part of their length hardly ever get away.
        constexpr double CONFINED = 0.15;
        constexpr double INFINITE = std::numeric_limits<double>::infinity();
    }  // namespace

    void CarSearch::connectAround(int side, std::uint32_t index)
    {
        const Node &node = trees_[side].nodes[index];
        if (node.mobility < CONFINED * std::min<double>(node.h, 2.0 * reach_))
            return;
        const Tree &other = trees_[1 - side];
        for (const std::uint32_t root : other.roots)
            side == 0 ? connect(index, root, CurveEnd::Start) : connect(root, index, CurveEnd::Goal);
        if (parameters_.bidirectional && other.bestClosed != NO_NODE && other.nodes[other.bestClosed].parent != NO_NODE)
            side == 0 ? connect(index, other.bestClosed, CurveEnd::Start)
                      : connect(other.bestClosed, index, CurveEnd::Goal);
    }

    bool CarSearch::connect(std::uint32_t fromStart, std::uint32_t fromGoal, CurveEnd sweptFrom)
    {
        const Node &a = trees_[0].nodes[fromStart], &b = trees_[1].nodes[fromGoal];
        const double before = a.g + b.g;
        if (before >= costBound_)
            return false;
        ++statistics_.connections;
        curves_.candidates(a.pose, b.pose, candidates_, costBound_ - before);
        const CostModel &cost = parameters_.cost;
        order_.clear();
        for (std::size_t i = 0; i < candidates_.size(); ++i)
        {
            const ReedsSheppCurve &curve = candidates_[i];
            double sum = before + curveCost(cost, a.pose, curve, *environment_);
            if (curve.count > 0 && a.parent != NO_NODE)
                sum += cost.join({a.curvature, a.length}, curve.pieces[0]);
            if (curve.count > 0 && b.parent != NO_NODE)
                sum += cost.join(curve.pieces[curve.count - 1], {b.curvature, -b.length});
            if (sum < costBound_)
                order_.emplace_back(sum, i);
        }
        std::sort(order_.begin(), order_.end());
        for (const auto &[sum, i] : order_)
        {
            if (!isCurveFree(*environment_, a.pose, candidates_[i], b.pose, sweptFrom))
                continue;
            Path path = pathFromStart(fromStart);
            for (std::size_t k = 0; k < candidates_[i].count; ++k)
                path.append(candidates_[i].pieces[k]);
            appendBranch(1, fromGoal, path);
            if (!environment_->acceptPath(path))
                continue;
            bestPath_ = std::move(path);
            bestCost_ = costBound_ = sum;
            improved_ = true;
            return true;
        }
        return false;
    }

    void CarSearch::appendBranch(int side, std::uint32_t index, Path &path) const
    {
        // From the node to its root, as the car drives on the goal's side.
        const Tree &tree = trees_[side];
        for (; tree.nodes[index].parent != NO_NODE; index = tree.nodes[index].parent)
            path.append({tree.nodes[index].curvature, -tree.nodes[index].length});
    }

    Path CarSearch::pathFromStart(std::uint32_t index) const
    {
        Path outward{trees_[0].nodes[index].pose, {}};
        appendBranch(0, index, outward);
        std::uint32_t root = index;
        while (trees_[0].nodes[root].parent != NO_NODE)
            root = trees_[0].nodes[root].parent;
        Path path = outward.reversed();
        path.start = trees_[0].nodes[root].pose;
        return path;
    }

    double CarSearch::shortestCurve() const
    {
        double shortest = INFINITE;
        for (const std::uint32_t root : trees_[0].roots)
            shortest = std::min(shortest, curveHeuristics_[0].exact(trees_[0].nodes[root].pose));
        return shortest;
    }

    double CarSearch::estimate() const
    {
        double least = INFINITE;
        for (const std::uint32_t root : trees_[confined_].roots)
            least = std::min<double>(least, trees_[confined_].nodes[root].h);
        return least;
    }

    bool CarSearch::nearestPath(const Pose &target, Path &path) const
    {
        std::uint32_t best = NO_NODE;
        double nearest = INFINITE;
        for (std::uint32_t i = 0; i < trees_[0].nodes.size(); ++i)
        {
            const Pose &pose = trees_[0].nodes[i].pose;
            const double distance = std::hypot(pose.x - target.x, pose.y - target.y);
            if (distance < nearest)
            {
                nearest = distance;
                best = i;
            }
        }
        if (best == NO_NODE)
            return false;
        path = pathFromStart(best);
        return true;
    }
}  // namespace parking::search

#include "ompl_improved_astar/search/CarSearch.h"

#include <algorithm>
#include <cmath>

namespace parking::search
{
    namespace
    {
        // In turning radii: how far a motion reaches, the step of the coarsest level, the shortest motion of use.
        constexpr double REACH = 4.0 / 3.0;
        constexpr double COARSEST_STEP = 2.0 / 3.0;
        constexpr double SHORTEST = 0.004;
        // Each finer level gets this many times fewer turns than the one before.
        constexpr double TURNS_RATIO = 8.0;
        // One expansion in so many goes to the side whose root is less confined.
        constexpr std::uint64_t OTHER_SIDE_PERIOD = 4;
        // A node cheaper by this part of its level's step than the one in its cell is worth keeping beside it.
        constexpr double WORTH = 0.3;
        // Expansions without progress after which a search that has little hope gives up.
        constexpr std::uint64_t PATIENCE = 3000;
        constexpr double LEAST_PROGRESS = 1e-3;  // metres
        constexpr double INFINITE = std::numeric_limits<double>::infinity();
    }  // namespace

    bool CarSearch::Tree::exhausted() const
    {
        return std::all_of(open.begin(), open.end(), [](const OpenList &list) { return list.empty(); });
    }

    CarSearch::CarSearch() : curveHeuristics_{CurveHeuristic(curves_), CurveHeuristic(curves_)}
    {
    }

    void CarSearch::begin(MotionEnvironment &environment, const CarParameters &parameters)
    {
        environment_ = &environment;
        parameters_ = parameters;
        parameters_.cost.fullLockCurvature = 1.0 / parameters.turningRadius;
        curves_ = ReedsShepp(parameters.turningRadius,
                             parameters.forwardOnly ? CurveFamily::Dubins : CurveFamily::ReedsShepp);
        const double radius = parameters.turningRadius;
        const double cellRatio = (parameters.xyResolution > 0.0 ? parameters.xyResolution : 0.1 * radius);
        reach_ = REACH * radius;
        shortest_ = SHORTEST * radius;
        for (int level = 0; level < LEVELS; ++level)
        {
            steps_[level] = COARSEST_STEP * radius * std::pow(0.5, level);
            // Cells are in proportion to the steps: xyResolution for a step of a metre (a third of the radius).
            const double scale = 3.0 * steps_[level] / radius;
            inverseCell_[level] = 1.0 / (cellRatio * scale);
            headingScale_[level] = std::max(8.0, parameters.headingBins / scale) / (2.0 * PI);
        }
        for (int side = 0; side < 2; ++side)
        {
            Tree &tree = trees_[side];
            tree.nodes.clear();
            tree.freeLengths.clear();
            tree.cells.clear();
            for (OpenList &list : tree.open)
                list = OpenList(parameters.openList);
            tree.turns.fill(0);
            tree.bestClosed = NO_NODE;
            tree.roots.clear();
            tree.rootMobility = INFINITE;
            tree.seenWhenExhausted = 0;
            curveHeuristics_[side].reset(side == 1);
            aroundObstacles_[side] = false;
        }
        confined_ = 1;
        prepared_ = false;
        provenUnreachable_ = false;
        hasTarget_ = false;
        nearest_ = INFINITE;
        nearestSince_ = 0;
        sideTurn_ = 0;
        bestCost_ = costBound_ = INFINITE;
        bestPath_ = {};
        improved_ = false;
        loadingTime_ = 0.0;
        statistics_ = {};
    }

    void CarSearch::addStart(const Pose &pose)
    {
        addRoot(0, pose);
    }

    void CarSearch::addGoal(const Pose &pose)
    {
        hasTarget_ = false;
        addRoot(1, pose);
    }

    void CarSearch::setTarget(const Pose &target)
    {
        hasTarget_ = true;
        target_ = target;
        prepared_ = false;
    }

    void CarSearch::addRoot(int side, const Pose &pose)
    {
        Tree &tree = trees_[side];
        Node node{};
        node.pose = pose;
        node.parent = NO_NODE;
        node.farthest = true;
        const auto index = static_cast<std::uint32_t>(tree.nodes.size());
        tree.nodes.push_back(node);
        tree.roots.push_back(index);
        // The other side's heuristic now has one more target; what it had computed no longer holds.
        curveHeuristics_[1 - side].addTarget(pose);
        prepared_ = false;
        if (!parameters_.analyticExpansion)
            return;
        for (const std::uint32_t other : trees_[1 - side].roots)
            side == 0 ? connect(index, other, CurveEnd::Goal) : connect(other, index, CurveEnd::Goal);
    }

    void CarSearch::push(int side, int level, std::uint32_t index)
    {
        const Node &node = trees_[side].nodes[index];
        trees_[side].open[level].push(priority(side, node), node.h, index);
    }

    std::uint64_t CarSearch::cellKey(const Pose &pose, int level) const
    {
        const double bins = headingScale_[level] * 2.0 * PI;
        const auto column = static_cast<std::int64_t>(std::floor(pose.x * inverseCell_[level]));
        const auto row = static_cast<std::int64_t>(std::floor(pose.y * inverseCell_[level]));
        const double turn = (wrapAngle(pose.yaw) + PI) * headingScale_[level];
        const auto heading = static_cast<std::int64_t>(turn < bins ? turn : 0.0);
        // 3 bits of level, 22 of column and row (tens of kilometres of the finest cells), 17 of heading.
        return (static_cast<std::uint64_t>(level + 1) << 61) | ((static_cast<std::uint64_t>(column) & 0x3fffff) << 39) |
               ((static_cast<std::uint64_t>(row) & 0x3fffff) << 17) | (static_cast<std::uint64_t>(heading) & 0x1ffff);
    }

    bool CarSearch::isHopeless() const
    {
        if (provenUnreachable_)
            return true;
        if (hasTarget_)
            return nearest_ <= LEAST_PROGRESS || statistics_.expanded > nearestSince_ + PATIENCE + nearestSince_ / 2;
        // With one side seen completely, the other gets as many expansions again: its curves may still reach a root
        // that this lattice cannot leave.
        if (hasSolution() || !parameters_.bidirectional)
            return false;
        for (const Tree &tree : trees_)
            if (tree.exhausted() && !tree.roots.empty())
                return statistics_.expanded > 2 * tree.seenWhenExhausted + PATIENCE;
        return false;
    }

    int CarSearch::chooseSide()
    {
        const bool empty[2] = {trees_[0].exhausted(), trees_[1].exhausted()};
        if (!parameters_.bidirectional)
            return empty[confined_] ? -1 : confined_;
        if (empty[0] && empty[1])
            return -1;
        // The more confined side gets most of the turns.
        const int side = ++sideTurn_ % OTHER_SIDE_PERIOD == 0 ? 1 - confined_ : confined_;
        return empty[side] ? 1 - side : side;
    }

    int CarSearch::chooseLevel(const Tree &tree) const
    {
        int best = -1;
        double fewest = INFINITE, ratio = 1.0;
        for (int level = 0; level < LEVELS; ++level, ratio *= TURNS_RATIO)
        {
            const double turns = static_cast<double>(tree.turns[level]) * ratio;
            if (!tree.open[level].empty() && turns < fewest)
            {
                fewest = turns;
                best = level;
            }
        }
        return best;
    }

    SearchOutcome CarSearch::run(const StopFunction &stop)
    {
        stop_ = stop;
        for (;;)
        {
            // Also what adding a root has found.
            if (improved_)
            {
                improved_ = false;
                return SearchOutcome::Improved;
            }
            if (stop && stop())
                return SearchOutcome::Stopped;
            if (!prepared_)
                prepareHeuristics();
            const int side = isHopeless() ? -1 : chooseSide();
            if (side < 0)
                return SearchOutcome::Exhausted;
            step(side, chooseLevel(trees_[side]));
        }
    }

    void CarSearch::step(int side, int level)
    {
        Tree &tree = trees_[side];
        const OpenList::Entry entry = tree.open[level].pop();
        Node &node = tree.nodes[entry.node];
        // Stale: the node has become cheaper since, or was expanded at this level already, or cannot help any more.
        if ((node.expanded && node.level == level) || node.g + node.h >= costBound_ ||
            entry.f > priority(side, node) + 1e-9)
            return;
        ++tree.turns[level];
        const bool first = !node.expanded;
        expand(side, entry.node, level);
        if (first && parameters_.analyticExpansion)
            connectAround(side, entry.node);
        if (first && environment_->wasInterrupted())
        {
            tree.nodes[entry.node].expanded = false;
            push(side, level, entry.node);
            return;
        }
        if (parameters_.adaptiveResolution && level + 1 < LEVELS)
            push(side, level + 1, entry.node);
        if (tree.exhausted())
            tree.seenWhenExhausted = statistics_.expanded;
    }

    void CarSearch::expand(int side, std::uint32_t index, int level)
    {
        Tree &tree = trees_[side];
        const Node node = tree.nodes[index];
        ++statistics_.expanded;
        tree.nodes[index].expanded = true;
        if (tree.bestClosed == NO_NODE || node.h < tree.nodes[tree.bestClosed].h)
            tree.bestClosed = index;

        const bool first = !node.expanded;
        collectMotions(side, node);
        const std::size_t count = motions_.size(), slots = 2 * parameters_.steeringAngles;
        if (tree.freeLengths.size() < (index + 1) * slots)
            tree.freeLengths.resize((index + 1) * slots);
        // How far each motion is free is found out once and serves the finer levels, too.
        float *const known = &tree.freeLengths[index * slots];
        const double step = steps_[level];
        if (!first)
        {
            for (std::size_t i = 0; i < count; ++i)
                if (static_cast<double>(known[i]) >= step)
                    addChild(side, index, motions_[i].curvature, std::copysign(step, motions_[i].length), false);
            return;
        }
        free_.resize(count);
        environment_->freeLengths(node.pose, motions_.data(), count, free_.data());
        double mobility = 0.0;
        for (std::size_t i = 0; i < count; ++i)
        {
            const auto &[curvature, reach] = motions_[i];
            const double free = free_[i];
            known[i] = std::nextafter(static_cast<float>(free), 0.0f);
            mobility = std::max(mobility, free);
            if (free < shortest_)
                continue;
            addChild(side, index, curvature, std::copysign(free, reach), free >= reach_);
            if (free > 1.1 * step)
                addChild(side, index, curvature, std::copysign(step, reach), false);
        }
        tree.nodes[index].mobility = static_cast<float>(mobility);
    }

    void CarSearch::collectMotions(int side, const Node &node)
    {
        motions_.clear();
        const int half = static_cast<int>(parameters_.steeringAngles / 2);
        for (int steer = -half; steer <= half; ++steer)
        {
            const double curvature = steer / (half * parameters_.turningRadius);
            for (const double gear : {1.0, -1.0})
            {
                // Roots of the goal's tree are left in the direction opposite to that in which the car arrives.
                if (parameters_.forwardOnly && gear != (side == 0 ? 1.0 : -1.0))
                    continue;
                // Back along the same arc leads nowhere new; on along it does only from where reach ended.
                if (node.parent != NO_NODE && curvature == node.curvature &&
                    (gear * node.length < 0.0 || !node.farthest))
                    continue;
                motions_.push_back({curvature, gear * reach_});
            }
        }
    }

    void CarSearch::addChild(int side, std::uint32_t parentIndex, double curvature, double length, bool farthest)
    {
        Tree &tree = trees_[side];
        const Node &parent = tree.nodes[parentIndex];
        ++statistics_.generated;
        const Arc arc{curvature, length};
        const Pose pose = advance(parent.pose, curvature, length);
        // On the goal's side the car will drive the arc the other way.
        double g = parent.g + (side == 0 ? parameters_.cost.drive(parent.pose, arc, *environment_)
                                         : parameters_.cost.drive(pose, {curvature, -length}, *environment_));
        if (parent.parent != NO_NODE)
            g += parameters_.cost.join({parent.curvature, parent.length}, arc);
        if (g >= costBound_)
            return;
        Node node{};
        node.pose = {pose.x, pose.y, wrapAngle(pose.yaw)};
        node.g = g;
        node.curvature = curvature;
        node.length = length;
        node.parent = parentIndex;
        node.farthest = farthest;

        for (int level = 0; level < LEVELS; ++level)
        {
            const std::uint64_t key = cellKey(node.pose, level);
            const std::uint32_t found = tree.cells.find(key);
            std::uint32_t target = static_cast<std::uint32_t>(tree.nodes.size());
            if (found != CellTable::NONE)
            {
                const Node &other = tree.nodes[found];
                if (other.g > g + 1e-9 && other.level == level && !other.expanded)
                    target = found;  // not yet expanded: simply replaced by the cheaper one
                else if (!(other.g > g + WORTH * steps_[level]))
                {
                    if (!parameters_.adaptiveResolution)
                        return;
                    continue;
                }
            }
            node.h = static_cast<float>(heuristic(side, node.pose));
            if (g + node.h >= costBound_)
                return;
            node.level = static_cast<std::uint8_t>(level);
            if (hasTarget_ && node.h < nearest_ - LEAST_PROGRESS)
            {
                nearest_ = node.h;
                nearestSince_ = statistics_.expanded;
            }
            if (target == tree.nodes.size())
                tree.nodes.push_back(node);
            else
                tree.nodes[target] = node;
            tree.cells.set(key, target);
            push(side, level, target);
            return;
        }
    }

    void CarSearch::setCostBound(double cost)
    {
        costBound_ = std::min(costBound_, cost);
    }

    const SearchStatistics &CarSearch::statistics() const
    {
        statistics_.heuristicCells = 0;
        for (int side = 0; side < 2; ++side)
            if (aroundObstacles_[side])
                statistics_.heuristicCells += obstacleHeuristics_[side].settledCells();
        return statistics_;
    }
}  // namespace parking::search

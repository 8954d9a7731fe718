#include "ompl_improved_astar/search/GridSearch.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace parking::search
{
    namespace
    {
        // Often, since a checker may take a tenth of a millisecond for each of the states that these ask for.
        constexpr std::int64_t CELLS_BETWEEN_STOPS = 8;

        struct Step
        {
            std::int32_t columns, rows;
        };

        // The eight neighbours in the order of their directions, then the knight's moves between them.
        constexpr Step STEPS[16] = {{1, 0}, {1, 1}, {0, 1},  {-1, 1}, {-1, 0},  {-1, -1}, {0, -1}, {1, -1},
                                    {2, 1}, {1, 2}, {-1, 2}, {-2, 1}, {-2, -1}, {-1, -2}, {1, -2}, {2, -1}};

        double distanceBetween(const Pose &a, const Pose &b)
        {
            return std::hypot(a.x - b.x, a.y - b.y);
        }
    }  // namespace

    void GridSearch::begin(GridEnvironment &environment, const GridParameters &parameters)
    {
        environment_ = &environment;
        parameters_ = parameters;
        const Eigen::Vector2d size = parameters.high - parameters.low;
        columns_ = static_cast<std::int32_t>(
            std::clamp(std::ceil(size.x() / parameters.resolution), 1.0, 2.0 * TiledGrid<Cell>::REACH));
        rows_ = static_cast<std::int32_t>(
            std::clamp(std::ceil(size.y() / parameters.resolution), 1.0, 2.0 * TiledGrid<Cell>::REACH));
        cells_.clear();
        nodes_.clear();
        for (int side = 0; side < 2; ++side)
        {
            open_[side] = OpenList(parameters.openList);
            roots_[side].clear();
            bestClosed_[side] = NO_NODE;
        }
        loaded_ = 0;
        loadingTime_ = 0.0;
        turn_ = false;
        unfinished_ = {0, NO_NODE, 0};
        path_.clear();
        statistics_ = {};
    }

    Pose GridSearch::centre(std::int32_t column, std::int32_t row) const
    {
        return {parameters_.low.x() + (column + 0.5) * parameters_.resolution,
                parameters_.low.y() + (row + 0.5) * parameters_.resolution, 0.0};
    }

    bool GridSearch::isAtCentre(const Node &node) const
    {
        const Pose middle = centre(node.column, node.row);
        return node.pose.x == middle.x && node.pose.y == middle.y;
    }

    void GridSearch::addStart(const Pose &pose)
    {
        addRoot(0, pose);
    }

    void GridSearch::addGoal(const Pose &pose)
    {
        addRoot(1, pose);
    }

    void GridSearch::setTarget(double x, double y)
    {
        target_ = {x, y};
    }

    void GridSearch::addRoot(int side, const Pose &pose)
    {
        const double u = (pose.x - parameters_.low.x()) / parameters_.resolution;
        const double v = (pose.y - parameters_.low.y()) / parameters_.resolution;
        const auto column = static_cast<std::int32_t>(std::clamp(std::floor(u), 0.0, columns_ - 1.0));
        const auto row = static_cast<std::int32_t>(std::clamp(std::floor(v), 0.0, rows_ - 1.0));
        Node node{pose, 0.0, 0.0, NO_NODE, column, row, static_cast<std::uint8_t>(side), false};
        const auto index = static_cast<std::uint32_t>(nodes_.size());
        nodes_.push_back(node);
        roots_[side].push_back(index);
        cells_.at(column - TiledGrid<Cell>::REACH, row - TiledGrid<Cell>::REACH).node[side] = index;
    }

    bool GridSearch::isCellFree(Cell &cell, const Pose &pose, std::size_t direction)
    {
        Occupancy &known = environment_->headingMatters() ? cell.byHeading[direction] : cell.occupancy;
        if (known == Occupancy::Unknown)
            known = environment_->isFree(pose) ? Occupancy::Free : Occupancy::Blocked;
        return known == Occupancy::Free;
    }

    GridSearch::Outcome GridSearch::load(const StopFunction &stop)
    {
        const auto begin = std::chrono::steady_clock::now();
        const std::size_t directions = environment_->headingMatters() ? (parameters_.sixteenNeighbours ? 16 : 8) : 1;
        const std::int64_t count = static_cast<std::int64_t>(columns_) * rows_;
        Outcome outcome = Outcome::Found;
        for (; loaded_ < count; ++loaded_)
        {
            if (loaded_ % CELLS_BETWEEN_STOPS == 0 && stop && stop())
            {
                outcome = Outcome::Stopped;
                break;
            }
            const auto column = static_cast<std::int32_t>(loaded_ % columns_);
            const auto row = static_cast<std::int32_t>(loaded_ / columns_);
            Cell &cell = cells_.at(column - TiledGrid<Cell>::REACH, row - TiledGrid<Cell>::REACH);
            Pose pose = centre(column, row);
            for (std::size_t direction = 0; direction < directions; ++direction)
            {
                pose.yaw = std::atan2(STEPS[direction].rows, STEPS[direction].columns);
                isCellFree(cell, pose, direction);
            }
        }
        loadingTime_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        return outcome;
    }

    double GridSearch::remaining(int side, const Pose &pose) const
    {
        // Each side aims at the best closed node of the other (paper, "Bidirectional Search").
        if (parameters_.bidirectional && bestClosed_[1 - side] != NO_NODE)
            return distanceBetween(pose, nodes_[bestClosed_[1 - side]].pose);
        double nearest = std::numeric_limits<double>::infinity();
        for (const std::uint32_t root : roots_[1 - side])
            nearest = std::min(nearest, distanceBetween(pose, nodes_[root].pose));
        return roots_[1 - side].empty() ? std::hypot(pose.x - target_.x(), pose.y - target_.y()) : nearest;
    }

    void GridSearch::push(int side, std::uint32_t index)
    {
        Node &node = nodes_[index];
        node.h = remaining(side, node.pose);
        open_[side].push(node.g + parameters_.weights.at(node.h) * node.h, node.h, index);
    }

    int GridSearch::chooseSide()
    {
        if (!parameters_.bidirectional || roots_[1].empty())
            return open_[0].empty() ? -1 : 0;
        // A side that has run dry has seen everything it can reach: the other cannot be there. The start's side is
        // searched to its end all the same, for the end nearest to the goal.
        if (open_[0].empty() || open_[1].empty())
            return open_[0].empty() ? -1 : 0;
        turn_ = !turn_;
        return turn_ ? 0 : 1;
    }

    GridSearch::Outcome GridSearch::run(const StopFunction &stop)
    {
        if (parameters_.eagerObstacles && load(stop) == Outcome::Stopped)
            return Outcome::Stopped;
        for (int side = 0; side < 2; ++side)
            for (const std::uint32_t root : roots_[side])
                if (!nodes_[root].closed && nodes_[root].h == 0.0)
                    push(side, root);
        // One cell may hold a start and a goal.
        for (const std::uint32_t start : roots_[0])
            for (const std::uint32_t goal : roots_[1])
                if (nodes_[start].column == nodes_[goal].column && nodes_[start].row == nodes_[goal].row &&
                    environment_->isMotionFree(nodes_[start].pose, nodes_[goal].pose))
                {
                    path_ = {nodes_[start].pose, nodes_[goal].pose};
                    return Outcome::Found;
                }
        for (;;)
        {
            if (unfinished_.node != NO_NODE && !expand(stop))
                return Outcome::Stopped;
            if (stop && stop())
                return Outcome::Stopped;
            const int side = chooseSide();
            if (side < 0)
                return Outcome::Exhausted;
            const OpenList::Entry entry = open_[side].pop();
            Node &node = nodes_[entry.node];
            if (node.closed)
                continue;
            node.closed = true;
            if (bestClosed_[side] == NO_NODE || entry.f < bestClosedF_[side] ||
                (entry.f == bestClosedF_[side] && node.h < nodes_[bestClosed_[side]].h))
            {
                bestClosed_[side] = entry.node;
                bestClosedF_[side] = entry.f;
            }
            const Cell &cell = cells_.at(node.column - TiledGrid<Cell>::REACH, node.row - TiledGrid<Cell>::REACH);
            const std::uint32_t other = cell.node[1 - side];
            // The other side's node must be closed, too; a root that never moved counts as such.
            if (other != NO_NODE && (nodes_[other].closed || nodes_[other].parent == NO_NODE) &&
                (side == 0 ? meets(entry.node, other) : meets(other, entry.node)))
                return Outcome::Found;
            ++statistics_.expanded;
            unfinished_ = {side, entry.node, 0};
        }
    }

    bool GridSearch::isStepFree(int side, const Node &from, const Pose &to, double heading) const
    {
        // The car turns on the spot before it goes; seen from the goal's side, after it has come.
        const Pose turned{from.pose.x, from.pose.y, heading};
        const bool turns = std::abs(wrapAngle(from.pose.yaw - heading)) > 1e-9;
        if (side == 0)
            return (!turns || environment_->isMotionFree(from.pose, turned)) && environment_->isMotionFree(turned, to);
        return environment_->isMotionFree(to, turned) && (!turns || environment_->isMotionFree(turned, from.pose));
    }

    bool GridSearch::expand(const StopFunction &stop)
    {
        const int side = unfinished_.side;
        const std::uint32_t index = unfinished_.node;
        const std::size_t directions = parameters_.sixteenNeighbours ? 16 : 8;
        for (std::size_t &direction = unfinished_.direction; direction < directions; ++direction)
        {
            if (direction > 0 && stop && stop())
                return false;
            const Node node = nodes_[index];
            const std::int32_t column = node.column + STEPS[direction].columns;
            const std::int32_t row = node.row + STEPS[direction].rows;
            if (column < 0 || row < 0 || column >= columns_ || row >= rows_)
                continue;
            ++statistics_.generated;
            Cell &cell = cells_.at(column - TiledGrid<Cell>::REACH, row - TiledGrid<Cell>::REACH);
            const std::uint32_t known = cell.node[side];
            if (known != NO_NODE && nodes_[known].closed)
                continue;
            // The cells of roots stand for the roots' own positions.
            Pose to = centre(column, row);
            const bool toRoot = cell.node[1 - side] != NO_NODE && nodes_[cell.node[1 - side]].parent == NO_NODE;
            if (toRoot)
                to = nodes_[cell.node[1 - side]].pose;
            const double dx = to.x - node.pose.x, dy = to.y - node.pose.y;
            const double g = node.g + std::hypot(dx, dy);
            if (known != NO_NODE && nodes_[known].g <= g)
                continue;
            const double heading = side == 0 ? std::atan2(dy, dx) : std::atan2(-dy, -dx);
            to.yaw = heading;
            // The matrix holds centres of cells and, where it matters, the sixteen headings between them; seen from
            // the goal's side, the car comes the other way.
            const std::size_t headed = side == 0 ? direction : (direction & 8u) | ((direction + 4) & 7u);
            const bool inMatrix = !toRoot && (!environment_->headingMatters() || isAtCentre(node));
            if (!(inMatrix ? isCellFree(cell, to, headed) : environment_->isFree(to)) ||
                !isStepFree(side, node, to, heading))
                continue;
            Node next{to, g, 0.0, index, column, row, static_cast<std::uint8_t>(side), false};
            std::uint32_t at = known;
            if (known == NO_NODE)
            {
                at = static_cast<std::uint32_t>(nodes_.size());
                nodes_.push_back(next);
                cell.node[side] = at;
            }
            else
                nodes_[known] = next;
            push(side, at);
        }
        unfinished_.node = NO_NODE;
        return true;
    }

    bool GridSearch::meets(std::uint32_t a, std::uint32_t b)
    {
        // Arriving with one heading, leaving with another: the turn between them must be free.
        if (std::abs(wrapAngle(nodes_[a].pose.yaw - nodes_[b].pose.yaw)) > 1e-9 &&
            !environment_->isMotionFree(nodes_[a].pose, nodes_[b].pose))
            return false;
        std::vector<Pose> front;
        appendToRoot(a, front);
        path_.assign(front.rbegin(), front.rend());
        std::vector<Pose> back;
        appendToRoot(b, back);
        for (const Pose &pose : back)
            if (distanceBetween(path_.back(), pose) > 0.0 || path_.back().yaw != pose.yaw)
                path_.push_back(pose);
        return true;
    }

    void GridSearch::appendToRoot(std::uint32_t index, std::vector<Pose> &poses) const
    {
        // Each edge is driven with the heading of its child, so the parent appears once with each heading.
        poses.push_back(nodes_[index].pose);
        for (; nodes_[index].parent != NO_NODE; index = nodes_[index].parent)
        {
            const Pose &parent = nodes_[nodes_[index].parent].pose;
            const Pose turned{parent.x, parent.y, nodes_[index].pose.yaw};
            if (std::abs(wrapAngle(parent.yaw - turned.yaw)) > 1e-9)
                poses.push_back(turned);
            poses.push_back(parent);
        }
    }

    std::vector<Pose> GridSearch::nearestPath(double x, double y) const
    {
        std::uint32_t best = NO_NODE;
        double nearest = std::numeric_limits<double>::infinity();
        for (std::uint32_t i = 0; i < nodes_.size(); ++i)
            if (const double distance = std::hypot(nodes_[i].pose.x - x, nodes_[i].pose.y - y);
                nodes_[i].side == 0 && distance < nearest)
            {
                nearest = distance;
                best = i;
            }
        std::vector<Pose> poses;
        if (best != NO_NODE)
            appendToRoot(best, poses);
        std::reverse(poses.begin(), poses.end());
        return poses;
    }
}  // namespace parking::search

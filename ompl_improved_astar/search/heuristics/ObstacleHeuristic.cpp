#include "ompl_improved_astar/search/heuristics/ObstacleHeuristic.h"

#include "ompl_improved_astar/search/containers/FloatBits.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace parking::search
{
    namespace
    {
        constexpr float DIAGONAL = 1.41421356f;
        constexpr double HALF_DIAGONAL = 0.70710679;
        constexpr int REFINEMENTS = 2;  // how often a cell is halved to find out whether the disc fits into it
        constexpr std::uint64_t CELLS_BETWEEN_STOPS = 1024;
        constexpr std::uint64_t MANY_CELLS = 128;     // settled for one question
        constexpr std::size_t LARGEST_POCKET = 1000;  // cells: what is larger is no pocket
    }                                                 // namespace

    void ObstacleHeuristic::begin(const HeuristicQuery &query)
    {
        begin(query, {query.parameters.inscribedRadius}, query.parameters.tuning.mostCells);
        if (query.parameters.eagerObstacles)
            load(query.parameters.bounds);
    }

    void ObstacleHeuristic::begin(const HeuristicQuery &query, const Disc &disc, std::uint64_t mostCells)
    {
        const SearchParameters &parameters = query.parameters;
        double farthest = 0.0;
        for (const Pose &root : query.roots)
            for (const Pose &target : query.targets)
                farthest = std::max(farthest, positionDistance(root, target));
        const double cell = parameters.tuning.heuristicCell * parameters.turningRadius;
        const Pose &toward = query.roots.empty() ? query.targets.front() : query.roots.front();
        reset(query.environment,
              std::clamp(parameters.tuning.cellOfLongWays * farthest, cell, parameters.tuning.coarsestCell * cell),
              disc, {toward.x, toward.y}, query.stop);
        mostCells_ = mostCells;
        for (const Pose &target : query.targets)
            addTarget(target.x, target.y);
    }

    void ObstacleHeuristic::reset(MotionEnvironment &environment, double resolution, const Disc &disc,
                                  const Eigen::Vector2d &toward, const StopFunction &stop)
    {
        stop_ = &stop;
        stopped_ = false;
        environment_ = &environment;
        resolution_ = resolution;
        disc_ = disc;
        mostCells_ = SearchTuning().mostCells;
        states_.clear();
        open_.clear();
        settled_ = 0;
        leftGrid_ = false;
        pocket_.cells.clear();
        pocket_.next = 0;
        // The grid is centred where the questions will be.
        origin_ = toward;
        towardColumn_ = towardRow_ = 0.5f;
        // A hair more than the octile distance: of many equally short ways in the open one is followed to its end. What
        // is settled is longer than the shortest way by no more than this hair.
        hair_ = 1.00002f;
    }

    bool ObstacleHeuristic::isOpen(CellState &state, std::int32_t column, std::int32_t row)
    {
        if (state.passage == Occupancy::Unknown)
        {
            const double x = origin_.x() + (column + 0.5) * resolution_, y = origin_.y() + (row + 0.5) * resolution_;
            const double half = 0.5 * resolution_;
            state.passage = mayHoldDisc(disc_.radius, x, y, half, REFINEMENTS) ? Occupancy::Free : Occupancy::Blocked;
            state.dear = disc_.wide > disc_.radius && !mayHoldDisc(disc_.wide, x, y, half, REFINEMENTS);
        }
        return state.passage == Occupancy::Free;
    }

    bool ObstacleHeuristic::mayHoldDisc(double radius, double x, double y, double halfSide, int refinements)
    {
        const double room = environment_->roomAt(x, y);
        if (room >= radius)
            return true;
        if (room + 2.0 * HALF_DIAGONAL * halfSide < radius)
            return false;
        if (refinements == 0)
            return true;
        // In doubt the quarters are asked: else the disc could slip through thin walls between two coarse cells.
        const double quarter = 0.5 * halfSide;
        for (const double dx : {-quarter, quarter})
            for (const double dy : {-quarter, quarter})
                if (mayHoldDisc(radius, x + dx, y + dy, quarter, refinements - 1))
                    return true;
        return false;
    }

    void ObstacleHeuristic::load(const Box &box)
    {
        for (double v = std::floor((box.min.y() - origin_.y()) / resolution_);
             v * resolution_ + origin_.y() < box.max.y() && !shouldStop(); v += 1.0)
            for (double u = std::floor((box.min.x() - origin_.x()) / resolution_);
                 u * resolution_ + origin_.x() < box.max.x(); u += 1.0)
                if (TiledGrid<CellState>::contains(u, v))
                {
                    const auto column = static_cast<std::int32_t>(u), row = static_cast<std::int32_t>(v);
                    isOpen(states_.at(column, row), column, row);
                }
    }

    float ObstacleHeuristic::estimate(std::int32_t column, std::int32_t row) const
    {
        const float dx = std::abs(static_cast<float>(column) + 0.5f - towardColumn_);
        const float dy = std::abs(static_cast<float>(row) + 0.5f - towardRow_);
        return hair_ * (std::max(dx, dy) + (DIAGONAL - 1.0f) * std::min(dx, dy));
    }

    void ObstacleHeuristic::push(float g, std::int32_t column, std::int32_t row)
    {
        const float f = g + estimate(column, row);
        open_.push(f, entryOf(f, g, column, row));
    }

    ObstacleHeuristic::Entry ObstacleHeuristic::entryOf(float f, float g, std::int32_t column, std::int32_t row) const
    {
        return {(static_cast<std::uint64_t>(bitsOf(f)) << 32) | (0xffffffffu - bitsOf(g)), column, row};
    }

    void ObstacleHeuristic::aimAt(std::int32_t column, std::int32_t row)
    {
        // Some cell of every shortest way waits with the length of that way up to it, whatever was made for until now,
        // so that what is settled from now on is settled with the length of its shortest way as well.
        towardColumn_ = static_cast<float>(column) + 0.5f;
        towardRow_ = static_cast<float>(row) + 0.5f;
        hair_ = 1.0f;
        open_.renewAll(
            [this](Entry &entry)
            {
                const CellState &state = states_.at(entry.column, entry.row);
                if (state.settled)
                    return -1.0f;
                const float f = state.g + estimate(entry.column, entry.row);
                entry = entryOf(f, state.g, entry.column, entry.row);
                return f;
            });
    }

    void ObstacleHeuristic::addTarget(double x, double y)
    {
        const double u = std::floor((x - origin_.x()) / resolution_), v = std::floor((y - origin_.y()) / resolution_);
        if (!TiledGrid<CellState>::contains(u, v))
        {
            leftGrid_ = true;
            return;
        }
        const auto column = static_cast<std::int32_t>(u), row = static_cast<std::int32_t>(v);
        states_.at(column, row).g = 0.0f;
        push(0.0f, column, row);
    }

    bool ObstacleHeuristic::settleNext(Entry &settled)
    {
        while (!open_.empty())
        {
            settled = open_.pop();
            CellState &state = states_.at(settled.column, settled.row);
            if (state.settled)
                continue;
            state.settled = true;
            ++settled_;
            const float here = state.g;
            const bool inside = states_.forEachNeighbour(
                settled.column, settled.row,
                [this, here](CellState &next, std::int32_t column, std::int32_t row, bool diagonal)
                {
                    const float step = diagonal ? DIAGONAL : 1.0f;
                    if (next.settled || here + step >= next.g || !isOpen(next, column, row))
                        return;
                    const float g = next.dear ? here + step * static_cast<float>(disc_.dear) : here + step;
                    if (g >= next.g)
                        return;
                    next.g = g;
                    push(g, column, row);
                });
            leftGrid_ = leftGrid_ || !inside;
            return true;
        }
        return false;
    }

    void ObstacleHeuristic::beginPocket(std::int32_t column, std::int32_t row)
    {
        CellState &state = states_.at(column, row);
        if (state.looked != Looked::Never)
            return;
        state.looked = Looked::Now;
        pocket_.cells.push_back({0, column, row});
    }

    void ObstacleHeuristic::widenPocket()
    {
        if (pocket_.cells.empty())
            return;
        if (pocket_.next == pocket_.cells.size())
        {
            // Meanwhile the search may have come in.
            endPocket(std::none_of(pocket_.cells.begin(), pocket_.cells.end(),
                                   [this](const Entry &each) { return isReached(states_.at(each.column, each.row)); }));
            return;
        }
        const Entry cell = pocket_.cells[pocket_.next++];
        bool hasWayOut = false;
        const bool inside =
            states_.forEachNeighbour(cell.column, cell.row,
                                     [this, &hasWayOut](CellState &next, std::int32_t column, std::int32_t row, bool)
                                     {
                                         if (next.looked == Looked::Now || !isOpen(next, column, row))
                                             return;
                                         hasWayOut = hasWayOut || isReached(next) || next.looked == Looked::Before;
                                         next.looked = Looked::Now;
                                         pocket_.cells.push_back({0, column, row});
                                     });
        if (hasWayOut || !inside || pocket_.cells.size() > LARGEST_POCKET)
            endPocket(false);
    }

    void ObstacleHeuristic::endPocket(bool isClosed)
    {
        for (const Entry &each : pocket_.cells)
        {
            CellState &state = states_.at(each.column, each.row);
            state.looked = Looked::Before;
            state.settled = state.settled || isClosed;
        }
        pocket_.cells.clear();
        pocket_.next = 0;
    }

    double ObstacleHeuristic::distance(double x, double y)
    {
        stopped_ = false;
        const double u = std::floor((x - origin_.x()) / resolution_), v = std::floor((y - origin_.y()) / resolution_);
        if (!TiledGrid<CellState>::contains(u, v))
            return 0.0;
        const auto column = static_cast<std::int32_t>(u), row = static_cast<std::int32_t>(v);
        CellState &asked = states_.at(column, row);
        if (!asked.settled && !isReached(asked) && !isOpen(asked, column, row))
            asked.settled = true;
        // Cells beside the way to the place that is made for come late, and those of a pocket never. A new aim costs as
        // much as a part of what waits.
        const std::uint64_t patienceEnds = settled_ + std::max<std::uint64_t>(MANY_CELLS, open_.size() / 4);
        Entry entry;
        while (!asked.settled)
        {
            if (settled_ >= patienceEnds)
            {
                if (settled_ == patienceEnds)
                {
                    aimAt(column, row);
                    beginPocket(column, row);
                }
                widenPocket();
            }
            if (settled_ % CELLS_BETWEEN_STOPS == CELLS_BETWEEN_STOPS - 1 && shouldStop())
            {
                stopped_ = true;
                return std::numeric_limits<double>::infinity();
            }
            if (settled_ >= mostCells_)
                return 0.0;
            if (!settleNext(entry))
                return leftGrid_ ? 0.0 : std::numeric_limits<double>::infinity();
        }
        if (!pocket_.cells.empty())
            endPocket(false);
        return static_cast<double>(asked.g) * resolution_;
    }

    double ObstacleHeuristic::estimate(const Pose &pose)
    {
        const double way = distance(pose.x, pose.y);
        return way < std::numeric_limits<double>::infinity() ? std::max(0.0, way - resolution_) : 0.0;
    }

    double ObstacleHeuristic::lowerBound(const Pose &pose)
    {
        const double way = distance(pose.x, pose.y);
        if (stopped_)
            return 0.0;
        // Pieces of the disc's way as long as a cell is wide touch two columns and two rows at most, so that their ends
        // lie in the same cell or in neighbours: each piece costs a diagonal at most.
        return std::max(0.0, way * (1.0 - 1e-5) / std::sqrt(2.0) - resolution_);
    }

    bool ObstacleHeuristic::provesUnreachable(const Pose &pose)
    {
        return distance(pose.x, pose.y) == std::numeric_limits<double>::infinity() && !stopped_;
    }

    Eigen::Vector2d ObstacleHeuristic::nearestReachable(const Eigen::Vector2d &goal)
    {
        Eigen::Vector2d best = goal;
        double nearest = std::numeric_limits<double>::infinity();
        Entry entry;
        while (nearest > HALF_DIAGONAL * resolution_ && settled_ < mostCells_ && settleNext(entry))
        {
            const Eigen::Vector2d centre = origin_ + resolution_ * Eigen::Vector2d(entry.column + 0.5, entry.row + 0.5);
            const double away = (centre - goal).norm();
            if (away < nearest)
            {
                nearest = away;
                best = centre;
            }
            if (settled_ % CELLS_BETWEEN_STOPS == 0 && shouldStop())
                break;
        }
        return best;
    }
}  // namespace parking::search

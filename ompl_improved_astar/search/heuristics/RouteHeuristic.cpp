#include "ompl_improved_astar/search/heuristics/RouteHeuristic.h"

#include "ompl_improved_astar/search/Tuning.h"

#include <algorithm>
#include <cmath>

namespace parking::search
{
    namespace
    {
        constexpr int STRAIGHT = 12, DIAGONAL = 17;  // lengths of the steps
        constexpr int REFINEMENTS = 3;               // halvings of a cell in doubt
        constexpr std::uint64_t CELLS_BETWEEN_STOPS = 1024, CELLS_LOADED_BETWEEN_STOPS = 64;
        constexpr std::uint64_t MIN_CELLS_PER_AIM = 128;

        /** The steps to the neighbours of a cell, the odd ones diagonal. */
        const Eigen::Vector2i STEPS[] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
    }  // namespace

    double routeResolution(double turningRadius, double bodyRadius, const std::vector<Pose> &roots,
                           const std::vector<Pose> &targets)
    {
        double farthest = 0.0;
        for (const Pose &root : roots)
            for (const Pose &target : targets)
                farthest = std::max(farthest, positionDistance(root, target));
        constexpr double FARTHEST_CELL = 1.0 / 1000.0;  // of the distance: the grid reaches 2048 cells
        const double side = std::max(tuning::ROUTE_CELL * turningRadius, tuning::MIN_ROUTE_CELL * bodyRadius);
        return std::max(std::clamp(tuning::ROUTE_CELL_LONG * farthest, side, tuning::ROUTE_CELL_RATIO * side),
                        FARTHEST_CELL * farthest);
    }

    inline std::optional<RouteHeuristic::Cell> RouteHeuristic::cellAt(double x, double y) const
    {
        const Eigen::Vector2d index = ((Eigen::Vector2d(x, y) - origin_) / resolution_).array().floor();
        if (!TiledGrid<CellState>::contains(index.x(), index.y()))
            return std::nullopt;
        return index.cast<int>();
    }

    inline Eigen::Vector2d RouteHeuristic::centreOf(const Cell &cell) const
    {
        return origin_ + resolution_ * (cell.cast<double>().array() + 0.5).matrix();
    }

    inline bool RouteHeuristic::isPassable(CellState &state, const Cell &cell)
    {
        if (state.passage == Occupancy::Unknown)
        {
            const Eigen::Vector2d centre = centreOf(cell);
            const double half = 0.5 * resolution_;
            const bool fits = mayHoldDisc(disc_.radius, centre, half, REFINEMENTS);
            state.passage = fits ? Occupancy::Free : Occupancy::Blocked;
            state.isCostly =
                fits && disc_.costFactor > 1.0 && !mayHoldDisc(disc_.wideRadius, centre, half, REFINEMENTS);
        }
        return state.passage == Occupancy::Free;
    }

    bool RouteHeuristic::mayHoldDisc(double radius, const Eigen::Vector2d &middle, double halfSide, int refinements)
    {
        // Of a cell on the bounds only the part inside counts. All of it is within half a diagonal of the point
        // queried. A hundredth of a side is left to rounding.
        const Eigen::Vector2d point = bounds_.nearest(middle);
        if ((point - middle).cwiseAbs().maxCoeff() > 1.01 * halfSide)
            return false;
        const double clearance = environment_->roomAt(point.x(), point.y()), halfDiagonal = 1.4142136 * halfSide;
        if (clearance >= radius || clearance + halfDiagonal < radius || refinements == 0)
            return clearance + halfDiagonal >= radius;
        // The quarters decide: otherwise the disc could slip through a thin wall between two coarse cells.
        const double quarter = 0.5 * halfSide;
        for (const double dx : {-quarter, quarter})
            for (const double dy : {-quarter, quarter})
                if (mayHoldDisc(radius, middle + Eigen::Vector2d(dx, dy), quarter, refinements - 1))
                    return true;
        return false;
    }

    inline std::uint32_t RouteHeuristic::stepLength(std::uint8_t step, bool isCostly) const
    {
        const int length = step % 2 == 0 ? STRAIGHT : DIAGONAL;
        return static_cast<std::uint32_t>(isCostly ? std::lround(length * disc_.costFactor) : length);
    }

    inline std::uint32_t RouteHeuristic::lengthToAim(const Cell &cell) const
    {
        const Cell away = (cell - aim_).cwiseAbs();
        return static_cast<std::uint32_t>(STRAIGHT * away.maxCoeff() + (DIAGONAL - STRAIGHT) * away.minCoeff());
    }

    void RouteHeuristic::begin(MotionEnvironment &environment, double resolution, const Disc &disc,
                               const Eigen::Vector2d &toward, const StopFunction &stop, std::uint64_t maxCells)
    {
        environment_ = &environment;
        bounds_ = environment.bounds();
        resolution_ = resolution;
        disc_ = disc.wideRadius > disc.radius ? disc : Disc{disc.radius};
        origin_ = toward;
        aim_ = Cell::Zero();
        stop_ = &stop;
        maxCells_ = maxCells;
        settled_ = 0;
        states_.clear();
        open_.clear();
        stopped_ = leftGrid_ = false;
    }

    void RouteHeuristic::addTarget(double x, double y)
    {
        const std::optional<Cell> cell = cellAt(x, y);
        leftGrid_ = leftGrid_ || !cell;
        if (!cell)
            return;
        states_.at(cell->x(), cell->y()).g = 0;
        open_.push(lengthToAim(*cell), *cell);
    }

    void RouteHeuristic::load(const Box &box)
    {
        constexpr int REACH = TiledGrid<CellState>::REACH;
        const auto cellOf = [this](const Eigen::Vector2d &point) -> Cell
        {
            return ((point - origin_) / resolution_).array().floor().max(-REACH).min(REACH - 1).cast<int>();
        };
        const Cell first = cellOf(box.min), last = cellOf(box.max);
        std::uint64_t loaded = 0;
        for (int row = first.y(); row <= last.y(); ++row)
            for (int column = first.x(); column <= last.x(); ++column)
            {
                if (loaded++ % CELLS_LOADED_BETWEEN_STOPS == 0 && *stop_ && (*stop_)())
                    return;
                isPassable(states_.at(column, row), {column, row});
            }
    }

    /** Settles one more cell; false when there is none, at the limit of cells, or when the search must stop. */
    bool RouteHeuristic::settleNext()
    {
        stopped_ = settled_ % CELLS_BETWEEN_STOPS == CELLS_BETWEEN_STOPS - 1 && *stop_ && (*stop_)();
        while (!stopped_ && settled_ < maxCells_ && !open_.empty())
        {
            const Cell cell = open_.pop();
            CellState &from = states_.at(cell.x(), cell.y());
            if (from.settled)
                continue;
            from.settled = true;
            ++settled_;
            for (std::uint8_t step = 0; step < NO_STEP; ++step)
            {
                const Cell next = cell + STEPS[step];
                if (!TiledGrid<CellState>::contains(next.x(), next.y()))
                {
                    leftGrid_ = true;
                    continue;
                }
                CellState &to = states_.at(next.x(), next.y());
                if (to.settled || !isPassable(to, next))
                    continue;
                const std::uint32_t g = from.g + stepLength(step, to.isCostly);
                if (g >= to.g)
                    continue;
                to.g = g;
                to.step = step;
                open_.push(g + lengthToAim(next), next);
            }
            return true;
        }
        return false;
    }

    void RouteHeuristic::aimAt(const Cell &cell)
    {
        // For any aim, the first unsettled cell of a shortest route is open with the length of that route. So all cells
        // settled later are settled with the length of a shortest route, too.
        aim_ = cell;
        for (const Cell &each : open_.takeAll())
            if (const CellState &state = states_.at(each.x(), each.y()); !state.settled)
                open_.push(state.g + lengthToAim(each), each);
    }

    double RouteHeuristic::distance(double x, double y)
    {
        stopped_ = false;
        const std::optional<Cell> cell = cellAt(x, y);
        if (!cell)
            return 0.0;
        CellState &state = states_.at(cell->x(), cell->y());
        if (state.g == UNREACHED && !isPassable(state, *cell))
            return HUGE_VAL;
        // The search settles cells beside the route to its aim late. Another aim costs as much as some of the open
        // cells.
        const std::uint64_t nextAim = settled_ + std::max<std::uint64_t>(MIN_CELLS_PER_AIM, open_.size() / 4);
        while (!state.settled)
        {
            if (settled_ == nextAim)
                aimAt(*cell);
            if (!settleNext())
                return stopped_ || (open_.empty() && !leftGrid_) ? HUGE_VAL : 0.0;
        }
        return state.g * (resolution_ / STRAIGHT);
    }

    std::optional<double> RouteHeuristic::knownDistance(double x, double y) const
    {
        const std::optional<Cell> cell = cellAt(x, y);
        const CellState *const state = cell ? states_.find(cell->x(), cell->y()) : nullptr;
        if (state != nullptr && state->settled)
            return state->g * (resolution_ / STRAIGHT);
        return cell && open_.empty() && !leftGrid_ ? std::optional(HUGE_VAL) : std::nullopt;
    }

    double RouteHeuristic::estimate(const Pose &pose)
    {
        const double length = distance(pose.x, pose.y);
        return length < HUGE_VAL ? std::max(0.0, length - resolution_) : 0.0;
    }

    double RouteHeuristic::lowerBound(const Pose &pose)
    {
        // Cut any route of length L into pieces shorter than a side: L / side + 1 are enough. Both ends of a piece lie
        // in the same cell or in neighbours, all of them passable. So a route of the grid has no more steps than there
        // are pieces, none of them longer than a diagonal one to a costly cell.
        const double length = distance(pose.x, pose.y) * STRAIGHT / stepLength(1, true);
        return stopped_ ? 0.0 : std::max(0.0, length - resolution_);
    }

    bool RouteHeuristic::provesUnreachable(const Pose &pose)
    {
        return distance(pose.x, pose.y) == HUGE_VAL && !stopped_;
    }

    Eigen::Vector2d RouteHeuristic::nearestReachable(const Eigen::Vector2d &goal)
    {
        const std::optional<Cell> cell = cellAt(goal.x(), goal.y());
        while (!(cell && states_.at(cell->x(), cell->y()).settled) && settleNext())
            continue;
        Eigen::Vector2d nearest(HUGE_VAL, HUGE_VAL);
        states_.forEach(
            [&](std::int32_t column, std::int32_t row, const CellState &state)
            {
                const Eigen::Vector2d centre = centreOf({column, row});
                if (state.settled && (centre - goal).norm() < (nearest - goal).norm())
                    nearest = centre;
            });
        return nearest.allFinite() ? nearest : goal;
    }

    std::optional<Pose> RouteHeuristic::placeOnRoute(double x, double y, double ahead, double around)
    {
        const double length = distance(x, y);
        if (length <= ahead + around || length == HUGE_VAL)
            return std::nullopt;
        Cell cell = *cellAt(x, y);
        double driven = 0.0;
        const auto follow = [&](double metres)
        {
            // A target may be nearer than its distance, which counts costly places as longer than they are.
            for (std::uint8_t step; driven < metres && (step = states_.at(cell.x(), cell.y()).step) != NO_STEP;)
            {
                cell -= STEPS[step];
                driven += stepLength(step, false) * (resolution_ / STRAIGHT);
            }
            return centreOf(cell);
        };
        const Eigen::Vector2d before = follow(ahead - around), place = follow(ahead);
        const Eigen::Vector2d heading = follow(ahead + around) - before;
        if (heading.isZero())
            return std::nullopt;
        return Pose{place.x(), place.y(), std::atan2(heading.y(), heading.x())};
    }
}  // namespace parking::search

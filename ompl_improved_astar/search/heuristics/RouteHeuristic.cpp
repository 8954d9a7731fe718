#include "ompl_improved_astar/search/heuristics/RouteHeuristic.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace parking::search
{
    namespace
    {
        constexpr double ROUTE_CELL = 1.0 / 6.0;      // turning radii; side of a cell,
        constexpr double ROUTE_CELL_OF_BODY = 0.35;   // and in radii of the largest disc within the car
        constexpr double ROUTE_CELLS = 120.0;         // per straight distance, up to
        constexpr double MAX_ROUTE_CELL_RATIO = 2.5;  // times the side on short routes
        constexpr double MAX_ROUTE_CELLS = 1000.0;    // per straight distance: the grid reaches 2048 cells

        constexpr std::uint32_t STRAIGHT = 12, DIAGONAL = 17;  // lengths of the steps
        constexpr double HALF_DIAGONAL = 0.70710679;           // of a cell, in sides
        constexpr double ON_THE_BOUNDS = 0.01;                 // half sides: nearer to the bounds, rounding decides
        constexpr int REFINEMENTS = 3;                         // halvings of a cell in doubt
        constexpr std::uint64_t CELLS_BETWEEN_STOPS = 1024;
        constexpr std::uint64_t CELLS_LOADED_BETWEEN_STOPS = 64;  // each takes up to 85 clearances
        constexpr std::uint64_t CELLS_BEFORE_AIMING = 128;        // settled for one question

        /** The eight directions, counter-clockwise from +x: the odd ones are diagonal. */
        constexpr std::uint8_t DIRECTIONS = 8;
        constexpr std::int32_t COLUMNS[DIRECTIONS] = {1, 1, 0, -1, -1, -1, 0, 1};
        constexpr std::int32_t ROWS[DIRECTIONS] = {0, 1, 1, 1, 0, -1, -1, -1};

        constexpr std::uint32_t stepLength(std::uint8_t direction)
        {
            return direction % 2 == 0 ? STRAIGHT : DIAGONAL;
        }
    }  // namespace

    double routeResolution(double turningRadius, double bodyRadius, const std::vector<Pose> &roots,
                           const std::vector<Pose> &targets)
    {
        double farthest = 0.0;
        for (const Pose &root : roots)
            for (const Pose &target : targets)
                farthest = std::max(farthest, positionDistance(root, target));
        const double cell = std::max(ROUTE_CELL * turningRadius, ROUTE_CELL_OF_BODY * bodyRadius);
        return std::max(std::clamp(farthest / ROUTE_CELLS, cell, MAX_ROUTE_CELL_RATIO * cell),
                        farthest / MAX_ROUTE_CELLS);
    }

    void RouteHeuristic::begin(MotionEnvironment &environment, double resolution, const Disc &disc,
                               const Eigen::Vector2d &toward, const StopFunction &stop, std::uint64_t maxCells)
    {
        environment_ = &environment;
        stop_ = &stop;
        bounds_ = environment.bounds();
        resolution_ = resolution;
        disc_ = disc;
        for (const std::uint8_t direction : {std::uint8_t{0}, std::uint8_t{1}})
            costlyLengths_[direction] =
                static_cast<std::uint32_t>(std::lround(disc.costFactor * stepLength(direction)));
        maxCells_ = maxCells;
        origin_ = toward;
        aim_ = {0, 0};
        states_.clear();
        open_.clear();
        settled_ = 0;
        stopped_ = leftGrid_ = false;
    }

    void RouteHeuristic::addTarget(double x, double y)
    {
        const std::optional<Cell> cell = cellAt(x, y);
        if (!cell)
        {
            leftGrid_ = true;
            return;
        }
        states_.at(cell->column, cell->row).g = 0;
        open_.push(lengthToAim(*cell), *cell);
    }

    std::optional<RouteHeuristic::Cell> RouteHeuristic::cellAt(double x, double y) const
    {
        const double column = std::floor((x - origin_.x()) / resolution_);
        const double row = std::floor((y - origin_.y()) / resolution_);
        if (!TiledGrid<CellState>::contains(column, row))
            return std::nullopt;
        return Cell{static_cast<std::int32_t>(column), static_cast<std::int32_t>(row)};
    }

    Eigen::Vector2d RouteHeuristic::centreOf(const Cell &cell) const
    {
        return origin_ + resolution_ * Eigen::Vector2d(cell.column + 0.5, cell.row + 0.5);
    }

    RouteHeuristic::CellClass RouteHeuristic::classOf(CellState &state, const Cell &cell)
    {
        if (state.kind == CellClass::Unknown)
        {
            const Eigen::Vector2d centre = centreOf(cell);
            const double half = 0.5 * resolution_;
            if (!mayHoldDisc(disc_.radius, centre, half, REFINEMENTS))
                state.kind = CellClass::Blocked;
            else if (disc_.wideRadius > disc_.radius && !mayHoldDisc(disc_.wideRadius, centre, half, REFINEMENTS))
                state.kind = CellClass::Costly;
            else
                state.kind = CellClass::Free;
        }
        return state.kind;
    }

    bool RouteHeuristic::mayHoldDisc(double radius, const Eigen::Vector2d &middle, double halfSide, int refinements)
    {
        // Of a cell on the bounds only the part inside counts. No point of it is farther than half a diagonal from the
        // one whose clearance is queried.
        const Eigen::Vector2d inside = bounds_.nearest(middle);
        if ((inside - middle).cwiseAbs().maxCoeff() > halfSide * (1.0 + ON_THE_BOUNDS))
            return false;
        const double clearance = clearanceBound(radius, inside);
        if (clearance >= radius)
            return true;
        if (clearance + 2.0 * HALF_DIAGONAL * halfSide < radius)
            return false;
        if (refinements == 0)
            return true;
        // Without a look at the quarters the disc would slip through thin walls between two coarse cells.
        const double quarter = 0.5 * halfSide;
        for (const double dx : {-quarter, quarter})
            for (const double dy : {-quarter, quarter})
                if (mayHoldDisc(radius, middle + Eigen::Vector2d(dx, dy), quarter, refinements - 1))
                    return true;
        return false;
    }

    /** An upper bound of the clearance: a closer one for the disc itself, since that decides what is blocked. */
    double RouteHeuristic::clearanceBound(double radius, const Eigen::Vector2d &point)
    {
        return radius > disc_.radius ? environment_->roomAt(point.x(), point.y())
                                     : environment_->roomAt(point.x(), point.y());
    }

    void RouteHeuristic::load(const Box &box)
    {
        constexpr double REACH = TiledGrid<CellState>::REACH;
        const auto index = [this](double metres, double origin)
        {
            return static_cast<std::int32_t>(
                std::clamp(std::floor((metres - origin) / resolution_), -REACH, REACH - 1));
        };
        const Cell first{index(box.min.x(), origin_.x()), index(box.min.y(), origin_.y())};
        const Cell last{index(box.max.x(), origin_.x()), index(box.max.y(), origin_.y())};
        std::uint64_t loaded = 0;
        for (Cell cell = first; cell.row <= last.row; ++cell.row)
            for (cell.column = first.column; cell.column <= last.column; ++cell.column)
            {
                if (loaded++ % CELLS_LOADED_BETWEEN_STOPS == 0 && isStopped())
                    return;
                classOf(states_.at(cell.column, cell.row), cell);
            }
    }

    std::uint32_t RouteHeuristic::lengthToAim(const Cell &cell) const
    {
        const auto columns = static_cast<std::uint32_t>(std::abs(cell.column - aim_.column));
        const auto rows = static_cast<std::uint32_t>(std::abs(cell.row - aim_.row));
        return STRAIGHT * std::max(columns, rows) + (DIAGONAL - STRAIGHT) * std::min(columns, rows);
    }

    void RouteHeuristic::aimAt(const Cell &cell)
    {
        // The first unsettled cell of every shortest route is open with the length of that route, for any aim: cells
        // settled from here on have the length of their shortest route, too.
        aim_ = cell;
        open_.renewAll(
            [this](const Cell &each, std::uint32_t &priority)
            {
                const CellState &state = states_.at(each.column, each.row);
                priority = state.g + lengthToAim(each);
                return !state.settled;
            });
    }

    /** Settles one more cell; false when none is left, at the limit of cells, or when stopped. */
    bool RouteHeuristic::settleNext()
    {
        stopped_ = settled_ % CELLS_BETWEEN_STOPS == CELLS_BETWEEN_STOPS - 1 && isStopped();
        if (stopped_ || settled_ >= maxCells_)
            return false;
        while (!open_.empty())
        {
            const Cell cell = open_.pop();
            CellState &state = states_.at(cell.column, cell.row);
            if (state.settled)
                continue;
            state.settled = true;
            ++settled_;
            for (std::uint8_t direction = 0; direction < DIRECTIONS; ++direction)
                step(cell, state.g, direction);
            return true;
        }
        return false;
    }

    void RouteHeuristic::step(const Cell &from, std::uint32_t g, std::uint8_t direction)
    {
        const Cell to{from.column + COLUMNS[direction], from.row + ROWS[direction]};
        if (!TiledGrid<CellState>::contains(to.column, to.row))
        {
            leftGrid_ = true;
            return;
        }
        CellState &state = states_.at(to.column, to.row);
        // Settled cells and most others are no farther than that already.
        if (state.g <= g + stepLength(direction))
            return;
        const CellClass kind = classOf(state, to);
        if (kind == CellClass::Blocked)
            return;
        g += kind == CellClass::Costly ? costlyLengths_[direction % 2] : stepLength(direction);
        if (g >= state.g)
            return;
        state.g = g;
        state.direction = direction;
        open_.push(g + lengthToAim(to), to);
    }

    double RouteHeuristic::lengthOf(const CellState &settled) const
    {
        return settled.g * (resolution_ / STRAIGHT);
    }

    double RouteHeuristic::distance(double x, double y)
    {
        stopped_ = false;
        const std::optional<Cell> cell = cellAt(x, y);
        if (!cell)
            return 0.0;
        CellState &state = states_.at(cell->column, cell->row);
        if (state.g == UNREACHED && classOf(state, *cell) == CellClass::Blocked)
            return INFINITE;
        // Cells beside the route to the aim are settled late. A new aim costs as much as settling a part of the open
        // cells.
        const std::uint64_t aimAgainAt = settled_ + std::max<std::uint64_t>(CELLS_BEFORE_AIMING, open_.size() / 4);
        while (!state.settled)
        {
            if (settled_ == aimAgainAt)
                aimAt(*cell);
            if (!settleNext())
                return stopped_ || isComplete() ? INFINITE : 0.0;
        }
        return lengthOf(state);
    }

    std::optional<double> RouteHeuristic::knownDistance(double x, double y) const
    {
        const std::optional<Cell> cell = cellAt(x, y);
        if (!cell)
            return std::nullopt;
        const CellState *const state = states_.find(cell->column, cell->row);
        if (state != nullptr && state->settled)
            return lengthOf(*state);
        const bool isBlocked = state != nullptr && state->kind == CellClass::Blocked && state->g == UNREACHED;
        return isBlocked || isComplete() ? std::optional(INFINITE) : std::nullopt;
    }

    double RouteHeuristic::estimate(const Pose &pose)
    {
        const double length = distance(pose.x, pose.y);
        return length < INFINITE ? std::max(0.0, length - resolution_) : 0.0;
    }

    double RouteHeuristic::lowerBound(const Pose &pose)
    {
        const double length = distance(pose.x, pose.y);
        if (stopped_)
            return 0.0;
        // Cut the disc's route of length L into pieces shorter than the side of a cell: L / side + 1 are enough. The
        // ends of a piece lie in the same cell or in neighbours, all of them passable. So the grid's route has at most
        // as many steps, none longer than a diagonal one through costly cells.
        return std::max(0.0, length * STRAIGHT / costlyLengths_[1] - resolution_);
    }

    bool RouteHeuristic::provesUnreachable(const Pose &pose)
    {
        return distance(pose.x, pose.y) == INFINITE && !stopped_;
    }

    std::optional<RouteHeuristic::PlaceOnRoute> RouteHeuristic::placeOnRoute(double x, double y, double ahead,
                                                                             double around)
    {
        const double length = distance(x, y);
        const std::optional<Cell> from = cellAt(x, y);
        if (!from || length <= ahead + around || length == INFINITE)
            return std::nullopt;
        Cell cell = *from;
        double driven = 0.0;
        const auto follow = [&](double metres)
        {
            while (driven < metres)
            {
                const std::uint8_t direction = states_.at(cell.column, cell.row).direction;
                if (direction == NO_PARENT)
                    break;  // at a target: the length counts costly cells as longer than they are
                cell = {cell.column - COLUMNS[direction], cell.row - ROWS[direction]};
                driven += stepLength(direction) * (resolution_ / STRAIGHT);
            }
            return centreOf(cell);
        };
        const Eigen::Vector2d before = follow(ahead - around), place = follow(ahead), after = follow(ahead + around);
        return after == before ? std::nullopt : std::optional(PlaceOnRoute{place, after - before});
    }

    Eigen::Vector2d RouteHeuristic::nearestReachable(const Eigen::Vector2d &goal)
    {
        const std::optional<Cell> cell = cellAt(goal.x(), goal.y());
        while (!(cell && states_.at(cell->column, cell->row).settled) && settleNext())
        {
        }
        Eigen::Vector2d nearest = goal;
        double closest = INFINITE;
        states_.forEach(
            [&](std::int32_t column, std::int32_t row, const CellState &state)
            {
                const Eigen::Vector2d centre = centreOf({column, row});
                const double away = (centre - goal).norm();
                if (!state.settled || away >= closest)
                    return;
                closest = away;
                nearest = centre;
            });
        return nearest;
    }
}  // namespace parking::search

#include "ompl_improved_astar/search/heuristics/ObstacleHeuristic.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace parking::search
{
    namespace
    {
        constexpr std::uint32_t STRAIGHT = 12, DIAGONAL = 17;  // lengths of the steps
        constexpr double HALF_DIAGONAL = 0.70710679;
        constexpr double ON_THE_BOUNDS =
            0.01;                       // of half a cell: so near to the bounds, rounding decides what is inside
        constexpr int REFINEMENTS = 3;  // how often a cell is halved to find out whether the disc fits into it
        constexpr std::uint64_t CELLS_BETWEEN_STOPS = 1024;
        constexpr std::size_t CELLS_LOADED_BETWEEN_STOPS = 64;  // of each up to 85 parts may be looked at
        constexpr std::uint64_t MANY_CELLS = 128;               // settled for one question
        constexpr std::size_t LARGEST_POCKET = 1000;            // cells: what is larger is no pocket

        /** The eight directions, counter-clockwise from +x: the odd ones are diagonal. */
        constexpr unsigned int DIRECTIONS = 8, ALL = 0xff;
        constexpr std::int32_t COLUMNS[DIRECTIONS] = {1, 1, 0, -1, -1, -1, 0, 1};
        constexpr std::int32_t ROWS[DIRECTIONS] = {0, 1, 1, 1, 0, -1, -1, -1};

        constexpr unsigned int turned(unsigned int direction, int eighths)
        {
            return (direction + DIRECTIONS + static_cast<unsigned int>(eighths)) % DIRECTIONS;
        }

        constexpr unsigned int bitOf(unsigned int direction)
        {
            return 1u << direction;
        }

        /** Calls visit(direction) for each direction of a set. */
        template <class Visit>
        void forEach(unsigned int directions, const Visit &visit)
        {
            for (; directions != 0; directions &= directions - 1)
                visit(static_cast<unsigned int>(__builtin_ctz(directions)));
        }
    }  // namespace

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
        const SearchTuning &tuning = parameters.tuning;
        const double cell =
            std::max(tuning.heuristicCell * parameters.turningRadius, tuning.cellOfBody * parameters.bodyRadius);
        const double cellOfLongWays = std::clamp(tuning.cellOfLongWays * farthest, cell, tuning.coarsestCell * cell);
        const Pose &toward = query.roots.empty() ? query.targets.front() : query.roots.front();
        // Else a way of many cells would lie beyond the reach of the grid, or of mostCells, and there would be no
        // guide.
        reset(query.environment, std::max(cellOfLongWays, tuning.cellOfLongest * farthest), disc, {toward.x, toward.y},
              query.stop);
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
        bounds_ = environment.bounds();
        resolution_ = resolution;
        disc_ = disc;
        dearer_ = {static_cast<std::uint32_t>(std::lround(STRAIGHT * (disc.dear - 1.0))),
                   static_cast<std::uint32_t>(std::lround(DIAGONAL * (disc.dear - 1.0)))};
        mostCells_ = SearchTuning().mostCells;
        states_.clear();
        open_.clear();
        settled_ = 0;
        leftGrid_ = false;
        pocket_.cells.clear();
        pocket_.next = 0;
        // The grid is centred where the questions will be.
        origin_ = toward;
        towardColumn_ = towardRow_ = 0;
        dearRoundAim_.forget();
    }

    void ObstacleHeuristic::findPassage(CellState &state, std::int32_t column, std::int32_t row)
    {
        const Eigen::Vector2d at = centreOf({column, row});
        const double half = 0.5 * resolution_;
        const bool fits = mayHoldDisc(disc_.radius, &MotionEnvironment::closeRoomAt, at.x(), at.y(), half, REFINEMENTS);
        state.passage = fits ? Occupancy::Free : Occupancy::Blocked;
        // What is dear is no matter of a few centimetres.
        state.dear = disc_.wide > disc_.radius &&
                     !mayHoldDisc(disc_.wide, &MotionEnvironment::roomAt, at.x(), at.y(), half, REFINEMENTS);
    }

    bool ObstacleHeuristic::mayHoldDisc(double radius, Room roomAt, double x, double y, double halfSide,
                                        int refinements)
    {
        // Of a cell on the bounds only a part counts, and none of its points is farther from the one that is asked for
        // than half a diagonal.
        const Eigen::Vector2d middle{x, y}, asked = bounds_.nearest(middle);
        if ((asked - middle).cwiseAbs().maxCoeff() > halfSide * (1.0 + ON_THE_BOUNDS))
            return false;
        const double room = (environment_->*roomAt)(asked.x(), asked.y());
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
                if (mayHoldDisc(radius, roomAt, x + dx, y + dy, quarter, refinements - 1))
                    return true;
        return false;
    }

    void ObstacleHeuristic::load(const Box &box)
    {
        // Of what lies beyond the reach of the grid there are no cells.
        constexpr std::int32_t REACH = TiledGrid<CellState>::REACH;
        const auto first = [this](double least, double origin)
        {
            const double cell = std::floor((least - origin) / resolution_);
            return static_cast<std::int32_t>(std::min<double>(REACH, std::max<double>(-REACH, cell)));
        };
        const auto isWithin = [this](std::int32_t cell, double most, double origin)
        {
            return cell < REACH && cell * resolution_ + origin < most;
        };
        std::size_t asked = 0;
        for (std::int32_t row = first(box.min.y(), origin_.y()); isWithin(row, box.max.y(), origin_.y()); ++row)
            for (std::int32_t column = first(box.min.x(), origin_.x()); isWithin(column, box.max.x(), origin_.x());
                 ++column)
            {
                if (asked++ % CELLS_LOADED_BETWEEN_STOPS == 0 && shouldStop())
                    return;
                isOpen(states_.at(column, row), column, row);
            }
    }

    std::uint32_t ObstacleHeuristic::estimate(std::int32_t column, std::int32_t row) const
    {
        const auto dx = static_cast<std::uint32_t>(std::abs(column - towardColumn_));
        const auto dy = static_cast<std::uint32_t>(std::abs(row - towardRow_));
        const std::uint32_t length = STRAIGHT * std::max(dx, dy) + (DIAGONAL - STRAIGHT) * std::min(dx, dy);
        return length + dearRoundAim_.from(column - towardColumn_, row - towardRow_);
    }

    Ground ObstacleHeuristic::groundOf(CellState &state, std::int32_t column, std::int32_t row)
    {
        if (!isOpen(state, column, row))
            return Ground::Closed;
        return state.dear ? Ground::Dear : Ground::Cheap;
    }

    void ObstacleHeuristic::findDearRoundAim()
    {
        dearRoundAim_.find(dearer_,
                           [this](std::int32_t columns, std::int32_t rows)
                           {
                               const std::int32_t column = towardColumn_ + columns, row = towardRow_ + rows;
                               // Of what the grid does not reach nothing is paid.
                               const bool isInside = TiledGrid<CellState>::contains(column - 1, row - 1) &&
                                                     TiledGrid<CellState>::contains(column + 1, row + 1);
                               return isInside ? groundOf(states_.at(column, row), column, row) : Ground::Cheap;
                           });
    }

    void ObstacleHeuristic::push(std::uint32_t g, std::int32_t column, std::int32_t row)
    {
        open_.push(g + estimate(column, row), {column, row});
    }

    void ObstacleHeuristic::aimAt(std::int32_t column, std::int32_t row)
    {
        // Some cell of every shortest way waits with the length of that way up to it, whatever was made for until now,
        // so that what is settled from now on is settled with the length of its shortest way as well.
        towardColumn_ = column;
        towardRow_ = row;
        findDearRoundAim();
        open_.renewAll(
            [this](const Entry &entry, std::uint32_t &priority)
            {
                const CellState &state = states_.at(entry.column, entry.row);
                priority = state.g + estimate(entry.column, entry.row);
                return !state.settled;
            });
    }

    void ObstacleHeuristic::addTarget(double x, double y)
    {
        const std::optional<Entry> cell = cellAt(x, y);
        if (!cell)
        {
            leftGrid_ = true;
            return;
        }
        CellState &state = states_.at(cell->column, cell->row);
        state.g = 0;
        state.arrivals = ALL;
        push(0, cell->column, cell->row);
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
            const Neighbours neighbours(states_, settled.column, settled.row);
            const std::uint32_t g = state.g;
            forEach(directionsFrom(settled, neighbours, state.arrivals),
                    [&](unsigned int direction) { step(settled, neighbours, g, direction); });
            return true;
        }
        return false;
    }

    /** Where ways that arrive at a cell in these directions go on; what this leaves out is reached as soon without. */
    unsigned int ObstacleHeuristic::directionsFrom(const Entry &cell, const Neighbours &neighbours,
                                                   unsigned int arrivals)
    {
        if (arrivals == ALL)
            return ALL;
        const auto look = [&](unsigned int direction)
        {
            CellState *const beside = neighbours.at(COLUMNS[direction], ROWS[direction]);
            return beside != nullptr ? groundOf(*beside, cell.column + COLUMNS[direction], cell.row + ROWS[direction])
                                     : Ground::Cheap;
        };
        unsigned int directions = arrivals;
        const auto goOn = [&](unsigned int arrival)
        {
            const bool diagonal = arrival % 2 != 0;
            for (const int side : {-1, 1})
            {
                if (diagonal)
                    directions |= bitOf(turned(arrival, side));
                // Another way, beside the last step, would be as short if it led through no dear or closed place.
                const Ground beside = look(turned(arrival, diagonal ? 3 * side : 2 * side));
                if (beside != Ground::Cheap)
                    directions |= bitOf(turned(arrival, diagonal ? 2 * side : side));
                // And a dear place is entered by the shorter step.
                if (beside == Ground::Dear && !diagonal)
                    directions |= bitOf(turned(arrival, 2 * side));
            }
        };
        forEach(arrivals, goOn);
        return directions;
    }

    void ObstacleHeuristic::step(const Entry &cell, const Neighbours &neighbours, std::uint32_t g,
                                 unsigned int direction)
    {
        CellState *const next = neighbours.at(COLUMNS[direction], ROWS[direction]);
        if (next == nullptr)
        {
            leftGrid_ = true;
            return;
        }
        const std::int32_t column = cell.column + COLUMNS[direction], row = cell.row + ROWS[direction];
        g += direction % 2 != 0 ? DIAGONAL : STRAIGHT;
        if (next->g < g || !isOpen(*next, column, row))
            return;
        if (next->dear)
            g += direction % 2 != 0 ? dearer_.diagonal : dearer_.straight;
        const auto bit = static_cast<std::uint8_t>(bitOf(direction));
        if (g < next->g && !next->settled)
        {
            next->g = g;
            next->arrivals = bit;
            push(g, column, row);
        }
        else if (g == next->g && (next->arrivals & bit) == 0)
        {
            // Another of its shortest ways, which may go on in other directions.
            next->arrivals |= bit;
            if (!next->settled)
                return;
            next->settled = false;
            push(g, column, row);
        }
    }

    void ObstacleHeuristic::beginPocket(std::int32_t column, std::int32_t row)
    {
        CellState &state = states_.at(column, row);
        if (state.looked != Looked::Never)
            return;
        state.looked = Looked::Now;
        pocket_.cells.push_back({column, row});
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
        const Neighbours neighbours(states_, cell.column, cell.row);
        bool hasWayOut = false, inside = true;
        for (unsigned int direction = 0; direction < DIRECTIONS; ++direction)
        {
            const std::int32_t column = cell.column + COLUMNS[direction], row = cell.row + ROWS[direction];
            CellState *const next = neighbours.at(COLUMNS[direction], ROWS[direction]);
            inside = inside && next != nullptr;
            if (next == nullptr || next->looked == Looked::Now || !isOpen(*next, column, row))
                continue;
            hasWayOut = hasWayOut || isReached(*next) || next->looked == Looked::Before;
            next->looked = Looked::Now;
            pocket_.cells.push_back({column, row});
        }
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
        const std::optional<Entry> cell = cellAt(x, y);
        if (!cell)
            return 0.0;
        const auto [column, row] = *cell;
        if (!dearRoundAim_.isKnown())
            findDearRoundAim();
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
        return lengthOf(asked);
    }

    double ObstacleHeuristic::lengthOf(const CellState &settled) const
    {
        return isReached(settled) ? static_cast<double>(settled.g) * (resolution_ / STRAIGHT)
                                  : std::numeric_limits<double>::infinity();
    }

    std::optional<double> ObstacleHeuristic::knownDistance(double x, double y) const
    {
        const std::optional<Entry> cell = cellAt(x, y);
        const CellState *const state = cell ? states_.find(cell->column, cell->row) : nullptr;
        return state != nullptr && state->settled ? std::optional(lengthOf(*state)) : std::nullopt;
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
        return std::max(0.0, way * (STRAIGHT * (1.0 - 1e-9) / DIAGONAL) - resolution_);
    }

    bool ObstacleHeuristic::provesUnreachable(const Pose &pose)
    {
        return distance(pose.x, pose.y) == std::numeric_limits<double>::infinity() && !stopped_;
    }

    std::optional<ObstacleHeuristic::PlaceOnWay> ObstacleHeuristic::placeOnWay(double x, double y, double ahead,
                                                                               double around)
    {
        const double way = distance(x, y);
        const std::optional<Entry> from = cellAt(x, y);
        if (!from || way <= ahead + around || way == std::numeric_limits<double>::infinity())
            return std::nullopt;
        Entry cell = *from;
        unsigned int direction = DIRECTIONS;
        double driven = 0.0;
        // Back by the last steps of shortest ways, straight on where there is a choice.
        const auto driveOn = [&](double length)
        {
            for (; driven < length; driven += (direction % 2 != 0 ? DIAGONAL : STRAIGHT) * (resolution_ / STRAIGHT))
            {
                const unsigned int arrivals = states_.at(cell.column, cell.row).arrivals;
                if (arrivals == ALL)
                    break;  // a target: dear ways count as longer than they are
                if (direction == DIRECTIONS || (arrivals & bitOf(direction)) == 0)
                    direction = static_cast<unsigned int>(__builtin_ctz(arrivals));
                cell = {cell.column - COLUMNS[direction], cell.row - ROWS[direction]};
            }
            return centreOf(cell);
        };
        const Eigen::Vector2d before = driveOn(ahead - around), place = driveOn(ahead), after = driveOn(ahead + around);
        return after == before ? std::nullopt : std::optional(PlaceOnWay{place, after - before});
    }

    Eigen::Vector2d ObstacleHeuristic::nearestReachable(const Eigen::Vector2d &goal)
    {
        Eigen::Vector2d best = goal;
        double nearest = std::numeric_limits<double>::infinity();
        Entry entry;
        while (nearest > HALF_DIAGONAL * resolution_ && settled_ < mostCells_ && settleNext(entry))
        {
            const Eigen::Vector2d centre = centreOf(entry);
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

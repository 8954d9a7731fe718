#include "automatic_parking/perception/ExtendedObstacles.h"

#include "automatic_parking/perception/TouchedCells.h"

#include <cmath>

namespace parking
{
    ExtendedObstacles::ExtendedObstacles(const Scenario &seen, double reach)
      : seen_(seen.grid->width(), seen.grid->height(), seen.grid->resolution(), seen.grid->origin(), Cell::Unknown),
        map_(seen_),
        near_(seen_.cells().size(), 0),
        isKept_(seen_.cells().size(), false),
        isTouched_(seen_.cells().size(), false)
    {
        const double cells = reach / seen_.resolution();
        const auto steps = static_cast<std::ptrdiff_t>(cells);
        for (std::ptrdiff_t row = -steps; row <= steps; ++row)
            for (std::ptrdiff_t column = -steps; column <= steps; ++column)
                if (std::hypot(static_cast<double>(column), static_cast<double>(row)) <= cells)
                    disc_.emplace_back(column, row);
        const auto keep = [&](const Pose &pose)
        {
            visitTouchedCells(map_, inCells(map_, seen.vehicle.footprint(pose)),
                              [this](std::size_t cell, std::size_t /*edge*/) { isKept_[cell] = true; });
        };
        keep(seen.start);
        for (const Pose &goal : seen.goals)
            keep(goal);
        GridUpdate known;
        for (std::uint32_t row = 0; row < seen_.height(); ++row)
            for (std::uint32_t column = 0; column < seen_.width(); ++column)
                if (seen.grid->at(column, row) != Cell::Unknown)
                    known.push_back({column, row, seen.grid->at(column, row)});
        update(known);
    }

    Cell ExtendedObstacles::extended(std::size_t cell) const
    {
        const Cell seen = seen_.cells()[cell];
        return seen == Cell::Unknown && near_[cell] > 0 && !isKept_[cell] ? Cell::Occupied : seen;
    }

    const GridUpdate &ExtendedObstacles::update(const GridUpdate &changes)
    {
        const auto width = static_cast<std::ptrdiff_t>(seen_.width()),
                   height = static_cast<std::ptrdiff_t>(seen_.height());
        std::vector<std::size_t> touched;
        const auto touch = [&](std::size_t cell)
        {
            if (!isTouched_[cell])
                touched.push_back(cell);
            isTouched_[cell] = true;
        };
        for (const CellChange &change : changes)
        {
            const bool was = seen_.at(change.column, change.row) == Cell::Occupied;
            const bool is = change.cell == Cell::Occupied;
            seen_.set(change.column, change.row, change.cell);
            touch(change.row * seen_.width() + change.column);
            if (was == is)
                continue;
            for (const auto &[columns, rows] : disc_)
            {
                const std::ptrdiff_t column = change.column + columns, row = change.row + rows;
                if (column < 0 || row < 0 || column >= width || row >= height)
                    continue;
                const auto cell = static_cast<std::size_t>(row * width + column);
                near_[cell] += is ? 1 : -1;
                touch(cell);
            }
        }
        changes_.clear();
        for (const std::size_t cell : touched)
        {
            isTouched_[cell] = false;
            const std::size_t column = cell % seen_.width(), row = cell / seen_.width();
            if (const Cell now = extended(cell); now != map_.at(column, row))
            {
                map_.set(column, row, now);
                changes_.push_back({static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row), now});
            }
        }
        return changes_;
    }
}  // namespace parking

#include "automatic_parking/perception/PerceivedWorld.h"

#include "automatic_parking/perception/TouchedCells.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/Require.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace parking
{
    namespace
    {
        constexpr double MAX_EXTENSION = 10.0;  // metres; a farther one makes updates slow

        std::size_t cellsAlong(double length, double cellSize)
        {
            // Whole cells only: the rest lies outside of the map and counts as an obstacle.
            return static_cast<std::size_t>(std::min(std::floor(length / cellSize + 1e-9), 4294967295.0));
        }

        OccupancyGrid unseenMap(const Scenario &truth, double cellSize)
        {
            Pose origin{truth.bounds.min.x(), truth.bounds.min.y(), 0.0};
            Eigen::Vector2d size = truth.bounds.size();
            if (truth.grid)
            {
                origin = truth.grid->origin();
                size = truth.grid->resolution() * Eigen::Vector2d(static_cast<double>(truth.grid->width()),
                                                                  static_cast<double>(truth.grid->height()));
            }
            if (!size.allFinite() || size.minCoeff() <= 0.0)
                throw Error("bounds of the perceived world must be finite and span more than 0 m in x and in y");
            Require("perception")
                .that(cellSize <= size.minCoeff(), "cellSize", cellSize, "at most the shorter side of the world");
            return OccupancyGrid(cellsAlong(size.x(), cellSize), cellsAlong(size.y(), cellSize), cellSize, origin,
                                 Cell::Unknown);
        }
    }  // namespace

    void PerceptionParameters::validate() const
    {
        const Require require("perception");
        require.positive("cellSize", cellSize, "metres");
        require.that(obstacleExtension >= 0.0 && obstacleExtension <= MAX_EXTENSION, "obstacleExtension",
                     obstacleExtension, "from 0 to " + formatNumber(MAX_EXTENSION) + " metres");
    }

    PerceivedWorld::PerceivedWorld(const Scenario &truth, std::shared_ptr<Perception> perception,
                                   const PerceptionParameters &parameters)
      : scenario_(truth),
        perception_(std::move(perception)),
        time_(-std::numeric_limits<double>::infinity())
    {
        parameters.validate();
        truth.vehicle.validate();
        if (!perception_)
            throw Error("perceived world: the perception is missing");
        if (!isFinite(truth.start))
            throw Error("perceived world: the start must consist of finite numbers");
        OccupancyGrid map = unseenMap(truth, parameters.cellSize);
        const auto body = truth.vehicle.footprint(truth.start);
        visitTouchedCells(map, inCells(map, {body.begin(), body.end()}),
                          [&map](std::size_t cell, std::size_t /*edge*/)
                          { map.set(cell % map.width(), cell / map.width(), Cell::Free); });
        const std::vector<Eigen::Vector2d> outline = map.outline();
        scenario_.bounds = {outline.front(), outline.front()};
        for (const Eigen::Vector2d &corner : outline)
            scenario_.bounds.include(corner);
        scenario_.polygons.clear();
        scenario_.grid = std::move(map);
        scenario_.unknownIsOccupied = parameters.unseenIsOccupied;
    }

    const GridUpdate &PerceivedWorld::observe(double time, const Pose &car)
    {
        if (!std::isfinite(time) || time < time_)
            throw Error("perception: time is " + formatNumber(time) + " s; it must be a finite number" +
                        (std::isfinite(time_) ? " of at least " + formatNumber(time_) + " s" : ""));
        if (!isFinite(car))
            throw Error("perception: the pose of the car must consist of finite numbers");
        OccupancyGrid &map = *scenario_.grid;
        GridUpdate seen;
        try
        {
            seen = perception_->observe(time, car, map);
            checkUpdate(seen, map.width(), map.height());
        }
        catch (const std::exception &error)
        {
            throw Error("perception failed at " + formatNumber(time) + " s: " + error.what());
        }
        catch (...)
        {
            throw Error("perception failed at " + formatNumber(time) + " s for an unknown reason");
        }
        time_ = time;
        changes_.clear();
        for (const CellChange &change : seen)
        {
            const Cell before = map.at(change.column, change.row);
            if (before == change.cell)
                continue;
            map.set(change.column, change.row, change.cell);
            changes_.push_back({change.column, change.row, before});
        }
        // The first change of each cell holds its former occupancy.
        const auto isBefore = [](const CellChange &a, const CellChange &b)
        {
            return a.row != b.row ? a.row < b.row : a.column < b.column;
        };
        std::stable_sort(changes_.begin(), changes_.end(), isBefore);
        changes_.erase(std::unique(changes_.begin(), changes_.end(),
                                   [&](const CellChange &a, const CellChange &b) { return !isBefore(a, b); }),
                       changes_.end());
        std::size_t count = 0;
        for (const CellChange &each : changes_)
            if (const Cell now = map.at(each.column, each.row); now != each.cell)
                changes_[count++] = {each.column, each.row, now};
        changes_.resize(count);
        return changes_;
    }
}  // namespace parking

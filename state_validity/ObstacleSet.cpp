#include "state_validity/ObstacleSet.h"

#include "parking_geometry/Error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace parking
{
    namespace
    {
        constexpr double STROKE = 1e-6;  // metres

        void checkBounds(const Box &bounds)
        {
            if (!bounds.min.allFinite() || !bounds.max.allFinite())
                throw Error("bounds of the world must be finite");
            if (!(bounds.max.x() > bounds.min.x()) || !(bounds.max.y() > bounds.min.y()))
                throw Error("bounds of the world are empty: they must span more than 0 m in x and in y");
        }

        /** Merges occupied cells into rectangles: runs along each row, joined with the equal run of the row below. */
        std::vector<Box> mergeCells(const std::vector<std::uint8_t> &cells, std::size_t columns, std::size_t rows,
                                    double size)
        {
            struct Run
            {
                std::size_t begin, end, firstRow;
            };
            std::vector<Box> rectangles;
            std::vector<Run> open, next;
            const auto close = [&](const Run &run, std::size_t endRow)
            {
                rectangles.push_back({{static_cast<double>(run.begin) * size, static_cast<double>(run.firstRow) * size},
                                      {static_cast<double>(run.end) * size, static_cast<double>(endRow) * size}});
            };
            for (std::size_t row = 0; row < rows; ++row)
            {
                next.clear();
                std::size_t k = 0;
                const std::uint8_t *line = &cells[row * columns];
                for (std::size_t column = 0; column < columns;)
                {
                    if (!line[column])
                    {
                        ++column;
                        continue;
                    }
                    std::size_t end = column;
                    while (end < columns && line[end])
                        ++end;
                    Run run{column, end, row};
                    for (; k < open.size() && open[k].begin < column; ++k)
                        close(open[k], row);
                    if (k < open.size() && open[k].begin == column && open[k].end == end)
                        run.firstRow = open[k++].firstRow;
                    next.push_back(run);
                    column = end;
                }
                for (; k < open.size(); ++k)
                    close(open[k], row);
                open.swap(next);
            }
            for (const Run &run : open)
                close(run, rows);
            return rectangles;
        }

        /** A part of a grid: columns and rows from the first one up to but excluding the last one. */
        struct Window
        {
            std::size_t left, right, low, high;
        };

        /** Adds the boundaries between occupied and free cells in the window and on its border as straight lines, each
            as long as possible. */
        void addCellEdges(const std::vector<std::uint8_t> &cells, std::size_t columns, std::size_t rows, double size,
                          const Window &window, std::vector<Edge> &edges)
        {
            const auto at = [&](std::size_t column, std::size_t row)
            {
                return cells[row * columns + column] != 0;
            };
            for (std::size_t row = std::max<std::size_t>(1, window.low); row <= std::min(window.high, rows - 1); ++row)
                for (std::size_t column = window.left; column < window.right;)
                {
                    if (at(column, row) == at(column, row - 1))
                    {
                        ++column;
                        continue;
                    }
                    const std::size_t begin = column;
                    while (column < window.right && at(column, row) != at(column, row - 1))
                        ++column;
                    const double y = static_cast<double>(row) * size;
                    edges.push_back({{static_cast<double>(begin) * size, y}, {static_cast<double>(column) * size, y}});
                }
            // Column-wise runs, visited row by row for the cache: `begins` stores the beginning of each run.
            constexpr std::size_t NONE = static_cast<std::size_t>(-1);
            const std::size_t first = std::max<std::size_t>(1, window.left), last = std::min(window.right, columns - 1);
            std::vector<std::size_t> begins(last + 1, NONE);
            const auto close = [&](std::size_t column, std::size_t row)
            {
                const double x = static_cast<double>(column) * size;
                edges.push_back(
                    {{x, static_cast<double>(begins[column]) * size}, {x, static_cast<double>(row) * size}});
                begins[column] = NONE;
            };
            for (std::size_t row = window.low; row < window.high; ++row)
                for (std::size_t column = first; column <= last; ++column)
                {
                    const bool border = at(column, row) != at(column - 1, row);
                    if (border && begins[column] == NONE)
                        begins[column] = row;
                    else if (!border && begins[column] != NONE)
                        close(column, row);
                }
            for (std::size_t column = first; column <= last; ++column)
                if (begins[column] != NONE)
                    close(column, window.high);
        }

        void addBoundsEdges(const Box &bounds, std::vector<Edge> &edges)
        {
            const Eigen::Vector2d &a = bounds.min, &c = bounds.max;
            const Eigen::Vector2d b{c.x(), a.y()}, d{a.x(), c.y()};
            edges.insert(edges.end(), {{a, b}, {b, c}, {c, d}, {d, a}});
        }

        bool isObstacle(Cell cell, bool unknownIsOccupied)
        {
            return cell == Cell::Occupied || (unknownIsOccupied && cell == Cell::Unknown);
        }
    }  // namespace

    ObstacleSet ObstacleSet::fromPolygons(const std::vector<Polygon> &polygons, const Box &bounds)
    {
        checkBounds(bounds);
        ObstacleSet set;
        const Eigen::Vector2d centre = 0.5 * (bounds.min + bounds.max);
        set.frame_ = {centre.x(), centre.y(), 0.0};
        set.bounds_ = {bounds.min - centre, bounds.max - centre};
        for (std::size_t i = 0; i < polygons.size(); ++i)
        {
            if (polygons[i].empty())
                throw Error("obstacle polygon " + std::to_string(i + 1) + " has no corners");
            Polygon local;
            for (const Eigen::Vector2d &corner : polygons[i])
            {
                if (!corner.allFinite())
                    throw Error("obstacle polygon " + std::to_string(i + 1) + " has a corner that is not finite");
                const Eigen::Vector2d point = corner - centre;
                if (local.empty() || (point - local.back()).squaredNorm() > 0.0)
                    local.push_back(point);
            }
            while (local.size() > 1 && (local.front() - local.back()).squaredNorm() == 0.0)
                local.pop_back();
            // A point is an obstacle too. It becomes a short stroke, because edges require a direction.
            if (local.size() == 1)
                local.emplace_back(local.front().x() + STROKE, local.front().y());
            if (crossesItself(local))
                throw Error("the outline of obstacle polygon " + std::to_string(i + 1) +
                            " crosses itself; it must be a simple polygon");
            if (signedArea(local) < 0.0)
                std::reverse(local.begin(), local.end());
            set.polygons_.push_back(std::move(local));
        }
        return set;
    }

    ObstacleSet ObstacleSet::fromGrid(const OccupancyGrid &grid, bool unknownIsOccupied)
    {
        if (grid.width() == 0 || grid.height() == 0)
            throw Error("the occupancy grid has no cells");
        ObstacleSet set;
        set.frame_ = grid.origin();
        set.unknownIsOccupied_ = unknownIsOccupied;
        set.cellSize_ = grid.resolution();
        set.columns_ = grid.width();
        set.rows_ = grid.height();
        set.bounds_ = {{0.0, 0.0},
                       {static_cast<double>(grid.width()) * grid.resolution(),
                        static_cast<double>(grid.height()) * grid.resolution()}};
        set.cells_.resize(grid.cells().size());
        std::transform(grid.cells().begin(), grid.cells().end(), set.cells_.begin(),
                       [unknownIsOccupied](Cell cell) -> std::uint8_t { return isObstacle(cell, unknownIsOccupied); });
        return set;
    }

    ObstacleSet ObstacleSet::fromScenario(const Scenario &scenario)
    {
        return scenario.grid ? fromGrid(*scenario.grid, scenario.unknownIsOccupied)
                             : fromPolygons(scenario.polygons, scenario.bounds);
    }

    bool ObstacleSet::covers(double x, double y) const
    {
        if (!(x > bounds_.min.x() && x < bounds_.max.x() && y > bounds_.min.y() && y < bounds_.max.y()))
            return true;
        if (cellSize_ > 0.0)
        {
            const auto column = std::min(static_cast<std::size_t>(x / cellSize_), columns_ - 1);
            const auto row = std::min(static_cast<std::size_t>(y / cellSize_), rows_ - 1);
            return cells_[row * columns_ + column] != 0;
        }
        const Eigen::Vector2d point(x, y);
        return std::any_of(polygons_.begin(), polygons_.end(),
                           [&point](const Polygon &polygon) { return contains(polygon, point); });
    }

    const ObstacleSet::Derived &ObstacleSet::derived() const
    {
        std::call_once(derived_->once,
                       [this]
                       {
                           std::vector<Edge> &edges = derived_->edges;
                           if (cellSize_ > 0.0)
                           {
                               derived_->rectangles = mergeCells(cells_, columns_, rows_, cellSize_);
                               addCellEdges(cells_, columns_, rows_, cellSize_, {0, columns_, 0, rows_}, edges);
                           }
                           for (const Polygon &polygon : polygons_)
                               for (std::size_t k = 0; k < polygon.size(); ++k)
                                   edges.push_back({polygon[k], polygon[(k + 1) % polygon.size()]});
                           addBoundsEdges(bounds_, edges);
                       });
        return *derived_;
    }

    std::vector<Polygon> ObstacleSet::solids() const
    {
        std::vector<Polygon> solids = polygons();
        for (const Box &box : rectangles())
            solids.push_back({box.min, {box.max.x(), box.min.y()}, box.max, {box.min.x(), box.max.y()}});
        for (Polygon &solid : solids)
            for (Eigen::Vector2d &corner : solid)
            {
                const Pose point = compose(frame(), {corner.x(), corner.y(), 0.0});
                corner = {point.x, point.y};
            }
        return solids;
    }

    std::vector<Edge> ObstacleSet::edgesNear(const Box &box) const
    {
        // One more cell on each side, so that rounding loses none.
        const auto index = [this](double value, std::size_t count)
        {
            return static_cast<std::size_t>(std::clamp(value / cellSize_, 0.0, static_cast<double>(count)));
        };
        const Window window{index(box.min.x() - cellSize_, columns_), index(box.max.x() + 2.0 * cellSize_, columns_),
                            index(box.min.y() - cellSize_, rows_), index(box.max.y() + 2.0 * cellSize_, rows_)};
        std::vector<Edge> edges;
        addCellEdges(cells_, columns_, rows_, cellSize_, window, edges);
        addBoundsEdges(bounds_, edges);
        return edges;
    }

    std::vector<std::size_t> ObstacleSet::update(const GridUpdate &update)
    {
        if (cellSize_ == 0.0)
            throw Error("a world of polygons cannot be updated by cells; make a new one");
        checkUpdate(update, columns_, rows_);
        std::vector<std::size_t> changed;
        for (const CellChange &change : update)
        {
            const std::size_t index = change.row * columns_ + change.column;
            const std::uint8_t value = isObstacle(change.cell, unknownIsOccupied_);
            if (cells_[index] != value)
                changed.push_back(index);
            cells_[index] = value;
        }
        std::sort(changed.begin(), changed.end());
        // A cell that has changed an even number of times is as it was.
        std::size_t kept = 0;
        for (std::size_t k = 0; k < changed.size();)
        {
            std::size_t end = k;
            while (end < changed.size() && changed[end] == changed[k])
                ++end;
            if ((end - k) % 2 == 1)
                changed[kept++] = changed[k];
            k = end;
        }
        changed.resize(kept);
        if (!changed.empty())
            derived_ = std::make_shared<Derived>();
        return changed;
    }
}  // namespace parking

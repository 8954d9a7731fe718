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

        /** Adds the boundaries between occupied and free cells as maximal straight lines. */
        void addCellEdges(const std::vector<std::uint8_t> &cells, std::size_t columns, std::size_t rows, double size,
                          std::vector<Edge> &edges)
        {
            const auto at = [&](std::size_t column, std::size_t row)
            {
                return cells[row * columns + column] != 0;
            };
            for (std::size_t row = 1; row < rows; ++row)
                for (std::size_t column = 0; column < columns;)
                {
                    if (at(column, row) == at(column, row - 1))
                    {
                        ++column;
                        continue;
                    }
                    const std::size_t begin = column;
                    while (column < columns && at(column, row) != at(column, row - 1))
                        ++column;
                    const double y = static_cast<double>(row) * size;
                    edges.push_back({{static_cast<double>(begin) * size, y}, {static_cast<double>(column) * size, y}});
                }
            // Column-wise runs, visited row by row for the cache: `begins` stores the beginning of each run.
            constexpr std::size_t NONE = static_cast<std::size_t>(-1);
            std::vector<std::size_t> begins(columns, NONE);
            const auto close = [&](std::size_t column, std::size_t row)
            {
                const double x = static_cast<double>(column) * size;
                edges.push_back(
                    {{x, static_cast<double>(begins[column]) * size}, {x, static_cast<double>(row) * size}});
                begins[column] = NONE;
            };
            for (std::size_t row = 0; row < rows; ++row)
                for (std::size_t column = 1; column < columns; ++column)
                {
                    const bool border = at(column, row) != at(column - 1, row);
                    if (border && begins[column] == NONE)
                        begins[column] = row;
                    else if (!border && begins[column] != NONE)
                        close(column, row);
                }
            for (std::size_t column = 1; column < columns; ++column)
                if (begins[column] != NONE)
                    close(column, rows);
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
            for (std::size_t k = 0; k < local.size(); ++k)
                set.edges_.push_back({local[k], local[(k + 1) % local.size()]});
            set.polygons_.push_back(std::move(local));
        }
        set.addBoundsEdges();
        return set;
    }

    ObstacleSet ObstacleSet::fromGrid(const OccupancyGrid &grid, bool unknownIsOccupied)
    {
        if (grid.width() == 0 || grid.height() == 0)
            throw Error("the occupancy grid has no cells");
        ObstacleSet set;
        set.frame_ = grid.origin();
        set.cellSize_ = grid.resolution();
        set.columns_ = grid.width();
        set.rows_ = grid.height();
        set.bounds_ = {{0.0, 0.0},
                       {static_cast<double>(grid.width()) * grid.resolution(),
                        static_cast<double>(grid.height()) * grid.resolution()}};
        set.cells_.resize(grid.cells().size());
        std::transform(grid.cells().begin(), grid.cells().end(), set.cells_.begin(),
                       [unknownIsOccupied](Cell cell) -> std::uint8_t
                       { return cell == Cell::Occupied || (unknownIsOccupied && cell == Cell::Unknown); });
        set.rectangles_ = mergeCells(set.cells_, set.columns_, set.rows_, set.cellSize_);
        addCellEdges(set.cells_, set.columns_, set.rows_, set.cellSize_, set.edges_);
        set.addBoundsEdges();
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

    void ObstacleSet::addBoundsEdges()
    {
        const Eigen::Vector2d &a = bounds_.min, &c = bounds_.max;
        const Eigen::Vector2d b{c.x(), a.y()}, d{a.x(), c.y()};
        edges_.push_back({a, b});
        edges_.push_back({b, c});
        edges_.push_back({c, d});
        edges_.push_back({d, a});
    }
}  // namespace parking

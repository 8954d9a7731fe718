#include "parking_geometry/drawing/CellOutlines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace parking
{
    namespace
    {
        /** Columns and rows from begin up to, not including, end. */
        struct CellWindow
        {
            std::size_t beginColumn{0}, endColumn{0}, beginRow{0}, endRow{0};
        };

        std::size_t clampedIndex(double value, std::size_t end)
        {
            return static_cast<std::size_t>(std::clamp(value, 0.0, static_cast<double>(end)));
        }

        CellWindow cellsNear(const OccupancyGrid &grid, const Box &window)
        {
            Eigen::Vector2d low(HUGE_VAL, HUGE_VAL), high = -low;
            for (const double x : {window.min.x(), window.max.x()})
                for (const double y : {window.min.y(), window.max.y()})
                {
                    const Pose corner = relativeTo(grid.origin(), {x, y, 0.0});
                    low = low.cwiseMin(Eigen::Vector2d(corner.x, corner.y));
                    high = high.cwiseMax(Eigen::Vector2d(corner.x, corner.y));
                }
            low /= grid.resolution();
            high /= grid.resolution();
            return {clampedIndex(std::floor(low.x()), grid.width()), clampedIndex(std::ceil(high.x()), grid.width()),
                    clampedIndex(std::floor(low.y()), grid.height()), clampedIndex(std::ceil(high.y()), grid.height())};
        }

        /** Edges between cells of the kind and others, as one bit for each direction in which an edge leaves a corner
            of a cell; the cell lies on the left of its edges. Directions: 0 +x, 1 +y, 2 -x, 3 -y. */
        class EdgeMap
        {
        public:
            EdgeMap(const OccupancyGrid &grid, Cell kind, const CellWindow &window)
              : columns_(window.endColumn - window.beginColumn + 1),
                edges_(columns_ * (window.endRow - window.beginRow + 1))
            {
                const auto isKind = [&](std::size_t column, std::size_t row)
                {
                    return column >= window.beginColumn && column < window.endColumn && row >= window.beginRow &&
                           row < window.endRow && grid.at(column, row) == kind;
                };
                for (std::size_t row = window.beginRow; row < window.endRow; ++row)
                    for (std::size_t column = window.beginColumn; column < window.endColumn; ++column)
                    {
                        if (!isKind(column, row))
                            continue;
                        const std::size_t x = column - window.beginColumn, y = row - window.beginRow;
                        // Below the first row and left of the first column the index wraps round and is out of range.
                        if (!isKind(column, row - 1))
                            add(x, y, 0);
                        if (!isKind(column + 1, row))
                            add(x + 1, y, 1);
                        if (!isKind(column, row + 1))
                            add(x + 1, y + 1, 2);
                        if (!isKind(column - 1, row))
                            add(x, y + 1, 3);
                    }
            }

            std::size_t size() const
            {
                return edges_.size();
            }
            std::size_t columns() const
            {
                return columns_;
            }

            /** Takes the edge that goes on from a corner: to the left if it can, so that cells which touch at a corner
                only become outlines of their own. \return its direction, -1 without any */
            int take(std::size_t corner, int direction)
            {
                for (const int turn : {1, 0, 3})
                {
                    const int next = (direction + turn) % 4;
                    if (edges_[corner] & (1 << next))
                    {
                        edges_[corner] = static_cast<std::uint8_t>(edges_[corner] & ~(1 << next));
                        return next;
                    }
                }
                return -1;
            }

            bool hasEdge(std::size_t corner) const
            {
                return edges_[corner] != 0;
            }

        private:
            void add(std::size_t x, std::size_t y, int direction)
            {
                std::uint8_t &bits = edges_[y * columns_ + x];
                bits = static_cast<std::uint8_t>(bits | 1 << direction);
            }

            std::size_t columns_;
            std::vector<std::uint8_t> edges_;
        };
    }  // namespace

    std::vector<Polygon> outlineCells(const OccupancyGrid &grid, Cell kind, const Box &window)
    {
        const CellWindow cells = cellsNear(grid, window);
        std::vector<Polygon> outlines;
        if (cells.beginColumn >= cells.endColumn || cells.beginRow >= cells.endRow)
            return outlines;
        EdgeMap edges(grid, kind, cells);
        const auto columns = static_cast<std::ptrdiff_t>(edges.columns());
        const std::array<std::ptrdiff_t, 4> step = {1, columns, -1, -columns};
        for (std::size_t first = 0; first < edges.size(); ++first)
            while (edges.hasEdge(first))
            {
                Polygon outline;
                std::size_t corner = first;
                int direction = -1;
                for (int next = edges.take(first, 0); next >= 0; next = edges.take(corner, direction))
                {
                    if (next != direction)
                    {
                        const double x = static_cast<double>(cells.beginColumn + corner % edges.columns());
                        const double y = static_cast<double>(cells.beginRow + corner / edges.columns());
                        const Pose at = compose(grid.origin(), {x * grid.resolution(), y * grid.resolution(), 0.0});
                        outline.emplace_back(at.x, at.y);
                    }
                    direction = next;
                    corner = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(corner) +
                                                      step[static_cast<std::size_t>(direction)]);
                    if (corner == first)
                        break;
                }
                outlines.push_back(std::move(outline));
            }
        return outlines;
    }
}  // namespace parking

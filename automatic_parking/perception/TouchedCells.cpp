#include "automatic_parking/perception/TouchedCells.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        constexpr double SLACK = 1e-9;  // metres

        /** Whole numbers from the first to the last one. */
        struct Range
        {
            double first, last;
        };

        /** The cells between two coordinates. If these lie on one border, the cell on the side of the solid. */
        Range cellsBetween(double low, double high, double slack, bool solidAbove)
        {
            const double first = std::floor(low + slack), last = std::floor(high - slack);
            if (first <= last)
                return {first, last};
            const double border = std::round(0.5 * (low + high));
            return solidAbove ? Range{border, border} : Range{border - 1.0, border - 1.0};
        }

        Range within(const Range &range, std::size_t count)
        {
            return {std::max(range.first, 0.0), std::min(range.last, static_cast<double>(count) - 1.0)};
        }
    }  // namespace

    Polygon inCells(const OccupancyGrid &map, const Polygon &polygon)
    {
        Polygon local;
        for (const Eigen::Vector2d &corner : polygon)
        {
            const Pose point = relativeTo(map.origin(), {corner.x(), corner.y(), 0.0});
            local.emplace_back(point.x / map.resolution(), point.y / map.resolution());
        }
        if (signedArea(local) < 0.0)
            std::reverse(local.begin(), local.end());
        return local;
    }

    void visitTouchedCells(const OccupancyGrid &map, const Polygon &polygon, const VisitCell &visit)
    {
        const double slack = SLACK / map.resolution();
        const auto visitRow = [&](double row, const Range &columns, std::size_t edge)
        {
            const Range inside = within(columns, map.width());
            for (double column = inside.first; column <= inside.last; ++column)
                visit(static_cast<std::size_t>(row) * map.width() + static_cast<std::size_t>(column), edge);
        };
        for (std::size_t i = 0; i < polygon.size(); ++i)
        {
            const Eigen::Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
            const Eigen::Vector2d low = a.cwiseMin(b), high = a.cwiseMax(b), along = b - a;
            // The solid lies to the left of the edge.
            const Range rows = within(cellsBetween(low.y(), high.y(), slack, along.x() > 0.0), map.height());
            for (double row = rows.first; row <= rows.last; ++row)
            {
                // The part of the edge in this row; rounding must not exceed the edge.
                double left = low.x(), right = high.x();
                if (low.y() < row || high.y() > row + 1.0)
                {
                    const double y0 = std::clamp(row, low.y(), high.y()), y1 = std::clamp(row + 1.0, low.y(), high.y());
                    const double x0 = a.x() + along.x() * ((y0 - a.y()) / along.y()),
                                 x1 = a.x() + along.x() * ((y1 - a.y()) / along.y());
                    left = std::clamp(std::min(x0, x1), low.x(), high.x());
                    right = std::clamp(std::max(x0, x1), low.x(), high.x());
                }
                visitRow(row, cellsBetween(left, right, slack, along.y() < 0.0), i);
            }
        }
        // Cells that lie inside: those with an inner centre. The outline may cross them too.
        double lowest = HUGE_VAL, highest = -HUGE_VAL;
        for (const Eigen::Vector2d &corner : polygon)
        {
            lowest = std::min(lowest, corner.y());
            highest = std::max(highest, corner.y());
        }
        const Range rows = within({std::floor(lowest), std::floor(highest)}, map.height());
        std::vector<double> crossings;
        for (double row = rows.first; row <= rows.last; ++row)
        {
            const double y = row + 0.5;
            crossings.clear();
            for (std::size_t i = 0; i < polygon.size(); ++i)
            {
                const Eigen::Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
                if ((a.y() > y) != (b.y() > y))
                    crossings.push_back(a.x() + (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y()));
            }
            std::sort(crossings.begin(), crossings.end());
            for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
                visitRow(row, {std::ceil(crossings[i] - 0.5), std::floor(crossings[i + 1] - 0.5)}, INNER_CELL);
        }
    }
}  // namespace parking

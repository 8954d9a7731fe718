#include "parking_geometry/Polygon.h"

#include "parking_geometry/Box.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace parking
{
    double signedArea(const Polygon &polygon)
    {
        if (polygon.size() < 3)
            return 0.0;
        // Coordinates relative to the first corner avoid cancellation for polygons far from the origin.
        const Eigen::Vector2d &origin = polygon.front();
        double twice = 0.0;
        for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        {
            const Eigen::Vector2d a = polygon[i] - origin, b = polygon[i + 1] - origin;
            twice += a.x() * b.y() - a.y() * b.x();
        }
        return 0.5 * twice;
    }

    bool crossesItself(const Polygon &polygon)
    {
        const std::size_t count = polygon.size();
        // Sides sorted by their lower x. Only sides that begin before a side ends can cross it.
        struct Side
        {
            double left, right;
            std::size_t at;
        };
        std::vector<Side> sides(count);
        for (std::size_t i = 0; i < count; ++i)
        {
            const double x = polygon[i].x(), next = polygon[(i + 1) % count].x();
            sides[i] = {std::min(x, next), std::max(x, next), i};
        }
        std::sort(sides.begin(), sides.end(), [](const Side &a, const Side &b) { return a.left < b.left; });
        for (std::size_t i = 0; i < count; ++i)
        {
            const Eigen::Vector2d &a = polygon[sides[i].at], &b = polygon[(sides[i].at + 1) % count];
            const double low = std::min(a.y(), b.y()), high = std::max(a.y(), b.y());
            for (std::size_t k = i + 1; k < count && sides[k].left <= sides[i].right; ++k)
            {
                const Eigen::Vector2d &c = polygon[sides[k].at], &d = polygon[(sides[k].at + 1) % count];
                if (std::max(c.y(), d.y()) < low || std::min(c.y(), d.y()) > high)
                    continue;
                const double acd = turn(a, c, d), bcd = turn(b, c, d), abc = turn(a, b, c), abd = turn(a, b, d);
                if (((acd > 0.0 && bcd < 0.0) || (acd < 0.0 && bcd > 0.0)) &&
                    ((abc > 0.0 && abd < 0.0) || (abc < 0.0 && abd > 0.0)))
                    return true;
            }
        }
        return false;
    }

    bool contains(const Polygon &polygon, const Eigen::Vector2d &point)
    {
        bool inside = false;
        for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++)
        {
            // Coordinates relative to the point, so only the lengths of the edges limit the precision.
            const Eigen::Vector2d a = polygon[i] - point, b = polygon[j] - point;
            if ((a.y() > 0.0) == (b.y() > 0.0))
                continue;
            // The edge crosses the ray to the right if the point lies on the appropriate side of it. The multiplied
            // form avoids a division by zero for horizontal edges.
            const double side = a.x() * b.y() - a.y() * b.x();
            if ((side > 0.0) == (b.y() > a.y()))
                inside = !inside;
        }
        return inside;
    }

    double distanceToSegment(const Eigen::Vector2d &point, const Eigen::Vector2d &from, const Eigen::Vector2d &to)
    {
        const Eigen::Vector2d along = to - from;
        const double square = along.squaredNorm();
        const double share = square > 0.0 ? std::clamp((point - from).dot(along) / square, 0.0, 1.0) : 0.0;
        return (point - from - share * along).norm();
    }

    double depthWithin(const Polygon &polygon, const Eigen::Vector2d &point)
    {
        double nearest = HUGE_VAL;
        for (std::size_t i = 0; i < polygon.size(); ++i)
            nearest = std::min(nearest, distanceToSegment(point, polygon[i], polygon[(i + 1) % polygon.size()]));
        return contains(polygon, point) ? nearest : -nearest;
    }

    Eigen::Vector2d deepestPoint(const Polygon &polygon)
    {
        constexpr double PLACES = 24.0;   // of the first search, along either axis
        constexpr double FINEST = 1e-12;  // last step as a share of the first
        Box box{polygon.front(), polygon.front()};
        for (const Eigen::Vector2d &corner : polygon)
            box.include(corner);
        // Ears of the outline are inside even of polygons that are narrower than a step.
        Eigen::Vector2d deepest = box.min;
        double depth = -HUGE_VAL;
        const auto consider = [&](const Eigen::Vector2d &point)
        {
            const double there = depthWithin(polygon, point);
            if (there <= depth)
                return false;
            depth = there;
            deepest = point;
            return true;
        };
        const std::size_t count = polygon.size();
        for (std::size_t i = 0; i < count; ++i)
            consider((polygon[i] + polygon[(i + 1) % count] + polygon[(i + 2) % count]) / 3.0);
        const Eigen::Vector2d first = box.size() / PLACES;
        for (double column = 0.5; column < PLACES; ++column)
            for (double row = 0.5; row < PLACES; ++row)
                consider(box.min + Eigen::Vector2d(column * first.x(), row * first.y()));
        // Pattern search: eight neighbours, then half the step.
        for (double scale = 0.5; scale > FINEST;)
        {
            const Eigen::Vector2d step = scale * first;
            const Eigen::Vector2d from = deepest;  // NOLINT: consider() changes deepest
            bool deeper = false;
            for (const double dx : {-1.0, 0.0, 1.0})
                for (const double dy : {-1.0, 0.0, 1.0})
                    deeper |= consider(from + Eigen::Vector2d(dx * step.x(), dy * step.y()));
            if (!deeper)
                scale *= 0.5;
        }
        return deepest;
    }
}  // namespace parking

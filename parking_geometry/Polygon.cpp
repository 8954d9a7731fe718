#include "parking_geometry/Polygon.h"

namespace parking
{
    double signedArea(const Polygon &polygon)
    {
        if (polygon.size() < 3)
            return 0.0;
        // Relative to the first corner: polygons far from the origin would lose their area to cancellation otherwise.
        const Eigen::Vector2d &origin = polygon.front();
        double twice = 0.0;
        for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        {
            const Eigen::Vector2d a = polygon[i] - origin, b = polygon[i + 1] - origin;
            twice += a.x() * b.y() - a.y() * b.x();
        }
        return 0.5 * twice;
    }

    bool contains(const Polygon &polygon, const Eigen::Vector2d &point)
    {
        bool inside = false;
        for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++)
        {
            // Everything relative to the point, so that only the sizes of the edges limit the precision.
            const Eigen::Vector2d a = polygon[i] - point, b = polygon[j] - point;
            if ((a.y() > 0.0) == (b.y() > 0.0))
                continue;
            // The edge crosses the ray to the right when the point lies on the proper side of it; multiplied out, so
            // that flat edges divide by nothing.
            const double side = a.x() * b.y() - a.y() * b.x();
            if ((side > 0.0) == (b.y() > a.y()))
                inside = !inside;
        }
        return inside;
    }
}  // namespace parking

#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/StdVector>

namespace parking
{
    /** \brief Corners of a simple polygon in metres, closed implicitly. It may have either orientation and be
        non-convex. Two corners are a segment, one is a point. */
    using Polygon = std::vector<Eigen::Vector2d>;

    /** \brief A straight edge of an outline. */
    struct Edge
    {
        Eigen::Vector2d from;  ///< one end, metres
        Eigen::Vector2d to;    ///< the other end, metres
    };

    /** \brief Signed area in square metres, positive for counter-clockwise polygons. */
    double signedArea(const Polygon &polygon);

    /** \brief Twice the signed area of a triangle: positive if \e c lies to the left of the line from \e a to \e b. */
    inline double turn(const Eigen::Vector2d &a, const Eigen::Vector2d &b, const Eigen::Vector2d &c)
    {
        return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    }

    /** \brief Whether two sides of the polygon cross. Sides that only touch or overlap do not cross. */
    bool crossesItself(const Polygon &polygon);

    /** \brief Whether \e point lies inside \e polygon, by the crossing number. The result is undefined exactly on the
        outline. */
    bool contains(const Polygon &polygon, const Eigen::Vector2d &point);

    /** \brief Distance in metres between \e point and the outline of the polygon, positive inside. */
    double depthWithin(const Polygon &polygon, const Eigen::Vector2d &point);

    /** \brief A point within the polygon whose depth is locally largest, usually the centre of the largest circle in
        it. The polygon must have an area. */
    Eigen::Vector2d deepestPoint(const Polygon &polygon);

    /** \brief Distance in metres between a point and a segment. */
    double distanceToSegment(const Eigen::Vector2d &point, const Eigen::Vector2d &from, const Eigen::Vector2d &to);
}  // namespace parking

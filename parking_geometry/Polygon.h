#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/StdVector>

namespace parking
{
    /** \brief A simple polygon, closed implicitly; either orientation, convex or not. Metres. */
    using Polygon = std::vector<Eigen::Vector2d>;

    /** \brief A straight piece of an outline. */
    struct Edge
    {
        Eigen::Vector2d from;  ///< one end, metres
        Eigen::Vector2d to;    ///< the other end, metres
    };

    /** \brief Signed area: positive when counter-clockwise. */
    double signedArea(const Polygon &polygon);

    /** \brief Twice the signed area of a triangle: positive when \e c lies to the left of the way from \e a to \e b. */
    inline double turn(const Eigen::Vector2d &a, const Eigen::Vector2d &b, const Eigen::Vector2d &c)
    {
        return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    }

    /** \brief Do two sides of the polygon cross? Sides that merely touch, or run along each other, do not. */
    bool crossesItself(const Polygon &polygon);

    /** \brief Is \e point inside (crossing number; undefined exactly on the outline)? */
    bool contains(const Polygon &polygon, const Eigen::Vector2d &point);
}  // namespace parking

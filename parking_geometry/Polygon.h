#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/StdVector>

namespace parking
{
    /** \brief A simple polygon, closed implicitly; either orientation, convex or not. Metres. */
    using Polygon = std::vector<Eigen::Vector2d>;

    /** \brief Signed area: positive when counter-clockwise. */
    double signedArea(const Polygon &polygon);

    /** \brief Is \e point inside (crossing number; undefined exactly on the outline)? */
    bool contains(const Polygon &polygon, const Eigen::Vector2d &point);
}  // namespace parking

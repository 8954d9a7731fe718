#pragma once

#include "parking_geometry/Box.h"
#include "parking_geometry/Pose.h"

#include <cmath>

namespace parking
{
    /** \brief A rectangle at any angle: centre, heading as cosine and sine, half lengths. */
    struct OrientedBox
    {
        double x,           ///< x of the centre, metres
            y;              ///< y of the centre, metres
        double cosine,      ///< cosine of the heading
            sine;           ///< sine of the heading
        double halfLength,  ///< metres from the centre to either end along the heading
            halfWidth;      ///< metres from the centre to either side

        /** \brief A point in the frame of the box: metres along the heading and to its left. */
        Eigen::Vector2d toFrame(const Eigen::Vector2d &point) const
        {
            const double dx = point.x() - x, dy = point.y() - y;
            return {cosine * dx + sine * dy, cosine * dy - sine * dx};
        }

        /** \brief The axis-parallel bounding box. */
        Box bounds() const
        {
            const Eigen::Vector2d centre(x, y);
            const Eigen::Vector2d reach(halfLength * std::abs(cosine) + halfWidth * std::abs(sine),
                                        halfLength * std::abs(sine) + halfWidth * std::abs(cosine));
            return {centre - reach, centre + reach};
        }
    };

    /** \brief The body of a car whose rear axle is at \e pose. \param centreOffset metres from the axle to the centre
        of the body */
    inline OrientedBox bodyAt(const Pose &pose, double centreOffset, double halfLength, double halfWidth)
    {
        const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
        return {pose.x + c * centreOffset, pose.y + s * centreOffset, c, s, halfLength, halfWidth};
    }
}  // namespace parking

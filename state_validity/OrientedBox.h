#pragma once

#include "parking_geometry/Pose.h"

#include <cmath>

namespace parking
{
    /** \brief A rectangle at a place in the local frame: centre, heading as cosine and sine, half lengths. */
    struct OrientedBox
    {
        double x,           ///< of the centre, metres
            y;              ///< of the centre, metres
        double cosine,      ///< of the heading
            sine;           ///< of the heading
        double halfLength,  ///< metres from the centre to either end along the heading
            halfWidth;      ///< metres from the centre to either side
    };

    /** \brief The body of a car whose rear axle is at \e pose. \param centreOffset of its middle ahead of the axle */
    inline OrientedBox bodyAt(const Pose &pose, double centreOffset, double halfLength, double halfWidth)
    {
        const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
        return {pose.x + c * centreOffset, pose.y + s * centreOffset, c, s, halfLength, halfWidth};
    }
}  // namespace parking

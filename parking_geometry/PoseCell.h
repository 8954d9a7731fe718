#pragma once

#include "parking_geometry/Pose.h"

namespace parking
{
    /** \brief All poses whose places are in a square and whose headings are in a part of the circle. */
    struct PoseCell
    {
        Pose middle;      ///< of the square, whose sides are parallel to the axes, and of the part of the circle
        double side;      ///< of the square, metres
        double halfTurn;  ///< half of the angle of that part, radians
    };
}  // namespace parking

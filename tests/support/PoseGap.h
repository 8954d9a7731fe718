#pragma once

#include "parking_geometry/Pose.h"

#include <cmath>

namespace parking_test
{
    /** \brief How far two poses are apart in one number: metres and radians added up, to be compared with rounding. */
    inline double gap(const parking::Pose &a, const parking::Pose &b)
    {
        return parking::positionDistance(a, b) + std::abs(parking::wrapAngle(a.yaw - b.yaw));
    }
}  // namespace parking_test

#pragma once

#include "parking_geometry/Pose.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"

namespace parking
{
    /** \brief Largest change of curvature per metre driven, 1/m^2, if the wheels turn at the vehicle's maximum steering
        rate.

        It is rate (1 + (kappa L)^2) / (L v) with the wheelbase L and the speed v.

        \param speed m/s, positive
        \param curvature kappa at which the steering moves, 1/m; 0 gives the smallest value */
    double maxSharpness(const Vehicle &vehicle, double speed, double curvature = 0.0);

    /** \brief Highest speed, m/s, at which the steering follows a curvature that changes by \e sharpness per metre.

        This is the inverse of maxSharpness(); it is infinite for a sharpness of 0. */
    double maxSpeedForSharpness(const Vehicle &vehicle, double sharpness, double curvature = 0.0);

    /** \brief The circular arc that leaves \e from with its heading and ends at \e to.

        If an arc of at most half a circle joins both poses, the result is exact. Otherwise it has the change of heading
        and the length of chord of the two poses. */
    Arc arcBetween(const Pose &from, const Pose &to);
}  // namespace parking

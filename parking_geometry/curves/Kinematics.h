#pragma once

#include "parking_geometry/Pose.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"

namespace parking
{
    /** \brief How fast the curvature may change per metre driven, 1/m^2, when the wheels turn at the vehicle's steering
        rate while it drives at \e speed: rate (1 + (kappa L)^2) / (L v).

        \param speed m/s, positive
        \param curvature where along the steering range; 0, the default, gives the smallest value */
    double maxSharpness(const Vehicle &vehicle, double speed, double curvature = 0.0);

    /** \brief The highest speed, m/s, at which the steering keeps up with a curvature that changes by \e sharpness per
        metre: the inverse of maxSharpness; infinite for 0. */
    double maxSpeedForSharpness(const Vehicle &vehicle, double sharpness, double curvature = 0.0);

    /** \brief The circular arc that leaves \e from with its heading and ends at \e to.

        Exact when such an arc exists (\e to then ends with its heading, at most half a circle away); otherwise the one
        whose change of heading is that of the poses and whose chord has the length of theirs. */
    Arc arcBetween(const Pose &from, const Pose &to);
}  // namespace parking

#pragma once

#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"
#include "path_tracking/trajectory/TimedMotion.h"

#include <optional>

namespace parking
{
    /** \brief Drives \e path exactly. The car stops and steers at standstill at each jump of the curvature and each
        cusp. Such a motion always exists, but it is slow.

        Between two standstills the car accelerates and brakes at the limit of \e vehicle. Along clothoids its speed
        respects the steering rate.

        \param vehicle its limits must be positive; as shares of a car's limits they may be below Vehicle::LEAST_LIMIT
        \param initialSteering, finalSteering radians; if absent, the angles at the ends of the path
        Throws parking::Error for a path that turns on the spot, never drives, is not finite, is tighter than the
        turning radius, or takes more than LONGEST_MOTION. */
    TimedMotion stopAndSteer(const Path &path, const Vehicle &vehicle, std::optional<double> initialSteering,
                             std::optional<double> finalSteering);
}  // namespace parking

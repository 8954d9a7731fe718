#pragma once

#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"
#include "path_tracking/trajectory/TimedMotion.h"

#include <optional>

namespace parking
{
    /** \brief Drives \e path exactly: at rest wherever the curvature jumps or the direction changes, while the wheels
        turn, and as fast as the limits of \e vehicle allow in between. Always there, and slow.

        Between two standstills the speed rises and falls at the full acceleration; along clothoids it stays low enough
        for the steering rate.

        \param vehicle its limits may be shares of a car's, and so less than Vehicle::MIN_LIMIT; they are positive
        \param initialSteering, finalSteering radians; without them the wheels are where the path begins and ends
        Throws parking::Error for a path that turns on the spot, never drives, is not finite, turns tighter than the
        car, or takes more than LONGEST_MOTION. */
    TimedMotion stopAndSteer(const Path &path, const Vehicle &vehicle, std::optional<double> initialSteering,
                             std::optional<double> finalSteering);
}  // namespace parking

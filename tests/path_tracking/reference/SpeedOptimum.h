#pragma once

#include "parking_geometry/curves/Path.h"
#include "path_tracking/reference/SpeedProfile.h"

namespace parking::test
{
    /** Shortest time in which a path can be driven, by dynamic programming on a fine grid of places and squared speeds,
        from the path's curvature itself. Stands where the direction changes, steering there as long as needed.
        Knows nothing of the project's speed profile but the limits. */
    double optimalDuration(const Path &path, const Vehicle &vehicle, const SpeedLimits &limits);
}  // namespace parking::test

#pragma once

#include "tests/path_tracking/TestPaths.h"
#include "path_tracking/reference/SpeedProfile.h"

#include <vector>

namespace parking::test
{
    /** Shortest time in which a path can be driven, by dynamic programming on a fine grid of places and squared speeds,
        from the curvature functions themselves. Stands where the direction changes, steering there as long as needed.
        Knows nothing of the project's speed profile but the limits. */
    double optimalDuration(const std::vector<SmoothPiece> &pieces, const Vehicle &vehicle, const SpeedLimits &limits);
}  // namespace parking::test

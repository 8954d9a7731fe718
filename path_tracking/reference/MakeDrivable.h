#pragma once

#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"

#include <cstddef>

namespace parking
{
    /** \brief How corners are driven. */
    struct CornerParameters
    {
        double steeringSlope{1.0};     ///< radians of steering per metre while a corner is cut
        double maxCut{1.0};            ///< metres; a corner that would be cut by more is turned at with shunts
        double maxDeviation{9.0};      ///< metres; a path that would be left by more is refused
        double endTolerance{0.02};     ///< metres beside the end of the path from which the car shunts to it
        double endYawTolerance{0.03};  ///< radians, likewise
    };

    /** \brief What makeDrivable() did. */
    struct CornerReport
    {
        std::size_t corners{0};  ///< turns on the spot in what was given
        std::size_t shunts{0};   ///< places where the car shunts to turn, or to reach the end
        double deviation{0.0};   ///< metres that the result leaves what was given at most
    };

    /** \brief \e path as a car can drive it: without turns on the spot, which are its corners.

        A path without turns is returned as it is. Elsewhere stretches without turns are kept as they are, and corners
        are cut (see roundCorners()). Where that would leave the stretch by more than maxCut, the car stops at the
        corner where it is worst and turns to the next piece by the shortest Reeds-Shepp curve, cutting what lies before
        and behind; likewise at a stretch that begins with another heading than the car has, so that a manoeuvre behind
        a grid path is driven exactly, and at the end of the path.

        Throws parking::Error naming the piece for a number that is not finite, a piece that both turns and drives and a
        curvature beyond the car's (by more than 1 %; steering is cut to the car's limit), for a path of no length, and
        naming the deviation when it exceeds maxDeviation. */
    Path makeDrivable(const Path &path, const Vehicle &vehicle, const CornerParameters &parameters = {},
                      CornerReport *report = nullptr);
}  // namespace parking

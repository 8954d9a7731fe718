#pragma once

#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"

#include <cstddef>

namespace parking
{
    /** \brief Parameters for making a path drivable before it is timed. */
    struct ReferenceParameters
    {
        /** Metres that any point of the body may deviate from the path at a jump of the curvature, where the car steers
            while driving. */
        double bodyTolerance{0.01};
        /** m/s; if steering within bodyTolerance requires a lower speed, the car stops to steer. */
        double minBlendSpeed{0.1};
        /** Metres; maximum length over which a jump of the curvature is spread. */
        double maxBlendLength{1.0};
        /** Metres that the rear axle may deviate from a path when it cuts a sharp corner. At sharper corners the car
            turns with shunts. */
        double maxCornerCut{1.0};
        /** Maximum deviation of the rear axle from a path with sharp corners, in turning radii. A path that requires
            more is rejected. Turning round on the spot with shunts requires two. */
        double maxCornerRadii{3.0};
        /** m/s at which the car must be able to steer round the corners of such a path. */
        double cornerSpeed{0.5};

        /** \brief Throws parking::Error naming the first field that is not a positive finite number. */
        void validate() const;
    };

    /** \brief Result of makeDrivable(). */
    struct DrivablePath
    {
        Path path;               ///< without turns on the spot
        std::size_t corners{0};  ///< number of turns on the spot in the given path
        std::size_t shunts{0};   ///< number of places where the car shunts to turn or to reach the end
        double deviation{0.0};   ///< metres, maximum deviation from the given path
    };

    /** \brief Returns \e path as a car can drive it: without its corners, which are turns on the spot.

        A path without turns is returned unchanged. Otherwise stretches without turns are kept, and corners are cut. A
        simulated car follows the path (pure pursuit) and returns to it exactly after the last corner. A single corner
        of angle c is cut by little more than R (1 / cos(c / 2) - 1). This is the distance from the corner to the arc of
        radius R, the turning radius, that touches both chords.

        If the car would deviate by more than maxCornerCut, it stops at the worst corner. It turns to the next piece by
        the shortest Reeds-Shepp curve, and the parts before and after are cut separately. The car also shunts before a
        stretch that starts with another heading, and at the end of the path. A manoeuvre after a grid path is therefore
        driven exactly.

        Throws parking::Error naming the piece for a number that is not finite, and for a piece that both turns and
        drives. Throws also for a curvature that exceeds the car's by more than 1 %; below that, steering is clamped to
        the limit. Throws for a path without length, and naming the deviation if it exceeds maxCornerRadii. */
    DrivablePath makeDrivable(const Path &path, const Vehicle &vehicle, const ReferenceParameters &parameters = {});
}  // namespace parking

#pragma once

#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"

#include <cstddef>

namespace parking
{
    /** \brief How a path is made drivable before it is timed. */
    struct ReferenceParameters
    {
        /** Metres that any point of the body may leave the path when the steering wheel is turned in motion where the
            curvature jumps. */
        double bodyTolerance{0.01};
        /** m/s; where turning the wheel within bodyTolerance would need a lower speed, the car stops to steer. */
        double minBlendSpeed{0.1};
        /** Metres; a jump of curvature is never spread over more than this. */
        double maxBlendLength{1.0};
        /** Metres that the rear axle may leave a path at a sharp corner by cutting it; a sharper one is turned at with
            shunts. */
        double maxCornerCut{1.0};
        /** Turning radii of the car that the rear axle may leave a path with sharp corners at all; beyond it the path
            is refused. Turning round on the spot, which takes shunts, needs two. */
        double maxCornerRadii{3.0};
        /** m/s at which the car shall be able to turn its wheels round the corners of such a path. */
        double cornerSpeed{0.5};

        /** \brief Throws parking::Error naming the first field that is not a positive finite number. */
        void validate() const;
    };

    /** \brief What makeDrivable() made of a path. */
    struct DrivablePath
    {
        Path path;               ///< without turns on the spot
        std::size_t corners{0};  ///< turns on the spot in what was given
        std::size_t shunts{0};   ///< places where the car shunts to turn, or to reach the end
        double deviation{0.0};   ///< metres that the path leaves what was given at most
    };

    /** \brief \e path as a car can drive it: without turns on the spot, which are its corners.

        A path without turns is returned as it is. Elsewhere stretches without turns are kept as they are, and corners
        are cut: a simulated car follows the path (pure pursuit) and returns to it exactly behind the last corner. A
        lone corner of angle c is cut by little more than R (1 / cos(c / 2) - 1), the distance from the corner to the
        arc of the turning radius R that touches both chords. Where the car would leave the path by more than
        maxCornerCut, it stops at the corner where it is worst and turns to the next piece by the shortest Reeds-Shepp
        curve, cutting what lies before and behind; likewise at a stretch that begins with another heading than the car
        has, so that a manoeuvre behind a grid path is driven exactly, and at the end of the path.

        Throws parking::Error naming the piece for a number that is not finite, a piece that both turns and drives and a
        curvature beyond the car's (by more than 1 %; steering is cut to the car's limit), for a path of no length, and
        naming the deviation when it exceeds maxCornerRadii. */
    DrivablePath makeDrivable(const Path &path, const Vehicle &vehicle, const ReferenceParameters &parameters = {});
}  // namespace parking

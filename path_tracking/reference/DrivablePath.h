#pragma once

#include "parking_geometry/Vehicle.h"
#include "path_tracking/reference/PathSections.h"

#include <cstddef>
#include <vector>

namespace parking
{
    /** \brief How corners are driven. */
    struct CornerParameters
    {
        double steeringSlope{1.0};             ///< radians of steering per metre while a corner is cut
        double maxCut{1.0};                    ///< metres; a corner that would be cut by more is turned at with shunts
        double maxDeviation{3.5};              ///< metres; a path that would be left by more is refused
        double endTolerance{0.02};             ///< metres beside the end of the path from which the car shunts to it
        double endYawTolerance{CORNER_ANGLE};  ///< radians, likewise
    };

    /** \brief Arcs that a car can drive in one direction. */
    struct DrivablePiece
    {
        int direction{1};
        std::vector<PathNode> nodes;
    };

    /** \brief A path whose heading never jumps. */
    struct DrivablePath
    {
        std::vector<DrivablePiece> pieces;
        std::size_t corners{0};  ///< jumps of the heading in what was given
        std::size_t turns{0};    ///< of those, how many are turned at with shunts
        double deviation{0.0};   ///< metres that it leaves what was given at most
    };

    /** \brief Makes \e sections drivable, from the begin of the first to \e goal.

        Sections without corners are kept as they are. Corners are cut (see roundCorners()). Where that would leave the
        section by more than maxCut, the car stops at the corner where it is worst and turns to the next chord by the
        shortest Reeds-Shepp curve, cutting what lies before and behind; likewise at a section that begins with another
        heading than the car has, so that a manoeuvre behind a grid path is driven exactly, and at the end of the path.

        Throws parking::Error naming the deviation when it exceeds maxDeviation. */
    DrivablePath makeDrivable(const std::vector<PathSection> &sections, const Pose &goal, const Vehicle &vehicle,
                              const CornerParameters &parameters);
}  // namespace parking

#pragma once

#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"

#include <cstddef>
#include <vector>

namespace parking
{
    /** \brief A pose on a path and the piece of constant curvature that leads to it. */
    struct PathNode
    {
        Pose pose;
        double curvature{0.0};  ///< 1/m, of the piece that ends here (first node: of the piece that begins here)
        double length{0.0};     ///< metres of that piece, positive (first node: 0)
    };

    /** \brief A stretch of a path driven in one direction. */
    struct PathSection
    {
        int direction{1};               ///< 1 forwards, -1 in reverse
        std::vector<PathNode> nodes;    ///< at least two
        std::vector<bool> corner;       ///< per node: does the heading jump here, in the middle of the motion?
        double startYaw{0.0};           ///< heading with which the first piece leaves, radians
        double largestCorner{0.0};      ///< of the jumps inside the section and at its begin, radians
        std::size_t cornerCount{0};     ///< of those jumps
        std::size_t lastCornerNode{0};  ///< 0 when there is none but perhaps at the begin
    };

    /** \brief Heading jumps below this many radians (1.7 degrees) are rounding, not corners. */
    constexpr double CORNER_ANGLE = 0.03;

    /** \brief Checks \e path and splits it where the direction changes.

        Between two states the car drives an arc of the later state's curvature. Grid planners instead deliver straight
        chords whose heading jumps where they meet, with the heading of either chord given at the corner; both ways of
        writing it are understood, and the jumps are marked. States repeated at the same place are dropped.

        Throws parking::Error naming the state when the path has fewer than two different states, holds a number that is
        not finite, a direction other than 1 or -1, or a curvature beyond the car's (by more than 1 %; less is cut). */
    std::vector<PathSection> splitPath(const SampledPath &path, const Vehicle &vehicle);
}  // namespace parking

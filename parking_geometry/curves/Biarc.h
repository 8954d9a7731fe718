#pragma once

#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/Path.h"

#include <optional>

namespace parking
{
    /** \brief Two arcs that lead from \e from to \e to exactly, with one tangent where they meet.

        For poses that are nearly on one arc already, such as neighbouring states on a smooth curve: what is
        missing is spread over both arcs. Of all such pairs the one whose tangents reach equally far from either end is
        taken (K. M. Bolton, "Biarc curves", Computer-Aided Design 7(2), 1975).

        \param direction 1 forwards, -1 in reverse
        \return a path of one or two pieces; nothing when \e to is not ahead in that direction or is the same place */
    std::optional<Path> biarc(const Pose &from, const Pose &to, int direction);
}  // namespace parking

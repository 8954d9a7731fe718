#pragma once

#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/Path.h"

#include <optional>

namespace parking
{
    /** \brief Two arcs with a common tangent at their joint that lead exactly from \e from to \e to.

        The function is intended for poses that lie nearly on one arc, such as neighbouring states of a smooth curve. Of
        the possible pairs it returns the one with tangents of equal length at both ends (K. M. Bolton, "Biarc curves",
        Computer-Aided Design 7(2), 1975).

        \param direction 1 forwards, -1 in reverse
        \return a path of one or two pieces; nothing if \e to coincides with \e from or is not ahead in that
        direction */
    std::optional<Path> biarc(const Pose &from, const Pose &to, int direction);
}  // namespace parking

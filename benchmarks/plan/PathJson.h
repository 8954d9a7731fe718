#pragma once

#include "parking_geometry/curves/Path.h"

#include <nlohmann/json.hpp>

namespace parking
{
    /** \brief A path as files keep it, exactly: {"start": [x, y, yaw], "pieces": [...]} in metres and radians.

        A piece is [curvature, length] when it is an arc, [curvature, length, sharpness] when it is a clothoid and
        [turn] when it is a turn on the spot. */
    nlohmann::json toJson(const Path &path);

    /** \brief Reads what toJson() has written. Throws parking::Error or an exception of nlohmann's for anything
        else. */
    Path pathFromJson(const nlohmann::json &json);
}  // namespace parking

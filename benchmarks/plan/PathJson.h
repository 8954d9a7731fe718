#pragma once

#include "parking_geometry/curves/Path.h"

#include <nlohmann/json.hpp>

namespace parking
{
    /** \brief A path in files, without loss: {"start": [x, y, yaw], "pieces": [...]} in metres and radians.

        A piece is [curvature, length] for an arc, [curvature, length, sharpness] for a clothoid and [turn] for a turn
        on the spot. */
    nlohmann::json toJson(const Path &path);

    /** \brief Reads the output of toJson(). Throws parking::Error or an exception of nlohmann's library for other
        input. */
    Path pathFromJson(const nlohmann::json &json);
}  // namespace parking

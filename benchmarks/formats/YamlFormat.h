#pragma once

#include "parking_geometry/Scenario.h"

#include <string>

namespace parking
{
    /** \brief A YAML scenario: car, start, goal and obstacles, which are either polygons or the map file \e map.

        All poses and corners as given: callers choose the coordinates. */
    std::string yamlText(const Vehicle &car, const Pose &start, const Pose &goal, const std::vector<Polygon> &polygons,
                         const std::string &map = "", bool unknownIsOccupied = true);
}  // namespace parking

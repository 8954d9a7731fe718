#pragma once

#include "parking_geometry/Box.h"
#include "parking_geometry/OccupancyGrid.h"
#include "parking_geometry/ParkingSlot.h"
#include "parking_geometry/Polygon.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/Vehicle.h"

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief A parking problem: obstacles, a car, its start and its goals.

        All coordinates are local: metres relative to \e worldOffset. Readers choose the offset so that coordinates near
        the problem are small. Some cases lie at 4e9 m, where a double resolves only a micrometre. A world coordinate is
        the local one plus worldOffset. The yaw is the same in both.

        The world consists of either polygons in a bounded box or a grid. No part of the car's body may leave \e bounds
        or the grid. */
    struct Scenario
    {
        std::string name;                       ///< name in titles and results
        Vehicle vehicle;                        ///< the car to park
        Pose start;                             ///< start pose, local
        std::vector<Pose> goals;                ///< local goals, at least one; several if the slot has several entries
        std::optional<ParkingSlot> slot;        ///< the slot, if the file describes one
        std::vector<Polygon> polygons;          ///< obstacles of a polygon world
        std::optional<OccupancyGrid> grid;      ///< obstacles of a grid world
        bool unknownIsOccupied{true};           ///< whether unknown cells of the grid are obstacles
        Box bounds;                             ///< local bounds of the world; for a grid, the bounding box of the map
        Eigen::Vector2d worldOffset{0.0, 0.0};  ///< local origin in the coordinates of the file, metres
        std::vector<std::string> files;         ///< all files that were read: scenario, map, image, vehicle
        std::vector<std::string> warnings;      ///< sentences for the user of the files, for example on unknown cells

        /** \brief Expresses a local pose in the coordinates of the file. */
        Pose toWorld(const Pose &local) const
        {
            return {local.x + worldOffset.x(), local.y + worldOffset.y(), local.yaw};
        }
    };

    /** \brief Margin between the bounds of a polygon scenario and its start, goals and obstacles, in metres. */
    constexpr double POLYGON_WORLD_MARGIN = 10.0;
}  // namespace parking

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

        All coordinates are local: metres relative to \e worldOffset, which readers choose so that numbers near the
        problem are small (some cases sit at 4e9 m, where a double resolves a micrometre only). A world coordinate is
        the local one plus worldOffset; yaw is the same in both.

        The world is either polygons in a bounded box, or a grid. The car may not leave \e bounds, or the grid, with any
        part of its body. */
    struct Scenario
    {
        std::string name;                       ///< for titles and results
        Vehicle vehicle;                        ///< the car that shall park
        Pose start;                             ///< where the car stands, local
        std::vector<Pose> goals;                ///< at least one; several when the slot may be entered either way
        std::optional<ParkingSlot> slot;        ///< present when the file described a slot
        std::vector<Polygon> polygons;          ///< obstacles of a polygon world
        std::optional<OccupancyGrid> grid;      ///< obstacles of a grid world
        bool unknownIsOccupied{true};           ///< how unknown cells of the grid count
        Box bounds;                             ///< local; for a grid world the box round the map
        Eigen::Vector2d worldOffset{0.0, 0.0};  ///< metres; where the local origin lies in the coordinates of the file
        std::vector<std::string> files;         ///< all that it was read from: itself, its map and image, its car

        /** \brief Expresses a local pose in the coordinates of the file. */
        Pose toWorld(const Pose &local) const
        {
            return {local.x + worldOffset.x(), local.y + worldOffset.y(), local.yaw};
        }
    };

    /** \brief How far the free world of a polygon scenario reaches beyond start, goals and obstacles, in metres. */
    constexpr double POLYGON_WORLD_MARGIN = 10.0;
}  // namespace parking

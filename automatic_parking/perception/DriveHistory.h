#pragma once

#include "parking_geometry/OccupancyGrid.h"
#include "parking_geometry/curves/Path.h"

#include <vector>

namespace parking
{
    /** \brief Cells whose occupancy a car has seen at one moment of its drive. */
    struct SeenFrame
    {
        double time{0.0};    ///< seconds since the first command
        GridUpdate changes;  ///< the cells that differ from before
    };

    /** \brief A plan that a car has taken over during its drive. */
    struct TimedPlan
    {
        double time{0.0};  ///< seconds since the first command
        Path path;         ///< from where it continues the drive to the goal
    };

    /** \brief What a car has perceived and planned during a drive, in order of time. */
    struct DriveHistory
    {
        OccupancyGrid map;              ///< before the first frame; without cells in a known world
        std::vector<SeenFrame> frames;  ///< those with changes
        std::vector<TimedPlan> plans;   ///< the first one and all that followed
    };
}  // namespace parking

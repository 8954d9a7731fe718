#pragma once

#include "parking_geometry/OccupancyGrid.h"
#include "parking_geometry/Pose.h"

namespace parking
{
    /** \brief A source of sensor frames: what a car's sensors see of the ground around it.

        Implement it to connect a sensor of your own, see PerceivedWorld for its use. */
    class Perception
    {
    public:
        virtual ~Perception() = default;

        /** \brief The cells of \e map that the sensors see differently from \e map.

            Cells that are not seen are not reported, so they keep their last occupancy. A cell is free only if no
            obstacle touches it. The function may throw; PerceivedWorld reports exceptions as parking::Error.

            \param time seconds, not before that of the previous call
            \param car pose of the car, in the coordinates of the map's origin
            \param map all cells as perceived so far; its size, resolution and origin stay the same
            \return the changes; empty if no new frame is available at this time */
        virtual GridUpdate observe(double time, const Pose &car, const OccupancyGrid &map) = 0;
    };
}  // namespace parking

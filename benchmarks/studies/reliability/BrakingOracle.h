#pragma once

#include "parking_geometry/Vehicle.h"
#include "path_tracking/simulation/Plant.h"
#include "path_tracking/trajectory/Trajectory.h"

#include <vector>

namespace parking
{
    /** \brief Where a car goes that brakes with all it has from an instant of a drive on: what physics allows.

        An integration of its own, in steps of 5 ms, which shares nothing with controller, supervisor and simulated car:
        it slows down as hard as this car really can, its wheels stand as they do in the drive where it passes the same
        place, and stay where they are while they stick.

        \param drive what the car would do if it did not brake, truly driven
        \param odds what is wrong with the car
        \param since seconds, the begin of what is looked at: an obstacle appears, or something breaks
        \param brakes seconds, when the brake takes hold
        \return the poses from \e since to standstill */
    std::vector<Pose> brakingWay(const Trajectory &drive, const Vehicle &car, const Disturbances &odds, double since,
                                 double brakes);
}  // namespace parking

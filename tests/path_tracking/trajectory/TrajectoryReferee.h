#pragma once

#include "parking_geometry/Polygon.h"
#include "parking_geometry/Vehicle.h"
#include "path_tracking/trajectory/Trajectory.h"

#include <string>
#include <vector>

namespace parking::test
{
    /** \brief What a referee found out about a trajectory. */
    struct Verdict
    {
        std::string fault;     ///< the first thing that is wrong; empty when nothing is
        Pose end;              ///< where a car gets that does what the trajectory says
        double duration{0.0};  ///< seconds
    };

    /** \brief Can a car drive these samples from rest to rest, and does it touch nothing?

        Between two samples speed and steering angle are linear; a car is driven accordingly in steps of 2 ms. Limits,
        poses and, at every step, the body against the polygons. Nothing here is shared with the code that makes or
        checks trajectories. */
    Verdict judge(const Trajectory &trajectory, const Vehicle &vehicle, const std::vector<Polygon> &obstacles);

    /** \brief Does the body touch a polygon at this pose? */
    bool touches(const Pose &pose, const Vehicle &vehicle, const std::vector<Polygon> &obstacles);
}  // namespace parking::test

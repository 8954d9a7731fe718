#pragma once

#include "automatic_parking/ParkingPlanner.h"
#include "automatic_parking/QuickestTrajectory.h"
#include "parking_geometry/Vehicle.h"
#include "path_tracking/trajectory/TimedMotion.h"

#include <functional>
#include <optional>
#include <string>

namespace parking
{
    /** \brief A motion that continues another one. */
    struct Replan
    {
        std::string failure;            ///< why there is none; empty if there is one
        TimedMotion motion;             ///< equals the driven motion up to the splice
        bool stops{false};              ///< whether the car brakes to rest before it continues on another path
        ParkingPlan plan;               ///< of the part after the splice
        QuickestTrajectory trajectory;  ///< of the part after the splice
    };

    /** \brief Input of replan(). */
    struct ReplanRequest
    {
        const TimedMotion &motion;  ///< the motion that the car follows
        const Vehicle &car;         ///< as driven
        double now;                 ///< seconds since the start of the motion
        double splice;              ///< seconds since the start of the motion, when the new motion may begin
        double deceleration;        ///< m/s^2, for braking along the motion from the splice

        /** Plans a path from a pose to a goal. */
        std::function<ParkingPlan(const Pose &)> plan;
        /** Optimises a trajectory along a plan, from a steering angle in radians and a speed in m/s. */
        std::function<std::optional<QuickestTrajectory>(const ParkingPlan &, double steering, double speed)> optimize;
        /** Whether the part of a motion after \e now is free. */
        std::function<bool(const TimedMotion &)> isFree;
    };

    /** \brief A free motion from where the car will be at the splice, with its speed and steering angle there.

        The first candidate continues in motion: a trajectory along a new path that starts in the direction of travel.
        The second one brakes to rest along the driven motion, from the splice, or at once and with the
        whole brake if that is too late. It then
        continues along a new path. Position, heading, speed and steering angle are continuous, and the motion up to the
        splice is kept.

        \return if neither candidate exists, a result with the reason */
    Replan replan(const ReplanRequest &request);
}  // namespace parking

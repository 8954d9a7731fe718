#pragma once

#include "parking_geometry/Pose.h"
#include "parking_geometry/Vehicle.h"

#include <cstddef>
#include <functional>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief Settings of the controller that the paper leaves open. */
    struct PaperDriveOptions
    {
        double speed{1.0};            ///< speed of the reference along the path in m/s
        double headingWeight{300.0};  ///< W4, per rad^2
        double alignDistance{2.0};    ///< d in metres: W4 applies below this distance to the goal
    };

    /** \brief State and control at one time of a drive. */
    struct PaperDriveState
    {
        double time{0.0};          ///< seconds
        Pose pose;                 ///< pose of the vehicle's reference point
        double speed{0.0};         ///< m/s, negative in reverse
        double acceleration{0.0};  ///< m/s^2, constant since the previous moment
        double steering{0.0};      ///< radians
    };

    /** \brief The result of a drive. */
    struct PaperDriveResult
    {
        std::vector<PaperDriveState> states;  ///< one state per step of the controller, from the start
        bool stands{false};                   ///< whether the car is at rest in the end
        double travelTime{0.0};               ///< seconds until the last motion
        double meanAcceleration{0.0};         ///< mean of the absolute acceleration over that time in m/s^2
        double meanSteering{0.0};             ///< mean of the absolute steering angle over that time in radians
        double positionError{0.0};            ///< metres between final position and goal
        double headingError{0.0};             ///< absolute difference between final heading and goal in radians
        double greatestDeviation{0.0};        ///< maximum distance to the path in metres
        double collidingShare{0.0};           ///< share of the states in collision
        std::size_t failures{0};              ///< number of steps without a solution of the solver; the car then brakes
    };

    /** \brief Drives the paper's controller (section "Cost Function Design") along an unmodified path.

        The cost is the paper's. W1 weights u^2 and W2 the changes of u. W3 weights the distance to the reference D(t),
        and W4 within d of the goal the difference to the slot's heading. D(t) moves along \e path at constant speed and
        then waits at its end. Acceleration, steering angle and speed are bounded; the paper does not limit the steering
        rate. The direction of travel is free, since the paper's cost does not contain it. The paper states no weights;
        the others are those of MpcParameters.

        \param path points, at least one; the car begins at \e start, at rest
        \param goal defines the heading in the slot
        \param isFree whether the body is free at a pose, for collidingShare; may be empty */
    PaperDriveResult drivePaper(const Vehicle &vehicle, const std::vector<Eigen::Vector2d> &path, const Pose &start,
                                const Pose &goal, const PaperDriveOptions &options,
                                const std::function<bool(const Pose &)> &isFree);
}  // namespace parking

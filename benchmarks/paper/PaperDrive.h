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
        double speed{1.0};            ///< m/s, of the wanted position along the path
        double headingWeight{300.0};  ///< W4, per rad^2
        double alignDistance{2.0};    ///< metres, d: nearer to the goal than this W4 holds
    };

    /** \brief A moment of a drive. */
    struct PaperDriveState
    {
        double time{0.0};          ///< seconds
        Pose pose;                 ///< of the vehicle's reference point
        double speed{0.0};         ///< m/s, negative in reverse
        double acceleration{0.0};  ///< m/s^2, held since the moment before
        double steering{0.0};      ///< radians
    };

    /** \brief The result of a drive. */
    struct PaperDriveResult
    {
        std::vector<PaperDriveState> states;  ///< one per step of the controller, from the start on
        bool stands{false};                   ///< whether the car is at rest in the end
        double travelTime{0.0};               ///< seconds until it moved last
        double meanAcceleration{0.0};         ///< m/s^2, of absolute values over that time
        double meanSteering{0.0};             ///< radians, likewise
        double positionError{0.0};            ///< metres from the goal in the end
        double headingError{0.0};             ///< radians from the goal in the end, absolute
        double greatestDeviation{0.0};        ///< metres from the path
        double collidingShare{0.0};           ///< of the states
        std::size_t failures{0};              ///< steps for which the solver had no answer; then the car brakes
    };

    /** \brief Drives the paper's controller (section "Cost Function Design") along a path that is not reworked.

        The cost is the paper's: W1 u^2, W2 of the changes of u, W3 of the distance to the wanted position D(t), and
        nearer than d to the goal W4 of the difference to the heading in the slot. D(t) moves along \e path at constant
        speed and then waits at its end. Bounds are those of acceleration, steering angle and speed; the paper does not
        limit the steering rate. The car may change its direction at any time: the paper's cost does not say in which
        direction the path is driven. The paper gives no weights; the others are those of MpcParameters.

        \param path points, at least one; the car begins at \e start, at rest
        \param goal gives the heading in the slot
        \param isFree of the body at a pose, for collidingShare; may be empty */
    PaperDriveResult drivePaper(const Vehicle &vehicle, const std::vector<Eigen::Vector2d> &path, const Pose &start,
                                const Pose &goal, const PaperDriveOptions &options,
                                const std::function<bool(const Pose &)> &isFree);
}  // namespace parking

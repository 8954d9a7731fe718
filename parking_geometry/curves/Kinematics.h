#pragma once

#include "parking_geometry/Pose.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"

namespace parking
{
    /** \brief State of the bicycle model of the paper (section "Vehicle Kinematic Model"): z = [x, y, v, psi]. */
    struct CarState
    {
        Pose pose;
        double speed{0.0};  ///< m/s of the rear axle, negative in reverse
    };

    /** \brief The state after driving \e duration seconds with constant \e acceleration and constant \e steeringAngle.

        The paper's model (x' = v cos psi, y' = v sin psi, v' = a, psi' = v tan(delta) / L, no slip) solved exactly: the
        car stays on one circle whatever its speed does, so the distance driven is all that is needed.

        \param wheelbase metres, positive
        \param acceleration m/s^2; may reverse the direction of travel within the duration
        \param steeringAngle radians, magnitude below pi / 2
        \param duration seconds, not negative
        The yaw of the result is not wrapped. */
    CarState integrate(const CarState &state, double wheelbase, double acceleration, double steeringAngle,
                       double duration);

    /** \brief Turning radius of the rear axle's midpoint, L / tan(delta): positive to the left, infinite for 0. */
    double turningRadius(double wheelbase, double steeringAngle);

    /** \brief Angles of the two front wheels, radians, with the sign of the turn. */
    struct WheelAngles
    {
        double inner{0.0};  ///< of the wheel nearer to the turning centre, the larger magnitude
        double outer{0.0};
    };

    /** \brief Front wheel angles of a car with Ackermann steering when the bicycle model steers by \e steeringAngle.

        All wheels turn about one point on the rear axle's line, at R = L / tan(delta) from its midpoint:
        tan(inner) = L / (|R| - W/2), tan(outer) = L / (|R| + W/2) with the distance W between the front wheels.

        \param wheelbase metres, positive
        \param track W, metres, not negative
        \param steeringAngle radians, magnitude below pi / 2
        Throws parking::Error when the turning centre would lie between the wheels (|R| <= W/2). */
    WheelAngles frontWheelAngles(double wheelbase, double track, double steeringAngle);

    /** \brief The paper's mean steering angle, (inner + outer) / 2.

        An approximation of the angle of the bicycle model, which is the one with cot(delta) = (cot(inner) +
        cot(outer)) / 2; the mean is the larger one, by about a degree for a car at full lock. */
    double meanSteeringAngle(const WheelAngles &angles);

    /** \brief The angle of the bicycle model exactly, from cot(delta) = (cot(inner) + cot(outer)) / 2. */
    double bicycleSteeringAngle(const WheelAngles &angles);

    /** \brief Radii, about the turning centre, between which the whole body moves on a circle. */
    struct SweptRadii
    {
        double inner{0.0};       ///< of the inner side, abeam of the rear axle
        double outerFront{0.0};  ///< of the outer front corner
        double outerRear{0.0};   ///< of the outer rear corner
    };

    /** \brief What the body of \e vehicle sweeps when its rear axle drives a circle of \e radius metres (positive). */
    SweptRadii sweptRadii(const Vehicle &vehicle, double radius);

    /** \brief How fast the curvature may change per metre driven, 1/m^2, when the wheels turn at the vehicle's steering
        rate while it drives at \e speed: rate (1 + (kappa L)^2) / (L v).

        \param speed m/s, positive
        \param curvature where along the steering range; 0, the default, gives the smallest value */
    double maxSharpness(const Vehicle &vehicle, double speed, double curvature = 0.0);

    /** \brief The highest speed, m/s, at which the steering keeps up with a curvature that changes by \e sharpness per
        metre: the inverse of maxSharpness; infinite for 0. */
    double maxSpeedForSharpness(const Vehicle &vehicle, double sharpness, double curvature = 0.0);

    /** \brief The circular arc that leaves \e from with its heading and ends at \e to.

        Exact when such an arc exists (\e to then ends with its heading, at most half a circle away); otherwise the one
        whose change of heading is that of the poses and whose chord has the length of theirs. */
    Arc arcBetween(const Pose &from, const Pose &to);
}  // namespace parking

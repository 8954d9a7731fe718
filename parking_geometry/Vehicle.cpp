#include "parking_geometry/Vehicle.h"

#include "parking_geometry/text/Require.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        /** Nothing with wheels that parks is longer; a larger number means millimetres, and an error beats a planner
            that reports "infeasible". */
        constexpr double LONGEST = 50.0;
        /** Below it rounding is as large as the car: OMPL's curves fail their own checks. */
        constexpr double SHORTEST = 0.01;
        constexpr double TIGHTEST_TURN = 0.01, WIDEST_TURN = 1000.0;  // metres

        /** A car with less never gets there: what takes time would take hours, and memory for all of them. With more
            the numbers are in other units, or get out of hand when they are squared. Twice what a timed path asks for
            (SpeedLimits), so that a share of it may be kept for the controller. */
        void checkLimit(const Require &require, const char *field, double value, const std::string &unit)
        {
            require.that(value >= Vehicle::LEAST_LIMIT && value <= Vehicle::GREATEST_LIMIT, field, value,
                         "a number of " + unit + " from " + formatNumber(Vehicle::LEAST_LIMIT) + " to " +
                             formatNumber(Vehicle::GREATEST_LIMIT));
        }

        void checkLength(const Require &require, const char *field, double value, bool zeroAllowed)
        {
            const bool ok = std::isfinite(value) && value >= (zeroAllowed ? 0.0 : SHORTEST) && value <= LONGEST;
            require.that(ok, field, value,
                         zeroAllowed ? "a number of metres from 0 to 50" : "a number of metres from 0.01 to 50");
        }
    }  // namespace

    double Vehicle::turningLane(double margin) const
    {
        const double half = 0.5 * width + margin, farthest = margin + std::max(rearOverhang, wheelbase + frontOverhang);
        const double radius = minTurningRadius();
        return std::hypot(radius + half, farthest) - std::max(0.0, radius - half);
    }

    double Vehicle::minTurningRadius() const
    {
        return wheelbase / std::tan(maxSteeringAngle);
    }

    double Vehicle::curvature(double steeringAngle) const
    {
        return std::tan(steeringAngle) / wheelbase;
    }

    double Vehicle::steeringAngle(double curvature) const
    {
        return std::atan(curvature * wheelbase);
    }

    std::array<Eigen::Vector2d, 4> Vehicle::footprint(const Pose &pose) const
    {
        const Eigen::Vector2d axle(pose.x, pose.y);
        const Eigen::Vector2d forward(std::cos(pose.yaw), std::sin(pose.yaw));
        const Eigen::Vector2d left = 0.5 * width * Eigen::Vector2d(-forward.y(), forward.x());
        const Eigen::Vector2d rear = axle - rearOverhang * forward;
        const Eigen::Vector2d front = axle + (wheelbase + frontOverhang) * forward;
        return {rear - left, front - left, front + left, rear + left};
    }

    void Vehicle::validate() const
    {
        const Require require("vehicle " + inQuotes(name));
        checkLength(require, "wheelbase", wheelbase, false);
        checkLength(require, "front_overhang", frontOverhang, true);
        checkLength(require, "rear_overhang", rearOverhang, true);
        checkLength(require, "width", width, false);
        require.that(std::isfinite(maxSteeringAngle) && maxSteeringAngle > 0.0 && maxSteeringAngle < 0.5 * PI,
                     "max_steering_angle", maxSteeringAngle,
                     "a number of radians above 0 and below 1.5708 (90 degrees)");
        const double radius = minTurningRadius();
        require.that(radius >= TIGHTEST_TURN && radius <= WIDEST_TURN, "max_steering_angle", maxSteeringAngle,
                     "an angle that turns the car round a circle with a radius of 0.01 to 1000 m, not " +
                         formatNumber(radius) + " m");
        checkLimit(require, "max_speed", maxSpeed, "m/s");
        checkLimit(require, "max_acceleration", maxAcceleration, "m/s^2");
        checkLimit(require, "max_steering_rate", maxSteeringRate, "rad/s");
    }
}  // namespace parking

#include "parking_geometry/Vehicle.h"

#include "parking_geometry/text/Require.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        /** Largest length in metres. Larger values indicate other units and would otherwise only result in an
            infeasible problem. */
        constexpr double MAX_LENGTH = 50.0;
        /** Smallest length in metres. Below it, rounding errors are as large as the car and OMPL's curves fail their
            own checks. */
        constexpr double MIN_LENGTH = 0.01;
        constexpr double MIN_RADIUS = 0.01, MAX_RADIUS = 1000.0;  // metres

        /** Checks a limit of the drive. Smaller values would result in drives of hours and exhaust the memory, larger
            ones indicate other units. The minimum is twice that of a timed path (SpeedLimits), so a share of the limit
            can be reserved for the controller. */
        void checkLimit(const Require &require, const char *field, double value, const std::string &unit)
        {
            require.that(value >= Vehicle::MIN_LIMIT && value <= Vehicle::MAX_LIMIT, field, value,
                         "a number of " + unit + " from " + formatNumber(Vehicle::MIN_LIMIT) + " to " +
                             formatNumber(Vehicle::MAX_LIMIT));
        }

        void checkLength(const Require &require, const char *field, double value, bool zeroAllowed)
        {
            const bool ok = std::isfinite(value) && value >= (zeroAllowed ? 0.0 : MIN_LENGTH) && value <= MAX_LENGTH;
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
        require.that(radius >= MIN_RADIUS && radius <= MAX_RADIUS, "max_steering_angle", maxSteeringAngle,
                     "an angle that turns the car round a circle with a radius of 0.01 to 1000 m, not " +
                         formatNumber(radius) + " m");
        checkLimit(require, "max_speed", maxSpeed, "m/s");
        checkLimit(require, "max_acceleration", maxAcceleration, "m/s^2");
        checkLimit(require, "max_steering_rate", maxSteeringRate, "rad/s");
    }
}  // namespace parking

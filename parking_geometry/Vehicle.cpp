#include "parking_geometry/Vehicle.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <cmath>

namespace parking
{
    namespace
    {
        /** Nothing with wheels that parks is longer; a larger number means millimetres, and an error beats a planner
            that reports "infeasible". */
        constexpr double LONGEST = 50.0;

        void check(const Vehicle &vehicle, const char *field, double value, bool ok, const std::string &right)
        {
            if (!ok)
                throw Error("vehicle " + inQuotes(vehicle.name) + ": " + field + " is " + formatNumber(value) +
                            "; it must be " + right);
        }

        void checkLength(const Vehicle &vehicle, const char *field, double value, bool zeroAllowed)
        {
            const bool ok = std::isfinite(value) && (zeroAllowed ? value >= 0.0 : value > 0.0) && value <= LONGEST;
            check(vehicle, field, value, ok,
                  zeroAllowed ? "a number of metres from 0 to 50" : "a number of metres above 0 and up to 50");
        }

        void checkLimit(const Vehicle &vehicle, const char *field, double value, const char *unit)
        {
            check(vehicle, field, value, std::isfinite(value) && value > 0.0,
                  std::string("a positive number of ") + unit);
        }
    }  // namespace

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
        checkLength(*this, "wheelbase", wheelbase, false);
        checkLength(*this, "front_overhang", frontOverhang, true);
        checkLength(*this, "rear_overhang", rearOverhang, true);
        checkLength(*this, "width", width, false);
        check(*this, "max_steering_angle", maxSteeringAngle,
              std::isfinite(maxSteeringAngle) && maxSteeringAngle > 0.0 && maxSteeringAngle < 0.5 * PI,
              "a number of radians above 0 and below 1.5708 (90 degrees)");
        checkLimit(*this, "max_speed", maxSpeed, "m/s");
        checkLimit(*this, "max_acceleration", maxAcceleration, "m/s^2");
        checkLimit(*this, "max_steering_rate", maxSteeringRate, "rad/s");
    }
}  // namespace parking

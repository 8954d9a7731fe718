#include "parking_geometry/curves/Kinematics.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <cmath>
#include <limits>

namespace parking
{
    CarState integrate(const CarState &state, double wheelbase, double acceleration, double steeringAngle,
                       double duration)
    {
        const double distance = (state.speed + 0.5 * acceleration * duration) * duration;
        return {advance(state.pose, std::tan(steeringAngle) / wheelbase, distance),
                state.speed + acceleration * duration};
    }

    double turningRadius(double wheelbase, double steeringAngle)
    {
        return steeringAngle == 0.0 ? std::numeric_limits<double>::infinity() : wheelbase / std::tan(steeringAngle);
    }

    WheelAngles frontWheelAngles(double wheelbase, double track, double steeringAngle)
    {
        if (steeringAngle == 0.0)
            return {};
        const double radius = std::abs(turningRadius(wheelbase, steeringAngle));
        if (!(radius > 0.5 * track))
            throw Error("steering angle is " + formatNumber(steeringAngle) + "; with a track of " +
                        formatNumber(track) + " m it must be below " +
                        formatNumber(std::atan(2.0 * wheelbase / track)) + " rad");
        return {std::copysign(std::atan(wheelbase / (radius - 0.5 * track)), steeringAngle),
                std::copysign(std::atan(wheelbase / (radius + 0.5 * track)), steeringAngle)};
    }

    double meanSteeringAngle(const WheelAngles &angles)
    {
        return 0.5 * (angles.inner + angles.outer);
    }

    double bicycleSteeringAngle(const WheelAngles &angles)
    {
        const double inner = std::tan(angles.inner), outer = std::tan(angles.outer);
        return inner + outer == 0.0 ? 0.0 : std::atan(2.0 * inner * outer / (inner + outer));
    }

    SweptRadii sweptRadii(const Vehicle &vehicle, double radius)
    {
        const double outerSide = radius + 0.5 * vehicle.width;
        return {radius - 0.5 * vehicle.width, std::hypot(outerSide, vehicle.wheelbase + vehicle.frontOverhang),
                std::hypot(outerSide, vehicle.rearOverhang)};
    }

    double maxSharpness(const Vehicle &vehicle, double speed, double curvature)
    {
        const double tangent = curvature * vehicle.wheelbase;
        return vehicle.maxSteeringRate * (1.0 + tangent * tangent) / (vehicle.wheelbase * speed);
    }

    double maxSpeedForSharpness(const Vehicle &vehicle, double sharpness, double curvature)
    {
        return sharpness == 0.0 ? std::numeric_limits<double>::infinity()
                                : maxSharpness(vehicle, 1.0, curvature) / std::abs(sharpness);
    }

    Arc arcBetween(const Pose &from, const Pose &to)
    {
        const double dx = to.x - from.x, dy = to.y - from.y;
        const double half = 0.5 * wrapAngle(to.yaw - from.yaw);
        const double middle = from.yaw + half;
        const double chord = std::copysign(std::hypot(dx, dy), dx * std::cos(middle) + dy * std::sin(middle));
        const double length = std::abs(half) < 1e-6 ? chord * (1.0 + half * half / 6.0) : chord * half / std::sin(half);
        return {length == 0.0 ? 0.0 : 2.0 * half / length, length};
    }
}  // namespace parking

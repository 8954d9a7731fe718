#include "parking_geometry/curves/Kinematics.h"

#include <cmath>
#include <limits>

namespace parking
{
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

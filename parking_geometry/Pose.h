#pragma once

#include <cmath>

/** \brief All code of this project except the planner class ompl::geometric::ImprovedAStar.

    Units are metres, radians and seconds and their combinations unless a name or comment states another unit. */
namespace parking
{
    /** \brief Half the circumference of the unit circle. */
    constexpr double PI = 3.14159265358979323846;

    /** \brief The equivalent angle in [-pi, pi]. \param angle radians, finite */
    inline double wrapAngle(double angle)
    {
        // Faster than the remainder and equal to it: within three half turns the difference is exact.
        if (angle > PI && angle < 3.0 * PI)
            return angle - 2.0 * PI;
        if (angle < -PI && angle > -3.0 * PI)
            return angle + 2.0 * PI;
        return angle >= -PI && angle <= PI ? angle : std::remainder(angle, 2.0 * PI);
    }

    /** \brief A pose of the car in the plane: the midpoint of its rear axle and its heading.

        Every pose of a car in this project refers to this point, not to the centre of the body. */
    struct Pose
    {
        double x{0.0};    ///< metres
        double y{0.0};    ///< metres
        double yaw{0.0};  ///< radians, counter-clockwise from +x
    };

    /** \brief Largest magnitude of coordinates of scenarios and slots, in metres.

        All computations are relative to the start. Beyond this magnitude neighbouring doubles are more than 2
        micrometres apart, so results would lose their accuracy when they are moved back. */
    constexpr double MAX_COORDINATE = 1e10;

    /** \brief Whether all three coordinates are finite. */
    inline bool isFinite(const Pose &pose)
    {
        return std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.yaw);
    }

    /** \brief Metres between the positions of two poses. */
    inline double positionDistance(const Pose &a, const Pose &b)
    {
        return std::hypot(a.x - b.x, a.y - b.y);
    }

    /** \brief Whether the positions differ by at most \e tolerance metres and the headings by at most \e tolerance
        radians, modulo full turns. */
    inline bool isSamePose(const Pose &a, const Pose &b, double tolerance)
    {
        return positionDistance(a, b) <= tolerance && std::abs(wrapAngle(a.yaw - b.yaw)) <= tolerance;
    }

    /** \brief Expresses the pose \e local, given in the frame \e frame, in the parent frame of \e frame. */
    inline Pose compose(const Pose &frame, const Pose &local)
    {
        const double c = std::cos(frame.yaw), s = std::sin(frame.yaw);
        return {frame.x + c * local.x - s * local.y, frame.y + s * local.x + c * local.y,
                wrapAngle(frame.yaw + local.yaw)};
    }

    /** \brief Expresses \e pose in the frame \e frame; the inverse of compose(). */
    inline Pose relativeTo(const Pose &frame, const Pose &pose)
    {
        const double c = std::cos(frame.yaw), s = std::sin(frame.yaw);
        const double dx = pose.x - frame.x, dy = pose.y - frame.y;
        return {c * dx + s * dy, -s * dx + c * dy, wrapAngle(pose.yaw - frame.yaw)};
    }

    /** \brief Pose after driving \e distance along a circular arc or a straight line. The result is exact up to
        rounding and its yaw is not wrapped, so long arcs keep their number of turns.

        \param curvature 1/m, positive to the left
        \param distance metres along the arc, negative in reverse */
    inline Pose advance(const Pose &pose, double curvature, double distance)
    {
        // The half-angle form avoids cancellation for small curvatures and covers arcs and lines.
        const double half = 0.5 * curvature * distance;
        const double chord =
            std::abs(half) < 1e-6 ? distance * (1.0 - half * half / 6.0) : distance * std::sin(half) / half;
        return {pose.x + chord * std::cos(pose.yaw + half), pose.y + chord * std::sin(pose.yaw + half),
                pose.yaw + 2.0 * half};
    }
}  // namespace parking

#pragma once

#include <cmath>

/** \brief Everything of this project but the planner's own class, ompl::geometric::ImprovedAStar.

    Units are metres, radians, seconds and what follows from them, unless a name says otherwise. */
namespace parking
{
    /** \brief Half the circumference of the unit circle. */
    constexpr double PI = 3.14159265358979323846;

    /** \brief An angle brought into [-pi, pi]. \param angle radians, finite. */
    inline double wrapAngle(double angle)
    {
        // The same as the remainder, which takes longer: within three half turns the difference is exact.
        if (angle > PI && angle < 3.0 * PI)
            return angle - 2.0 * PI;
        if (angle < -PI && angle > -3.0 * PI)
            return angle + 2.0 * PI;
        return angle >= -PI && angle <= PI ? angle : std::remainder(angle, 2.0 * PI);
    }

    /** \brief A pose of the car in the plane: the midpoint of its rear axle and its heading.

        Metres and radians; yaw counter-clockwise from +x. Everything in this project that speaks of a pose of the car
        means this point, never the centre of the body. */
    struct Pose
    {
        double x{0.0};    ///< metres
        double y{0.0};    ///< metres
        double yaw{0.0};  ///< radians, counter-clockwise from +x
    };

    /** \brief Coordinates of scenarios and slots that are larger in magnitude are refused, metres: beyond this two
        neighbouring doubles are more than 2 micrometres apart, and what is found in exact numbers nearby (everything is
        computed relative to the start) is no longer exact where it lies. */
    constexpr double FARTHEST_COORDINATE = 1e10;

    /** \brief Are all three numbers finite? */
    inline bool isFinite(const Pose &pose)
    {
        return std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.yaw);
    }

    /** \brief Metres between the positions of two poses. */
    inline double positionDistance(const Pose &a, const Pose &b)
    {
        return std::hypot(a.x - b.x, a.y - b.y);
    }

    /** \brief Are the positions no farther apart than \e tolerance metres, and the headings than \e tolerance radians?
        Full turns between the headings do not count. */
    inline bool isSamePose(const Pose &a, const Pose &b, double tolerance)
    {
        return positionDistance(a, b) <= tolerance && std::abs(wrapAngle(a.yaw - b.yaw)) <= tolerance;
    }

    /** \brief The pose \e local, given in the frame \e frame, expressed in the frame that \e frame is given in. */
    inline Pose compose(const Pose &frame, const Pose &local)
    {
        const double c = std::cos(frame.yaw), s = std::sin(frame.yaw);
        return {frame.x + c * local.x - s * local.y, frame.y + s * local.x + c * local.y,
                wrapAngle(frame.yaw + local.yaw)};
    }

    /** \brief The pose \e pose expressed in the frame \e frame (inverse of compose). */
    inline Pose relativeTo(const Pose &frame, const Pose &pose)
    {
        const double c = std::cos(frame.yaw), s = std::sin(frame.yaw);
        const double dx = pose.x - frame.x, dy = pose.y - frame.y;
        return {c * dx + s * dy, -s * dx + c * dy, wrapAngle(pose.yaw - frame.yaw)};
    }

    /** \brief Where the car is after driving \e distance along a circular arc: exact, also for the straight line.

        \param curvature 1/m, positive to the left
        \param distance metres along the arc, negative in reverse
        The yaw of the result is not wrapped, so that long arcs keep count of their turns. */
    inline Pose advance(const Pose &pose, double curvature, double distance)
    {
        // Half-angle form: no cancellation for small curvature, one formula for arcs and lines.
        const double half = 0.5 * curvature * distance;
        const double chord =
            std::abs(half) < 1e-6 ? distance * (1.0 - half * half / 6.0) : distance * std::sin(half) / half;
        return {pose.x + chord * std::cos(pose.yaw + half), pose.y + chord * std::sin(pose.yaw + half),
                pose.yaw + 2.0 * half};
    }
}  // namespace parking

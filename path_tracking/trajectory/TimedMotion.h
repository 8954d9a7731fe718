#pragma once

#include "parking_geometry/Vehicle.h"
#include "path_tracking/trajectory/Trajectory.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace parking
{
    /** \brief Speed and steering angle at an instant. */
    struct MotionKnot
    {
        double t{0.0};         ///< seconds
        double v{0.0};         ///< m/s, negative in reverse
        double steering{0.0};  ///< radians
    };

    /** \brief The knot at a share \e part of the time between two knots. */
    MotionKnot between(const MotionKnot &a, const MotionKnot &b, double part);

    /** \brief Maximum duration of a motion or a reference, in seconds.

        Longer ones are rejected, because their samples would fill the memory. The limit corresponds to 50 km at TPCAP's
        speed, or 400 m of the slowest car. */
    constexpr double LONGEST_MOTION = 2e4;

    /** \brief A motion in exact form: its start, and speed and steering angle over time, both linear between two knots.
        It is the counterpart of Path with time.

        The pose follows from the bicycle model: x' = v cos yaw, y' = v sin yaw, yaw' = v tan(steering) / wheelbase. */
    struct TimedMotion
    {
        Pose start;                     ///< pose at the first knot
        std::vector<MotionKnot> knots;  ///< in order of time

        /** \brief Seconds from the first knot to the last; 0 without knots. */
        double duration() const
        {
            return knots.empty() ? 0.0 : knots.back().t - knots.front().t;
        }

        /** \brief Adds a knot \e after seconds after the last one. If \e after is 0, it replaces the last knot. */
        void append(double after, double v, double steering);
    };

    /** \brief A short part of a motion along which speed and steering are linear in time. */
    struct MotionPart
    {
        MotionKnot from,  ///< where the part begins
            to;           ///< where the part ends
        Pose before,      ///< pose at \e from; yaw not wrapped
            after;        ///< pose at \e to; yaw not wrapped

        /** \brief Duration in seconds. */
        double duration() const
        {
            return to.t - from.t;
        }

        /** \brief Metres driven, negative in reverse. */
        double length() const
        {
            return 0.5 * (from.v + to.v) * duration();
        }
    };

    /** \brief Integrates \e motion (fourth-order Runge-Kutta) and calls \e visit with its parts in order until it
        returns false.

        No part is longer than \e step seconds or \e length metres. Each standstill is one part. With parts of 0.02 s
        the poses are accurate to a micrometre.

        \return whether \e visit accepted all parts */
    bool visitParts(const TimedMotion &motion, const Vehicle &vehicle, double step, double length,
                    const std::function<bool(const MotionPart &)> &visit);

    /** \brief The last pose of the motion; yaw not wrapped. */
    Pose endOf(const TimedMotion &motion, const Vehicle &vehicle);

    /** \brief The remainder of the motion after its first \e driven metres. */
    TimedMotion restOf(const TimedMotion &motion, const Vehicle &vehicle, double driven);

    /** \brief The motion as samples no more than \e step seconds apart, including every knot.

        Acceleration and steering rate of a sample apply after it; those of the last sample apply before it. */
    Trajectory sample(const TimedMotion &motion, const Vehicle &vehicle, double step);

    /** \brief Cost of a trajectory in the Trajectory Planning Competition of Automated Parking (TPCAP).

        It is J = 100 T + 10 times the control effort + 10 times the steering integral + 5 times the gear changes. */
    struct TpcapCost
    {
        double time{0.0};              ///< T, seconds
        double controlEffort{0.0};     ///< integral of a^2 + (v w)^2, with the steering rate w
        double steeringIntegral{0.0};  ///< integral of the squared steering angle
        std::size_t gearChanges{0};    ///< changes of direction

        /** \brief The total cost J. */
        double total() const
        {
            return 100.0 * time + 10.0 * controlEffort + 10.0 * steeringIntegral +
                   5.0 * static_cast<double>(gearChanges);
        }
    };

    /** \brief TPCAP's cost of \e motion, in closed form. */
    TpcapCost tpcapCost(const TimedMotion &motion);
}  // namespace parking

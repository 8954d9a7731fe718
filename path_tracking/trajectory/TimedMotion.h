#pragma once

#include "parking_geometry/Vehicle.h"
#include "path_tracking/trajectory/Trajectory.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace parking
{
    /** \brief What the car does at an instant: speed and steering angle. */
    struct MotionKnot
    {
        double t{0.0};         ///< seconds
        double v{0.0};         ///< m/s, negative in reverse
        double steering{0.0};  ///< radians
    };

    /** \brief Seconds that a motion or a reference to be driven lasts at most.

        What takes longer is refused, for it would fill the memory with samples: 50 km at TPCAP's speed, 400 m of the
        slowest car. */
    constexpr double LONGEST_MOTION = 2e4;

    /** \brief A motion in exact form: where it starts, and its speed and steering angle over time, both linear between
        two knots. What Path is without time.

        Where the car is follows from the bicycle model: x' = v cos yaw, y' = v sin yaw, yaw' = v tan(steering) /
        wheelbase. */
    struct TimedMotion
    {
        Pose start;                     ///< where the car stands at the first knot
        std::vector<MotionKnot> knots;  ///< in order of time

        /** \brief Seconds from the first knot to the last; 0 without knots. */
        double duration() const
        {
            return knots.empty() ? 0.0 : knots.back().t - knots.front().t;
        }

        /** \brief Adds a knot \e after seconds behind the last one, or changes that one when it is no time behind it.
         */
        void append(double after, double v, double steering);
    };

    /** \brief A short part of a motion along which speed and steering are linear in time. */
    struct MotionPart
    {
        MotionKnot from,  ///< where it begins
            to;           ///< where it ends
        Pose before,      ///< at \e from; yaw not wrapped
            after;        ///< at \e to; yaw not wrapped

        /** \brief Seconds. */
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

    /** \brief Integrates \e motion (Runge-Kutta of fourth order) and calls \e visit with its parts in order, none of
        them longer than \e step seconds or \e way metres, until it says no. Standstills are one part each.

        With parts of 0.02 s the poses are right to less than a micrometre. */
    bool visitParts(const TimedMotion &motion, const Vehicle &vehicle, double step, double way,
                    const std::function<bool(const MotionPart &)> &visit);

    /** \brief Where the motion ends, yaw not wrapped. */
    Pose endOf(const TimedMotion &motion, const Vehicle &vehicle);

    /** \brief What is left of the motion behind its first \e driven metres. */
    TimedMotion restOf(const TimedMotion &motion, const Vehicle &vehicle, double driven);

    /** \brief The motion as samples no more than \e step seconds apart, every knot among them.

        Acceleration and steering rate of a sample are those behind it, of the last one those before it. */
    Trajectory sample(const TimedMotion &motion, const Vehicle &vehicle, double step);

    /** \brief What the Trajectory Planning Competition of Automated Parking (TPCAP) charges for a trajectory:
        J = 100 T + 10 * effort + 10 * steering + 5 * gear changes. */
    struct TpcapCost
    {
        double time{0.0};              ///< T, seconds
        double controlEffort{0.0};     ///< integral of a^2 + (v w)^2, with the steering rate w
        double steeringIntegral{0.0};  ///< integral of the squared steering angle
        std::size_t gearChanges{0};    ///< changes of direction

        /** \brief J. */
        double total() const
        {
            return 100.0 * time + 10.0 * controlEffort + 10.0 * steeringIntegral +
                   5.0 * static_cast<double>(gearChanges);
        }
    };

    /** \brief TPCAP's cost of \e motion, in closed form. */
    TpcapCost tpcapCost(const TimedMotion &motion);
}  // namespace parking

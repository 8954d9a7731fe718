#pragma once

#include "parking_geometry/Vehicle.h"
#include "path_tracking/trajectory/TimedMotion.h"

namespace parking
{
    /** \brief The same way, driven so that the acceleration changes by no more than \e jerk per second.

        Where the car goes and how its wheels stand there stays; only when changes. Between two standstills the car
        drives as fast as the acceleration limit of \e vehicle, the jerk and the speed of \e motion at the same place
        allow, so that it is never quicker and never turns its wheels faster. Every stop begins and ends without
        acceleration. Standstills last as long as before.

        What counts as the acceleration of an interval between two knots is the change of speed by its duration; from
        the middle of one interval to that of the next it changes by no more than \e jerk times the time between.
        Turning the wheels makes the car jerk sideways; that is not limited.

        \param jerk m/s^3, positive
        \param step seconds between two knots; a shorter one follows the way more closely (0.02: to a tenth of a
        millimetre)
        \throws parking::Error for a jerk or a step that is not positive and finite, and for a motion that does not
        begin and end at rest */
    TimedMotion withJerkLimit(const TimedMotion &motion, const Vehicle &vehicle, double jerk, double step = 0.02);
}  // namespace parking

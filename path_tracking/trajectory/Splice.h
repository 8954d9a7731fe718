#pragma once

#include "parking_geometry/Vehicle.h"
#include "path_tracking/trajectory/TimedMotion.h"

namespace parking
{
    /** \brief The motion up to \e time seconds after its first knot, clamped to the motion. Its last knot is there. */
    TimedMotion beginOf(const TimedMotion &motion, double time);

    /** \brief The motion up to \e time seconds after its first knot, then braking to rest along its own path.

        Where the motion itself is slower, its speed is kept. The steering angle is that of the motion at the same
       place, so the steering rate never exceeds that of the motion.

        \param deceleration m/s^2, positive */
    TimedMotion stopAfter(const TimedMotion &motion, const Vehicle &vehicle, double time, double deceleration);

    /** \brief The motion \e begin, continued by \e next. The result has the speed and steering angle of \e begin where
        they meet, so those of \e next must be equal there. */
    TimedMotion joined(TimedMotion begin, const TimedMotion &next);
}  // namespace parking

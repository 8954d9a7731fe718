#pragma once

#include "parking_geometry/Pose.h"

namespace parking
{
    /** \brief Measurement that the car sends to the controller. */
    struct Measurement
    {
        Pose pose;             ///< of the rear axle, world frame; unknown if a value is not finite
        double speed{0.0};     ///< m/s, negative in reverse
        double steering{0.0};  ///< radians, of the wheels
    };

    /** \brief Command that the controller sends to the car for one period. */
    struct Command
    {
        double acceleration{0.0};  ///< m/s^2, held over the period
        double steering{0.0};      ///< radians; the wheels move there evenly over the period
        /** Whether to brake to standstill and keep standing, with \e acceleration as the deceleration; 0 brakes as hard
            as possible. */
        bool hold{false};
    };
}  // namespace parking

#pragma once

#include "parking_geometry/Pose.h"

namespace parking
{
    /** \brief What the car tells the controller. */
    struct Measurement
    {
        Pose pose;             ///< of the rear axle, world frame; a value that is not finite: not known
        double speed{0.0};     ///< m/s, negative in reverse
        double steering{0.0};  ///< radians, of the wheels
    };

    /** \brief What the controller tells the car, for one period. */
    struct Command
    {
        double acceleration{0.0};  ///< m/s^2, held over the period
        double steering{0.0};      ///< radians; the wheels move there evenly over the period
        /** Brake to standstill and keep standing: acceleration says how hard, 0 as hard as the car can. */
        bool hold{false};
    };
}  // namespace parking

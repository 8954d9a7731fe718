#pragma once

#include "parking_geometry/Vehicle.h"

#include <vector>

namespace parking
{
    /** \brief Limits of a drive. All are finite and at least 0.01. */
    struct SpeedLimits
    {
        double speed{2.5};                ///< m/s, either direction
        double acceleration{1.0};         ///< m/s^2 along the path, either sign
        double steeringRate{0.5};         ///< rad/s
        double lateralAcceleration{1.0};  ///< m/s^2, speed^2 * |curvature|

        /** \brief The limits of \e vehicle, with a lateral acceleration of 1 m/s^2 for comfort. */
        static SpeedLimits of(const Vehicle &vehicle);

        /** \brief Throws parking::Error naming the first field that is not finite or below 0.01. */
        void validate() const;
    };

    /** \brief Steering angle at a position of a leg. It is linear in the driven length between two knots. */
    struct SteeringKnot
    {
        double s;      ///< metres since the start of the path
        double angle;  ///< radians
    };

    /** \brief The steering angle at \e s, clamped to the ends of the leg. \param knots at least two, in order */
    double steeringAt(const std::vector<SteeringKnot> &knots, double s);

    /** \brief Point of a speed profile. The speed is linear in time between two points. */
    struct SpeedPoint
    {
        double t;      ///< seconds since the start of the drive
        double s;      ///< metres since the start of the path
        double speed;  ///< m/s, not negative
    };

    /** \brief The maximum squared speeds, (m/s)^2, at the borders of the parts of a path that ends at rest.

        Each respects the caps of both adjacent parts and is reachable from both ends, by one forward and one backward
        pass. With bounded acceleration the squared speed is linear in the driven length.

        \param lengths metres, of the parts
        \param caps (m/s)^2, of the squared speed on each part
        \param acceleration m/s^2
        \param initial (m/s)^2, of the squared speed at the start; the first result is lower if the path is too short to
        brake */
    std::vector<double> squaredSpeeds(const std::vector<double> &lengths, const std::vector<double> &caps,
                                      double acceleration, double initial = 0.0);

    /** \brief The fastest drive from rest to rest along a leg.

        Between two knots the speed is capped by the steering rate, and by the lateral acceleration at the larger
        curvature. No drive within these caps is faster. */
    std::vector<SpeedPoint> fastestDrive(const std::vector<SteeringKnot> &leg, const SpeedLimits &limits,
                                         const Vehicle &vehicle);
}  // namespace parking

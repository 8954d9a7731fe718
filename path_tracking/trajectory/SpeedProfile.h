#pragma once

#include "parking_geometry/Vehicle.h"

#include <vector>

namespace parking
{
    /** \brief What a drive may ask of the car. All finite and at least 0.01. */
    struct SpeedLimits
    {
        double speed{2.5};                ///< m/s, either direction
        double acceleration{1.0};         ///< m/s^2 along the path, either sign
        double steeringRate{0.5};         ///< rad/s
        double lateralAcceleration{1.0};  ///< m/s^2, speed^2 * |curvature|

        /** \brief The limits of \e vehicle; its lateral acceleration is a matter of comfort and stays 1 m/s^2. */
        static SpeedLimits of(const Vehicle &vehicle);

        /** \brief Throws parking::Error naming the first field that is not finite or below 0.01. */
        void validate() const;
    };

    /** \brief The steering angle at a place of a leg; linear in the driven length between two of them. */
    struct SteeringKnot
    {
        double s;      ///< metres since the begin of the path
        double angle;  ///< radians
    };

    /** \brief The steering angle at \e s, cut to the ends of a leg. \param knots two at least, in order */
    double steeringAt(const std::vector<SteeringKnot> &knots, double s);

    /** \brief A moment of a drive; the speed is linear in time between two of them. */
    struct SpeedPoint
    {
        double t;      ///< seconds since the begin of the drive
        double s;      ///< metres since the begin of the path
        double speed;  ///< m/s, not negative
    };

    /** \brief The squared speeds, (m/s)^2, at the borders of parts of a way that is driven from rest to rest: the
       highest that is within the caps of the parts on both sides and can be reached from both ends, by one pass
       forwards and one backwards. Under a bounded acceleration the squared speed is linear in the driven length.

        \param lengths metres, of the parts
        \param caps (m/s)^2, of the squared speed on each part
        \param acceleration m/s^2 */
    std::vector<double> squaredSpeeds(const std::vector<double> &lengths, const std::vector<double> &caps,
                                      double acceleration);

    /** \brief The fastest drive from rest to rest along a leg.

        Between two knots the speed is capped by the steering rate, and by the lateral acceleration at the larger of the
        two curvatures. No drive within these caps is faster. */
    std::vector<SpeedPoint> fastestDrive(const std::vector<SteeringKnot> &leg, const SpeedLimits &limits,
                                         const Vehicle &vehicle);
}  // namespace parking

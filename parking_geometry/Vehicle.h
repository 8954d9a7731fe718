#pragma once

#include "parking_geometry/Pose.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief A car: its rectangle round the rear axle and the limits of its steering and drive.

        Lengths in metres, angles in radians, SI units for the limits. The defaults are the car of the Trajectory
        Planning Competition of Automated Parking (TPCAP). */
    struct Vehicle
    {
        static constexpr double LEAST_LIMIT = 0.02;      ///< m/s, m/s^2 and rad/s that a car's limits are at least
        static constexpr double GREATEST_LIMIT = 100.0;  ///< and at most

        std::string name{"tpcap"};      ///< for results; one of vehicleNames() or of the user's own
        double wheelbase{2.8};          ///< rear axle to front axle
        double frontOverhang{0.96};     ///< front axle to front bumper
        double rearOverhang{0.929};     ///< rear axle to rear bumper
        double width{1.942};            ///< of the body
        double maxSteeringAngle{0.75};  ///< mean angle of the front wheels
        double maxSpeed{2.5};           ///< m/s, either direction
        double maxAcceleration{1.0};    ///< m/s^2, either sign
        double maxSteeringRate{0.5};    ///< rad/s

        /** \brief Bumper to bumper. */
        double length() const
        {
            return rearOverhang + wheelbase + frontOverhang;
        }

        /** \brief How far the middle of the body lies ahead of the rear axle. */
        double centreOffset() const
        {
            return 0.5 * length() - rearOverhang;
        }

        /** \brief Radius of the largest circle round the rear axle's midpoint that lies within the body, enlarged by
            \e margin (metres) on each side: no obstacle can be nearer to the axle than this. */
        double inscribedRadius(double margin = 0.0) const
        {
            return margin + std::min({0.5 * width, rearOverhang, wheelbase + frontOverhang});
        }

        /** \brief Radius of the largest circle that lies within the body wherever its centre is, enlarged likewise: no
            gap that the car drives through is narrower than twice this. */
        double bodyRadius(double margin = 0.0) const
        {
            return margin + 0.5 * std::min(width, length());
        }

        /** \brief Width of the lane that the body, enlarged likewise, covers while it drives in a circle at full lock.
         */
        double turningLane(double margin = 0.0) const;

        /** \brief Of the rear axle's midpoint: wheelbase / tan(maxSteeringAngle). */
        double minTurningRadius() const;

        /** \brief Curvature that a steering angle gives, tan(angle) / wheelbase. */
        double curvature(double steeringAngle) const;

        /** \brief Steering angle that a curvature needs. */
        double steeringAngle(double curvature) const;

        /** \brief Corners of the body at \e pose: rear right, front right, front left, rear left
            (counter-clockwise). */
        std::array<Eigen::Vector2d, 4> footprint(const Pose &pose) const;

        /** \brief Throws parking::Error naming the first field that is not finite or out of its range: lengths up to
            50 m, wheelbase and width from 1 cm, a turning radius of 1 cm to 1 km, speed, acceleration and steering rate
            from LEAST_LIMIT to GREATEST_LIMIT. */
        void validate() const;
    };

    /** \brief A car known by name (see vehicleNames()). Throws parking::Error listing the known names otherwise. */
    Vehicle vehicleByName(const std::string &name);

    /** \brief The names that vehicleByName() knows. */
    std::vector<std::string> vehicleNames();
}  // namespace parking

#pragma once

#include "parking_geometry/Pose.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief A car: its rectangular body relative to the rear axle and the limits of its steering and drive.

        Units are metres, radians and seconds. The defaults describe the car of the Trajectory Planning Competition of
        Automated Parking (TPCAP). */
    struct Vehicle
    {
        static constexpr double MIN_LIMIT = 0.02;   ///< lowest maximum of speed, acceleration and steering rate, SI
        static constexpr double MAX_LIMIT = 100.0;  ///< highest maximum of speed, acceleration and steering rate, SI

        std::string name{"tpcap"};      ///< name in results, from vehicleNames() or chosen by the user
        double wheelbase{2.8};          ///< distance from the rear to the front axle, metres
        double frontOverhang{0.96};     ///< distance from the front axle to the front bumper, metres
        double rearOverhang{0.929};     ///< distance from the rear axle to the rear bumper, metres
        double width{1.942};            ///< width of the body, metres
        double maxSteeringAngle{0.75};  ///< largest mean angle of the front wheels, radians
        double maxSpeed{2.5};           ///< largest speed in either direction, m/s
        double maxAcceleration{1.0};    ///< largest acceleration and deceleration, m/s^2
        double maxSteeringRate{0.5};    ///< largest rate of the steering angle, rad/s

        /** \brief Length of the body from bumper to bumper, metres. */
        double length() const
        {
            return rearOverhang + wheelbase + frontOverhang;
        }

        /** \brief Distance from the rear axle forward to the centre of the body, metres. */
        double centreOffset() const
        {
            return 0.5 * length() - rearOverhang;
        }

        /** \brief Radius of the largest circle about the rear axle's midpoint within the body, enlarged by \e margin
            metres on each side. No obstacle can be nearer to this point. */
        double inscribedRadius(double margin = 0.0) const
        {
            return margin + std::min({0.5 * width, rearOverhang, wheelbase + frontOverhang});
        }

        /** \brief Radius of the largest circle within the body, enlarged by \e margin metres on each side. Every gap
            that the car passes is at least twice as wide. */
        double bodyRadius(double margin = 0.0) const
        {
            return margin + 0.5 * std::min(width, length());
        }

        /** \brief Width of the annulus that the body, enlarged by \e margin metres on each side, sweeps at full
            lock. */
        double turningLane(double margin = 0.0) const;

        /** \brief Smallest turning radius of the rear axle's midpoint: wheelbase / tan(maxSteeringAngle), metres. */
        double minTurningRadius() const;

        /** \brief Curvature for a steering angle, tan(angle) / wheelbase, in 1/m. */
        double curvature(double steeringAngle) const;

        /** \brief Steering angle for a curvature, radians. */
        double steeringAngle(double curvature) const;

        /** \brief Corners of the body at \e pose, counter-clockwise: rear right, front right, front left, rear left. */
        std::array<Eigen::Vector2d, 4> footprint(const Pose &pose) const;

        /** \brief Throws parking::Error naming the first field that is not finite or out of range.

            Lengths may be up to 50 m, wheelbase and width must be at least 1 cm. The turning radius must be 1 cm to 1
            km. Speed, acceleration and steering rate must be from MIN_LIMIT to MAX_LIMIT. */
        void validate() const;
    };

    /** \brief The car of this name, one of vehicleNames(). Throws parking::Error listing the known names for any other
        name. */
    Vehicle vehicleByName(const std::string &name);

    /** \brief Names that vehicleByName() accepts. */
    std::vector<std::string> vehicleNames();
}  // namespace parking

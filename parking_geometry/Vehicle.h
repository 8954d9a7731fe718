#pragma once

#include "parking_geometry/Polygon.h"
#include "parking_geometry/Pose.h"

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief A car: its body relative to the rear axle and the limits of its steering and drive.

        The body is a rectangle or, with an outline, any simple polygon. The frame of the car has its origin in the
        middle of the fixed axle, and x points to the steered axle. If a vehicle steers at the rear, its outline is
        given in this frame too: the forks of a forklift lie at negative x, and driving with the forks ahead is reverse.

        Units are metres, radians and seconds. The defaults describe the car of the Trajectory Planning Competition of
        Automated Parking (TPCAP). */
    struct Vehicle
    {
        static constexpr double MIN_LIMIT = 0.02;   ///< lowest maximum of speed, acceleration and steering rate, SI
        static constexpr double MAX_LIMIT = 100.0;  ///< highest maximum of speed, acceleration and steering rate, SI
        static constexpr std::size_t MAX_CORNERS = 128;  ///< highest number of corners of an outline

        std::string name{"tpcap"};      ///< name in results, from vehicleNames() or chosen by the user
        double wheelbase{2.8};          ///< distance from the rear to the front axle, metres
        double frontOverhang{0.96};     ///< distance from the front axle to the front bumper, metres
        double rearOverhang{0.929};     ///< distance from the rear axle to the rear bumper, metres
        double width{1.942};            ///< width of the body, metres
        double maxSteeringAngle{0.75};  ///< largest mean angle of the front wheels, radians
        double maxSpeed{2.5};           ///< largest speed in either direction, m/s
        double maxAcceleration{1.0};    ///< largest acceleration and deceleration, m/s^2
        double maxSteeringRate{0.5};    ///< largest rate of the steering angle, rad/s
        /** Corners of the body in the frame of the car, counter-clockwise; empty for the rectangle that overhangs and
            width describe. The rear axle may lie anywhere. Set by setOutline(). */
        Polygon outline;

        /** \brief Sets the outline, whose corners may have either order, and the overhangs and the width that follow
            from it.

            They become those of the bounding rectangle: the smallest rectangle that contains the outline and both axles
            and is symmetric about the car's axis. Slots, manoeuvres and the paper's rules use this rectangle. The
            wheelbase must be set before. validate() checks the outline. */
        void setOutline(const Polygon &corners);

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
            metres on each side; 0 if this point lies outside. No obstacle can be nearer to it. */
        double inscribedRadius(double margin = 0.0) const;

        /** \brief Radius of the largest circle within the body, enlarged by \e margin metres on each side. Every gap
            that the car passes is at least twice as wide. For an outline it may be that of a smaller circle. */
        double bodyRadius(double margin = 0.0) const;

        /** \brief Width of the annulus that the bounding rectangle, enlarged by \e margin metres on each side, sweeps
            at full lock. */
        double turningLane(double margin = 0.0) const;

        /** \brief Smallest turning radius of the rear axle's midpoint: wheelbase / tan(maxSteeringAngle), metres. */
        double minTurningRadius() const;

        /** \brief Curvature for a steering angle, tan(angle) / wheelbase, in 1/m. */
        double curvature(double steeringAngle) const;

        /** \brief Steering angle for a curvature, radians. */
        double steeringAngle(double curvature) const;

        /** \brief Corners of the body at \e pose, counter-clockwise: those of the outline, or of the rectangle: rear
            right, front right, front left, rear left. */
        Polygon footprint(const Pose &pose) const;

        /** \brief Throws parking::Error naming the first field that is not finite or out of range.

            Lengths may be up to 50 m, wheelbase and width must be at least 1 cm. The turning radius must be 1 cm to 1
            km. Speed, acceleration and steering rate must be from MIN_LIMIT to MAX_LIMIT.

            An outline must be a simple polygon of 3 to MAX_CORNERS corners within 50 m of the rear axle. No corner may
            be nearer than 1 mm to a side to which it does not belong. Overhangs and width must be those of
            setOutline(). */
        void validate() const;
    };

    /** \brief The car of this name, one of vehicleNames(). Throws parking::Error listing the known names for any other
        name. */
    Vehicle vehicleByName(const std::string &name);

    /** \brief Names that vehicleByName() accepts. */
    std::vector<std::string> vehicleNames();
}  // namespace parking

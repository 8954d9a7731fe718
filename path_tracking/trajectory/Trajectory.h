#pragma once

#include <string>
#include <vector>

namespace parking
{
    /** \brief State of a drive at an instant, in the columns of the Trajectory Planning Competition of Automated
        Parking. */
    struct TrajectoryPoint
    {
        double t{0.0};             ///< seconds
        double x{0.0};             ///< metres, midpoint of the rear axle
        double y{0.0};             ///< metres
        double yaw{0.0};           ///< radians in [-pi, pi]
        double v{0.0};             ///< m/s, negative in reverse
        double acceleration{0.0};  ///< m/s^2, the derivative of v
        double steering{0.0};      ///< radians
        double steeringRate{0.0};  ///< rad/s
    };

    /** \brief A drive over time, as points in order. */
    using Trajectory = std::vector<TrajectoryPoint>;

    /** \brief The trajectory as comma-separated values: a header (t,x,y,yaw,v,a,steering,steering_rate), then one line
        per point. Every number reads back exactly. */
    std::string toCsv(const Trajectory &trajectory);

    /** \brief Writes toCsv() to \e file atomically. Throws parking::Error naming the file. */
    void writeCsv(const Trajectory &trajectory, const std::string &file);
}  // namespace parking

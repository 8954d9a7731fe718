#pragma once

#include "parking_geometry/Pose.h"
#include "path_tracking/trajectory/TimedMotion.h"
#include "path_tracking/trajectory/Trajectory.h"
#include "state_validity/FootprintChecker.h"

#include <cstddef>
#include <vector>

namespace parking
{
    /** \brief Metrics of a drive in time, by the definitions of TPCAP and CommonParking (see
        docs/benchmark-reference.md). */
    struct DriveFigures
    {
        double duration{0.0};      ///< seconds
        double standingTime{0.0};  ///< seconds at a speed below one millimetre per second
        double meanJerk{0.0};      ///< mean over time of the absolute jerk in m/s^3
        bool attainsGoal{false};   ///< whether its end attains a goal, see attainsGoal()
        std::size_t frames{0};     ///< number of frames, one per millisecond plus the end
        std::size_t colliding{0};  ///< number of frames in collision

        /** \brief Share of frames in collision; 0 without frames. */
        double collidingShare() const
        {
            return frames > 0 ? static_cast<double>(colliding) / static_cast<double>(frames) : 0.0;
        }
    };

    /** \brief Whether \e pose is within 1 cm of a goal in x and in y, and within 1 degree of its heading. */
    bool attainsGoal(const Pose &pose, const std::vector<Pose> &goals);

    /** \brief Metrics of a sampled drive; poses between two samples are interpolated linearly.

        \param trajectory in the coordinates of \e goals and \e checker */
    DriveFigures driveFigures(const Trajectory &trajectory, const std::vector<Pose> &goals,
                              const FootprintChecker &checker);

    /** \brief Metrics of a motion, sampled every 5 ms to integrate. */
    DriveFigures driveFigures(const TimedMotion &motion, const std::vector<Pose> &goals,
                              const FootprintChecker &checker);
}  // namespace parking

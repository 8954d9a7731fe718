#pragma once

#include "parking_geometry/Pose.h"
#include "path_tracking/trajectory/TimedMotion.h"
#include "path_tracking/trajectory/Trajectory.h"
#include "state_validity/FootprintChecker.h"

#include <cstddef>
#include <vector>

namespace parking
{
    /** \brief What a drive in time is like, by the terms of TPCAP and CommonParking; docs/benchmark-reference.md
     * defines each. */
    struct DriveFigures
    {
        double duration{0.0};      ///< seconds
        double standingTime{0.0};  ///< seconds at less than a millimetre a second
        double meanJerk{0.0};      ///< m/s^3, mean over time of the absolute value
        bool attainsGoal{false};   ///< see attainsGoal(); where it ends
        std::size_t frames{0};     ///< one a millisecond, and the end
        std::size_t colliding{0};  ///< of them

        /** \brief Of the frames; 0 without any. */
        double collidingShare() const
        {
            return frames > 0 ? static_cast<double>(colliding) / static_cast<double>(frames) : 0.0;
        }
    };

    /** \brief Is \e pose within 1 cm of a goal, in x and in y, and within 1 degree of its heading? */
    bool attainsGoal(const Pose &pose, const std::vector<Pose> &goals);

    /** \brief The figures of a drive that is given by samples; poses between two samples lie evenly between them.

        \param trajectory in the coordinates of \e goals and \e checker */
    DriveFigures driveFigures(const Trajectory &trajectory, const std::vector<Pose> &goals,
                              const FootprintChecker &checker);

    /** \brief The figures of a motion, integrated and sampled every 5 ms for that. */
    DriveFigures driveFigures(const TimedMotion &motion, const std::vector<Pose> &goals,
                              const FootprintChecker &checker);
}  // namespace parking

#pragma once

#include "parking_geometry/Pose.h"

#include <vector>

namespace parking
{
    /** \brief Headings that a goal allows. */
    enum class GoalHeading
    {
        Fixed,  ///< that of the pose
        Both,   ///< that of the pose and the opposite one
        Any     ///< every heading
    };

    /** \brief A goal pose with tolerances, planned for as a set of goals. */
    struct GoalRegion
    {
        Pose pose;                                ///< preferred goal
        double tolerance{0.0};                    ///< metres by which the position may deviate
        double yawTolerance{0.0};                 ///< radians by which the heading may deviate, below pi
        GoalHeading heading{GoalHeading::Fixed};  ///< headings allowed; yawTolerance applies to each of them

        /** \brief Equally distributed poses of the region, \e pose first; the region's limits are included.

            Seven positions (one without a tolerance) with one or three headings each, twice as many for Both. For Any,
            the headings are 22.5 degrees apart. Throws what validate() throws. */
        std::vector<Pose> goals() const;

        /** \brief Throws parking::Error naming the first field that is not finite or out of range. */
        void validate() const;
    };
}  // namespace parking

#pragma once

#include "parking_geometry/Pose.h"

#include <string>
#include <vector>

namespace parking
{
    /** \brief Poses that a plan may end at, by the names and meanings of nav2's Smac planners. */
    struct GoalSettings
    {
        /** `goal_heading_mode`: DEFAULT, BIDIRECTIONAL (also the opposite heading) or ALL_DIRECTION (all headings). */
        std::string headingMode{"DEFAULT"};
        int coarseSearchResolution{1};  ///< `coarse_search_resolution` n: every n-th heading of ALL_DIRECTION
        double tolerance{0.0};          ///< `tolerance`: metres from the goal, if the goal itself cannot be reached
        double headingTolerance{0.0};   ///< `heading_tolerance`: radians from the goal's headings, likewise
    };

    /** \brief The poses at the position of \e goal that a plan may end at, the goal itself first.

        \e headingBins is the number of headings of ALL_DIRECTION before `coarse_search_resolution` divides it. */
    std::vector<Pose> goalPoses(const Pose &goal, const GoalSettings &settings, unsigned int headingBins);

    /** \brief Poses within the tolerances of goalPoses(), nearest first and without these; empty if both tolerances
        are zero. */
    std::vector<Pose> posesNearGoal(const Pose &goal, const GoalSettings &settings, unsigned int headingBins);

    /** \brief Throws parking::Error naming a setting that is out of range. */
    void checkGoalSettings(const GoalSettings &settings, unsigned int headingBins);
}  // namespace parking

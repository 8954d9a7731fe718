#include "integrations/nav2/GoalPoses.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <cmath>

namespace parking
{
    namespace
    {
        constexpr int DIRECTIONS = 8;  // positions on each circle around the goal

        Pose turned(const Pose &pose, double angle)
        {
            return {pose.x, pose.y, wrapAngle(pose.yaw + angle)};
        }

        Pose shifted(const Pose &pose, double distance, double direction)
        {
            return {pose.x + distance * std::cos(pose.yaw + direction),
                    pose.y + distance * std::sin(pose.yaw + direction), pose.yaw};
        }
    }  // namespace

    std::vector<Pose> goalPoses(const Pose &goal, const GoalSettings &settings, unsigned int headingBins)
    {
        unsigned int count = 1;
        if (settings.headingMode == "BIDIRECTIONAL")
            count = 2;
        else if (settings.headingMode == "ALL_DIRECTION")
            count = headingBins / static_cast<unsigned int>(settings.coarseSearchResolution);
        std::vector<Pose> poses{goal};
        for (unsigned int i = 1; i < count; ++i)
            poses.push_back(turned(goal, 2.0 * PI * i / count));
        return poses;
    }

    std::vector<Pose> posesNearGoal(const Pose &goal, const GoalSettings &settings, unsigned int headingBins)
    {
        std::vector<Pose> positions{goal};
        if (settings.tolerance > 0.0)
            for (const double share : {0.5, 1.0})
                for (int i = 0; i < DIRECTIONS; ++i)
                    positions.push_back(shifted(goal, share * settings.tolerance, 2.0 * PI * i / DIRECTIONS));
        std::vector<double> turns{0.0};
        // All directions leave nothing between them that matters.
        if (settings.headingTolerance > 0.0 && settings.headingMode != "ALL_DIRECTION")
            for (const double share : {0.5, -0.5, 1.0, -1.0})
                turns.push_back(share * settings.headingTolerance);
        std::vector<Pose> poses;
        for (const Pose &position : positions)
            for (const Pose &pose : goalPoses(position, settings, headingBins))
                for (const double turn : turns)
                    if (&position != &positions.front() || turn != 0.0)
                        poses.push_back(turned(pose, turn));
        return poses;
    }

    void checkGoalSettings(const GoalSettings &settings, unsigned int headingBins)
    {
        const std::string &mode = settings.headingMode;
        if (mode != "DEFAULT" && mode != "BIDIRECTIONAL" && mode != "ALL_DIRECTION")
            throw Error("goal_heading_mode must be DEFAULT, BIDIRECTIONAL or ALL_DIRECTION, not " + inQuotes(mode));
        const int each = settings.coarseSearchResolution;
        if (each < 1 || headingBins % static_cast<unsigned int>(each) != 0)
            throw Error("coarse_search_resolution must divide heading_bins, " + std::to_string(headingBins) + ", not " +
                        std::to_string(each));
        if (!(settings.tolerance >= 0.0 && settings.tolerance <= 10.0))
            throw Error("tolerance must be between 0 and 10, not " + formatNumber(settings.tolerance));
        if (!(settings.headingTolerance >= 0.0 && settings.headingTolerance <= PI))
            throw Error("heading_tolerance must be between 0 and pi, not " + formatNumber(settings.headingTolerance));
    }
}  // namespace parking

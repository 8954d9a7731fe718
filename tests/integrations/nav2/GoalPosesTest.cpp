// Which poses count as the goal, without ROS.

#include "integrations/nav2/GoalPoses.h"
#include "parking_geometry/Error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
    using namespace parking;

    constexpr unsigned int BINS = 72;
    const Pose GOAL{3.0, -2.0, 2.5};

    double headingOff(const Pose &pose, double yaw)
    {
        return std::abs(std::remainder(pose.yaw - yaw, 2.0 * PI));
    }

    double off(const Pose &pose)
    {
        return std::hypot(pose.x - GOAL.x, pose.y - GOAL.y);
    }

    TEST(GoalPoses, EveryModeBeginsWithTheGoalAndKeepsItsPosition)
    {
        GoalSettings settings;
        EXPECT_EQ(goalPoses(GOAL, settings, BINS).size(), 1U);
        settings.headingMode = "BIDIRECTIONAL";
        const std::vector<Pose> both = goalPoses(GOAL, settings, BINS);
        ASSERT_EQ(both.size(), 2U);
        EXPECT_NEAR(headingOff(both.back(), GOAL.yaw), PI, 1e-12);
        settings.headingMode = "ALL_DIRECTION";
        for (const int each : {1, 4, 72})
        {
            settings.coarseSearchResolution = each;
            const std::vector<Pose> all = goalPoses(GOAL, settings, BINS);
            ASSERT_EQ(all.size(), BINS / static_cast<unsigned int>(each));
            EXPECT_EQ(all.front().yaw, GOAL.yaw);
            for (const Pose &pose : all)
                EXPECT_EQ(off(pose), 0.0);
            for (std::size_t i = 1; i < all.size(); ++i)
                EXPECT_NEAR(headingOff(all[i], all[i - 1].yaw), 2.0 * PI * each / BINS, 1e-12);
        }
    }

    TEST(GoalPoses, PosesNearTheGoalAreWithinTheTolerancesAndReachThem)
    {
        for (const char *mode : {"DEFAULT", "BIDIRECTIONAL"})
        {
            GoalSettings settings;
            settings.headingMode = mode;
            EXPECT_TRUE(posesNearGoal(GOAL, settings, BINS).empty());
            settings.tolerance = 0.5;
            settings.headingTolerance = 0.3;
            double furthest = 0.0, mostTurned = 0.0, last = 0.0;
            for (const Pose &pose : posesNearGoal(GOAL, settings, BINS))
            {
                double turn = headingOff(pose, GOAL.yaw);
                if (settings.headingMode == "BIDIRECTIONAL")
                    turn = std::min(turn, headingOff(pose, GOAL.yaw + PI));
                EXPECT_TRUE(off(pose) > 0.1 || turn > 0.1) << "the goal itself is not among them";
                EXPECT_GE(off(pose), last - 1e-12) << "nearest first";
                last = off(pose);
                furthest = std::max(furthest, last);
                mostTurned = std::max(mostTurned, turn);
            }
            EXPECT_NEAR(furthest, 0.5, 1e-12);
            EXPECT_NEAR(mostTurned, 0.3, 1e-12);
        }
    }

    TEST(GoalPoses, SettingsOutOfRangeAreRefused)
    {
        const auto isRefused = [](const std::string &mode, int each, double tolerance, double headingTolerance)
        {
            try
            {
                checkGoalSettings({mode, each, tolerance, headingTolerance}, BINS);
                return false;
            }
            catch (const Error &)
            {
                return true;
            }
        };
        EXPECT_FALSE(isRefused("ALL_DIRECTION", 72, 10.0, PI));
        EXPECT_FALSE(isRefused("BIDIRECTIONAL", 1, 0.0, 0.0));
        EXPECT_TRUE(isRefused("default", 1, 0.0, 0.0));
        EXPECT_TRUE(isRefused("DEFAULT", 0, 0.0, 0.0));
        EXPECT_TRUE(isRefused("DEFAULT", 5, 0.0, 0.0));
        EXPECT_TRUE(isRefused("DEFAULT", 144, 0.0, 0.0));
        EXPECT_TRUE(isRefused("DEFAULT", 1, -0.01, 0.0));
        EXPECT_TRUE(isRefused("DEFAULT", 1, 10.01, 0.0));
        EXPECT_TRUE(isRefused("DEFAULT", 1, std::nan(""), 0.0));
        EXPECT_TRUE(isRefused("DEFAULT", 1, 0.0, -0.01));
        EXPECT_TRUE(isRefused("DEFAULT", 1, 0.0, PI + 0.01));
    }
}  // namespace

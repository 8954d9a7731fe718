// A goal with tolerances: its poses lie in the region, include its limits, and begin with the preferred pose.

#include "parking_geometry/GoalRegion.h"

#include "tests/parking_geometry/ExpectError.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

using namespace parking;

namespace
{
    const Pose POSE{3.0, -2.0, 3.0};
}  // namespace

TEST(GoalRegion, IsThePoseAloneWithoutTolerances)
{
    const std::vector<Pose> goals = GoalRegion{POSE}.goals();
    ASSERT_EQ(goals.size(), 1u);
    EXPECT_TRUE(isSamePose(goals.front(), POSE, 1e-15));
}

TEST(GoalRegion, FillsItsTolerances)
{
    for (const GoalHeading heading : {GoalHeading::Fixed, GoalHeading::Both, GoalHeading::Any})
        for (const double tolerance : {0.0, 0.4})
            for (const double yawTolerance : {0.0, 0.2})
            {
                const std::vector<Pose> goals = GoalRegion{POSE, tolerance, yawTolerance, heading}.goals();
                const bool isAny = heading == GoalHeading::Any;
                const std::size_t headings =
                    isAny ? 16 : (yawTolerance > 0.0 ? 3 : 1) * (heading == GoalHeading::Both ? 2 : 1);
                EXPECT_EQ(goals.size(), headings * (tolerance > 0.0 ? 7 : 1));
                EXPECT_TRUE(isSamePose(goals.front(), POSE, 1e-15));
                double farthest = 0.0, mostTurned = 0.0;
                for (const Pose &goal : goals)
                {
                    const double turn = std::abs(wrapAngle(goal.yaw - POSE.yaw));
                    farthest = std::max(farthest, positionDistance(goal, POSE));
                    mostTurned = std::max(mostTurned, heading == GoalHeading::Both ? std::min(turn, PI - turn) : turn);
                    EXPECT_LE(std::abs(goal.yaw), PI);
                    EXPECT_EQ(std::count_if(goals.begin(), goals.end(),
                                            [&](const Pose &other) { return isSamePose(goal, other, 1e-9); }),
                              1);
                }
                EXPECT_NEAR(farthest, tolerance, 1e-12);
                EXPECT_NEAR(mostTurned, isAny ? PI : yawTolerance, 1e-12);
            }
}

TEST(GoalRegion, NamesWhatIsOutOfRange)
{
    parking_test::expectError([] { GoalRegion{POSE, -0.1}.goals(); }, {"goal", "tolerance"});
    parking_test::expectError([] { GoalRegion{POSE, std::nan("")}.goals(); }, {"goal", "tolerance"});
    parking_test::expectError([] { GoalRegion{POSE, 101.0}.goals(); }, {"goal", "tolerance"});
    parking_test::expectError([] { GoalRegion{POSE, 0.0, -0.1}.goals(); }, {"goal", "yaw_tolerance"});
    parking_test::expectError([] { GoalRegion{POSE, 0.0, 3.2}.goals(); }, {"goal", "yaw_tolerance"});
    parking_test::expectError([] { GoalRegion{{HUGE_VAL, 0.0, 0.0}}.goals(); }, {"goal", "pose x"});
}

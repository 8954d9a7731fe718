// The figures of drives in time against cases that can be computed by hand; memory against what was allocated.

#include "benchmarks/metrics/DriveMetrics.h"
#include "benchmarks/metrics/PeakMemory.h"

#include "path_tracking/trajectory/StopAndSteer.h"
#include "state_validity/ObstacleSet.h"
#include "tests/automatic_parking/ParkingProblems.h"

#include <gtest/gtest.h>

#include <vector>

namespace
{
    using namespace parking;

    const Vehicle CAR;
    const std::vector<Pose> GOALS{{10.0, 0.0, 0.0}};

    /** A wall whose near side is at \e x. */
    FootprintChecker wallAt(double x)
    {
        return FootprintChecker(
            ObstacleSet::fromPolygons({parking_test::box(x, -3.0, x + 1.0, 3.0)}, {{-15.0, -15.0}, {40.0, 15.0}}), CAR);
    }

    /** Ten metres straight ahead at 1 m/s. */
    const Trajectory STEADY{{0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0}, {10.0, 10.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0}};

    TEST(DriveFigures, FramesAreMillisecondsAndTheEnd)
    {
        const DriveFigures figures = driveFigures(STEADY, GOALS, wallAt(30.0));
        EXPECT_EQ(figures.frames, 10001U);
        EXPECT_EQ(figures.colliding, 0U);
        Trajectory longer = STEADY;
        longer.back().t = 10.0004;
        EXPECT_EQ(driveFigures(longer, GOALS, wallAt(30.0)).frames, 10002U);
    }

    TEST(DriveFigures, CollidingFramesAreCounted)
    {
        // The bumper reaches the wall after 6.0005 s; all frames after that collide.
        const DriveFigures figures = driveFigures(STEADY, GOALS, wallAt(6.0005 + 2.8 + 0.96));
        EXPECT_EQ(figures.colliding, 4000U);
        EXPECT_DOUBLE_EQ(figures.collidingShare(), 4000.0 / 10001.0);
    }

    TEST(DriveFigures, GoalIsAttainedWithinACentimetreAndADegree)
    {
        EXPECT_TRUE(attainsGoal({10.0099, -0.0099, 0.0174}, GOALS));
        EXPECT_FALSE(attainsGoal({10.0101, 0.0, 0.0}, GOALS));
        EXPECT_FALSE(attainsGoal({10.0, -0.0101, 0.0}, GOALS));
        EXPECT_FALSE(attainsGoal({10.0, 0.0, 0.0176}, GOALS));
        EXPECT_TRUE(attainsGoal({10.0, 0.0, 2.0 * PI}, GOALS));
        EXPECT_TRUE(attainsGoal({1.0, 1.0, 1.0}, {GOALS.front(), {1.0, 1.0, 1.0}}));
        EXPECT_TRUE(driveFigures(STEADY, GOALS, wallAt(30.0)).attainsGoal);
    }

    TEST(DriveFigures, StandingAndJerkOfADriveWithAStop)
    {
        // 4 m ahead in 4 s, the wheels turn for 1.0211 s, 4 m back in 4 s.
        const TimedMotion motion =
            stopAndSteer({{0.0, 0.0, 0.0}, {{0.0, 4.0}, {0.2, -4.0}}}, CAR, std::nullopt, std::nullopt);
        const DriveFigures figures = driveFigures(motion, GOALS, wallAt(30.0));
        const double standing = std::atan(2.8 * 0.2) / 0.5;
        EXPECT_NEAR(figures.duration, 8.0 + standing, 1e-9);
        EXPECT_NEAR(figures.standingTime, standing, 1e-9);
        EXPECT_NEAR(figures.meanJerk, 8.0 / (8.0 + standing), 1e-6);  // four times up and down by 1 m/s^2
        EXPECT_FALSE(figures.attainsGoal);
    }

    TEST(DriveFigures, OfNothingAreNothing)
    {
        EXPECT_EQ(driveFigures(Trajectory{}, GOALS, wallAt(30.0)).frames, 0U);
        EXPECT_EQ(driveFigures(Trajectory{STEADY.front()}, GOALS, wallAt(30.0)).frames, 1U);
    }

    TEST(PeakMemory, IsWhatWasTaken)
    {
#ifdef __SANITIZE_THREAD__
        GTEST_SKIP() << "the thread sanitizer takes four times as much";
#endif
        constexpr std::size_t BYTES = 64000000;
        PeakMemory memory;
        memory.begin();
        if (!memory.megabytes())
            GTEST_SKIP() << "this system does not tell";
        const double nothing = *memory.megabytes();
        {
            std::vector<char> much(BYTES, 'x');
            EXPECT_EQ(much[BYTES / 2], 'x');
        }
        EXPECT_LT(nothing, 8.0);
        EXPECT_GT(*memory.megabytes(), 60.0);
        EXPECT_LT(*memory.megabytes(), 80.0);
    }
}  // namespace

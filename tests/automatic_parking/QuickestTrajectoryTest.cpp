#include "automatic_parking/QuickestTrajectory.h"

#include "automatic_parking/ParkingPlanner.h"
#include "automatic_parking/ParkingWorld.h"
#include "path_tracking/trajectory/MotionCheck.h"
#include "state_validity/sweeps/PathSweep.h"
#include "tests/automatic_parking/ParkingProblems.h"

#include <gtest/gtest.h>

namespace
{
    using namespace parking;
    using namespace parking_test;

    /** A planned problem. */
    struct Planned
    {
        Scenario scenario = rowOfSlots();
        FootprintChecker checker{ObstacleSet::fromScenario(scenario), scenario.vehicle};
        Path path = ParkingPlanner().plan(scenario).path;
    };

    TEST(QuickestTrajectory, AlternativesLeadFromTheSameStartToTheSameEndAndTouchNothing)
    {
        const Planned problem;
        const std::vector<Path> paths = alternativePaths(problem.checker, problem.scenario.bounds, problem.path, {});
        EXPECT_GE(paths.size(), 1U);
        for (const Path &path : paths)
        {
            EXPECT_TRUE(isSamePose(path.start, problem.path.start, 1e-6));
            EXPECT_TRUE(isSamePose(path.end(), problem.path.end(), 1e-6));
            EXPECT_TRUE(isPathFree(problem.checker, path));
        }
    }

    TEST(QuickestTrajectory, IsNoSlowerForLookingAtAlternatives)
    {
        const Planned problem;
        QuickestTrajectoryOptions alone;
        alone.alternatives = false;
        const QuickestTrajectory one =
            quickestTrajectory(problem.checker, problem.scenario.bounds, problem.path, alone);
        const QuickestTrajectory best = quickestTrajectory(problem.checker, problem.scenario.bounds, problem.path);
        EXPECT_EQ(one.paths, 1U);
        EXPECT_GT(best.paths, 1U);
        EXPECT_FALSE(best.trajectory.fallback) << best.trajectory.reason;
        // What is near counts a little, too.
        EXPECT_LE(best.trajectory.motion.duration(), 1.005 * one.trajectory.motion.duration());
        EXPECT_TRUE(collisionsOf(best.trajectory.motion, problem.checker, 1).empty());
        EXPECT_TRUE(isSamePose(endOf(best.trajectory.motion, problem.scenario.vehicle), problem.path.end(), 5e-3));
    }
}  // namespace

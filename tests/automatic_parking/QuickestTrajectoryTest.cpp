#include "automatic_parking/QuickestTrajectory.h"

#include "automatic_parking/ParkingPlanner.h"
#include "automatic_parking/ParkingWorld.h"
#include "path_tracking/trajectory/MotionCheck.h"
#include "state_validity/sweeps/PathSweep.h"
#include "tests/automatic_parking/ParkingProblems.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

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

    TEST(QuickestTrajectory, AlternativesDriveInOneDirectionAllTheWayWhereThatIsPossible)
    {
        const Vehicle car;
        const Box ground{{-40.0, -40.0}, {60.0, 40.0}};
        const FootprintChecker checker(ObstacleSet::fromPolygons({}, ground), car);
        Path path;  // with two cusps
        for (const double length : {-2.0, 27.0, -5.0})
            path.append({0.0, length});
        const auto drivesOnly = [](int direction)
        {
            return [direction](const Path &each)
            {
                return std::all_of(each.pieces.begin(), each.pieces.end(),
                                   [direction](const PathPiece &piece) { return piece.length * direction >= 0.0; });
            };
        };
        std::vector<Path> paths = alternativePaths(checker, ground, path, {});
        EXPECT_TRUE(std::any_of(paths.begin(), paths.end(), drivesOnly(1)));
        const auto reverse = std::find_if(paths.begin(), paths.end(), drivesOnly(-1));
        ASSERT_NE(reverse, paths.end());
        EXPECT_TRUE(isSamePose(reverse->start, path.start, 1e-6));
        EXPECT_TRUE(isSamePose(reverse->end(), path.end(), 1e-6));
        QuickestTrajectoryOptions options;
        options.forwardOnly = true;
        paths = alternativePaths(checker, ground, path, options);
        EXPECT_TRUE(std::all_of(paths.begin(), paths.end(), drivesOnly(1)));
    }

    TEST(QuickestTrajectory, AlternativesHaveFewerCuspsWhereThatIsPossible)
    {
        // A path that goes to and fro for nothing; the other searches are given too little to find anything.
        const Planned problem;
        Path path{problem.path.start, {}};
        for (const double length : {0.5, -0.5})
            path.append({0.0, length});
        for (const PathPiece &piece : problem.path.pieces)
            path.append(piece);
        ASSERT_TRUE(isPathFree(problem.checker, path));
        ASSERT_GT(path.cusps(), problem.path.cusps());
        QuickestTrajectoryOptions options;
        options.maxExpansions = 1;
        const std::vector<Path> paths = alternativePaths(problem.checker, problem.scenario.bounds, path, options);
        EXPECT_TRUE(
            std::any_of(paths.begin(), paths.end(), [&path](const Path &each) { return each.cusps() < path.cusps(); }));
        options.maxExpansions = 0;
        EXPECT_TRUE(alternativePaths(problem.checker, problem.scenario.bounds, path, options).empty());
    }

    TEST(QuickestTrajectory, IsNoSlowerForLookingAtAlternatives)
    {
        const Planned problem;
        // What is near would count a little, too: then a path that keeps more room may win and be slower.
        QuickestTrajectoryOptions others;
        others.trajectory.weights.nearness = 0.0;
        QuickestTrajectoryOptions alone = others;
        alone.alternatives = false;
        const QuickestTrajectory one =
            quickestTrajectory(problem.checker, problem.scenario.bounds, problem.path, alone);
        const QuickestTrajectory best =
            quickestTrajectory(problem.checker, problem.scenario.bounds, problem.path, others);
        EXPECT_EQ(one.paths, 1U);
        EXPECT_GT(best.paths, 1U);
        EXPECT_FALSE(best.trajectory.fallback) << best.trajectory.reason;
        // Of paths that lie side by side only one is optimised, and solutions that differ by a thousandth count as one:
        // measured here, 12 ms of 11.9 s.
        EXPECT_LE(best.trajectory.motion.duration(), 1.002 * one.trajectory.motion.duration());
        EXPECT_TRUE(collisionsOf(best.trajectory.motion, problem.checker, 1).empty());
        EXPECT_TRUE(isSamePose(endOf(best.trajectory.motion, problem.scenario.vehicle), problem.path.end(), 5e-3));
    }

    TEST(QuickestTrajectory, ThatIsInterruptedDrivesThePathAndSaysSo)
    {
        const Planned problem;
        const QuickestTrajectory best =
            quickestTrajectory(problem.checker, problem.scenario.bounds, problem.path, {}, [] { return true; });
        EXPECT_TRUE(best.trajectory.fallback);
        EXPECT_EQ(best.trajectory.reason, "interrupted");
        EXPECT_TRUE(collisionsOf(best.trajectory.motion, problem.checker, 1).empty());
    }
}  // namespace

// Random worlds: whatever the planner returns is judged by an oracle that has nothing of the project in it.

#include "benchmarks/worlds/PolygonOracle.h"
#include "benchmarks/worlds/RandomWorlds.h"
#include "tests/ompl_improved_astar/PlanningProblem.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>

namespace
{
    using namespace parking_test;
    using parking::Path;
    using parking::PathPiece;
    using parking::Pose;
    using Status = ob::PlannerStatus;

    constexpr double STEP = 0.005;  // metres between the poses that are judged

    /** Is the path's every pose free, and its curvature within the limit? Along OMPL's own interpolation. */
    void expectDrivable(const PlanningProblem &problem, const World &world, const Path &arcs)
    {
        const double sharpest = 1.0 / problem.vehicle.minTurningRadius();
        Pose pose = arcs.start;
        for (const PathPiece &segment : arcs.pieces)
        {
            EXPECT_LE(std::abs(segment.curvature), sharpest * (1.0 + 1e-9));
            EXPECT_TRUE(world.oracle.isArcFree(pose, segment.curvature, segment.length, problem.vehicle, STEP));
            pose = advance(pose, segment.curvature, segment.length);
        }
    }

    void expectInterpolationFree(const PlanningProblem &problem, const World &world)
    {
        const og::PathGeometric path = problem.path();
        ob::ScopedState<> state(problem.space);
        double between = 0.0;
        for (std::size_t i = 1; i < path.getStateCount(); ++i)
        {
            const double length = problem.space->distance(path.getState(i - 1), path.getState(i));
            const double pieces = std::ceil(length / STEP);
            for (double k = 1.0; k <= pieces; k += 1.0)
            {
                problem.space->interpolate(path.getState(i - 1), path.getState(i), k / pieces, state.get());
                ASSERT_TRUE(world.oracle.isFree(parking::poseOf(state.get()), problem.vehicle));
            }
            between += length;
        }
        EXPECT_NEAR(between, path.length(), 1e-9);
    }

    std::optional<Pose> freePose(Random &random, const World &world, const parking::Vehicle &vehicle)
    {
        for (int attempt = 0; attempt < 1000; ++attempt)
            if (const Pose pose = world.anywhere(random); world.oracle.isFree(pose, vehicle, 1e-6))
                return pose;
        return std::nullopt;
    }

    class RandomProblems : public Silent<testing::TestWithParam<int>>
    {
    };

    TEST_P(RandomProblems, PathsAreFreeExactAndDrivable)
    {
        constexpr std::uint64_t PROBLEMS = 30;
        int exact = 0, approximate = 0;
        for (std::uint64_t i = 0; i < PROBLEMS; ++i)
        {
            const std::uint64_t seed = 1000 * static_cast<std::uint64_t>(GetParam()) + i;
            SCOPED_TRACE("seed " + std::to_string(seed));
            Random random(seed);
            const Eigen::Vector2d offset = i % 5 == 4 ? Eigen::Vector2d(2000.0, -700.0) : Eigen::Vector2d(0.0, 0.0);
            const World world = i % 2 == 0 ? randomPolygonWorld(seed, offset) : randomGridWorld(seed, offset);
            const Space kind = i % 3 == 0 ? Space::SE2 : i % 3 == 1 ? Space::ReedsShepp : Space::Dubins;
            PlanningProblem problem(kind, world.bounds);
            problem.setObstacles(world.obstacles);
            problem.makePlanner();
            problem.set("anytime", i % 7 == 3);
            problem.set("bidirectional", i % 11 != 5);
            problem.set("steering_angles", i % 4 == 1 ? 5 : 3);
            problem.set("preferred_clearance", i % 13 == 6 ? 1.0 : 0.1);
            const auto start = freePose(random, world, problem.vehicle);
            // Now and then a goal in an obstacle.
            const auto goal = i % 9 == 8 ? world.anywhere(random) : freePose(random, world, problem.vehicle);
            if (!start || !goal)
                continue;
            problem.from(*start).to({*goal});
            const Status status = problem.solveForQuestions(6000);
            if (!problem.pdef->hasSolution())
            {
                EXPECT_TRUE(status == Status::TIMEOUT || status == nothingLeft());
                continue;
            }
            const std::vector<Pose> poses = problem.poses();
            EXPECT_TRUE(isSamePose(poses.front(), *start, 0.0));
            EXPECT_TRUE(problem.path().check());
            expectInterpolationFree(problem, world);
            if (status == Status::APPROXIMATE_SOLUTION)
            {
                ++approximate;
                EXPECT_TRUE(problem.pdef->hasApproximateSolution());
                continue;
            }
            ++exact;
            ASSERT_EQ(status, Status::EXACT_SOLUTION);
            EXPECT_TRUE(isSamePose(poses.back(), *goal, 1e-15));
            ASSERT_NE(problem.planner->solutionPath(), nullptr);
            const Path &arcs = *problem.planner->solutionPath();
            EXPECT_TRUE(isSamePose(arcs.start, *start, SAME));
            EXPECT_TRUE(isSamePose(arcs.end(), *goal, 1e-9));
            expectDrivable(problem, world, arcs);
        }
        RecordProperty("exact", exact);
        RecordProperty("approximate", approximate);
        EXPECT_GE(exact, static_cast<int>(PROBLEMS) / 4);
        EXPECT_GE(approximate, 1);
    }

    INSTANTIATE_TEST_SUITE_P(Planner, RandomProblems, testing::Range(1, 11));
}  // namespace

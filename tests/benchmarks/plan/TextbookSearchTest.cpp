// The textbook's search, in worlds whose motions are judged by simple functions.

#include "benchmarks/planners/TextbookSearch.h"
#include "parking_geometry/curves/ReedsShepp.h"
#include "state_validity/FootprintChecker.h"
#include "tests/parking_geometry/ExpectError.h"

#include <gtest/gtest.h>

namespace
{
    using namespace parking;

    constexpr double RADIUS = 5.0;

    /** A problem in a square of 40 m, without obstacles. */
    TextbookProblem openSquare(const Pose &start, const Pose &goal)
    {
        TextbookProblem problem;
        problem.start = start;
        problem.goal = goal;
        problem.bounds = {{-20.0, -20.0}, {20.0, 20.0}};
        problem.turningRadius = RADIUS;
        problem.curveToGoal = [goal](const Pose &pose)
        {
            return ReedsShepp(RADIUS).distance(pose, goal);
        };
        problem.isMotionFree = [](const Pose & /*from*/, const Pose &to)
        {
            return std::abs(to.x) < 20.0 && std::abs(to.y) < 20.0;
        };
        problem.stop = []
        {
            return false;
        };
        return problem;
    }

    TEST(TextbookSearch, JoinsStartAndGoalAtOnceWhereItCan)
    {
        const Pose start{0.0, 0.0, 0.0}, goal{8.0, 3.0, 0.5};
        TextbookSearch search(openSquare(start, goal), {});
        const std::vector<Pose> path = search.run();
        ASSERT_EQ(path.size(), 2u);
        EXPECT_EQ(path.front().x, start.x);
        EXPECT_EQ(path.back().y, goal.y);
        EXPECT_EQ(search.growth().size(), 1u);
        EXPECT_NEAR(search.nodes().front().ahead, ReedsShepp(RADIUS).distance(start, goal), 1e-12);
    }

    TEST(TextbookSearch, ItsMotionsAreJoinedAndFree)
    {
        TextbookProblem problem = openSquare({-8.0, 0.0, 0.0}, {8.0, 0.0, 0.0});
        // A wall between them; only steps of the lattice and curves from behind it are free.
        problem.isMotionFree = [](const Pose &from, const Pose &to)
        {
            const bool isBehind = from.x > 1.0 && to.x > 1.0;
            const bool isStep = std::hypot(to.x - from.x, to.y - from.y) < 0.6;
            const bool isInWall = std::abs(to.x) < 1.0 && to.y < 4.0;
            return std::abs(to.x) < 20.0 && std::abs(to.y) < 20.0 && !isInWall && (isBehind || isStep);
        };
        TextbookSearch search(problem, {});
        const std::vector<Pose> path = search.run();
        ASSERT_GT(path.size(), 10u);
        for (std::size_t i = 1; i < path.size(); ++i)
            EXPECT_TRUE(problem.isMotionFree(path[i - 1], path[i])) << i;
        ASSERT_FALSE(search.growth().empty());
        for (std::size_t i = 1; i < search.nodes().size(); ++i)
        {
            const TextbookSearch::Node &node = search.nodes()[i];
            ASSERT_LT(node.parent, i);
            EXPECT_GT(node.cost, search.nodes()[node.parent].cost);
            EXPECT_LE(std::abs(node.curvature), 1.0 / RADIUS + 1e-12);
        }
        EXPECT_LE(search.growth().back(), search.nodes().size());
    }

    TEST(TextbookSearch, EndsWithoutAPath)
    {
        TextbookProblem walled = openSquare({0.0, 0.0, 0.0}, {8.0, 3.0, 0.5});
        walled.isMotionFree = [](const Pose & /*from*/, const Pose & /*to*/)
        {
            return false;
        };
        EXPECT_TRUE(TextbookSearch(walled, {}).run().empty());
        TextbookProblem stopped = openSquare({0.0, 0.0, 0.0}, {8.0, 3.0, 0.5});
        stopped.stop = []
        {
            return true;
        };
        EXPECT_TRUE(TextbookSearch(stopped, {}).run().empty());
    }

    TEST(TextbookSearch, RefusesAWorldOfTooManyCells)
    {
        Scenario scenario;
        scenario.vehicle = vehicleByName("tpcap");
        scenario.polygons = {{{10.0, 10.0}, {11.0, 10.0}, {11.0, 11.0}}};
        scenario.bounds = {{-20.0, -20.0}, {20.0, 20.0}};
        const FootprintChecker footprint(ObstacleSet::fromScenario(scenario), scenario.vehicle);
        TextbookProblem problem = openSquare({0.0, 0.0, 0.0}, {8.0, 3.0, 0.5});
        problem.footprint = &footprint;
        TextbookParameters fine;
        fine.xyResolution = 0.001;
        parking_test::expectError([&] { TextbookSearch(problem, fine); }, {"too many cells", "xy_resolution"});
        EXPECT_EQ(TextbookSearch(problem, {}).run().size(), 2u);
    }
}  // namespace

// Driving parts of paths the other way round: cheaper, ends kept, free and drivable.

#include "ompl_improved_astar/search/planning/PathPlanner.h"
#include "ompl_improved_astar/search/planning/PathTurner.h"
#include "tests/ompl_improved_astar/search/CarProblems.h"
#include "tests/ompl_improved_astar/search/planning/SamePath.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    const CostModel &model()
    {
        static const CostModel cost = carParameters().cost;
        return cost;
    }

    /** A lane with a room at each of its ends: one in which the car turns in many moves only, and one of 12 m. */
    DiscCarWorld laneBetweenRooms()
    {
        return DiscCarWorld({{-5.6, -6.0}, {36.0, 6.0}}, {{{-5.6, 4.2}, {2.6, 6.0}},
                                                          {{-5.6, -6.0}, {2.6, -1.5}},
                                                          {{2.6, 1.3}, {24.0, 6.0}},
                                                          {{2.6, -6.0}, {24.0, -1.3}}});
    }

    /** Turns the car by half at the beginning of the lane, in so many moves, and drives it through in reverse. */
    Path turnAndReverse(int moves)
    {
        Path path{{-2.0, 0.0, 0.0}, {}};
        const double length = PI * TURNING_RADIUS / moves;
        for (int i = 0; i < moves; ++i)
            path.append(i % 2 == 0 ? Arc{1.0 / TURNING_RADIUS, length} : Arc{-1.0 / TURNING_RADIUS, -length});
        path.start.y = -path.end().y;  // to be in the middle of the lane then
        path.append(Arc{0.0, -30.0});
        return path;
    }

    /** A first solution; without pieces when there is none. */
    Path plannedPath(CarProblem &problem, double dearTurns = std::numeric_limits<double>::infinity(),
                     bool shorten = false)
    {
        PathPlannerParameters parameters;
        parameters.search = parametersIn(problem);
        parameters.search.tuning.dearTurns = dearTurns;
        parameters.shorten = shorten;
        PathPlanner planner;
        problem.begin(planner, parameters);
        planner.solve(afterAsking(20000), {});
        return planner.bestPath();
    }
}  // namespace

TEST(PathTurner, turnsWhereThereIsRoomInsteadOfWhereThereIsNone)
{
    const ReedsShepp curves(TURNING_RADIUS);
    DiscCarWorld world = laneBetweenRooms();
    const Path before = turnAndReverse(10);
    ASSERT_EQ(faultOf(before, world, {before.start}, {before.end()}, TURNING_RADIUS), "");
    Path path = before;
    PathTurner turner(world, curves, model(), SearchTuning());
    const double cost = pathCost(model(), before, world);
    ASSERT_TRUE(turner.pass(path, cost, nullptr));
    EXPECT_EQ(faultOf(path, world, {before.start}, {before.end()}, TURNING_RADIUS), "");
    EXPECT_LT(pathCost(model(), path, world), cost);
    EXPECT_LE(path.cusps(), 3U);
    EXPECT_GT(turner.connections(), 0U);
    // It drives through the lane forwards.
    Pose pose = path.start;
    double forwards = 0.0;
    for (const PathPiece &piece : path.pieces)
    {
        const Pose end = advance(pose, piece);
        if (piece.length > 0.0 && std::cos(end.yaw) > 0.9)
            forwards += end.x - pose.x;
        pose = end;
    }
    EXPECT_GT(forwards, 20.0);
    EXPECT_EQ(world.pathsAsked, 1U);
}

/** The same lane, with the room at its end walled up but for what the path itself needs. */
TEST(PathTurner, leavesPathsAloneThatCannotTurnElsewhere)
{
    const ReedsShepp curves(TURNING_RADIUS);
    DiscCarWorld world = laneBetweenRooms();
    world.boxes.push_back({{24.0, 1.3}, {36.0, 6.0}});
    world.boxes.push_back({{24.0, -6.0}, {36.0, -1.3}});
    const Path before = turnAndReverse(10);
    ASSERT_EQ(faultOf(before, world, {before.start}, {before.end()}, TURNING_RADIUS), "");
    Path path = before;
    PathTurner turner(world, curves, model(), SearchTuning());
    EXPECT_FALSE(turner.pass(path, pathCost(model(), before, world), nullptr));
    EXPECT_TRUE(isSamePath(path, before));
}

TEST(PathTurner, takesOnlyWhatCostsLess)
{
    const ReedsShepp curves(TURNING_RADIUS);
    DiscCarWorld world = laneBetweenRooms();
    const Path before = turnAndReverse(10);
    PathTurner turner(world, curves, model(), SearchTuning());
    Path path = before;
    ASSERT_TRUE(turner.pass(path, pathCost(model(), before, world), nullptr));
    const double cost = pathCost(model(), path, world);
    Path same = before, other = before;
    EXPECT_TRUE(turner.pass(same, cost + 1e-6, nullptr));
    EXPECT_TRUE(isSamePath(same, path));
    EXPECT_FALSE(turner.pass(other, cost - 1e-6, nullptr));
    EXPECT_TRUE(isSamePath(other, before));
}

/** What is near to an obstacle is priced where it is, not spread over the pieces of the path. */
TEST(PathTurner, reckonsWhatAPathCostsForBeingNearToObstacles)
{
    const ReedsShepp curves(TURNING_RADIUS);
    DiscCarWorld world = laneBetweenRooms();
    CostModel cost = model();
    cost.preferredClearance = 0.5;
    cost.clearanceCost = 2.0;
    cost.reversePenalty = 0.5;
    const Path before = turnAndReverse(10);
    PathTurner turner(world, curves, cost, SearchTuning());
    Path path = before;
    ASSERT_TRUE(turner.pass(path, pathCost(cost, before, world), nullptr));
    const double cheaper = pathCost(cost, path, world);
    ASSERT_GT(pathCloseness(cost, path, world), 10.0);
    Path same = before, other = before;
    // Where pieces are cut their samples are others; there are 25 cm between these.
    EXPECT_TRUE(turner.pass(same, cheaper + 2.0, nullptr));
    EXPECT_FALSE(turner.pass(other, cheaper - 2.0, nullptr));
}

TEST(PathTurner, endsWhenItIsStoppedOrThePathIsNotAccepted)
{
    const ReedsShepp curves(TURNING_RADIUS);
    const DiscCarWorld plain = laneBetweenRooms();
    DiscCarWorld world = plain;
    world.acceptsPaths = false;
    const Path before = turnAndReverse(10);
    const double cost = pathCost(model(), before, world);
    Path path = before;
    PathTurner turner(world, curves, model(), SearchTuning());
    std::uint64_t asked = 0;
    EXPECT_FALSE(turner.pass(path, cost, [&asked] { return ++asked == 0; }));
    EXPECT_TRUE(isSamePath(path, before));
    EXPECT_LE(turner.connections(), asked);
    for (std::uint64_t calls = 0; calls < asked; calls += 5)
    {
        DiscCarWorld open = plain;
        PathTurner stopped(open, curves, model(), SearchTuning());
        std::uint64_t left = calls;
        EXPECT_FALSE(stopped.pass(path, cost, [&left] { return left-- == 0; }));
        EXPECT_TRUE(isSamePath(path, before));
        EXPECT_LE(stopped.connections(), calls);
    }
}

/** With a limit between none and enough it may know a way to the end when it is reached, and then takes it. */
TEST(PathTurner, triesNoMoreCurvesThanItMay)
{
    const ReedsShepp curves(TURNING_RADIUS);
    const Path before = turnAndReverse(10);
    std::size_t turned = 0, left = 0;
    std::uint64_t most = 0;
    for (std::size_t curvesAtMost = 0; curvesAtMost <= 100; ++curvesAtMost)
    {
        SCOPED_TRACE(curvesAtMost);
        DiscCarWorld world = laneBetweenRooms();
        SearchTuning tuning;
        tuning.mostTurnCurves = curvesAtMost;
        Path path = before;
        PathTurner turner(world, curves, model(), tuning);
        const double cost = pathCost(model(), before, world);
        const bool isTurned = turner.pass(path, cost, nullptr);
        ASSERT_LE(turner.connections(), curvesAtMost);
        most = std::max(most, turner.connections());
        ASSERT_EQ(faultOf(path, world, {before.start}, {before.end()}, TURNING_RADIUS), "");
        ASSERT_EQ(isSamePath(path, before), !isTurned);
        ASSERT_TRUE(!isTurned || pathCost(model(), path, world) < cost);
        ++(isTurned ? turned : left);
        if (curvesAtMost == 0)
        {
            EXPECT_EQ(world.lengthsAsked, 0U);
        }
    }
    EXPECT_GT(turned, 10U);
    EXPECT_GT(left, 1U);
    EXPECT_GT(most, 5U);
}

TEST(PathTurner, staysDrivableInAnyWorld)
{
    const ReedsShepp curves(TURNING_RADIUS);
    int turned = 0, same = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed)
    {
        SCOPED_TRACE(seed);
        CarProblem problem = randomProblem(seed);
        const Path before = plannedPath(problem);
        if (before.cusps() == 0)
            continue;
        CostModel prices = model();
        prices.reversePenalty = seed % 2 == 0 ? 0.0 : 0.4;
        const double cost = pathCost(prices, before, problem.world);
        Path path = before, again = before;
        const bool isTurned = PathTurner(problem.world, curves, prices, SearchTuning()).pass(path, cost, nullptr);
        ASSERT_EQ(PathTurner(problem.world, curves, prices, SearchTuning()).pass(again, cost, nullptr), isTurned);
        ASSERT_TRUE(isSamePath(path, again));
        if (isTurned)
        {
            ASSERT_EQ(faultOf(path, problem.world, problem.starts, problem.goals, TURNING_RADIUS), "");
            ASSERT_LT(pathCost(prices, path, problem.world), cost + 1e-9);
        }
        else
        {
            ASSERT_TRUE(isSamePath(path, before));
        }
        ++(isTurned ? turned : same);
    }
    EXPECT_GT(turned, 10);
    EXPECT_GT(same, 10);
}

/** The planner takes it only when it is cheaper in the end, and leaves paths without cusps alone. */
TEST(PathTurner, makesTheFirstSolutionsOfThePlannerCheaper)
{
    int cheaper = 0, solved = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed)
    {
        SCOPED_TRACE(seed);
        CarProblem problem = randomProblem(seed);
        const Path without = plannedPath(problem, std::numeric_limits<double>::infinity(), true);
        if (without.pieces.empty())
            continue;
        ++solved;
        const Path with = plannedPath(problem, SearchTuning().dearTurns, true);
        ASSERT_EQ(faultOf(with, problem.world, problem.starts, problem.goals, TURNING_RADIUS), "");
        const double cost = pathCost(model(), with, problem.world);
        const double costWithout = pathCost(model(), without, problem.world);
        ASSERT_LE(cost, costWithout + 1e-9);
        cheaper += cost < costWithout - 1e-6 ? 1 : 0;
        if (without.cusps() == 0)
        {
            ASSERT_TRUE(isSamePath(with, without));
        }
    }
    EXPECT_GT(solved, 100);
    EXPECT_GT(cheaper, 3);
}

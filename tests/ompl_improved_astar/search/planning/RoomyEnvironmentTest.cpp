// The world of a car that must keep a clearance, and what planning in it is good for.

#include "ompl_improved_astar/search/planning/PathPlanner.h"
#include "ompl_improved_astar/search/planning/RoomyEnvironment.h"
#include "tests/ompl_improved_astar/search/CarProblems.h"
#include "tests/ompl_improved_astar/search/ClearanceWorld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    constexpr double CLEARANCE = 0.3;

    struct Solved
    {
        bool isSolved{false};
        Path path;
        double cost{std::numeric_limits<double>::infinity()};
    };

    /** What the planner finds first. */
    Solved solve(ClearanceWorld &world, const Pose &start, const Pose &goal, const SearchTuning &tuning)
    {
        PathPlannerParameters parameters;
        parameters.search = carParameters();
        parameters.search.inscribedRadius = world.radius;
        parameters.search.cost.preferredClearance = CLEARANCE;
        parameters.search.cost.clearanceCost = 10.0;
        parameters.search.tuning = tuning;
        PathPlanner planner;
        planner.begin(world, parameters);
        planner.addStart(start);
        planner.addGoal(goal);
        planner.solve(afterAsking(3000), nullptr);
        return {planner.hasSolution(), planner.bestPath(), planner.bestCost()};
    }
}  // namespace

TEST(RoomyEnvironment, IsFreeWhereTheClearanceIsKept)
{
    int free = 0, near = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed)
    {
        ClearanceWorld world(randomField(seed));
        RoomyEnvironment roomy(world, CLEARANCE);
        Random random(seed);
        for (int i = 0; i < 100; ++i)
        {
            const Pose pose = world.freePose(random);
            const bool keeps = world.gap(pose) >= CLEARANCE;
            ASSERT_EQ(roomy.isFree(pose), keeps);
            ASSERT_EQ(roomy.isPassable(pose), keeps);
            ++(keeps ? free : near);
            ASSERT_NEAR(roomy.roomAt(pose.x, pose.y), world.roomAt(pose.x, pose.y) - CLEARANCE, 1e-12);
            ASSERT_NEAR(roomy.closeRoomAt(pose.x, pose.y), world.closeRoomAt(pose.x, pose.y) - CLEARANCE, 1e-12);
            ASSERT_EQ(roomy.clearance(pose), world.clearance(pose));
            const double curvature = random.between(-0.3, 0.3), length = random.between(-6.0, 6.0);
            const double driven = roomy.freeLength(pose, curvature, length);
            ASSERT_LE(driven, std::abs(length));
            for (double at = 0.0; at < driven; at += 0.01)
                ASSERT_GE(world.gap(advance(pose, curvature, std::copysign(at, length))), CLEARANCE);
        }
    }
    EXPECT_GT(free, 300);
    EXPECT_GT(near, 100);
}

TEST(RoomyEnvironment, IsNowhereFreeWhereNothingIsKnownOfClearances)
{
    DiscCarWorld world({{-20.0, -20.0}, {20.0, 20.0}});
    RoomyEnvironment roomy(world, CLEARANCE);
    EXPECT_EQ(roomy.freeLength({}, 0.0, 5.0), 0.0);
}

TEST(RoomyEnvironment, AWayWithRoomIsFoundBesideOneWithout)
{
    int more = 0, less = 0, ends = 0;
    // Moving the poses of dear paths finds some of the room, too.
    SearchTuning usual;
    usual.dearToRelax = usual.dearToRelaxOnce = std::numeric_limits<double>::infinity();
    SearchTuning without = usual;
    without.partsForRoom = 0;
    SearchTuning shortenedOnly = without;
    shortenedOnly.posesBeside = 0;
    for (std::uint64_t number = 0; number < 600; ++number)
    {
        SCOPED_TRACE(number);
        // Few obstacles, then many.
        const std::uint64_t seed = number % 300;
        ClearanceWorld world(randomField(1000 + seed, number < 300 ? 6 : 20));
        Random random(seed);
        const Pose start = world.freePose(random), goal = world.freePose(random);
        if (world.gap(start) < CLEARANCE || world.gap(goal) < CLEARANCE)
            continue;
        const Solved with = solve(world, start, goal, usual), before = solve(world, start, goal, without);
        ASSERT_EQ(with.isSolved, before.isSolved);
        if (!with.isSolved)
            continue;
        ++ends;
        ASSERT_EQ(faultOf(with.path, world, {start}, {goal}, carParameters().turningRadius), "");
        ASSERT_LE(with.cost, before.cost + 1e-9);
        ASSERT_LE(before.cost, 1.02 * solve(world, start, goal, shortenedOnly).cost + 1e-9);
        const bool keeps = leastGap(world, with.path) >= 0.98 * CLEARANCE;
        const bool kept = leastGap(world, before.path) >= 0.98 * CLEARANCE;
        more += keeps && !kept;
        less += kept && !keeps;
    }
    EXPECT_GT(ends, 300);
    EXPECT_GE(more, 6);
    EXPECT_EQ(less, 0);
}

/** However much more room is asked for between the samples, by its plain cost a path gets hardly dearer. */
TEST(RoomyEnvironment, RoomCostsNoMoreThanItMay)
{
    SearchTuning spacious;
    spacious.partsForRoom = 0;
    spacious.dearlyClose = 2.0;  // no path is compared with others, which may cost anything
    SearchTuning shortenedOnly = spacious;
    shortenedOnly.posesBeside = 0;
    int changed = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed)
    {
        SCOPED_TRACE(seed);
        ClearanceWorld world(randomField(seed % 60, 6));
        Random random(seed);
        const Pose start = world.freePose(random), goal = world.freePose(random);
        spacious.roomToSpare = seed % 2 == 0 ? 1.1 : 3.0;
        const Solved before = solve(world, start, goal, shortenedOnly), wider = solve(world, start, goal, spacious);
        ASSERT_EQ(wider.isSolved, before.isSolved);
        if (!before.isSolved)
            continue;
        ASSERT_LE(wider.cost, 1.02 * before.cost + 1e-9);
        changed += wider.cost != before.cost;
    }
    EXPECT_GT(changed, 3);
}

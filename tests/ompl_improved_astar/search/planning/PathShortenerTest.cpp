// The shortening of paths: never worse, ends kept, free and drivable.

#include "ompl_improved_astar/search/planning/PathShortener.h"
#include "tests/ompl_improved_astar/search/NoisyWorld.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    constexpr double RADIUS = 3.0;
    constexpr double INFINITE = std::numeric_limits<double>::infinity();

    /** Drives about at random, free of obstacles. */
    Path wander(DiscCarWorld &world, Random &random, bool forwardOnly = false)
    {
        Path path{world.freePose(random), {}};
        Pose pose = path.start;
        for (int i = 0; i < 12; ++i)
        {
            const double curvature = (static_cast<double>(random.index(3)) - 1.0) / RADIUS;
            const double wanted = random.between(0.3, 5.0) * (!forwardOnly && random.chance(0.5) ? -1.0 : 1.0);
            const double free = world.freeLength(pose, curvature, wanted);
            if (free < 0.1)
                continue;
            path.append({curvature, std::copysign(0.95 * free, wanted)});
            pose = advance(pose, curvature, std::copysign(0.95 * free, wanted));
        }
        return path;
    }

    CostModel model(double gear, double clearance)
    {
        return {0.2, gear, 0.1, clearance, 1.0, 1.0 / RADIUS};
    }
}  // namespace

TEST(PathShortener, makesPathsCheaperAndNothingElse)
{
    int shortened = 0, kept = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed)
    {
        SCOPED_TRACE(seed);
        DiscCarWorld world = randomField(seed % 12);
        Random random(seed);
        const bool forwardOnly = seed % 3 == 0;
        const CurveChoice choice = seed % 2 == 0 ? CurveChoice::All : CurveChoice::Cheapest;
        const ReedsShepp curves(RADIUS, forwardOnly ? CurveFamily::Dubins : CurveFamily::ReedsShepp);
        const CostModel cost = model(1.0, 0.0);
        const Path before = wander(world, random, forwardOnly);
        ASSERT_EQ(faultOf(before, world, {before.start}, {before.end()}, RADIUS, forwardOnly), "");
        Path path = before;
        PathShortener shortener(world, curves, cost);
        const double spacing = random.between(0.5, 3.0);
        const bool changed = shortener.pass(path, spacing, random.between(0.0, spacing), INFINITE, choice, nullptr);
        ASSERT_EQ(faultOf(path, world, {before.start}, {before.end()}, RADIUS, forwardOnly), "");
        const double old = pathCost(cost, before, world), now = pathCost(cost, path, world);
        if (changed)
            ASSERT_LT(now, old);
        else
            ASSERT_EQ(now, old);
        ++(changed ? shortened : kept);

        Path again = before;
        Random same(seed);
        wander(world, same, forwardOnly);
        const double sameSpacing = same.between(0.5, 3.0);
        PathShortener(world, curves, cost)
            .pass(again, sameSpacing, same.between(0.0, sameSpacing), INFINITE, choice, nullptr);
        ASSERT_EQ(again.pieces.size(), path.pieces.size());
        for (std::size_t i = 0; i < path.pieces.size(); ++i)
            ASSERT_TRUE(again.pieces[i].length == path.pieces[i].length &&
                        again.pieces[i].curvature == path.pieces[i].curvature);
    }
    EXPECT_GT(shortened, 30);
    EXPECT_GT(kept, 0);
}

TEST(PathShortener, pricesClearanceAsTheWholePathDoes)
{
    for (std::uint64_t seed = 0; seed < 60; ++seed)
    {
        SCOPED_TRACE(seed);
        DiscCarWorld world = randomField(seed % 12);
        Random random(seed);
        const ReedsShepp curves(RADIUS);
        const CostModel cost = model(0.5, 2.0);
        Path path = wander(world, random);
        const double old = pathCost(cost, path, world);
        PathShortener(world, curves, cost).pass(path, 1.0, 0.0, INFINITE, CurveChoice::All, nullptr);
        ASSERT_LE(pathCost(cost, path, world), old + 1e-9);
    }
}

/** Closeness is sampled: where it changes from millimetre to millimetre, no two ways to cut a path agree on it. Found
   by a million random queries: two curves replaced each other for ever, each cheaper than the other. */
TEST(PathShortener, endsWhereClosenessIsNothingButNoise)
{
    NoisyWorld world({{-100.0, -100.0}, {100.0, 100.0}});
    constexpr std::uint64_t FAR_TOO_MANY = 20000;
    const ReedsShepp curves(RADIUS);
    CostModel cost = model(0.1, 0.0);
    cost.preferredClearance = 0.3;
    cost.clearanceCost = 10.0;
    for (std::uint64_t seed = 0; seed < 40; ++seed)
    {
        SCOPED_TRACE(seed);
        Random random(seed);
        Path path = wander(world, random);
        PathShortener shortener(world, curves, cost);
        shortener.pass(path, 1.0, 0.0, INFINITE, CurveChoice::All,
                       [&] { return shortener.connections() > FAR_TOO_MANY; });
        ASSERT_LT(shortener.connections(), FAR_TOO_MANY);
        ASSERT_LT(path.pieces.size(), 100U);
    }
}

TEST(PathShortener, straightensADetourInTheOpen)
{
    DiscCarWorld world({{-100.0, -100.0}, {100.0, 100.0}});
    const ReedsShepp curves(RADIUS);
    const CostModel cost = model(1.0, 0.0);
    // An S that comes back to its line.
    Path path{{0.0, 0.0, 0.0}, {{1.0 / RADIUS, 3.0}, {-1.0 / RADIUS, 6.0}, {1.0 / RADIUS, 3.0}}};
    const Pose end = path.end();
    EXPECT_TRUE(PathShortener(world, curves, cost).pass(path, 1.0, 0.0, INFINITE, CurveChoice::All, nullptr));
    EXPECT_NEAR(path.length(), std::hypot(end.x, end.y), 1e-6);
}

TEST(PathShortener, triesOtherCurvesThanTheCheapestWhenAllowed)
{
    double before = 0.0, byCheapest = 0.0, byAll = 0.0;
    for (std::uint64_t seed = 0; seed < 60; ++seed)
    {
        DiscCarWorld world = randomField(seed % 12);
        Random random(seed);
        const ReedsShepp curves(RADIUS);
        const CostModel cost = model(1.0, 0.0);
        const Path path = wander(world, random);
        Path one = path, other = path;
        PathShortener(world, curves, cost).pass(one, 1.0, 0.0, INFINITE, CurveChoice::Cheapest, nullptr);
        PathShortener(world, curves, cost).pass(other, 1.0, 0.0, INFINITE, CurveChoice::All, nullptr);
        before += pathCost(cost, path, world);
        byCheapest += pathCost(cost, one, world);
        byAll += pathCost(cost, other, world);
    }
    EXPECT_LT(byCheapest, 0.8 * before);
    EXPECT_LT(byAll, byCheapest);
}

/** The shortener does not look at such parts. */
TEST(PathShortener, twoQuarterTurnsTheSameWayAreTheShortestCurve)
{
    const ReedsShepp curves(RADIUS);
    Random random(4);
    for (int i = 0; i < 20000; ++i)
    {
        const double gear = random.chance(0.5) ? 1.0 : -1.0;
        Path path{random.poseIn(-10.0, 10.0), {}};
        for (int arc = 0; arc < 2; ++arc)
        {
            const double lock = static_cast<double>(random.index(3)) - 1.0;
            const double longest = lock == 0.0 ? 4.0 * RADIUS : 0.5 * PI * RADIUS;
            path.pieces.push_back({lock / RADIUS, gear * random.between(0.0, longest)});
        }
        ASSERT_GE(curves.distance(path.start, path.end()), path.length() - 1e-6);
    }
    // A hair more than that, and there may be a shorter one.
    const Path wide{{0.0, 0.0, 0.0}, {{1.0 / RADIUS, 1.8 * RADIUS}, {1.0 / RADIUS, 1.8 * RADIUS}}};
    EXPECT_LT(curves.distance(wide.start, wide.end()), wide.length() - 0.1);
}

TEST(PathShortener, shortensOneWideTurn)
{
    DiscCarWorld world({{-100.0, -100.0}, {100.0, 100.0}});
    const ReedsShepp curves(RADIUS);
    const CostModel cost = model(0.0, 0.0);
    for (const double curvature : {1.0 / RADIUS, 0.4 / RADIUS})
    {
        Path path{{0.0, 0.0, 0.0}, {{curvature, 4.0 / std::abs(curvature)}}};
        const double before = path.length();
        EXPECT_TRUE(PathShortener(world, curves, cost).pass(path, 1.0, 0.0, INFINITE, CurveChoice::Cheapest, nullptr));
        EXPECT_LT(path.length(), 0.95 * before);
    }
}

TEST(PathShortener, leavesPartsAloneThatAreWiderThanAllowed)
{
    DiscCarWorld world({{-100.0, -100.0}, {100.0, 100.0}});
    const ReedsShepp curves(RADIUS);
    const CostModel cost = model(1.0, 0.0);
    const Path before{{0.0, 0.0, 0.0}, {{1.0 / RADIUS, 3.0}, {-1.0 / RADIUS, 6.0}, {1.0 / RADIUS, 3.0}}};
    Path path = before;
    EXPECT_FALSE(PathShortener(world, curves, cost).pass(path, 1.0, 0.0, 0.5, CurveChoice::All, nullptr));
    EXPECT_EQ(path.length(), before.length());
}

TEST(PathShortener, takesNoCurveThatTheWorldRefuses)
{
    DiscCarWorld world({{-100.0, -100.0}, {100.0, 100.0}});
    world.acceptsPaths = false;
    const ReedsShepp curves(RADIUS);
    Path path{{0.0, 0.0, 0.0}, {{1.0 / RADIUS, 3.0}, {-1.0 / RADIUS, 6.0}, {1.0 / RADIUS, 3.0}}};
    EXPECT_FALSE(
        PathShortener(world, curves, model(1.0, 0.0)).pass(path, 1.0, 0.0, INFINITE, CurveChoice::All, nullptr));
    EXPECT_EQ(path.pieces.size(), 3u);
}

TEST(PathShortener, leavesTrivialPathsAlone)
{
    DiscCarWorld world({{-100.0, -100.0}, {100.0, 100.0}});
    const ReedsShepp curves(RADIUS);
    for (const std::vector<parking::PathPiece> &segments :
         std::vector<std::vector<parking::PathPiece>>{{}, {{0.0, 1e-3}}, {{0.0, 10.0}}})
    {
        Path path{{1.0, 2.0, 3.0}, segments};
        EXPECT_FALSE(
            PathShortener(world, curves, model(1.0, 0.0)).pass(path, 1.0, 0.0, INFINITE, CurveChoice::All, nullptr));
        EXPECT_EQ(path.pieces.size(), segments.size());
    }
}

TEST(PathShortener, stopsWhenTold)
{
    DiscCarWorld world({{-100.0, -100.0}, {100.0, 100.0}});
    const ReedsShepp curves(RADIUS);
    const CostModel cost = model(1.0, 0.0);
    Random random(3);
    const Path before = wander(world, random);
    Path path = before;
    PathShortener shortener(world, curves, cost);
    shortener.pass(path, 0.2, 0.0, INFINITE, CurveChoice::All, [] { return true; });
    EXPECT_LE(shortener.connections(), 16u);
    EXPECT_LE(pathCost(cost, path, world), pathCost(cost, before, world));
}

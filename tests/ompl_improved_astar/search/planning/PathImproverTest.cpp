// The improver of paths: laws on paths of the search and on wiggly ones, and what each kind of pass is for.

#include "ompl_improved_astar/search/Search.h"
#include "ompl_improved_astar/search/planning/PathImprover.h"
#include "tests/ompl_improved_astar/search/CarWorlds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    constexpr std::size_t ANY_NUMBER = 1000;
    constexpr double CENTRE = 1.3;  // of the disc car

    CostModel costModel(double preferredClearance = 0.0)
    {
        CostModel cost;
        cost.gearChangePenalty = 0.5;
        cost.steeringChangePenalty = 0.1;
        cost.fullLockCurvature = 1.0 / TURNING_RADIUS;
        cost.preferredClearance = preferredClearance;
        cost.clearanceCost = 10.0;
        return cost;
    }

    PathImprover::Pass passOf(double spacing, double step = 0.0, bool turnsCar = false)
    {
        return {spacing, 0.0, std::numeric_limits<double>::infinity(), step, FreeCurves::MAX_CURVES, turnsCar};
    }

    /** A walk of random arcs that is free. */
    Path wiggle(DiscCarWorld &world, Random &random, std::size_t pieces)
    {
        Path path{world.freePose(random), {}};
        Pose pose = path.start;
        for (std::size_t i = 0; i < pieces; ++i)
        {
            const PathPiece piece{random.between(-1.0, 1.0) / TURNING_RADIUS, random.magnitude(0.3, 4.0)};
            const double free = world.freeLength(pose, {piece.curvature, piece.length});
            if (free < 0.2)
                continue;
            path.append({piece.curvature, std::copysign(free, piece.length)});
            pose = path.end();
        }
        return path;
    }

    /** Free paths of either kind in random worlds, and those worlds. */
    std::vector<std::pair<DiscCarWorld, Path>> somePaths()
    {
        std::vector<std::pair<DiscCarWorld, Path>> paths;
        for (std::uint64_t seed = 0; seed < 60; ++seed)
        {
            CarProblem problem = randomProblem(seed, 6 + static_cast<std::uint32_t>(seed % 8));
            Random random(seed);
            if (seed % 2 == 0)
                paths.emplace_back(problem.world, wiggle(problem.world, random, 4 + random.index(10)));
            else
            {
                Search search;
                problem.begin(search, carParameters());
                if (search.run({}, 1000) == SearchOutcome::Improved)
                    paths.emplace_back(problem.world, search.bestPath());
            }
        }
        return paths;
    }

    bool isUnchanged(const PricedPath &a, const PricedPath &b)
    {
        return isSamePath(a.path, b.path) && a.cost == b.cost && a.proximity == b.proximity;
    }

    /** Passes of a kind until one finds nothing. */
    void improveFully(PathImprover &improver, PricedPath &path, const PathImprover::Pass &pass)
    {
        for (int i = 0; i < 20 && improver.improve(path, pass, ANY_NUMBER, {}); ++i)
        {
        }
    }
}  // namespace

TEST(PathImprover, onlyEverMakesAPathCheaper)
{
    const ReedsShepp curves(TURNING_RADIUS);
    std::size_t improved = 0, kept = 0, cuspsAdded = 0;
    std::uint64_t seed = 0;
    for (auto [world, original] : somePaths())
        for (const PathImprover::Pass &pass : {passOf(0.5 * TURNING_RADIUS), passOf(1.0), passOf(TURNING_RADIUS, 0.3),
                                               passOf(TURNING_RADIUS, 0.0, true)})
            for (const bool isLimited : {true, false})
            {
                SCOPED_TRACE(++seed);
                const CostModel cost = costModel(seed % 3 == 0 ? 0.2 : 0.0);
                const std::size_t maxCusps = isLimited ? original.cusps() : ANY_NUMBER;
                const PricedPath before = price(cost, original, world);
                PricedPath path = before;
                PathImprover improver(world, curves, cost, CENTRE);
                const bool isImproved = improver.improve(path, pass, maxCusps, {});
                ASSERT_EQ(isUnchanged(path, before), !isImproved);
                ++(isImproved ? improved : kept);
                if (!isImproved)
                    continue;
                cuspsAdded += path.path.cusps() > original.cusps();
                ASSERT_LT(path.cost, before.cost);
                ASSERT_EQ(path.cost, price(cost, path.path, world).cost);
                ASSERT_LE(path.path.cusps(), maxCusps);
                ASSERT_EQ(faultOf(path.path, world, {original.start}, {original.end()}, TURNING_RADIUS), "");
            }
    EXPECT_GT(improved, 100u);
    EXPECT_GT(kept, 10u);
    EXPECT_GT(cuspsAdded, 0u);
}

TEST(PathImprover, stoppedOrRefusedItLeavesThePathAsItWas)
{
    // Between two polls a few pairs of poses are joined, by up to some dozens of curves each.
    constexpr std::uint64_t MAX_QUESTIONS = 3000;
    const ReedsShepp curves(TURNING_RADIUS);
    std::size_t stopped = 0, refused = 0;
    for (auto [world, original] : somePaths())
        for (const PathImprover::Pass &pass :
             {passOf(1.0), passOf(TURNING_RADIUS, 0.3), passOf(TURNING_RADIUS, 0.0, true)})
        {
            const CostModel cost = costModel(0.1);
            PathImprover improver(world, curves, cost, CENTRE);
            const PricedPath before = price(cost, original, world);
            PricedPath path = before;
            int polls = 0;
            if (!improver.improve(path, pass, ANY_NUMBER, [&polls] { return ++polls < 0; }))
                continue;
            for (int most = 0; most < polls; most += 1 + polls / 5)
            {
                path = before;
                MeasuredStop stop{world, afterPolls(most)};
                ASSERT_FALSE(improver.improve(path, pass, ANY_NUMBER, std::ref(stop)));
                ASSERT_TRUE(isUnchanged(path, before));
                ASSERT_LE(stop.maxQuestions(), MAX_QUESTIONS);
                ++stopped;
            }
            world.acceptsPaths = false;
            ASSERT_FALSE(improver.improve(path, pass, ANY_NUMBER, {}));
            world.acceptsPaths = true;
            ASSERT_TRUE(isUnchanged(path, before));
            // A world that has no more time finds nothing free, and nothing near.
            world.lastQuestion = world.questions + 100 * (refused % 20);
            ASSERT_TRUE(improver.improve(path, pass, ANY_NUMBER, {}) || isUnchanged(path, before));
            world.lastQuestion = ~std::uint64_t{0};
            ASSERT_EQ(path.cost, price(cost, path.path, world).cost);
            ASSERT_EQ(faultOf(path.path, world, {original.start}, {original.end()}, TURNING_RADIUS), "");
            ++refused;
        }
    EXPECT_GT(stopped, 100u);
    EXPECT_GT(refused, 30u);
}

TEST(PathImprover, removesADetour)
{
    // Round a circle, round a box that is gone, and forwards past the goal and back.
    const double quarter = 0.5 * PI * TURNING_RADIUS, left = 1.0 / TURNING_RADIUS;
    const Path detours[]{
        {{0.0, 0.0, 0.0}, {{0.0, 2.0}, {left, 4.0 * quarter}, {0.0, 8.0}}},
        {{0.0, 0.0, 0.0},
         {{0.0, 1.0}, {left, quarter}, {-left, quarter}, {0.0, 4.0}, {-left, quarter}, {left, quarter}}},
        {{0.0, 0.0, 0.0}, {{0.0, 9.0}, {0.0, -4.0}}}};
    for (const Path &detour : detours)
    {
        DiscCarWorld world({{-20.0, -20.0}, {30.0, 20.0}});
        const ReedsShepp curves(TURNING_RADIUS);
        PathImprover improver(world, curves, costModel(), CENTRE);
        PricedPath path = price(costModel(), detour, world);
        improveFully(improver, path, passOf(0.5 * TURNING_RADIUS));
        EXPECT_NEAR(path.path.length(), curves.distance(detour.start, detour.end()), 0.1);
    }
}

TEST(PathImprover, movesPosesAsideOfObstaclesWhereCurvesAloneGainNothing)
{
    constexpr double CLEARANCE = 0.3;
    const ReedsShepp curves(TURNING_RADIUS);
    std::size_t moved = 0;
    double before = 0.0, after = 0.0;
    for (auto [world, original] : somePaths())
    {
        const CostModel cost = costModel(CLEARANCE);
        PathImprover improver(world, curves, cost, CENTRE);
        PricedPath path = price(cost, original, world);
        improveFully(improver, path, passOf(TURNING_RADIUS));
        const double nearer = metresNearer(world, path.path, CLEARANCE);
        if (!improver.improve(path, passOf(TURNING_RADIUS, 0.3), ANY_NUMBER, {}))
            continue;
        ++moved;
        before += nearer;
        after += metresNearer(world, path.path, CLEARANCE);
    }
    EXPECT_GT(moved, 10u);
    EXPECT_LT(after, 0.7 * before);
}

TEST(PathImprover, turnsTheCarRoundWhereThatIsCheaper)
{
    // A long narrow lane between two places to turn, driven in reverse where that costs three times as much.
    DiscCarWorld world({{-32.0, -8.0}, {32.0, 8.0}}, {{{-20.0, 1.5}, {20.0, 8.0}}, {{-20.0, -8.0}, {20.0, -1.5}}});
    CostModel cost = costModel();
    cost.reversePenalty = 2.0;
    const ReedsShepp curves(TURNING_RADIUS);
    PathImprover improver(world, curves, cost, CENTRE);
    PricedPath path = price(cost, {{26.0, 0.0, 0.0}, {{0.0, -52.0}}}, world);
    improveFully(improver, path, passOf(TURNING_RADIUS));
    EXPECT_EQ(path.path.cusps(), 0u) << "curves alone cannot";
    ASSERT_TRUE(improver.improve(path, passOf(TURNING_RADIUS, 0.0, true), ANY_NUMBER, {}));
    EXPECT_EQ(faultOf(path.path, world, {path.path.start}, {{-26.0, 0.0, 0.0}}, TURNING_RADIUS), "");
    EXPECT_LT(metresInReverse(path.path), 15.0);
    // With no more cusps than it has, it must stay.
    PricedPath kept = price(cost, {{26.0, 0.0, 0.0}, {{0.0, -52.0}}}, world);
    EXPECT_FALSE(improver.improve(kept, passOf(TURNING_RADIUS, 0.0, true), 0, {}));
}

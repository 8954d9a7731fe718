// Leading a part of a path through a pose beside it: what it costs, its limits, its ends.

#include "ompl_improved_astar/search/planning/GapBridge.h"

#include "ompl_improved_astar/search/models/CurveCheck.h"
#include "tests/ompl_improved_astar/search/CarProblems.h"
#include "tests/ompl_improved_astar/search/ClearanceWorld.h"
#include "tests/support/PoseGap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    constexpr std::size_t ANY_NUMBER = 1000;
    constexpr double INFINITE = std::numeric_limits<double>::infinity();

    CostModel model()
    {
        return {0.2, 1.0, 0.1, 0.0, 1.0, 1.0 / TURNING_RADIUS};
    }

    /** Forwards with bends, then in reverse. */
    const Path &bentAndBack()
    {
        static const Path path{
            {0.0, 0.0, 0.3},
            {{1.0 / TURNING_RADIUS, 2.0}, {0.0, 3.0}, {-1.0 / TURNING_RADIUS, 2.5}, {0.0, -2.0}, {0.2, -3.0}}};
        return path;
    }

    DiscCarWorld open()
    {
        return DiscCarWorld({{-100.0, -100.0}, {100.0, 100.0}});
    }

    /** Up to so many metres off in x and in y, and turned by up to so many radians. */
    Pose poseBeside(const Pose &pose, double metres, double turn, Random &random)
    {
        return {pose.x + random.between(-metres, metres), pose.y + random.between(-metres, metres),
                pose.yaw + random.between(-turn, turn)};
    }
}  // namespace

TEST(GapBridge, whatIsCutOutIsTheRestOfWhatIsLeft)
{
    DiscCarWorld world = open();
    const ReedsShepp curves(TURNING_RADIUS);
    const Path &path = bentAndBack();
    GapBridge bridge(world, curves, model());
    const double whole = path.length();
    for (const double begin : {0.0, 1.0, 4.9, 6.0})
        for (const double end : {6.5, 7.5, 8.0, whole})
        {
            const GapBridge::Gap gap = bridge.cutOut(*pricePath(model(), path, world, {}), begin, end);
            EXPECT_NEAR(gap.before.length(), begin, 1e-9);
            EXPECT_NEAR(gap.after.length(), whole - end, 1e-9);
            EXPECT_LT(parking_test::gap(gap.from, path.at(begin)), 1e-9);
            EXPECT_LT(parking_test::gap(gap.after.start, path.at(end)), 1e-9);
            const double left = pathCost(model(), gap.before, world) + pathCost(model(), gap.after, world);
            EXPECT_NEAR(gap.cost + left, pathCost(model(), path, world), 1e-9);
        }
}

/** Near to walls, so that closeness costs something. */
TEST(GapBridge, takesWhatItKnowsOfPiecesThatAreCutOutWhole)
{
    CostModel cost = model();
    cost.preferredClearance = 0.5;
    cost.clearanceCost = 1.0;
    ClearanceWorld world{DiscCarWorld({{-100.0, -100.0}, {100.0, 100.0}}, {{{3.0, 3.5}, {6.0, 4.0}}})};
    const ReedsShepp curves(TURNING_RADIUS);
    const PricedPath priced = *pricePath(cost, bentAndBack(), world, {});
    const Path &path = priced.path;
    ASSERT_EQ(priced.closeness.size(), path.pieces.size());
    EXPECT_GT(pathCloseness(cost, path, world), 1.0);
    EXPECT_NEAR(std::accumulate(priced.closeness.begin(), priced.closeness.end(), 0.0),
                pathCloseness(cost, path, world), 1e-9);
    EXPECT_NEAR(priced.cost, pathCost(cost, path, world), 1e-9);
    PricedPath dearer = priced;
    for (double &closeness : dearer.closeness)
        closeness += 100.0;
    GapBridge bridge(world, curves, cost);
    // The pieces end after 2, 5, 7.5, 9.5 and 12.5 metres.
    struct Cut
    {
        double begin, end;
        int whole;
    };
    for (const auto &[begin, end, whole] : {Cut{0.0, 12.5, 5},
                                            {2.0, 9.5, 3},
                                            {2.0, 5.0, 1},
                                            {1.0, 9.5, 3},
                                            {2.0, 9.0, 2},
                                            {0.5, 12.0, 3},
                                            {2.5, 4.5, 0},
                                            {1.5, 6.0, 1}})
    {
        SCOPED_TRACE(testing::Message() << begin << " to " << end);
        const GapBridge::Gap gap = bridge.cutOut(priced, begin, end);
        double joins = 0.0;
        const Path part = path.first(end).rest(begin);
        if (gap.pieceBefore() != nullptr)
            joins += cost.join(*gap.pieceBefore(), part.pieces.front());
        if (gap.pieceAfter() != nullptr)
            joins += cost.join(part.pieces.back(), *gap.pieceAfter());
        EXPECT_NEAR(gap.cost, pathCost(cost, part, world) + joins, 1e-9);
        EXPECT_NEAR(bridge.cutOut(dearer, begin, end).cost - gap.cost, 100.0 * whole, 1e-9);
    }
}

TEST(GapBridge, leadsThroughThePoseWithinItsLimits)
{
    const ReedsShepp curves(TURNING_RADIUS);
    int led = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed)
    {
        SCOPED_TRACE(seed);
        DiscCarWorld world = open();
        Random random(seed);
        const Path &path = bentAndBack();
        GapBridge bridge(world, curves, model());
        const double begin = random.between(0.0, 5.0), end = random.between(7.0, path.length());
        const GapBridge::Gap gap = bridge.cutOut(*pricePath(model(), path, world, {}), begin, end);
        const Pose pose = poseBeside(path.at(random.between(begin, end)), 1.0, 0.5, random);
        const std::optional<GapBridge::Bridged> bridged = bridge.lead(gap, pose, INFINITE, ANY_NUMBER);
        ASSERT_TRUE(bridged);
        ++led;
        ASSERT_EQ(faultOf(bridged->path, world, {path.start}, {path.end()}, TURNING_RADIUS), "");
        ASSERT_LT(parking_test::gap(bridged->path.at(bridged->reach), pose), 1e-6);
        const double left = pathCost(model(), gap.before, world) + pathCost(model(), gap.after, world);
        ASSERT_NEAR(bridged->cost + left, pathCost(model(), bridged->path, world), 1e-9);
        // Both sides of both limits.
        const std::size_t cusps = bridged->path.cusps();
        ASSERT_TRUE(bridge.lead(gap, pose, bridged->cost + 1e-9, cusps));
        ASSERT_FALSE(bridge.lead(gap, pose, bridged->cost - 1e-9, cusps));
        if (cusps > 0)
        {
            ASSERT_FALSE(bridge.lead(gap, pose, INFINITE, cusps - 1));
        }
    }
    EXPECT_EQ(led, 300);
}

/** A wall on either half of the way is seen. */
TEST(GapBridge, leadsAlongNothingThatIsNotFree)
{
    const ReedsShepp curves(TURNING_RADIUS);
    const Path straight{{0.0, 0.0, 0.0}, {{0.0, 20.0}}};
    const Pose beside{10.0, 0.2, 0.0};
    for (const double wall : {-3.0, 5.0, 15.0, 25.0})
    {
        SCOPED_TRACE(wall);
        DiscCarWorld world = open();
        GapBridge bridge(world, curves, model());
        const GapBridge::Gap gap = bridge.cutOut(*pricePath(model(), straight, world, {}), 0.0, 20.0);
        ASSERT_TRUE(bridge.lead(gap, beside, INFINITE, ANY_NUMBER));
        world.boxes.push_back({{wall, -3.0}, {wall + 0.1, 3.0}});
        EXPECT_EQ(bridge.lead(gap, beside, INFINITE, ANY_NUMBER).has_value(), wall < 0.0 || wall > 24.0);
    }
}

/** A post where the last piece of either curve begins. */
TEST(GapBridge, looksAtBothCurvesBeforeItSweepsEither)
{
    const ReedsShepp curves(TURNING_RADIUS);
    const Path straight{{0.0, 0.0, 0.0}, {{0.0, 20.0}}};
    const Pose beside{10.0, 4.0, 0.0};
    DiscCarWorld world = open();
    GapBridge bridge(world, curves, model());
    const GapBridge::Gap gap = bridge.cutOut(*pricePath(model(), straight, world, {}), 0.0, 20.0);
    const std::optional<GapBridge::Bridged> bridged = bridge.lead(gap, beside, INFINITE, ANY_NUMBER);
    ASSERT_TRUE(bridged);
    EXPECT_GT(world.lengthsAsked, 0u);
    for (const double arrival : {bridged->reach, bridged->path.length()})
    {
        SCOPED_TRACE(arrival);
        double begin = 0.0, end = 0.0;
        for (auto piece = bridged->path.pieces.begin(); end < arrival - 1e-6; ++piece)
        {
            begin = end;
            end += piece->driven();
        }
        const Pose joint = bridged->path.at(begin);
        world.boxes = {{{joint.x - 0.01, joint.y - 0.01}, {joint.x + 0.01, joint.y + 0.01}}};
        for (const Pose &pose : {straight.start, beside, straight.end()})
            ASSERT_GT(world.gap(pose), 0.0);
        world.lengthsAsked = 0;
        EXPECT_FALSE(bridge.lead(gap, beside, INFINITE, ANY_NUMBER));
        EXPECT_EQ(world.lengthsAsked, 0u);
    }
}

/** What cannot cost less from end to end is not looked at pose by pose: all but nothing is missed by that. Not nothing,
    since the cheapest of all ways need not be one of the curves. */
TEST(GapBridge, hardlyEverLeadsThroughAPoseForLessThanTheCheapestCurve)
{
    const ReedsShepp curves(TURNING_RADIUS);
    DiscCarWorld world = open();
    int led = 0, missed = 0, cheaper = 0;
    for (std::uint64_t seed = 0; seed < 3000; ++seed)
    {
        SCOPED_TRACE(seed);
        Random random(seed);
        Path path{{0.0, 0.0, random.between(-PI, PI)}, {}};
        for (int i = 0; i < 6; ++i)
            path.append(Arc{(static_cast<double>(random.index(3)) - 1.0) / TURNING_RADIUS,
                            random.between(0.5, 4.0) * (random.chance(0.3) ? -1.0 : 1.0)});
        GapBridge bridge(world, curves, model());
        const double begin = random.between(0.0, 0.4) * path.length(), end = random.between(0.6, 1.0) * path.length();
        const GapBridge::Gap gap = bridge.cutOut(*pricePath(model(), path, world, {}), begin, end);
        cheaper += bridge.canCostLess(gap, gap.cost - 1e-3);
        // Both sides of what the cheapest one costs.
        std::vector<ReedsSheppCurve> candidates;
        curves.candidates(gap.from, gap.after.start, candidates, INFINITE);
        double cheapest = INFINITE;
        for (const ReedsSheppCurve &curve : candidates)
            if (curve.count > 0)
                cheapest = std::min(cheapest, curveCost(model(), curve, gap.pieceBefore(), gap.pieceAfter()));
        ASSERT_TRUE(bridge.canCostLess(gap, cheapest + 1e-9));
        ASSERT_FALSE(bridge.canCostLess(gap, cheapest - 1e-9));
        for (int i = 0; i < 10; ++i)
        {
            const Pose pose = poseBeside(path.at(random.between(begin, end)), 0.5, 0.2, random);
            const std::optional<GapBridge::Bridged> bridged = bridge.lead(gap, pose, INFINITE, ANY_NUMBER);
            ASSERT_TRUE(bridged);
            ++led;
            missed += !bridge.canCostLess(gap, bridged->cost + 1e-9);
        }
    }
    EXPECT_LT(missed, 6);
    EXPECT_GT(led, 20000);
    EXPECT_GT(cheaper, 2000);
}

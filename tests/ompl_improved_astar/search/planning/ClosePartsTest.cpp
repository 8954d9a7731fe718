// Where paths come nearer to obstacles than preferred.

#include "ompl_improved_astar/search/planning/CloseParts.h"
#include "parking_geometry/curves/ReedsShepp.h"
#include "tests/ompl_improved_astar/search/ClearanceWorld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    constexpr double RADIUS = 3.0, PREFERRED = 0.3;

    const Path &straightOn()
    {
        static const Path path{{-20.0, 0.0, 0.0}, {{0.0, 15.0}, {0.0, 25.0}}};
        return path;
    }

    /** A drive of 40 m along y = 0 with a post beside it at each of these x, so far from the flank of the car. */
    DiscCarWorld postsBeside(const std::vector<double> &places, double room)
    {
        DiscCarWorld world({{-30.0, -10.0}, {30.0, 10.0}});
        for (const double x : places)
            world.boxes.push_back({{x - 0.01, world.radius + room}, {x + 0.01, 9.0}});
        return world;
    }

    std::vector<ClosePart> partsOf(DiscCarWorld &world, const Path &path, double from = 0.0,
                                   const StopFunction &stop = nullptr)
    {
        return closeParts(world, path, from, PREFERRED, RADIUS, stop);
    }
}  // namespace

TEST(CloseParts, areWhereThePostsAre)
{
    DiscCarWorld world = postsBeside({-8.0, 9.0}, 0.1);
    const std::vector<ClosePart> parts = partsOf(world, straightOn());
    ASSERT_EQ(parts.size(), 2U);
    for (std::size_t k = 0; k < 2; ++k)
    {
        // From the first disc that comes to the last one that leaves; a post is near while the rear axle is at most
        // so far from it:
        const double post = k == 0 ? 12.0 : 29.0, dx = std::sqrt(1.25 * 1.25 - 1.05 * 1.05);
        EXPECT_NEAR(parts[k].begin, post - 2.6 - dx, 0.1);
        EXPECT_NEAR(parts[k].end, post + dx, 0.1);
        EXPECT_NEAR(parts[k].clearance, 0.1, 0.002);
        EXPECT_GE(parts[k].nearest, parts[k].begin);
        EXPECT_LE(parts[k].nearest, parts[k].end);
    }
}

TEST(CloseParts, areNoneWhereTheCarIsHardlyNearer)
{
    for (const double room : {0.295, 0.31})
    {
        DiscCarWorld world = postsBeside({-8.0, 9.0}, room);
        EXPECT_TRUE(partsOf(world, straightOn()).empty()) << room;
    }
    DiscCarWorld world = postsBeside({-8.0, 9.0}, 0.29);
    EXPECT_FALSE(partsOf(world, straightOn()).empty());
}

TEST(CloseParts, BeforeThePlaceThatIsAskedForAreLeftOut)
{
    DiscCarWorld world = postsBeside({-8.0, 9.0}, 0.1);
    const std::vector<ClosePart> all = partsOf(world, straightOn());
    const std::vector<ClosePart> later = partsOf(world, straightOn(), 20.0);
    ASSERT_EQ(all.size(), 2U);
    ASSERT_EQ(later.size(), 1U);
    EXPECT_NEAR(later[0].begin, all[1].begin, 0.051);
    EXPECT_NEAR(later[0].end, all[1].end, 0.051);
}

TEST(CloseParts, areOneWhenNearToEachOther)
{
    // Between the posts the car is away from both for 0.34 m, or for 0.64 m.
    DiscCarWorld one = postsBeside({-8.0, -3.7}, 0.1), two = postsBeside({-8.0, -3.4}, 0.1);
    EXPECT_EQ(partsOf(one, straightOn()).size(), 1U);
    EXPECT_EQ(partsOf(two, straightOn()).size(), 2U);
}

/** By a look at every centimetre of random curves: what is nearer for longer than two looks apart is in a part. */
TEST(CloseParts, MissNothingOnRandomCurves)
{
    int close = 0, clear = 0;
    const ReedsShepp curves(RADIUS);
    for (std::uint64_t seed = 0; seed < 300; ++seed)
    {
        SCOPED_TRACE(seed);
        DiscCarWorld plain = randomField(seed % 20, 6);
        ClearanceWorld world(plain);
        Random random(seed);
        const Pose from = world.freePose(random), to = world.freePose(random);
        std::vector<ReedsSheppCurve> candidates;
        curves.candidates(from, to, candidates);
        Path path{from, {}};
        for (std::size_t k = 0; k < candidates[0].count; ++k)
            path.append(candidates[0].pieces[k]);
        // Both in a world that knows what motions keep and in one that does not.
        const std::vector<ClosePart> parts = partsOf(world, path), slowly = partsOf(plain, path);
        const auto isIn = [](const std::vector<ClosePart> &all, double begin, double end)
        {
            return std::any_of(all.begin(), all.end(),
                               [&](const ClosePart &part)
                               { return part.begin <= begin + 0.06 && part.end >= end - 0.06; });
        };
        double begin = -1.0;
        const double length = path.length();
        for (double at = 0.0; at <= length + 0.01; at += 0.01)
        {
            const bool isClose = at <= length && world.gap(path.at(at)) < 0.98 * PREFERRED - 1e-6;
            if (isClose && begin < 0.0)
                begin = at;
            if (isClose || begin < 0.0)
                continue;
            if (at - begin > 0.12)
            {
                ASSERT_TRUE(isIn(parts, begin, at)) << begin << " to " << at;
                ASSERT_TRUE(isIn(slowly, begin, at)) << begin << " to " << at;
                ++close;
            }
            begin = -1.0;
        }
        for (const ClosePart &part : parts)
        {
            ASSERT_NEAR(world.clearance(path.at(part.nearest)), part.clearance, 1e-9);
            ASSERT_LT(part.clearance, 0.98 * PREFERRED);
        }
        clear += parts.empty();
    }
    EXPECT_GT(close, 100);
    EXPECT_GT(clear, 20);
}

TEST(CloseParts, AreLookedForNoLongerThanTold)
{
    DiscCarWorld world = postsBeside({-8.0, 9.0}, 0.1);
    int asked = 0;
    EXPECT_EQ(partsOf(world, straightOn(), 0.0, [&] { return ++asked == 1000; }).size(), 2U);
    const int all = asked;
    ASSERT_GT(all, 5);
    asked = 0;
    EXPECT_LE(partsOf(world, straightOn(), 0.0, [&] { return ++asked >= 3; }).size(), 1U);
    EXPECT_EQ(asked, 3);
}

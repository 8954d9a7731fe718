// Leading paths past obstacles: more room, never dearer, ends kept, free and drivable.

#include "ompl_improved_astar/search/planning/PathWidener.h"
#include "tests/ompl_improved_astar/search/NoisyWorld.h"
#include "tests/ompl_improved_astar/search/planning/ShortestFree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    constexpr double RADIUS = 3.0, PREFERRED = 0.3;

    CostModel model()
    {
        CostModel cost{0.2, 1.0, 0.1, 0.0, 1.0, 1.0 / RADIUS};
        cost.preferredClearance = PREFERRED;
        cost.clearanceCost = 10.0;
        return cost;
    }

    /** What paths are to be cheaper by: a little more room, as clearances are sampled. */
    CostModel strictModel()
    {
        CostModel cost = model();
        cost.preferredClearance *= SearchTuning().roomToSpare;
        return cost;
    }

    PathWidener widenerFor(DiscCarWorld &world, const ReedsShepp &curves)
    {
        return PathWidener(world, curves, model(), SearchTuning());
    }

    /** A straight drive of 17 m along y = 0 with a block beside it, so far from the flank of the car. */
    DiscCarWorld blockBeside(double room)
    {
        DiscCarWorld world({{-15.0, -10.0}, {15.0, 10.0}});
        world.boxes.push_back({{-1.0, world.radius + room}, {1.0, 9.0}});
        return world;
    }

    const Path &straightOn()
    {
        static const Path path{{-10.0, 0.0, 0.0}, {{0.0, 17.0}}};
        return path;
    }
}  // namespace

TEST(PathWidener, givesPathsRoomAndChangesNothingElse)
{
    int widened = 0, same = 0, kept = 0;
    const ReedsShepp curves(RADIUS);
    for (std::uint64_t seed = 0; seed < 400; ++seed)
    {
        SCOPED_TRACE(seed);
        DiscCarWorld world = randomField(seed % 20);
        Random random(seed);
        const Path before = shortestFree(world, curves, world.freePose(random), world.freePose(random));
        if (before.pieces.empty())
            continue;
        Path path = before;
        PathWidener widener = widenerFor(world, curves);
        const bool changed = widener.pass(path, nullptr);
        // A dip between two strides may be missed, but what it says keeps a clearance nearly does.
        if (!widener.isTooNear())
        {
            ASSERT_GE(leastGap(world, path), 0.9 * PREFERRED);
        }
        else
        {
            ASSERT_LT(leastGap(world, path), PREFERRED + 1e-9);
        }
        ASSERT_EQ(faultOf(path, world, {before.start}, {before.end()}, RADIUS), "");
        if (changed)
            ASSERT_LT(pathCost(strictModel(), path, world), pathCost(strictModel(), before, world));
        else
        {
            ASSERT_EQ(path.pieces.size(), before.pieces.size());
            ASSERT_EQ(path.length(), before.length());
        }
        ++(changed ? widened : same);
        kept += leastGap(world, before) < PREFERRED && leastGap(world, path) >= PREFERRED;

        Path again = before;
        widenerFor(world, curves).pass(again, nullptr);
        ASSERT_EQ(again.pieces.size(), path.pieces.size());
        ASSERT_EQ(again.length(), path.length());
    }
    EXPECT_GT(widened, 20);
    EXPECT_GT(same, 20);
    EXPECT_GT(kept, 10);
}

TEST(PathWidener, leadsStraightDrivesPastABlock)
{
    const ReedsShepp curves(RADIUS);
    for (const double room : {0.02, 0.1, 0.2, 0.28})
    {
        SCOPED_TRACE(room);
        DiscCarWorld world = blockBeside(room);
        Path path = straightOn();
        ASSERT_NEAR(leastGap(world, path), room, 1e-9);
        EXPECT_TRUE(widenerFor(world, curves).pass(path, nullptr));
        EXPECT_EQ(faultOf(path, world, {straightOn().start}, {straightOn().end()}, RADIUS), "");
        EXPECT_GE(leastGap(world, path), PREFERRED);
        EXPECT_EQ(path.cusps(), 0U);
        EXPECT_LT(path.length(), 1.02 * straightOn().length());
    }
}

/** A car that turns round in front of a wall does so before it comes too near, forwards or backwards. */
TEST(PathWidener, turnsRoundShortOfAWall)
{
    const ReedsShepp curves(RADIUS);
    for (const double direction : {1.0, -1.0})
        for (const double room : {0.02, 0.1, 0.25})
        {
            SCOPED_TRACE(::testing::Message() << direction << ", " << room);
            const Path before{{0.0, 0.0, direction < 0.0 ? PI : 0.0},
                              {{0.0, 10.0 * direction}, {0.25 * direction, -6.0 * direction}}};
            // The car's front, or its rear, is so far from the wall when it turns round.
            const double reach = direction > 0.0 ? 2.6 : 0.0;
            DiscCarWorld world({{-20.0, -20.0}, {20.0, 20.0}});
            world.boxes.push_back({{10.0 + reach + world.radius + room, -19.0}, {19.0, 19.0}});
            ASSERT_NEAR(leastGap(world, before), room, 1e-9);
            Path path = before;
            EXPECT_TRUE(widenerFor(world, curves).pass(path, nullptr));
            EXPECT_EQ(faultOf(path, world, {before.start}, {before.end()}, RADIUS), "");
            EXPECT_GE(leastGap(world, path), 0.95 * PREFERRED);
            EXPECT_LE(path.cusps(), before.cusps() + 1);
        }
}

TEST(PathWidener, leavesAloneWhatKeepsWhatIsPreferred)
{
    const ReedsShepp curves(RADIUS);
    DiscCarWorld world = blockBeside(PREFERRED + 0.001);
    Path path = straightOn();
    PathWidener widener = widenerFor(world, curves);
    EXPECT_FALSE(widener.pass(path, nullptr));
    EXPECT_EQ(widener.connections(), 0U);
    EXPECT_EQ(path.length(), straightOn().length());
}

/** What an environment knows to be clear is on the safe side: not all that lies beyond is near. */
TEST(PathWidener, looksCloserAtWhatIsNotKnownToBeClear)
{
    class Careful : public DiscCarWorld
    {
    public:
        using DiscCarWorld::DiscCarWorld;
        void clearLengths(const Pose & /*from*/, const Arc *arcs, std::size_t count, double /*clearance*/,
                          double *clear) override
        {
            for (std::size_t i = 0; i < count; ++i)
                clear[i] = 0.5 * std::abs(arcs[i].length);
        }
    } world({{-15.0, -10.0}, {15.0, 10.0}});
    const ReedsShepp curves(RADIUS);
    Path path = straightOn();
    PathWidener widener = widenerFor(world, curves);
    EXPECT_FALSE(widener.pass(path, nullptr));
    EXPECT_EQ(widener.connections(), 0U);
}

/** Where the car begins or ends too near to something, and where there is no room on the other side either. */
TEST(PathWidener, leavesAloneWhatCannotBeLedPast)
{
    const ReedsShepp curves(RADIUS);
    for (const double end : {-9.0, 11.0})
    {
        DiscCarWorld world({{-15.0, -10.0}, {15.0, 10.0}});
        world.boxes.push_back({{end - 1.0, world.radius + 0.1}, {end + 1.0, 9.0}});
        Path path = straightOn();
        PathWidener widener = widenerFor(world, curves);
        EXPECT_FALSE(widener.pass(path, nullptr)) << end;
        EXPECT_EQ(widener.connections(), 0U);
        EXPECT_EQ(path.length(), straightOn().length());
    }
    DiscCarWorld narrow = blockBeside(0.1);
    narrow.boxes.push_back({{-1.0, -9.0}, {1.0, -narrow.radius - 0.2}});
    Path path = straightOn();
    PathWidener widener = widenerFor(narrow, curves);
    EXPECT_FALSE(widener.pass(path, nullptr));
    EXPECT_EQ(widener.connections(), 0U);
}

/** One change of direction more is a price for room, two are none, cheap as they may be. */
TEST(PathWidener, addsOneCuspAtMost)
{
    CostModel cost = model();
    cost.reversePenalty = cost.gearChangePenalty = cost.steeringChangePenalty = 0.0;
    const ReedsShepp curves(RADIUS);
    int more = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed)
    {
        SCOPED_TRACE(seed);
        DiscCarWorld world = randomField(seed % 20);
        Random random(seed);
        const Path before = shortestFree(world, curves, world.freePose(random), world.freePose(random));
        Path path = before;
        PathWidener(world, curves, cost, SearchTuning()).pass(path, nullptr);
        ASSERT_LE(path.cusps(), before.cusps() + 1);
        more += path.cusps() > before.cusps();
    }
    EXPECT_GT(more, 10);
}

TEST(PathWidener, neverMakesDearerAndEndsWhereClosenessIsNothingButNoise)
{
    NoisyWorld world({{-100.0, -100.0}, {100.0, 100.0}});
    const ReedsShepp curves(RADIUS);
    int changed = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed)
    {
        SCOPED_TRACE(seed);
        Random random(seed);
        Path path = shortestFree(world, curves, world.freePose(random), world.freePose(random));
        const double before = pathCost(strictModel(), path, world);
        PathWidener widener = widenerFor(world, curves);
        const bool isWider = widener.pass(path, nullptr);
        if (isWider)
        {
            ASSERT_LT(pathCost(strictModel(), path, world), before);
        }
        ASSERT_LT(widener.connections(), 100000U);
        changed += isWider;
    }
    EXPECT_GT(changed, 10);
}

TEST(PathWidener, stopsWhenTold)
{
    const ReedsShepp curves(RADIUS);
    DiscCarWorld world = blockBeside(0.1);
    for (int most = 0; most < 8; ++most)
    {
        int asked = 0;
        Path path = straightOn();
        PathWidener widener = widenerFor(world, curves);
        widener.pass(path, [&] { return ++asked > most; });
        EXPECT_LE(asked, most + 3);
        EXPECT_LE(widener.connections(), 2U * static_cast<unsigned int>(most));
        EXPECT_EQ(faultOf(path, world, {straightOn().start}, {straightOn().end()}, RADIUS), "");
    }
}

TEST(PathWidener, doesNotTakeWhatIsRefused)
{
    DiscCarWorld world({{-15.0, -10.0}, {15.0, 10.0}});
    world.acceptsPaths = false;
    world.boxes.push_back({{-1.0, world.radius + 0.1}, {1.0, 9.0}});
    Path path = straightOn();
    EXPECT_FALSE(PathWidener(world, ReedsShepp(RADIUS), model(), SearchTuning()).pass(path, nullptr));
    EXPECT_GT(world.pathsAsked, 0U);
    EXPECT_EQ(path.length(), straightOn().length());
}

// Planning parts of paths anew: with room, for less, from and to the same poses, or not at all.

#include "ompl_improved_astar/search/planning/PathReplanner.h"
#include "tests/ompl_improved_astar/search/CarProblems.h"
#include "tests/ompl_improved_astar/search/ClearanceWorld.h"
#include "tests/ompl_improved_astar/search/planning/ShortestFree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    constexpr double PREFERRED = 0.3;
    constexpr PathReplanner::Effort EFFORT{400, std::size_t{1} << 30};

    SearchParameters parameters(const DiscCarWorld &world)
    {
        SearchParameters parameters = carParameters();
        parameters.inscribedRadius = world.radius;
        parameters.bounds = world.inside;
        parameters.cost.preferredClearance = PREFERRED;
        parameters.cost.clearanceCost = 10.0;
        return parameters;
    }

    std::vector<ClosePart> partsOf(DiscCarWorld &world, const Path &path)
    {
        return closeParts(world, path, 0.0, PREFERRED, TURNING_RADIUS, nullptr);
    }

    /** A wall across the way with two doors: one that is hardly wider than the car, straight on, and a wide one. */
    ClearanceWorld wallWithDoors()
    {
        DiscCarWorld world({{-40.0, -10.0}, {40.0, 10.0}});
        const double door = world.radius + 0.1;
        world.boxes.push_back({{-1.0, -10.0}, {1.0, -door}});
        world.boxes.push_back({{-1.0, door}, {1.0, 2.0}});
        world.boxes.push_back({{-1.0, 7.0}, {1.0, 10.0}});
        return ClearanceWorld(world);
    }

    /** Through the narrow one. */
    const Path &straightOn()
    {
        static const Path path{{-35.0, 0.0, 0.0}, {{0.0, 70.0}}};
        return path;
    }
}  // namespace

TEST(PathReplanner, leadsThroughAnotherDoor)
{
    ClearanceWorld world = wallWithDoors();
    const std::vector<ClosePart> parts = partsOf(world, straightOn());
    ASSERT_EQ(parts.size(), 1U);
    PathReplanner replanner;
    replanner.begin(world, parameters(world));
    const std::optional<Path> path = replanner.replan(straightOn(), parts[0], EFFORT, nullptr);
    ASSERT_TRUE(path);
    EXPECT_EQ(faultOf(*path, world, {straightOn().start}, {straightOn().end()}, TURNING_RADIUS), "");
    EXPECT_GE(leastGap(world, *path), 0.95 * PREFERRED);
    EXPECT_LT(path->length(), straightOn().length() + 5.0);
    // What is far from the part is left as it is.
    const double far = parts[0].begin - SearchTuning().reachForRoom * TURNING_RADIUS - 0.01;
    EXPECT_TRUE(isSamePose(path->at(far), straightOn().at(far), 1e-9));
    EXPECT_TRUE(isSamePose(path->at(path->length() - far), straightOn().at(straightOn().length() - far), 1e-6));
    EXPECT_GT(replanner.expanded(), 0U);
    EXPECT_LE(replanner.expanded(), EFFORT.expansions);
    EXPECT_EQ(replanner.expanded(), replanner.statistics().expanded);

    // Once more: it is a sum, of this query.
    const std::uint64_t once = replanner.expanded();
    ASSERT_TRUE(replanner.replan(straightOn(), parts[0], EFFORT, nullptr));
    EXPECT_EQ(replanner.expanded(), 2 * once);
    EXPECT_EQ(replanner.expanded(), replanner.statistics().expanded);
    replanner.begin(world, parameters(world));
    EXPECT_EQ(replanner.expanded(), 0U);
    EXPECT_EQ(replanner.statistics().connections, 0U);
}

TEST(PathReplanner, triesNoMoreThanItMay)
{
    ClearanceWorld world = wallWithDoors();
    const std::vector<ClosePart> parts = partsOf(world, straightOn());
    PathReplanner replanner;
    replanner.begin(world, parameters(world));
    EXPECT_FALSE(replanner.replan(straightOn(), parts[0], {2, EFFORT.memory}, nullptr));
    EXPECT_LE(replanner.expanded(), 2U);
    for (int most = 0; most < 12; ++most)
    {
        int asked = 0;
        EXPECT_FALSE(replanner.replan(straightOn(), parts[0], EFFORT, [&] { return ++asked > most; }));
        EXPECT_LE(asked, most + 3);
    }
}

/** Whoever checks whole paths sees the whole, too: what is driven before the new way changes what is looked at. */
TEST(PathReplanner, asksWhetherTheWholeIsAccepted)
{
    /** Refuses whatever begins where the path does, or nothing. */
    class PickyWorld : public ClearanceWorld
    {
    public:
        using ClearanceWorld::ClearanceWorld;

        bool acceptPath(const Path &path) override
        {
            return !isPicky || path.start.x != straightOn().start.x;
        }

        bool isPicky{true};
    };
    PickyWorld world(wallWithDoors());
    const std::vector<ClosePart> parts = partsOf(world, straightOn());
    PathReplanner replanner;
    replanner.begin(world, parameters(world));
    EXPECT_FALSE(replanner.replan(straightOn(), parts[0], EFFORT, nullptr));
    world.isPicky = false;
    EXPECT_TRUE(replanner.replan(straightOn(), parts[0], EFFORT, nullptr));
}

/** Where there is no other door; a search that may come nearer would find the narrow one. */
TEST(PathReplanner, keepsThePreferenceAsACondition)
{
    ClearanceWorld world = wallWithDoors();
    world.boxes[1].max.y() = 8.0;
    const std::vector<ClosePart> parts = partsOf(world, straightOn());
    ASSERT_EQ(parts.size(), 1U);
    PathReplanner replanner;
    replanner.begin(world, parameters(world));
    EXPECT_FALSE(replanner.replan(straightOn(), parts[0], EFFORT, nullptr));
    EXPECT_GT(replanner.statistics().connections, 0U);
}

/** With room at neither of the places where the new way could begin, nothing is searched. */
TEST(PathReplanner, beginsAndEndsWhereThereIsRoom)
{
    for (const double side : {-1.0, 1.0})
    {
        SCOPED_TRACE(side);
        ClearanceWorld world = wallWithDoors();
        const std::vector<ClosePart> parts = partsOf(world, straightOn());
        ASSERT_EQ(parts.size(), 1U);
        const double reach = SearchTuning().reachForRoom * TURNING_RADIUS;
        const double place = side < 0.0 ? -35.0 + parts[0].begin - reach : -35.0 + parts[0].end + reach;
        // A lane that is too narrow, up to behind the last place that is tried, or up to short of it. The car reaches
        // farther ahead of its rear axle than behind it.
        for (const double lengthOfLane : {7.5, side < 0.0 ? 2.0 : 4.5})
        {
            SCOPED_TRACE(lengthOfLane);
            ClearanceWorld lane = world;
            const double from = place - side * 3.0, to = place + side * lengthOfLane;
            for (const double y : {-1.0, 1.0})
                lane.boxes.push_back({{std::min(from, to), std::min(y * 1.05, y * 1.5)},
                                      {std::max(from, to), std::max(y * 1.05, y * 1.5)}});
            PathReplanner replanner;
            replanner.begin(lane, parameters(lane));
            replanner.replan(straightOn(), parts[0], EFFORT, nullptr);
            EXPECT_EQ(replanner.statistics().connections > 0, lengthOfLane < 7.0);
        }
    }
}

/** Of worlds that know nothing of clearances nothing is asked of the search. */
TEST(PathReplanner, needsAWorldThatKnowsClearances)
{
    DiscCarWorld world = wallWithDoors();
    const std::vector<ClosePart> parts = partsOf(world, straightOn());
    ASSERT_EQ(parts.size(), 1U);
    PathReplanner replanner;
    replanner.begin(world, parameters(world));
    EXPECT_FALSE(replanner.replan(straightOn(), parts[0], EFFORT, nullptr));
    EXPECT_EQ(replanner.expanded(), 0U);
}

TEST(PathReplanner, onlyMakesPathsCheaperInRandomWorlds)
{
    int replanned = 0, failed = 0, dearer = 0;
    PathReplanner replanner;
    const ReedsShepp curves(TURNING_RADIUS);
    for (std::uint64_t seed = 0; seed < 600; ++seed)
    {
        SCOPED_TRACE(seed);
        ClearanceWorld world(randomField(seed % 40, 6));
        Random random(seed);
        const Pose from = world.freePose(random), to = world.freePose(random);
        const Path path = shortestFree(world, curves, from, to);
        SearchParameters known = parameters(world);
        known.cost.steeringChangePenalty = 0.5;
        // What full lock is the search knows; nobody else must tell it.
        SearchParameters unknown = known;
        unknown.cost.fullLockCurvature = 1.0;
        replanner.begin(world, known);
        for (const ClosePart &part : partsOf(world, path))
        {
            const std::optional<Path> other = replanner.replan(path, part, {100, EFFORT.memory}, nullptr);
            ++(other ? replanned : failed);
            if (!other)
                continue;
            ASSERT_EQ(faultOf(*other, world, {from}, {path.end()}, TURNING_RADIUS), "");
            // But for what one look more or less is worth, since closeness is sampled.
            const double oneLook = known.cost.clearanceCost * known.cost.samplesApart;
            const double before = pathCost(known.cost, path, world), after = pathCost(known.cost, *other, world);
            ASSERT_LT(after, before + oneLook);
            dearer += after > before;
            const std::optional<Path> again = [&]
            {
                PathReplanner fresh;
                fresh.begin(world, unknown);
                return fresh.replan(path, part, {100, EFFORT.memory}, nullptr);
            }();
            ASSERT_TRUE(again);
            ASSERT_EQ(again->length(), other->length());
        }
    }
    EXPECT_GT(replanned, 30);
    EXPECT_GT(failed, 30);
    EXPECT_LE(20 * dearer, replanned);
}

// Places on a disc's way round the obstacles, and what is known of it without looking any farther.

#include "ompl_improved_astar/search/heuristics/ObstacleHeuristic.h"
#include "tests/ompl_improved_astar/search/DiscCarWorld.h"
#include "tests/ompl_improved_astar/search/heuristics/SmallWorld.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <optional>

using namespace parking::search;
using namespace parking_test;

namespace
{
    constexpr double INFINITE = std::numeric_limits<double>::infinity();
}  // namespace

// A place on a shortest way is nearer by what was driven, which is a whole number of steps.
TEST(ObstacleHeuristic, tellsPlacesOnAShortestWay)
{
    int told = 0, towards = 0;
    for (std::uint64_t seed = 0; seed < 30; ++seed)
    {
        SCOPED_TRACE(seed);
        DiscCarWorld world = smallWorld(seed);
        Random random(seed + 300);
        const double resolution = random.between(0.12, 0.4), radius = random.between(0.2, 0.6);
        const bool isDear = seed % 2 == 1;
        const Eigen::Vector2d target = anywhere(random);
        HeuristicIn heuristic(world, resolution, {radius, isDear ? 2.0 * radius : 0.0, 21.0}, target);
        heuristic.addTarget(target.x(), target.y());
        for (int i = 0; i < 100; ++i)
        {
            const Eigen::Vector2d p = anywhere(random);
            const double ahead = random.between(0.0, 6.0), around = random.between(0.0, ahead);
            const double way = heuristic.distance(p.x(), p.y());
            const auto found = heuristic.placeOnWay(p.x(), p.y(), ahead, around);
            const bool isFarEnough = way < INFINITE && way > ahead + around;
            EXPECT_TRUE(isFarEnough ? found || isDear || around <= 2.0 * resolution : !found);
            if (!found)
                continue;
            ++told;
            const double rest = heuristic.distance(found->place.x(), found->place.y());
            EXPECT_LE(rest, way - ahead + 1e-9);
            EXPECT_TRUE(isDear || rest > way - ahead - 17.0 / 12.0 * resolution - 1e-9);
            EXPECT_GT(found->heading.norm(), 0.0);
            const Eigen::Vector2d on = found->place + 0.5 * found->heading, back = found->place - 0.5 * found->heading;
            towards += heuristic.distance(on.x(), on.y()) < heuristic.distance(back.x(), back.y());
            EXPECT_LE(found->heading.norm(), 2.0 * around + 2.9 * resolution);
        }
    }
    EXPECT_GT(told, 500);
    EXPECT_GT(towards, 3 * told / 4) << "the chord of a bend may end beside the way";
}

TEST(ObstacleHeuristic, tellsWhatIsKnownWithoutLookingOn)
{
    int known = 0, unknown = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed)
    {
        SCOPED_TRACE(seed);
        DiscCarWorld world = smallWorld(seed);
        Random random(seed + 400);
        const Eigen::Vector2d toward = anywhere(random), target = anywhere(random);
        HeuristicIn heuristic(world, 0.3, {0.4}, toward);
        heuristic.addTarget(target.x(), target.y());
        EXPECT_FALSE(heuristic.knownDistance(target.x(), target.y())) << "before the first question";
        if (heuristic.distance(toward.x(), toward.y()) < INFINITE)
        {
            EXPECT_TRUE(heuristic.knownDistance(toward.x(), toward.y()));
        }
        EXPECT_FALSE(heuristic.knownDistance(1e12, 0.0)) << "beyond the grid";
        for (int i = 0; i < 50; ++i)
        {
            if (i % 10 == 0)
            {
                const Eigen::Vector2d asked = anywhere(random);
                heuristic.distance(asked.x(), asked.y());
            }
            const Eigen::Vector2d p = anywhere(random);
            const std::uint64_t cells = heuristic.cells(), rooms = world.roomsAsked;
            const std::optional<double> told = heuristic.knownDistance(p.x(), p.y());
            EXPECT_EQ(heuristic.cells(), cells);
            EXPECT_EQ(world.roomsAsked, rooms);
            EXPECT_TRUE(!told || heuristic.distance(p.x(), p.y()) == *told);
            ++(told ? known : unknown);
        }
    }
    EXPECT_GT(known, 100);
    EXPECT_GT(unknown, 100);
}

#include "benchmarks/worlds/RandomWorlds.h"
#include "parking_geometry/Error.h"
#include "state_validity/FootprintCells.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

using namespace parking;
using namespace parking_test;

namespace
{
    constexpr double FIELD_RESOLUTION = 0.02;

    bool has(const FootprintCells::Headings &set, std::size_t bit)
    {
        return (set[bit / 64] >> (bit % 64) & 1U) != 0;
    }

    /** The rear axle of a body with its middle here. */
    Pose rearAxle(const Pose &middle, const Vehicle &vehicle)
    {
        return advance(middle, 0.0, -vehicle.centreOffset());
    }
}  // namespace

/** Wherever the body stands in a blocked cell, corners included, it collides: by the polygons themselves. And most
   cells deep inside of what collides are seen to be blocked. */
TEST(FootprintCells, blockOnlyWhatCollidesThroughout)
{
    const Vehicle vehicle;
    int blocked = 0, deep = 0, deepAndBlocked = 0;
    for (std::uint64_t seed = 0; seed < 24; ++seed)
    {
        const World world = seed % 2 == 0 ? randomPolygonWorld(seed) : randomGridWorld(seed);
        const FootprintChecker checker(world.obstacles, vehicle, 0.0, {}, FIELD_RESOLUTION);
        Random random(seed + 7);
        const double side = random.chance(0.5) ? 0.2 : random.between(0.02, 0.6);
        const int headings = random.chance(0.5) ? 72 : 8 + random.below(121);
        const FootprintCells cells(checker, side, headings);
        for (int i = 0; i < 1000; ++i)
        {
            const Pose near = i % 3 == 0 ? world.anywhere(random) : world.touching(random, vehicle, 0.6);
            const Pose middle = advance(near, 0.0, vehicle.centreOffset());
            const FootprintCells::Headings bits = cells.blocked(middle.x, middle.y);
            const std::size_t heading = random.index(static_cast<std::size_t>(headings));
            const double yaw = 2.0 * PI * (static_cast<double>(heading) + 0.5) / headings - PI;
            const auto bodyAt = [&](double dx, double dy, double turn)
            {
                return rearAxle({middle.x + 0.5 * side * dx, middle.y + 0.5 * side * dy, yaw + PI / headings * turn},
                                vehicle);
            };
            if (!world.oracle.isFree(bodyAt(0.0, 0.0, 0.0), vehicle, -0.6))
            {
                ++deep;
                deepAndBlocked += has(bits, heading);
            }
            if (!has(bits, heading))
                continue;
            ++blocked;
            for (const double dx : {-1.0, 1.0})
                for (const double dy : {-1.0, 1.0})
                    for (const double turn : {-1.0, 1.0})
                        ASSERT_FALSE(world.oracle.isFree(bodyAt(dx, dy, turn), vehicle)) << world.name;
            for (int k = 0; k < 10; ++k)
                ASSERT_FALSE(world.oracle.isFree(
                    bodyAt(random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0)), vehicle))
                    << world.name;
        }
    }
    EXPECT_GT(blocked, 1500);
    EXPECT_GT(deep, 1000);
    EXPECT_GT(deepAndBlocked, 0.6 * deep);
}

/** A post 0.3 m beside the body's middle line closes the cell as long as the cell moves the side by less than that. */
TEST(FootprintCells, sayNothingWhenTheyAreWide)
{
    const Vehicle vehicle;
    const double half = 0.5 * vehicle.width;
    const Pose post{0.0, half - 0.3, 0.0};
    const ObstacleSet obstacles =
        ObstacleSet::fromPolygons({rectangle(0.02, 0.02, post)}, {{-20.0, -20.0}, {20.0, 20.0}});
    const FootprintChecker checker(obstacles, vehicle, 0.0, {}, 0.05);
    const auto isBlocked = [&](double side, int headings)
    {
        // The heading nearest to 0 is the first of the upper half.
        return has(FootprintCells(checker, side, headings).blocked(0.0, 0.0), static_cast<std::size_t>(headings) / 2);
    };
    EXPECT_TRUE(isBlocked(0.1, 120));
    EXPECT_FALSE(isBlocked(0.7, 120)) << "a body may stand beside the post";
    EXPECT_FALSE(isBlocked(3.0, 120)) << "nothing is left of the body";
}

TEST(FootprintCells, refuseWhatIsNoCell)
{
    const FootprintChecker checker(ObstacleSet::fromPolygons({}, {{-9.0, -9.0}, {9.0, 9.0}}), Vehicle());
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double side : {0.0, -1.0, nan})
        EXPECT_THROW(FootprintCells(checker, side, 72), Error) << side;
    for (const int headings : {-1, 0, 7, 129})
        EXPECT_THROW(FootprintCells(checker, 0.2, headings), Error) << headings;
    const FootprintCells cells(checker, 0.2, 72);
    EXPECT_EQ(cells.blocked(0.0, 0.0), FootprintCells::Headings());
    EXPECT_TRUE(has(cells.blocked(nan, 0.0), 71));
    EXPECT_FALSE(has(cells.blocked(nan, 0.0), 72)) << "there are 72 only";
}

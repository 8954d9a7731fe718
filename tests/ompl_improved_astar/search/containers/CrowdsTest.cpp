// Counts by place and heading, against a map that is asked for the place and the sector by other means.

#include "benchmarks/worlds/Random.h"
#include "ompl_improved_astar/search/containers/Crowds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <tuple>

using parking::PI;
using parking::Pose;
using parking::search::Crowds;
using parking_test::Random;

namespace
{
    /** The sector whose middle is nearest to the heading. */
    int sectorOf(double yaw, int sectors)
    {
        int best = 0;
        for (int sector = 1; sector < sectors; ++sector)
            if (std::cos(yaw - 2.0 * PI * sector / sectors) > std::cos(yaw - 2.0 * PI * best / sectors))
                best = sector;
        return best;
    }
}  // namespace

TEST(Crowds, matchAMapOfPlacesAndSectors)
{
    Random random(7);
    Crowds crowds;
    for (const int sectors : {1, 4, 8, 11})
        for (const double side : {0.7, 6.0})
        {
            crowds.begin(side, static_cast<unsigned int>(sectors));
            std::map<std::tuple<int, int, int>, std::uint32_t> oracle;
            for (int i = 0; i < 4000; ++i)
            {
                // A few places, most of them crowded, round a corner of four squares far from the origin, too.
                const double far = random.chance(0.2) ? 5000.0 : 0.0;
                const Pose pose{random.between(-9.0, 9.0) - far, random.between(-9.0, 9.0) + far,
                                random.between(-3.0 * PI, 3.0 * PI)};
                const std::tuple place{static_cast<int>(std::floor(pose.x / side)),
                                       static_cast<int>(std::floor(pose.y / side)), sectorOf(pose.yaw, sectors)};
                ASSERT_EQ(crowds.at(pose), oracle[place]);
                crowds.add(pose);
                ++oracle[place];
            }
        }
}

TEST(Crowds, sectorsAreCentredOnTheAxesAndGoRound)
{
    Crowds crowds;
    crowds.begin(2.0, 8);
    crowds.add({1.0, 1.0, 0.0});
    for (const double yaw : {0.39, -0.39, 2.0 * PI - 0.39, -2.0 * PI + 0.39})
        EXPECT_EQ(crowds.at({1.0, 1.0, yaw}), 1u) << yaw;
    for (const double yaw : {0.40, -0.40, PI, -PI})
        EXPECT_EQ(crowds.at({1.0, 1.0, yaw}), 0u) << yaw;
    crowds.add({1.0, 1.0, PI});
    EXPECT_EQ(crowds.at({1.0, 1.0, -PI + 0.1}), 1u);
}

TEST(Crowds, beginForgets)
{
    Crowds crowds;
    crowds.begin(2.0, 8);
    const std::size_t nothing = crowds.bytes();
    for (int i = 0; i < 1000; ++i)
        crowds.add({3.0 * i, 0.0, 0.0});
    EXPECT_EQ(crowds.at({0.0, 0.0, 0.0}), 1u);
    EXPECT_GE(crowds.bytes(), 1000 * (sizeof(std::uint64_t) + sizeof(std::uint32_t)));
    crowds.begin(2.0, 8);
    EXPECT_EQ(crowds.at({0.0, 0.0, 0.0}), 0u);
    EXPECT_EQ(crowds.bytes(), nothing);
}

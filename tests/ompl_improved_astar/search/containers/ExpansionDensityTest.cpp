// How often a search has been in a place with a heading, against a map of squares and directions.

#include "benchmarks/worlds/Random.h"
#include "ompl_improved_astar/search/containers/ExpansionDensity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <tuple>

using namespace parking;
using parking::search::ExpansionDensity;
using parking_test::Random;

namespace
{
    using Key = std::tuple<double, double, int>;

    /** The square and the nearest of eight directions. */
    Key keyOf(const Pose &pose, double side)
    {
        int nearest = 0;
        for (int i = 1; i < 8; ++i)
            if (std::cos(pose.yaw - 0.25 * PI * i) > std::cos(pose.yaw - 0.25 * PI * nearest))
                nearest = i;
        return {std::floor(pose.x / side), std::floor(pose.y / side), nearest};
    }
}  // namespace

TEST(ExpansionDensity, countsByPlaceAndHeading)
{
    Random random(1);
    ExpansionDensity density;
    for (const double side : {0.4, 2.0, 7.5})
    {
        density.begin(side);
        std::map<Key, std::uint32_t> oracle;
        for (int i = 0; i < 20000; ++i)
        {
            Pose pose = random.poseIn(-4.0 * side, 4.0 * side);
            pose.yaw += 2.0 * PI * random.below(3);
            const Key key = keyOf(pose, side);
            const auto known = oracle.find(key);
            ASSERT_EQ(density.at(pose), known == oracle.end() ? 0 : known->second);
            if (random.chance(0.7))
            {
                density.add(pose);
                ++oracle[key];
            }
        }
        EXPECT_EQ(oracle.size(), 8u * 8u * 8u);
        EXPECT_GT(density.bytes(), 0u);
    }
    density.begin(1.0);
    for (int i = 0; i < 100; ++i)
        ASSERT_EQ(density.at(random.poseIn(-4.0, 4.0)), 0u) << "of the query before";
}

TEST(ExpansionDensity, tellsNeighboursOnBothSidesOfABorderApart)
{
    constexpr double HAIR = 1e-9;
    ExpansionDensity density;
    density.begin(2.0);
    for (const Pose &border : {Pose{0.0, 1.0, 0.1}, Pose{1.0, -4.0, 0.1}, Pose{1.0, 1.0, 0.125 * PI},
                               Pose{-3.0, 1.0, -0.875 * PI}, Pose{1e6, 1.0, 0.1}})
    {
        SCOPED_TRACE(border.x);
        const bool isHeading = std::abs(std::fmod(border.yaw, 0.25 * PI)) > 0.12 * PI;
        const bool isColumn = !isHeading && std::fmod(border.x, 2.0) == 0.0;
        Pose low = border, high = border;
        double Pose::*const across = isHeading ? &Pose::yaw : isColumn ? &Pose::x : &Pose::y;
        low.*across -= HAIR;
        high.*across += HAIR;
        density.add(low);
        EXPECT_EQ(density.at(low), 1u);
        EXPECT_EQ(density.at(high), 0u);
    }
}

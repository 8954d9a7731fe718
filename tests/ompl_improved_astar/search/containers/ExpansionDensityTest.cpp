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

TEST(ExpansionDensity, countsBySquaresAndTheNearestOfEightHeadings)
{
    Random random(1);
    ExpansionDensity density;
    for (const double side : {0.4, 2.0, 7.5})
    {
        density.begin(side);
        std::map<std::tuple<double, double, int>, std::uint32_t> oracle;
        for (int i = 0; i < 20000; ++i)
        {
            Pose pose = random.poseIn(-4.0 * side, 4.0 * side);
            // A hair on either side of a border, too, and any number of turns.
            const double hair = random.magnitude(1e-9, 1e-9);
            if (random.chance(0.3))
                pose.x = std::round(pose.x / side) * side + hair;
            if (random.chance(0.3))
                pose.y = std::round(pose.y / side) * side + hair;
            if (random.chance(0.3))
                pose.yaw = (random.below(8) + 0.5) * 0.25 * PI + hair;
            pose.yaw += 2.0 * PI * (random.below(5) - 2);
            int nearest = 0;
            for (int k = 1; k < 8; ++k)
                if (std::cos(pose.yaw - 0.25 * PI * k) > std::cos(pose.yaw - 0.25 * PI * nearest))
                    nearest = k;
            std::uint32_t &count = oracle[{std::floor(pose.x / side), std::floor(pose.y / side), nearest}];
            ASSERT_EQ(density.at(pose), count);
            if (random.chance(0.7))
            {
                density.add(pose);
                ++count;
            }
        }
        EXPECT_GT(density.bytes(), 0u);
    }
    density.begin(1.0);
    for (int i = 0; i < 100; ++i)
        ASSERT_EQ(density.at(random.poseIn(-4.0, 4.0)), 0u) << "of the query before";
}

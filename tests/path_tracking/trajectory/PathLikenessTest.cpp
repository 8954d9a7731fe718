#include "path_tracking/trajectory/PathLikeness.h"

#include <gtest/gtest.h>

namespace
{
    using namespace parking;

    /** Forwards and back, from a place beside the origin. */
    Path shunt(double aside, double forwards = 10.0, double back = 6.0)
    {
        return {{0.0, aside, 0.0}, {{0.1, forwards}, {-0.1, -back}}};
    }

    TEST(PathLikeness, PathsAreAlikeThatAreNowhereFartherApart)
    {
        EXPECT_TRUE(areAlike(shunt(0.0), shunt(0.0), 0.01));
        EXPECT_TRUE(areAlike(shunt(0.0), shunt(0.4), 0.5));
        EXPECT_TRUE(areAlike(shunt(0.4), shunt(0.0), 0.5));
        EXPECT_FALSE(areAlike(shunt(0.0), shunt(0.6), 0.5));
        EXPECT_TRUE(areAlike(shunt(0.0), shunt(0.0, 10.3, 6.3), 0.5));
        EXPECT_FALSE(areAlike(shunt(0.0), shunt(0.0, 10.0, 6.6), 0.5));
    }

    TEST(PathLikeness, PathsThatPassAnObstacleOnTwoSidesAreNotAlike)
    {
        // Equal at both ends and in the middle; between these 2 m apart.
        const auto swing = [](double side)
        {
            return Path{{}, {{0.2 * side, 3.0}, {-0.2 * side, 6.0}, {0.2 * side, 3.0}}};
        };
        EXPECT_TRUE(areAlike(swing(1.0), swing(1.0), 0.5));
        EXPECT_FALSE(areAlike(swing(1.0), swing(-1.0), 0.5));
        Path longWay{{}, {{0.0, 200.0}}}, detour{{}, {{0.0, 60.0}}};
        for (const double curvature : {0.1, -0.1, -0.1, 0.1})
            detour.append({curvature, 5.0});
        detour.append({0.0, positionDistance(detour.end(), longWay.end())});
        EXPECT_FALSE(areAlike(longWay, detour, 0.5));
    }

    TEST(PathLikeness, DirectionsCount)
    {
        EXPECT_FALSE(areAlike(shunt(0.0), {{}, {{0.1, 10.0}}}, 100.0));
        EXPECT_FALSE(areAlike({{}, {{0.0, 1.0}}}, {{1.0, 0.0, 0.0}, {{0.0, -1.0}}}, 100.0));
        EXPECT_TRUE(areAlike({}, {}, 0.0));
        EXPECT_FALSE(areAlike({}, shunt(0.0), 100.0));
    }
}  // namespace

#include "benchmarks/worlds/Random.h"
#include "parking_geometry/Pose.h"

#include <cmath>

#include <gtest/gtest.h>

using namespace parking;
using namespace parking_test;

TEST(WrapAngle, IsTheRemainder)
{
    Random random(1);
    for (int i = 0; i < 100000; ++i)
    {
        const double angle = random.magnitude(1e-9, i % 3 == 0 ? 4.0 : 40.0);
        ASSERT_EQ(wrapAngle(angle), std::remainder(angle, 2.0 * PI)) << angle;
    }
    for (const double halfTurns : {-5.0, -3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0, 5.0})
    {
        // On both sides of where the number of turns that is taken off changes.
        const double angle = halfTurns * PI;
        for (const double near : {std::nextafter(angle, -100.0), angle, std::nextafter(angle, 100.0)})
        {
            ASSERT_EQ(wrapAngle(near), std::remainder(near, 2.0 * PI)) << near;
            ASSERT_LE(std::abs(wrapAngle(near)), PI);
        }
    }
}

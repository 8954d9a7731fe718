#include "parking_geometry/curves/Kinematics.h"

#include "benchmarks/worlds/RandomParking.h"

#include <cmath>

#include <gtest/gtest.h>

using namespace parking;
using parking_test::RandomParking;

TEST(Kinematics, SharpnessIsWhatTheSteeringRateAllows)
{
    RandomParking random(5);
    for (int i = 0; i < 10000; ++i)
    {
        const Vehicle car = random.vehicle();
        const double speed = random.between(0.05, 2.5), angle = random.between(-0.7, 0.7);
        const double curvature = car.curvature(angle), sharpness = maxSharpness(car, speed, curvature);
        // A car that drives 1e-5 m at this sharpness turns its wheels at exactly its steering rate.
        const double distance = 1e-5;
        const double turned = car.steeringAngle(curvature + sharpness * distance) - angle;
        EXPECT_NEAR(turned / (distance / speed), car.maxSteeringRate, 1e-3);
        EXPECT_NEAR(maxSpeedForSharpness(car, sharpness, curvature), speed, 1e-12);
        EXPECT_NEAR(maxSpeedForSharpness(car, -sharpness, curvature), speed, 1e-12);
        EXPECT_GE(sharpness, maxSharpness(car, speed));
    }
    EXPECT_TRUE(std::isinf(maxSpeedForSharpness(Vehicle(), 0.0)));
}

TEST(Kinematics, ArcBetweenFindsTheArc)
{
    RandomParking random(6);
    for (int i = 0; i < 100000; ++i)
    {
        const Pose from = random.pose(20.0);
        const double curvature = i % 7 == 0 ? 0.0 : random.between(-0.5, 0.5);
        const double length = random.between(-6.0, 6.0);
        if (std::abs(curvature * length) > 0.99 * PI || std::abs(length) < 1e-3)
            continue;
        Pose to = advance(from, curvature, length);
        to.yaw = wrapAngle(to.yaw);
        const Arc arc = arcBetween(from, to);
        ASSERT_NEAR(arc.length, length, 1e-9);
        ASSERT_NEAR(arc.curvature, curvature, 1e-9 / std::abs(length));
    }
    EXPECT_EQ(arcBetween({1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}).length, 0.0);
}

#include "parking_geometry/curves/Kinematics.h"

#include "benchmarks/worlds/RandomParking.h"
#include "tests/parking_geometry/ExpectError.h"

#include <cmath>

#include <gtest/gtest.h>

using namespace parking;
using parking_test::expectError;
using parking_test::RandomParking;

namespace
{
    /** The paper's differential equations by classical Runge-Kutta steps. */
    CarState rungeKutta(CarState state, double wheelbase, double acceleration, double steering, double duration)
    {
        constexpr int STEPS = 400;
        const double h = duration / STEPS;
        const auto rate = [&](const CarState &s)
        {
            return CarState{{s.speed * std::cos(s.pose.yaw), s.speed * std::sin(s.pose.yaw),
                             s.speed * std::tan(steering) / wheelbase},
                            acceleration};
        };
        const auto plus = [](const CarState &s, const CarState &r, double dt)
        {
            return CarState{{s.pose.x + dt * r.pose.x, s.pose.y + dt * r.pose.y, s.pose.yaw + dt * r.pose.yaw},
                            s.speed + dt * r.speed};
        };
        for (int i = 0; i < STEPS; ++i)
        {
            const CarState a = rate(state), b = rate(plus(state, a, 0.5 * h)), c = rate(plus(state, b, 0.5 * h)),
                           d = rate(plus(state, c, h));
            state = plus(plus(plus(plus(state, a, h / 6.0), b, h / 3.0), c, h / 3.0), d, h / 6.0);
        }
        return state;
    }

    void expectNear(const Pose &a, const Pose &b, double tolerance)
    {
        EXPECT_NEAR(a.x, b.x, tolerance);
        EXPECT_NEAR(a.y, b.y, tolerance);
        EXPECT_NEAR(wrapAngle(a.yaw - b.yaw), 0.0, tolerance);
    }
}  // namespace

TEST(Kinematics, IntegrationSolvesThePapersEquations)
{
    RandomParking random(1);
    int reversals = 0;
    for (int i = 0; i < 500; ++i)
    {
        const Vehicle car = random.vehicle();
        const CarState state{random.pose(10.0), random.between(-2.5, 2.5)};
        const double acceleration = random.between(-1.0, 1.0), duration = random.between(0.0, 4.0);
        const double steering = random.between(-car.maxSteeringAngle, car.maxSteeringAngle);
        const CarState exact = integrate(state, car.wheelbase, acceleration, steering, duration);
        const CarState numeric = rungeKutta(state, car.wheelbase, acceleration, steering, duration);
        expectNear(exact.pose, numeric.pose, 1e-7);
        EXPECT_NEAR(exact.speed, numeric.speed, 1e-9);
        reversals += exact.speed * state.speed < 0.0;
    }
    EXPECT_GT(reversals, 20) << "the case of a car that changes direction on the way must be among them";
}

TEST(Kinematics, IntegrationOfPartsIsThatOfTheWhole)
{
    RandomParking random(2);
    for (int i = 0; i < 100000; ++i)
    {
        const CarState state{random.pose(10.0), random.between(-2.5, 2.5)};
        const double a = random.between(-1.0, 1.0), first = random.between(0.0, 3.0), rest = random.between(0.0, 3.0);
        const double steering = i % 10 == 0 ? 0.0 : random.between(-0.78, 0.78);
        const CarState whole = integrate(state, 2.8, a, steering, first + rest);
        const CarState parts = integrate(integrate(state, 2.8, a, steering, first), 2.8, a, steering, rest);
        ASSERT_NEAR(std::hypot(whole.pose.x - parts.pose.x, whole.pose.y - parts.pose.y), 0.0, 1e-11);
        ASSERT_NEAR(whole.pose.yaw, parts.pose.yaw, 1e-12);
        ASSERT_NEAR(whole.speed, parts.speed, 1e-12);
    }
}

TEST(Kinematics, AllWheelsTurnAboutOnePointOnTheRearAxle)
{
    RandomParking random(3);
    for (int i = 0; i < 10000; ++i)
    {
        const double wheelbase = random.between(1.8, 3.4), track = random.between(0.5, 0.65) * wheelbase;
        const double steering = random.between(-0.7, 0.7);
        const WheelAngles wheels = frontWheelAngles(wheelbase, track, steering);
        const double radius = turningRadius(wheelbase, steering);
        // The normals of the wheels, from (wheelbase, +-track / 2), meet the rear axle's line at (0, radius).
        const double side = std::copysign(0.5 * track, steering);
        EXPECT_NEAR(side + wheelbase / std::tan(wheels.inner), radius, 1e-9 * std::abs(radius));
        EXPECT_NEAR(-side + wheelbase / std::tan(wheels.outer), radius, 1e-9 * std::abs(radius));
        EXPECT_GE(std::abs(wheels.inner), std::abs(wheels.outer));
        EXPECT_NEAR(bicycleSteeringAngle(wheels), steering, 1e-12);
        // The paper's mean differs from the model's angle by about a degree at most, and never falls below it.
        EXPECT_GE(std::abs(meanSteeringAngle(wheels)), std::abs(steering) - 1e-12);
        EXPECT_LT(std::abs(meanSteeringAngle(wheels)) - std::abs(steering), 1.7 * PI / 180.0);
    }
    EXPECT_EQ(frontWheelAngles(2.8, 1.6, 0.0).inner, 0.0);
    EXPECT_TRUE(std::isinf(turningRadius(2.8, 0.0)));
}

TEST(Kinematics, ATurningCentreBetweenTheWheelsIsAnError)
{
    const double limit = std::atan(2.0 * 2.8 / 1.6);
    EXPECT_NO_THROW(frontWheelAngles(2.8, 1.6, limit - 1e-6));
    expectError([&] { frontWheelAngles(2.8, 1.6, limit + 1e-6); }, {"steering angle", "1.6 m", "below"});
    expectError([&] { frontWheelAngles(2.8, 1.6, -limit - 1e-6); }, {"steering angle"});
}

TEST(Kinematics, TheBodyStaysBetweenTheSweptRadii)
{
    RandomParking random(4);
    for (int i = 0; i < 1000; ++i)
    {
        const Vehicle car = random.vehicle();
        const double radius = random.between(car.minTurningRadius(), 12.0);
        const SweptRadii radii = sweptRadii(car, radius);
        // Points round the outline, seen from the centre of a left turn at (0, radius).
        double least = 1e9, most = 0.0;
        const auto corners = car.footprint({});
        for (std::size_t edge = 0; edge < 4; ++edge)
            for (int k = 0; k <= 1000; ++k)
            {
                const Eigen::Vector2d point = corners[edge] + 1e-3 * k * (corners[(edge + 1) % 4] - corners[edge]);
                const double distance = (point - Eigen::Vector2d(0.0, radius)).norm();
                least = std::min(least, distance);
                most = std::max(most, distance);
            }
        EXPECT_NEAR(least, radii.inner, 1e-4);
        EXPECT_NEAR(most, std::max(radii.outerFront, radii.outerRear), 1e-9);
    }
}

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
        const Arc arc = arcBetween(from, advance(from, curvature, length));
        ASSERT_NEAR(arc.length, length, 1e-9);
        ASSERT_NEAR(arc.curvature, curvature, 1e-9 / std::abs(length));
    }
    EXPECT_EQ(arcBetween({1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}).length, 0.0);
}

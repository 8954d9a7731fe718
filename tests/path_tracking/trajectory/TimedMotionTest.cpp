#include "parking_geometry/Error.h"
#include "path_tracking/trajectory/StopAndSteer.h"
#include "path_tracking/trajectory/TimedMotion.h"
#include "tests/path_tracking/TestPaths.h"
#include "tests/path_tracking/trajectory/TrajectoryReferee.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace parking
{
    namespace
    {
        constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();

        TEST(TimedMotion, AnArcAtConstantSpeedEndsWhereThePathDoes)
        {
            const Vehicle car;
            const TimedMotion motion{{1.0, 2.0, 0.5}, {{0.0, -1.5, 0.4}, {3.0, -1.5, 0.4}}};
            const Pose expected = advance(motion.start, car.curvature(0.4), -4.5);
            EXPECT_TRUE(isSamePose(endOf(motion, car), expected, 1e-8));
        }

        TEST(TimedMotion, TpcapCostIsWhatFineSumsGive)
        {
            const TimedMotion motion{{},
                                     {{0.0, 0.0, 0.0},
                                      {1.0, 0.0, 0.4},
                                      {2.5, 1.5, -0.2},
                                      {4.0, 0.0, 0.1},
                                      {5.0, -1.0, 0.3},
                                      {6.0, 0.0, 0.3}}};
            double effort = 0.0, steering = 0.0;
            constexpr int PARTS = 20000;
            for (std::size_t i = 1; i < motion.knots.size(); ++i)
            {
                const MotionKnot &a = motion.knots[i - 1], &b = motion.knots[i];
                const double h = b.t - a.t, acceleration = (b.v - a.v) / h, rate = (b.steering - a.steering) / h;
                for (int k = 0; k < PARTS; ++k)
                {
                    const double t = (k + 0.5) / PARTS, v = a.v + t * (b.v - a.v);
                    const double angle = a.steering + t * (b.steering - a.steering);
                    effort += h / PARTS * (acceleration * acceleration + v * v * rate * rate);
                    steering += h / PARTS * angle * angle;
                }
            }
            const TpcapCost cost = tpcapCost(motion);
            EXPECT_DOUBLE_EQ(cost.time, 6.0);
            EXPECT_NEAR(cost.controlEffort, effort, 1e-6);
            EXPECT_NEAR(cost.steeringIntegral, steering, 1e-6);
            EXPECT_EQ(cost.gearChanges, 1U);
            EXPECT_NEAR(cost.total(), 600.0 + 10.0 * effort + 10.0 * steering + 5.0, 1e-4);
        }

        TEST(TimedMotion, SamplesHoldEveryKnotAndAreNoFartherApartThanAsked)
        {
            const Vehicle car;
            const TimedMotion motion{{}, {{0.0, 0.0, 0.0}, {0.73, 0.7, 0.3}, {1.9, 0.0, 0.0}}};
            const Trajectory samples = sample(motion, car, 0.1);
            EXPECT_EQ(test::judge(samples, car, {}).fault, "");
            std::size_t found = 0;
            for (std::size_t i = 0; i < samples.size(); ++i)
            {
                for (const MotionKnot &knot : motion.knots)
                    found += std::abs(samples[i].t - knot.t) < 1e-12 ? 1 : 0;
                if (i > 0)
                {
                    EXPECT_LE(samples[i].t - samples[i - 1].t, 0.1 + 1e-12);
                }
            }
            EXPECT_EQ(found, motion.knots.size());
        }

        TEST(StopAndSteer, AStraightLineTakesWhatFullAccelerationAllows)
        {
            const Vehicle car;
            for (const double length : {0.01, 1.0, 4.0, 6.25, 30.0})
            {
                const double top = std::min(car.maxSpeed, std::sqrt(length * car.maxAcceleration));
                const double expected = length / top + top / car.maxAcceleration;
                for (const double sign : {1.0, -1.0})
                    EXPECT_NEAR(stopAndSteer({{}, {{0.0, sign * length}}}, car, 0.0, 0.0).duration(), expected, 1e-9);
            }
        }

        TEST(StopAndSteer, StandsWhileTheWheelsTurn)
        {
            const Vehicle car;
            const double angle = 0.5;
            const Path path{{}, {{0.0, 4.0}, {car.curvature(angle), 4.0}}};
            EXPECT_NEAR(stopAndSteer(path, car, 0.0, 0.0).duration(), 4.0 + 1.0 + 4.0 + 1.0, 1e-9);
            EXPECT_NEAR(stopAndSteer(path, car, std::nullopt, std::nullopt).duration(), 4.0 + 1.0 + 4.0, 1e-9);
        }

        TEST(StopAndSteer, DrivesEveryKindOfPathToItsEnd)
        {
            const Vehicle car;
            for (std::uint64_t seed = 1; seed <= 30; ++seed)
                for (const Path &path : {test::randomReedsShepp(seed, 15.0), test::randomSmooth(seed, 15.0)})
                {
                    const TimedMotion motion = stopAndSteer(path, car, 0.0, 0.0);
                    const test::Verdict verdict = test::judge(sample(motion, car, 0.05), car, {});
                    EXPECT_EQ(verdict.fault, "") << seed;
                    EXPECT_TRUE(isSamePose(verdict.end, path.end(), 2e-3)) << seed;
                }
        }

        TEST(StopAndSteer, RefusesWhatNoCarCanDrive)
        {
            const Vehicle car;
            const auto drive = [&car](const Path &path)
            {
                return stopAndSteer(path, car, 0.0, 0.0);
            };
            EXPECT_THROW(drive({{}, {}}), Error);
            EXPECT_THROW(drive({{}, {{0.0, NOT_A_NUMBER}}}), Error);
            EXPECT_THROW(drive({{NOT_A_NUMBER, 0.0, 0.0}, {{0.0, 1.0}}}), Error);
            EXPECT_THROW(drive({{}, {{0.0, 1.0}, PathPiece::turnOnTheSpot(1.0)}}), Error);
            EXPECT_THROW(drive({{}, {{1.1 / car.minTurningRadius(), 1.0}}}), Error);
            for (double Vehicle::*limit : {&Vehicle::maxSpeed, &Vehicle::maxAcceleration, &Vehicle::maxSteeringRate})
                for (const double value : {0.0, -1.0, NOT_A_NUMBER})
                {
                    Vehicle broken;
                    broken.*limit = value;
                    EXPECT_THROW(stopAndSteer({{}, {{0.0, 1.0}}}, broken, 0.0, 0.0), Error);
                }
        }
    }  // namespace
}  // namespace parking

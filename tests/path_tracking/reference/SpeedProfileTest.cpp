#include "path_tracking/reference/SpeedProfile.h"

#include "parking_geometry/Error.h"
#include "tests/path_tracking/TestPaths.h"
#include "tests/path_tracking/reference/SpeedOptimum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace parking::test
{
    namespace
    {
        SpeedProfile profileOf(const Path &path)
        {
            return SpeedProfile(path, Vehicle());
        }

        TEST(SpeedProfile, AStraightLineTakesItsTime)
        {
            // Long enough to cruise: 2.5 s and 3.125 m each to speed up and to brake.
            EXPECT_NEAR(profileOf(arcs({}, {{0.0, 10.0}})).duration(), 5.0 + (10.0 - 6.25) / 2.5, 1e-9);
            EXPECT_NEAR(profileOf(arcs({}, {{0.0, 4.0}})).duration(), 4.0, 1e-9);
            EXPECT_NEAR(profileOf(arcs({}, {{0.0, -4.0}, {0.0, 1.0}})).duration(), 6.0, 1e-9);
        }

        TEST(SpeedProfile, StandsToSteer)
        {
            const double lock = Vehicle().maxSteeringAngle, rate = Vehicle().maxSteeringRate;
            const SpeedProfile profile = profileOf(arcs({}, {{1.0, 2.0}, {-1.0, 2.0}}));
            ASSERT_EQ(profile.reference().legs().size(), 2u);
            EXPECT_NEAR(profile.steeringTime(0), lock / rate, 1e-12);
            EXPECT_NEAR(profile.steeringTime(1), 2.0 * lock / rate, 1e-12);
            const SpeedProfile turned(ReferencePath(arcs({}, {{1.0, 2.0}}), Vehicle()), SpeedLimits(), lock, 0.0);
            EXPECT_NEAR(turned.steeringTime(0), 0.0, 1e-12);
            EXPECT_NEAR(turned.duration(), turned.legDuration(0) + lock / rate, 1e-12);
        }

        /** Every number and every difference within the limits, no jump, standstill at both ends. */
        void expectWithinLimits(const Trajectory &trajectory, const SpeedLimits &limits, const Vehicle &vehicle)
        {
            constexpr double EPS = 1e-6;
            ASSERT_GE(trajectory.size(), 2u);
            EXPECT_EQ(trajectory.front().t, 0.0);
            EXPECT_EQ(trajectory.front().v, 0.0);
            EXPECT_EQ(trajectory.back().v, 0.0);
            for (std::size_t i = 0; i < trajectory.size(); ++i)
            {
                const TrajectoryPoint &p = trajectory[i];
                EXPECT_LE(std::abs(p.v), limits.speed + EPS);
                EXPECT_LE(std::abs(p.acceleration), limits.acceleration + EPS);
                EXPECT_LE(std::abs(p.steering), vehicle.maxSteeringAngle + EPS);
                EXPECT_LE(std::abs(p.steeringRate), limits.steeringRate + EPS);
                EXPECT_LE(p.v * p.v * std::abs(vehicle.curvature(p.steering)), limits.lateralAcceleration + EPS);
                if (i == 0)
                    continue;
                const TrajectoryPoint &q = trajectory[i - 1];
                const double dt = p.t - q.t;
                ASSERT_GT(dt, 0.0);
                EXPECT_LE(std::abs(p.v - q.v), limits.acceleration * dt + EPS);
                EXPECT_LE(std::abs(p.steering - q.steering), limits.steeringRate * dt + EPS);
                EXPECT_LE(std::hypot(p.x - q.x, p.y - q.y), limits.speed * dt + EPS);
            }
        }

        TEST(SpeedProfile, ObeysTheLimitsEverywhere)
        {
            for (std::uint64_t seed = 0; seed < 25; ++seed)
                for (const Path &path :
                     {randomReedsShepp(seed, 30.0), randomLattice(seed, 30.0), randomSmooth(seed, 30.0)})
                {
                    const SpeedProfile profile = profileOf(path);
                    expectWithinLimits(profile.sample(0.01), SpeedLimits(), Vehicle());
                    SpeedLimits limits;
                    limits.speed = 1.3;
                    limits.acceleration = 0.4;
                    limits.steeringRate = 0.2;
                    limits.lateralAcceleration = 0.3;
                    const SpeedProfile slow(ReferencePath(path, Vehicle()), limits, 0.3, -0.3);
                    expectWithinLimits(slow.sample(0.05), limits, Vehicle());
                    EXPECT_GT(slow.duration(), profile.duration());
                }
        }

        TEST(SpeedProfile, DrivesWhereThePathGoes)
        {
            // Integrating speed and steering of the trajectory, without looking at its poses, ends at the goal.
            for (std::uint64_t seed = 0; seed < 10; ++seed)
                for (const Path &path : {randomReedsShepp(seed, 30.0), randomSmooth(seed, 30.0)})
                {
                    const Vehicle vehicle;
                    const Trajectory trajectory = profileOf(path).sample(0.002);
                    Pose car = path.start;
                    double worst = 0.0;
                    for (std::size_t i = 1; i < trajectory.size(); ++i)
                    {
                        const TrajectoryPoint &a = trajectory[i - 1], &b = trajectory[i];
                        car = advance(car, vehicle.curvature(0.5 * (a.steering + b.steering)),
                                      0.5 * (a.v + b.v) * (b.t - a.t));
                        worst = std::max(worst, std::hypot(b.x - car.x, b.y - car.y));
                    }
                    EXPECT_LE(worst, 0.02) << seed;
                }
        }

        TEST(SpeedProfile, TimeAndPlaceAreInverse)
        {
            const SpeedProfile profile = profileOf(randomSmooth(3, 20.0));
            for (std::size_t leg = 0; leg < profile.reference().legs().size(); ++leg)
            {
                double before = -1.0;
                for (double t = 0.0; t <= profile.legDuration(leg); t += 0.03)
                {
                    const double s = profile.at(leg, t).s;
                    EXPECT_GE(s, before);
                    before = s;
                    EXPECT_NEAR(profile.timeAt(leg, s), t, 1e-5);
                }
                EXPECT_NEAR(profile.at(leg, 1e9).s, profile.reference().legs()[leg].endLength, 1e-12);
                EXPECT_EQ(profile.at(leg, -1.0).speed, 0.0);
            }
        }

        TEST(SpeedProfile, IsNearTheOptimumOfDynamicProgramming)
        {
            const double most = 1.0 / Vehicle().minTurningRadius();
            const std::vector<std::vector<SmoothPart>> paths{
                {straight(1, 30.0)},
                {straight(1, 6.0), clothoidTurn(1, 0.9 * most, 2.0, 3.0), straight(1, 8.0),
                 clothoidTurn(1, -0.5 * most, 1.0, 5.0), straight(1, 5.0)},
                {clothoidTurn(-1, most, 3.0, 2.0), clothoidTurn(-1, -most, 3.0, 0.5), straight(-1, 10.0)},
                {clothoidTurn(1, 0.7 * most, 0.4, 2.0), straight(-1, 7.0), clothoidTurn(-1, -most, 1.5, 6.0),
                 straight(1, 3.0), clothoidTurn(1, 0.3 * most, 0.5, 3.0)},
            };
            for (const std::vector<SmoothPart> &parts : paths)
            {
                const Path path = smooth({}, parts);
                const double optimum = optimalDuration(path, Vehicle(), SpeedLimits());
                const double duration = profileOf(path).duration();
                EXPECT_LE(duration, 1.05 * optimum);
                EXPECT_GE(duration, 0.97 * optimum);
            }
        }

        TEST(SpeedProfile, RefusesLimitsThatLeadNowhere)
        {
            const ReferencePath reference(arcs({}, {{0.0, 2.0}}), Vehicle());
            for (double SpeedLimits::*field : {&SpeedLimits::speed, &SpeedLimits::acceleration,
                                               &SpeedLimits::steeringRate, &SpeedLimits::lateralAcceleration})
            {
                for (const double value : {0.0, -1.0, 0.0099, std::nan(""), std::numeric_limits<double>::infinity()})
                {
                    SpeedLimits limits;
                    limits.*field = value;
                    EXPECT_THROW(SpeedProfile(reference, limits), Error) << value;
                }
                SpeedLimits limits;
                limits.*field = 0.01;
                EXPECT_NO_THROW(SpeedProfile(reference, limits));
            }
            EXPECT_THROW(SpeedProfile(reference, SpeedLimits(), 0.76), Error);
            EXPECT_THROW(SpeedProfile(reference, SpeedLimits(), std::nan("")), Error);
            EXPECT_THROW(SpeedProfile(reference, SpeedLimits(), 0.0, -0.76), Error);
            const SpeedProfile profile(reference, SpeedLimits());
            EXPECT_THROW(profile.sample(0.0), Error);
            EXPECT_THROW(profile.sample(std::nan("")), Error);
            EXPECT_THROW(profile.sample(1e-9), Error);
        }
    }  // namespace
}  // namespace parking::test

#include "path_tracking/reference/ReferencePath.h"

#include "tests/path_tracking/TestPaths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace parking::test
{
    namespace
    {
        TEST(ReferencePath, PosesLieOnThePath)
        {
            std::vector<Path> paths{
                {{2.0, -1.0, 3.0}, {{0.2, 4.0}, {0.0, 2.0}, {-0.1, -3.0}, {-0.1, -2.0, 0.1}, {0.1, -1.5}}}};
            for (std::uint64_t seed = 0; seed < 10; ++seed)
                for (const Path &path : {randomReedsShepp(seed, 20.0), randomSmooth(seed, 20.0)})
                    paths.push_back(path);
            for (const Path &exact : paths)
            {
                const ReferencePath reference(exact, Vehicle());
                EXPECT_NEAR(reference.length(), exact.length(), 1e-9);
                double s = 0.0;
                Pose begin = exact.start;
                for (const PathPiece &piece : exact.pieces)
                {
                    for (double part = 0.05; part < 1.0; part += 0.1)
                    {
                        const double at = s + part * piece.driven();
                        std::size_t leg = 0;
                        while (reference.legs()[leg].endLength < at)
                            ++leg;
                        const Pose expected = advance(begin, piece, part * piece.driven());
                        const Pose offset = relativeTo(expected, reference.pose(leg, at));
                        EXPECT_NEAR(offset.x, 0.0, 1e-9);
                        EXPECT_NEAR(offset.y, 0.0, 1e-9);
                        EXPECT_NEAR(offset.yaw, 0.0, 1e-9);
                    }
                    s += piece.driven();
                    begin = advance(begin, piece);
                }
            }
        }

        TEST(ReferencePath, StopsAtCuspsAndLargeJumpsOnly)
        {
            // Straight, full lock left, full lock right, then a cusp with the wheels as they are.
            const ReferencePath reference(arcs({}, {{0.0, 2.0}, {1.0, 2.0}, {-1.0, 2.0}, {-1.0, -2.0}}), Vehicle());
            ASSERT_EQ(reference.legs().size(), 4u);
            EXPECT_EQ(reference.legs()[2].direction, 1);
            EXPECT_EQ(reference.legs()[3].direction, -1);
            const double lock = Vehicle().maxSteeringAngle;
            EXPECT_NEAR(reference.legs()[0].steering.back().angle, 0.0, 1e-12);
            EXPECT_NEAR(reference.legs()[1].steering.front().angle, lock, 1e-12);
            EXPECT_NEAR(reference.legs()[1].steering.back().angle, lock, 1e-12);
            EXPECT_NEAR(reference.legs()[2].steering.front().angle, -lock, 1e-12);
        }

        /** The steering profile of a path of two arcs, in motion: how far does the body leave the path? */
        double bodyDeviation(const ReferencePath &reference)
        {
            const Vehicle &vehicle = reference.vehicle();
            const double reach = vehicle.wheelbase + vehicle.frontOverhang;
            Pose car = reference.pose(0, 0.0);
            double worst = 0.0;
            constexpr double H = 0.0005;
            for (double s = 0.0; s < reference.length() - H; s += H)
            {
                car = advance(car, vehicle.curvature(reference.steering(0, s + 0.5 * H)), H);
                const Pose off = relativeTo(reference.pose(0, s + H), car);
                worst = std::max(worst, std::abs(off.y + reach * off.yaw));
            }
            return worst;
        }

        TEST(ReferencePath, SteersThroughSmallJumpsWithinTheBodyTolerance)
        {
            for (const double share : {0.02, 0.1, 0.3, 0.45})
                for (const double tolerance : {0.005, 0.01, 0.03})
                {
                    ReferenceParameters parameters;
                    parameters.bodyTolerance = tolerance;
                    parameters.minBlendSpeed = 1e-3;
                    const ReferencePath reference(arcs({}, {{0.0, 3.0}, {share, 3.0}}), Vehicle(), parameters);
                    ASSERT_EQ(reference.legs().size(), 1u);
                    EXPECT_LE(bodyDeviation(reference), 1.25 * tolerance) << share << " " << tolerance;
                    EXPECT_GT(reference.steering(0, 3.0), reference.steering(0, 2.999));
                }
        }

        TEST(ReferencePath, TheSpeedOfTheBlendDecidesWhetherToStop)
        {
            const Path path = arcs({}, {{0.0, 3.0}, {0.4, 3.0}});
            ReferenceParameters parameters;
            const ReferencePath moving(path, Vehicle(), parameters);
            ASSERT_EQ(moving.legs().size(), 1u);
            const double slope = (moving.steering(0, 3.001) - moving.steering(0, 2.999)) / 0.002;
            const double speed = Vehicle().maxSteeringRate / slope;
            parameters.minBlendSpeed = 0.999 * speed;
            EXPECT_EQ(ReferencePath(path, Vehicle(), parameters).legs().size(), 1u);
            parameters.minBlendSpeed = 1.001 * speed;
            EXPECT_EQ(ReferencePath(path, Vehicle(), parameters).legs().size(), 2u);
        }

        TEST(ReferencePath, SteersAlongClothoidsAsTheyBend)
        {
            const Path path = smooth({}, {clothoidTurn(1, 0.3, 2.0, 1.0), straight(1, 1.0)});
            const ReferencePath exact(path, Vehicle());
            ASSERT_EQ(exact.legs().size(), 1u);
            const auto curvature = [](double s)
            {
                return std::max(0.0, 0.3 * std::min({1.0, s / 2.0, (5.0 - s) / 2.0}));
            };
            for (double s = 0.0; s < path.length(); s += 0.01)
                EXPECT_NEAR(exact.steering(0, s), Vehicle().steeringAngle(curvature(s)), 1e-3) << s;
            EXPECT_LE(bodyDeviation(exact), 0.002);
            // Of a clothoid that comes in arcs the jumps are ramped.
            for (const double step : {0.02, 0.05, 0.1})
            {
                const ReferencePath sampled(inArcs(path, step), Vehicle());
                ASSERT_EQ(sampled.legs().size(), 1u);
                for (double s = 0.1; s < 4.9; s += 0.01)
                    EXPECT_NEAR(sampled.steering(0, s), Vehicle().steeringAngle(curvature(s)), 0.015) << s;
            }
        }

        TEST(ReferencePath, RampsJumpsBetweenClothoids)
        {
            // From a clothoid's end to another one's begin with a jump between: one ramp, as far as it may reach.
            const Path path{{}, {{0.0, 2.0, 0.05}, {0.12, 2.0, -0.05}}};
            const ReferencePath reference(path, Vehicle());
            ASSERT_EQ(reference.legs().size(), 1u);
            EXPECT_LE(bodyDeviation(reference), 0.015);
            double before = reference.steering(0, 0.0);
            for (double s = 0.01; s < 2.0; s += 0.01)
            {
                EXPECT_GE(reference.steering(0, s), before - 1e-12);
                before = reference.steering(0, s);
            }
        }

        TEST(ReferencePath, IgnoresStubs)
        {
            EXPECT_EQ(ReferencePath(arcs({}, {{1.0, 2.0}, {-1.0, 0.001}, {1.0, 2.0}}), Vehicle()).legs().size(), 1u);
            EXPECT_EQ(ReferencePath(arcs({}, {{1.0, 2.0}, {-1.0, 0.003}, {1.0, 2.0}}), Vehicle()).legs().size(), 3u);
            // A finely sampled clothoid is not made of stubs.
            const ReferencePath fine(inArcs(smooth({}, {clothoidTurn(1, 0.3, 2.0, 1.0)}), 0.001), Vehicle());
            EXPECT_NEAR(fine.steering(0, 1.0), Vehicle().steeringAngle(0.15), 0.003);
        }
    }  // namespace
}  // namespace parking::test

// The figures of a path against cases that can be computed by hand, and against a drive that stops at the same places.

#include "benchmarks/metrics/PathMetrics.h"

#include "path_tracking/trajectory/StopAndSteer.h"
#include "path_tracking/trajectory/TimedMotion.h"
#include "tests/parking_geometry/ExpectError.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{
    using namespace parking;

    const Vehicle CAR;  // 2.8 m wheelbase, 2.5 m/s, 1 m/s^2, 0.5 rad/s
    const double ANGLE = std::atan(2.8 * 0.2);

    Path pathOf(std::vector<PathPiece> pieces)
    {
        return {{1.0, 2.0, 0.3}, std::move(pieces)};
    }

    TEST(PathShape, OfALineAheadAndAQuarterCircleBack)
    {
        const double quarter = 0.5 * PI / 0.2;
        const PathShape shape = shapeOf(pathOf({{0.0, 10.0}, {0.2, -quarter}}));
        EXPECT_NEAR(shape.normalizedCurvature, 0.5 * PI, 1e-12);
        EXPECT_NEAR(shape.angleOverLength, 1.5 * PI / (10.0 + quarter), 1e-12);  // half a turn at the cusp
        EXPECT_DOUBLE_EQ(shape.maxCurvature, 0.2);
        EXPECT_NEAR(shape.reverseShare, quarter / (10.0 + quarter), 1e-12);
    }

    TEST(PathShape, SmoothnessIsOmpls)
    {
        EXPECT_NEAR(shapeOf(pathOf({{0.0, 10.0}})).smoothness, 0.0, 1e-9);
        // A hundred chords of a circle of 5 m: each turns by 0.02 rad over twice 10 sin(0.01) m.
        EXPECT_NEAR(shapeOf(pathOf({{0.2, 10.0}})).smoothness, 99.0 * std::pow(0.02 / (10.0 * std::sin(0.01)), 2.0),
                    1e-6);
        // Straight there and back: half a turn within 0.1 m.
        EXPECT_NEAR(shapeOf(pathOf({{0.0, 2.0}, {0.0, -2.0}})).smoothness, std::pow(PI / 0.1, 2.0), 1e-3);
    }

    TEST(PathShape, ClothoidsMayChangeTheSideOnTheWay)
    {
        // From 0.2 to the left to 0.1 to the right: two triangles.
        const PathShape shape = shapeOf(pathOf({{0.2, 6.0, -0.05}}));
        EXPECT_NEAR(shape.normalizedCurvature, 0.5 * 4.0 * 0.2 + 0.5 * 2.0 * 0.1, 1e-12);
        EXPECT_DOUBLE_EQ(shape.maxCurvature, 0.2);
    }

    TEST(PathShape, TurnsOnTheSpotCount)
    {
        const PathShape shape =
            shapeOf(pathOf({PathPiece::turnOnTheSpot(-1.0), {0.0, 4.0}, PathPiece::turnOnTheSpot(0.5)}));
        EXPECT_NEAR(shape.angleOverLength, 1.5 / 4.0, 1e-12);
        EXPECT_EQ(shape.maxCurvature, std::numeric_limits<double>::infinity());
        EXPECT_EQ(shapeOf(pathOf({})).angleOverLength, 0.0);
    }

    TEST(Clearance, IsThatOfEvenlySpacedPoses)
    {
        Path path{{0.0, 0.0, 0.0}, {{0.0, 1.0}, {0.0, 1.0}}};
        const auto x = [](const Pose &pose, double)
        {
            return pose.x;
        };
        EXPECT_NEAR(clearanceAlong(path, x).mean, 1.0, 1e-9);
        EXPECT_NEAR(clearanceAlong(path, x).median, 1.0, 1e-9);
        // Eight of ten metres are farther than the farthest.
        path.pieces = {{0.0, 10.0}};
        const auto far = [](const Pose &pose, double)
        {
            return pose.x < 2.0 - 1e-6 ? 1.0 : 50.0;
        };
        EXPECT_NEAR(clearanceAlong(path, far).mean, (20.0 * 1.0 + 81.0 * FARTHEST_CLEARANCE) / 101.0, 1e-9);
        EXPECT_EQ(clearanceAlong(path, far).median, FARTHEST_CLEARANCE);
    }

    TEST(Clearance, AsksNoMoreThanAThousandTimes)
    {
        std::size_t asked = 0;
        clearanceAlong({{0.0, 0.0, 0.0}, {{0.0, 5000.0}}},
                       [&asked](const Pose &, double)
                       {
                           ++asked;
                           return 1.0;
                       });
        EXPECT_EQ(asked, 1001U);
    }

    TEST(CuspToCusp, OfAStraightLine)
    {
        // 2.5 s to the full speed and 2.5 s from it, 3.125 m each; 3.75 m at 2.5 m/s between.
        const CuspToCusp longWay = cuspToCusp(pathOf({{0.0, 10.0}}), CAR);
        EXPECT_NEAR(longWay.cost.time, 6.5, 1e-12);
        EXPECT_NEAR(longWay.cost.controlEffort, 5.0, 1e-12);
        EXPECT_NEAR(longWay.cost.total(), 650.0 + 50.0, 1e-9);
        EXPECT_NEAR(longWay.meanJerk, 4.0 / 6.5, 1e-12);
        EXPECT_EQ(longWay.standingSteerings, 0U);
        // Too short for the full speed: 2 s each.
        const CuspToCusp shortWay = cuspToCusp(pathOf({{0.0, -4.0}}), CAR);
        EXPECT_NEAR(shortWay.cost.time, 4.0, 1e-12);
        EXPECT_NEAR(shortWay.cost.controlEffort, 4.0, 1e-12);
        EXPECT_NEAR(shortWay.meanJerk, 4.0 / 4.0, 1e-12);
    }

    TEST(CuspToCusp, CountsAndShowsApartWhatWheelsTurnAtStandstill)
    {
        const CuspToCusp profile = cuspToCusp(pathOf({{0.0, 4.0}, {0.2, -4.0}}), CAR);
        EXPECT_NEAR(profile.cost.time, 8.0, 1e-12);
        EXPECT_NEAR(profile.cost.controlEffort, 8.0, 1e-12);
        EXPECT_NEAR(profile.cost.steeringIntegral, ANGLE * ANGLE * 4.0, 1e-12);
        EXPECT_EQ(profile.cost.gearChanges, 1U);
        EXPECT_EQ(profile.standingSteerings, 1U);
        EXPECT_NEAR(profile.standingSteeringTime, ANGLE / 0.5, 1e-12);
        EXPECT_NEAR(profile.cost.total(), 800.0 + 80.0 + 40.0 * ANGLE * ANGLE + 5.0, 1e-9);
        EXPECT_NEAR(profile.meanJerk, 6.0 / 8.0, 1e-12);  // braking ahead is speeding up in reverse
    }

    TEST(CuspToCusp, DoesNotStopBetweenCusps)
    {
        const CuspToCusp profile = cuspToCusp(pathOf({{0.2, 5.0}, {-0.2, 5.0}}), CAR);
        EXPECT_NEAR(profile.cost.time, 6.5, 1e-12);
        EXPECT_EQ(profile.standingSteerings, 1U);
        EXPECT_NEAR(profile.standingSteeringTime, 2.0 * ANGLE / 0.5, 1e-12);
        EXPECT_NEAR(profile.cost.steeringIntegral, ANGLE * ANGLE * 6.5, 1e-12);
    }

    TEST(CuspToCusp, IsTheDriveOfAPathThatJumpsAtCuspsOnly)
    {
        const Path path = pathOf({{0.1, 7.0}, {-0.2, -3.0}, {0.2, 9.0}});
        const CuspToCusp profile = cuspToCusp(path, CAR);
        const TimedMotion drive = stopAndSteer(path, CAR, std::nullopt, std::nullopt);
        EXPECT_NEAR(profile.cost.time + profile.standingSteeringTime, drive.duration(), 1e-9);
        EXPECT_NEAR(profile.cost.controlEffort, tpcapCost(drive).controlEffort, 1e-9);
        EXPECT_EQ(profile.cost.gearChanges, tpcapCost(drive).gearChanges);
    }

    TEST(CuspToCusp, IntegratesAlongClothoids)
    {
        const double length = 10.0, sharpness = 0.02;
        const CuspToCusp profile = cuspToCusp(pathOf({{0.0, length, sharpness}}), CAR);
        // The same in small steps of time.
        double effort = 0.0, steering = 0.0, place = 0.0, before = 0.0;
        const double step = 1e-5;
        for (double t = 0.5 * step; t < 6.5; t += step)
        {
            const double v = std::min({t, 2.5, 6.5 - t}), a = t < 2.5 ? 1.0 : t > 4.0 ? -1.0 : 0.0;
            place += v * step;
            const double angle = std::atan(2.8 * sharpness * place), rate = (angle - before) / step;
            before = angle;
            effort += (a * a + std::pow(v * rate, 2.0)) * step;
            steering += angle * angle * step;
        }
        EXPECT_NEAR(profile.cost.controlEffort, effort, 1e-3 * effort);
        EXPECT_NEAR(profile.cost.steeringIntegral, steering, 1e-3 * steering);
        EXPECT_EQ(profile.standingSteerings, 0U);
    }

    TEST(CuspToCusp, RefusesWhatNoCarDrives)
    {
        using parking_test::expectError;
        expectError([] { cuspToCusp(pathOf({{0.0, 1.0}, PathPiece::turnOnTheSpot(0.5)}), CAR); }, {"on the spot"});
        expectError([] { cuspToCusp(pathOf({}), CAR); }, {"never drives"});
        expectError([] { cuspToCusp(pathOf({{std::nan(""), 1.0}}), CAR); }, {"finite"});
    }
}  // namespace

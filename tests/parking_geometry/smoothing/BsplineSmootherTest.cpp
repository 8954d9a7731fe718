#include "parking_geometry/smoothing/BsplineSmoother.h"

#include "parking_geometry/curves/Kinematics.h"
#include "tests/parking_geometry/ExpectError.h"
#include "tests/parking_geometry/PolygonWorld.h"
#include "tests/parking_geometry/manoeuvres/RandomParking.h"

#include <cmath>

#include <gtest/gtest.h>

using namespace parking;
using parking_test::expectError;
using parking_test::PolygonWorld;
using parking_test::RandomParking;

namespace
{
    using Points = std::vector<Eigen::Vector2d>;

    /** A walk on a grid of half metres with corners of 45 and 90 degrees, as a grid planner returns it. */
    Points gridWalk(RandomParking &random, int steps)
    {
        Points points{{0.0, 0.0}};
        int heading = 0;
        for (int i = 0; i < steps; ++i)
        {
            if (random.below(5) == 0)
                heading += random.coin() ? 1 : -1;
            heading = std::clamp(heading, -2, 2);
            const double angle = 0.25 * PI * heading, length = heading % 2 == 0 ? 0.5 : 0.5 * std::sqrt(2.0);
            points.push_back(points.back() + length * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
        }
        return points;
    }

    double distanceToPolyline(const Points &points, const Pose &pose)
    {
        double least = 1e9;
        const Eigen::Vector2d p(pose.x, pose.y);
        for (std::size_t i = 1; i < points.size(); ++i)
        {
            const Eigen::Vector2d d = points[i] - points[i - 1];
            const double t = std::clamp((p - points[i - 1]).dot(d) / d.squaredNorm(), 0.0, 1.0);
            least = std::min(least, (p - points[i - 1] - t * d).norm());
        }
        return least;
    }

    Path arcsThrough(const SampledPath &states)
    {
        Path path{states.front().pose, {}};
        for (std::size_t i = 1; i < states.size(); ++i)
            path.pieces.emplace_back(arcBetween(states[i - 1].pose, states[i].pose));
        return path;
    }

    Vehicle robot()
    {
        Vehicle car;
        car.wheelbase = 0.3;
        car.frontOverhang = car.rearOverhang = 0.1;
        car.width = 0.4;
        return car;
    }
}  // namespace

TEST(BsplineSmoother, IsTheCurveOfDeBoorWithClampedEnds)
{
    // Degree 3 through four control points is the Bezier curve of the paper's equation for n = 3.
    const Points points{{0.0, 0.0}, {1.0, 2.0}, {3.0, 2.0}, {4.0, 0.0}};
    const SampledPath path = bsplineSmooth(points, 3, 1);
    for (const PathState &state : path)
    {
        double nearest = 1e9;
        for (int i = 0; i <= 20000; ++i)
        {
            const double t = i / 20000.0, u = 1.0 - t;
            const Eigen::Vector2d p = u * u * u * points[0] + 3.0 * u * u * t * points[1] +
                                      3.0 * u * t * t * points[2] + t * t * t * points[3];
            nearest = std::min(nearest, std::hypot(p.x() - state.pose.x, p.y() - state.pose.y));
        }
        EXPECT_LT(nearest, 2e-4);
    }
    EXPECT_NEAR(path.front().pose.yaw, std::atan2(2.0, 1.0), 1e-9);
    EXPECT_NEAR(path.back().pose.yaw, std::atan2(-2.0, 1.0), 1e-9);
}

TEST(BsplineSmoother, HeadingAndCurvatureAreThoseOfTheCurve)
{
    RandomParking random(51);
    for (int i = 0; i < 100; ++i)
        for (const int degree : {3, 4, 5})
            for (const std::size_t sampling : {1u, 3u, 6u})
            {
                const Points points = gridWalk(random, 60);
                BsplineOptions options;
                options.degree = degree;
                options.sampling = sampling;
                options.step = 0.02;
                const SampledPath path = bsplineSmooth(points, options, Vehicle(), {}).path;
                ASSERT_LT(
                    std::hypot(path.front().pose.x - points.front().x(), path.front().pose.y - points.front().y()),
                    1e-12);
                ASSERT_LT(std::hypot(path.back().pose.x - points.back().x(), path.back().pose.y - points.back().y()),
                          1e-12);
                for (std::size_t k = 1; k < path.size(); ++k)
                {
                    const Arc arc = arcBetween(path[k - 1].pose, path[k].pose);
                    ASSERT_LE(std::abs(arc.length), options.step * (1.0 + 1e-3));
                    ASSERT_NEAR(path[k].arcLength - path[k - 1].arcLength, arc.length, 1e-12);
                    ASSERT_EQ(path[k].direction, 1);
                    // The arc between two states has the mean of their curvatures, and the curvature does not jump.
                    const double scale = 1.0 + std::abs(arc.curvature);
                    ASSERT_NEAR(arc.curvature, 0.5 * (path[k].curvature + path[k - 1].curvature), 0.05 * scale);
                    ASSERT_LT(std::abs(path[k].curvature - path[k - 1].curvature), 0.6 * scale);
                }
            }
}

TEST(BsplineSmoother, SmoothsCornersAndStaysNearThePolyline)
{
    RandomParking random(52);
    for (int i = 0; i < 200; ++i)
    {
        const Points points = gridWalk(random, 60);
        const SampledPath path = bsplineSmooth(points, 3, 3);
        // The curve lies in the hulls of four control points, which are at most 9 steps apart.
        for (const PathState &state : path)
            ASSERT_LT(distanceToPolyline(points, state.pose), 1.6);
        double length = 0.0;
        for (std::size_t k = 1; k < points.size(); ++k)
            length += (points[k] - points[k - 1]).norm();
        EXPECT_LE(pathLength(path), length + 1e-6);
        EXPECT_GT(pathLength(path), 0.7 * length);
    }
}

TEST(BsplineSmoother, CollidingSpansComeCloserAndOthersStay)
{
    RandomParking random(53);
    const Vehicle car = robot();
    std::size_t denser = 0, kept = 0;
    for (int i = 0; i < 200; ++i)
    {
        const Points points = gridWalk(random, 60);
        // Posts beside the polyline, where corners would be cut; the polyline itself is free at both headings.
        std::vector<Polygon> obstacles;
        for (int k = 0; k < 12; ++k)
        {
            const Eigen::Vector2d spot = points[static_cast<std::size_t>(random.below(60))] +
                                         Eigen::Vector2d(random.uniform(-0.8, 0.8), random.uniform(-0.8, 0.8));
            if (distanceToPolyline(points, {spot.x(), spot.y(), 0.0}) < 0.52)
                continue;
            const double r = 0.05;
            obstacles.push_back({{spot.x() - r, spot.y() - r},
                                 {spot.x() + r, spot.y() - r},
                                 {spot.x() + r, spot.y() + r},
                                 {spot.x() - r, spot.y() + r}});
        }
        const PolygonWorld world(car, obstacles);
        BsplineOptions options;
        options.sampling = 5;
        const BsplinePath result = bsplineSmooth(points, options, car, world.queries());
        const BsplinePath plain = bsplineSmooth(points, options, car, {});
        EXPECT_EQ(plain.denserPieces + plain.polylinePieces, 0u);
        if (isPathFree(world.queries(), car, arcsThrough(plain.path)))
        {
            EXPECT_EQ(result.denserPieces + result.polylinePieces, 0u);
            EXPECT_EQ(result.path.size(), plain.path.size());
        }
        else
        {
            EXPECT_GT(result.denserPieces + result.polylinePieces, 0u);
        }
        denser += result.denserPieces;
        kept += result.polylinePieces;
        for (const PathState &state : result.path)
            ASSERT_TRUE(world.isFree(state.pose)) << i;
    }
    EXPECT_GT(denser, 100u);
}

TEST(BsplineSmoother, FollowsThePolylineWhereNothingElseIsFree)
{
    Points points;
    for (int i = 0; i <= 10; ++i)
        points.emplace_back(0.5 * i, 0.0);
    for (int i = 1; i <= 10; ++i)
        points.emplace_back(5.0, 0.5 * i);
    FootprintQueries onThePolyline;
    onThePolyline.isFree = [&](const Pose &pose)
    {
        return distanceToPolyline(points, pose) < 1e-6;
    };
    const BsplinePath result = bsplineSmooth(points, {}, robot(), onThePolyline);
    EXPECT_GT(result.polylinePieces, 0u);
    for (const PathState &state : result.path)
    {
        EXPECT_LT(distanceToPolyline(points, state.pose), 1e-6);
        EXPECT_NEAR(std::abs(std::sin(2.0 * state.pose.yaw)), 0.0, 1e-6) << "along one edge or the other";
    }
    EXPECT_NEAR(pathLength(result.path), 10.0, 1e-6);
}

TEST(BsplineSmoother, KeepsTheCurvatureLimitWhereItCan)
{
    Points points;
    for (int i = 0; i <= 20; ++i)
        points.emplace_back(0.5 * i, 0.0);
    for (int i = 1; i <= 20; ++i)
        points.emplace_back(10.0 + 0.5 * i * std::cos(0.6), 0.5 * i * std::sin(0.6));
    BsplineOptions options;
    options.sampling = 8;
    const double plain = [&]
    {
        double most = 0.0;
        for (const PathState &state : bsplineSmooth(points, options, robot(), {}).path)
            most = std::max(most, std::abs(state.curvature));
        return most;
    }();
    options.maxCurvature = 1.01 * plain;
    EXPECT_EQ(bsplineSmooth(points, options, robot(), {}).polylinePieces, 0u);
    options.maxCurvature = 0.9 * plain;
    const BsplinePath limited = bsplineSmooth(points, options, robot(), {});
    EXPECT_GT(limited.denserPieces + limited.polylinePieces, 0u) << "a denser spline is sharper: the corner is kept";
    for (const PathState &state : limited.path)
        EXPECT_LE(std::abs(state.curvature), options.maxCurvature);
}

TEST(BsplineSmoother, ShortAndDegeneratePolylines)
{
    const SampledPath line = bsplineSmooth({{0.0, 0.0}, {1.0, 1.0}}, 3, 4);
    EXPECT_NEAR(pathLength(line), std::sqrt(2.0), 1e-9);
    for (const PathState &state : line)
        EXPECT_NEAR(state.pose.yaw, 0.25 * PI, 1e-9);
    EXPECT_NEAR(pathLength(bsplineSmooth({{0.0, 0.0}, {0.0, 0.0}, {1.0, 0.0}, {1.0, 0.0}}, 3, 1)), 1.0, 1e-9);
    EXPECT_GT(bsplineSmooth({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}}, 5, 1).size(), 2u) << "degree reduced to 2";
    expectError([] { bsplineSmooth({}, 3, 1); }, {"B-spline", "0 distinct points", "at least 2"});
    expectError([] { bsplineSmooth({{1.0, 1.0}, {1.0, 1.0}}, 3, 1); }, {"B-spline", "1 distinct points"});
    expectError([] { bsplineSmooth({{1.0, 1.0}, {std::nan(""), 1.0}}, 3, 1); }, {"B-spline", "point 1", "finite"});
    expectError([] { bsplineSmooth({{0.0, 0.0}, {1.0, 0.0}}, 1, 1); }, {"B-spline", "degree is 1"});
    expectError([] { bsplineSmooth({{0.0, 0.0}, {1.0, 0.0}}, 6, 1); }, {"B-spline", "degree is 6"});
    expectError([] { bsplineSmooth({{0.0, 0.0}, {1.0, 0.0}}, 3, 0); }, {"B-spline", "sampling is 0"});
    BsplineOptions options;
    options.step = 0.0;
    expectError([&] { bsplineSmooth({{0.0, 0.0}, {1.0, 0.0}}, options, Vehicle(), {}); }, {"B-spline", "step"});
    options.step = 0.1;
    options.maxCurvature = -1.0;
    expectError([&] { bsplineSmooth({{0.0, 0.0}, {1.0, 0.0}}, options, Vehicle(), {}); }, {"B-spline", "curvature"});
}

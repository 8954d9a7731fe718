#include "parking_geometry/smoothing/BsplineSmoother.h"

#include "benchmarks/worlds/RandomParking.h"
#include "tests/parking_geometry/ExpectError.h"
#include "tests/parking_geometry/PolygonWorld.h"

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
                heading += random.chance(0.5) ? 1 : -1;
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
    BsplineOptions options;
    options.sampling = 1;
    const Path path = bsplineSmooth(points, options).path;
    for (const PathState &state : path.sample(0.05))
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
    EXPECT_NEAR(path.start.yaw, std::atan2(2.0, 1.0), 1e-9);
    EXPECT_NEAR(path.end().yaw, std::atan2(-2.0, 1.0), 1e-9);
}

TEST(BsplineSmoother, TheCurvatureIsThatOfTheCurveAndHardlyJumps)
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
                const Path path = bsplineSmooth(points, options).path;
                const Pose end = path.end();
                ASSERT_LT(std::hypot(path.start.x - points.front().x(), path.start.y - points.front().y()), 1e-12);
                ASSERT_LT(std::hypot(end.x - points.back().x(), end.y - points.back().y()), 1e-8);
                for (std::size_t k = 0; k < path.pieces.size(); ++k)
                {
                    const PathPiece &piece = path.pieces[k];
                    ASSERT_EQ(piece.direction(), 1);
                    ASSERT_EQ(piece.sharpness, 0.0);
                    if (k == 0)
                        continue;
                    const double jump = std::abs(piece.curvature - path.pieces[k - 1].curvature);
                    ASSERT_LT(jump, 0.6 * (1.0 + std::abs(piece.curvature)));
                }
            }
}

TEST(BsplineSmoother, CollidingSpansComeCloserAndOthersStay)
{
    RandomParking random(53);
    const Vehicle car = robot();
    std::size_t denser = 0;
    for (int i = 0; i < 200; ++i)
    {
        const Points points = gridWalk(random, 60);
        // Posts beside the polyline, where corners would be cut; the polyline itself is free at both headings.
        std::vector<Polygon> obstacles;
        for (int k = 0; k < 12; ++k)
        {
            const Eigen::Vector2d spot = points[static_cast<std::size_t>(random.below(60))] +
                                         Eigen::Vector2d(random.between(-0.8, 0.8), random.between(-0.8, 0.8));
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
        const BsplineResult result = bsplineSmooth(points, options, car, world.queries());
        const BsplineResult plain = bsplineSmooth(points, options);
        EXPECT_EQ(plain.denserSpans + plain.polylineSpans, 0u);
        if (isPathFree(world.queries(), car, plain.path))
        {
            EXPECT_EQ(result.denserSpans + result.polylineSpans, 0u);
            EXPECT_EQ(result.path.pieces.size(), plain.path.pieces.size());
        }
        else
        {
            EXPECT_GT(result.denserSpans + result.polylineSpans, 0u);
        }
        denser += result.denserSpans;
        for (const PathState &state : result.path.sample(0.1))
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
    const BsplineResult result = bsplineSmooth(points, {}, robot(), onThePolyline);
    EXPECT_GT(result.polylineSpans, 0u);
    for (const PathState &state : result.path.sample(0.1))
    {
        EXPECT_LT(distanceToPolyline(points, state.pose), 1e-6);
        EXPECT_NEAR(std::abs(std::sin(2.0 * state.pose.yaw)), 0.0, 1e-6) << "along one edge or the other";
    }
    EXPECT_NEAR(result.path.length(), 10.0, 1e-6);
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
        for (const PathPiece &piece : bsplineSmooth(points, options).path.pieces)
            most = std::max(most, std::abs(piece.curvature));
        return most;
    }();
    options.maxCurvature = 1.01 * plain;
    EXPECT_EQ(bsplineSmooth(points, options).polylineSpans, 0u);
    options.maxCurvature = 0.9 * plain;
    const BsplineResult limited = bsplineSmooth(points, options);
    EXPECT_GT(limited.denserSpans + limited.polylineSpans, 0u) << "a denser spline is sharper: the corner is kept";
    for (const PathPiece &piece : limited.path.pieces)
        EXPECT_LE(std::abs(piece.curvature), options.maxCurvature);
}

TEST(BsplineSmoother, ShortAndDegeneratePolylines)
{
    BsplineOptions options;
    options.sampling = 4;
    const Path line = bsplineSmooth({{0.0, 0.0}, {1.0, 1.0}}, options).path;
    EXPECT_NEAR(line.length(), std::sqrt(2.0), 1e-9);
    for (const PathState &state : line.sample(0.1))
        EXPECT_NEAR(state.pose.yaw, 0.25 * PI, 1e-9);
    options.sampling = 1;
    EXPECT_NEAR(bsplineSmooth({{0.0, 0.0}, {0.0, 0.0}, {1.0, 0.0}, {1.0, 0.0}}, options).path.length(), 1.0, 1e-9);
    options.degree = 5;
    const Path bend = bsplineSmooth({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}}, options).path;
    EXPECT_GT(bend.pieces.size(), 2u) << "degree reduced to 2";
    EXPECT_NEAR(bend.end().yaw, 0.5 * PI, 1e-9);
    expectError([] { bsplineSmooth({}); }, {"B-spline", "0 distinct points", "at least 2"});
    expectError([] { bsplineSmooth({{1.0, 1.0}, {1.0, 1.0}}); }, {"B-spline", "1 distinct points"});
    expectError([] { bsplineSmooth({{1.0, 1.0}, {std::nan(""), 1.0}}); }, {"B-spline", "point 1", "finite"});
    const auto refused = [](const BsplineOptions &bad, const char *what)
    {
        expectError([&] { bsplineSmooth({{0.0, 0.0}, {1.0, 0.0}}, bad); }, {"B-spline", what});
    };
    BsplineOptions bad;
    bad.degree = 1;
    refused(bad, "degree is 1");
    bad.degree = 6;
    refused(bad, "degree is 6");
    bad = {};
    bad.sampling = 0;
    refused(bad, "sampling is 0");
    bad = {};
    bad.step = 0.0;
    refused(bad, "step");
    bad = {};
    bad.maxCurvature = -1.0;
    refused(bad, "curvature");
}

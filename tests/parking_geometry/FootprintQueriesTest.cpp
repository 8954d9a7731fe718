#include "parking_geometry/FootprintQueries.h"

#include "benchmarks/worlds/RandomParking.h"
#include "tests/parking_geometry/PolygonWorld.h"

#include <cmath>

#include <gtest/gtest.h>

using namespace parking;
using parking_test::PolygonWorld;
using parking_test::RandomParking;

TEST(FootprintQueries, ThePathCallableDecidesAlone)
{
    FootprintQueries queries;
    queries.isFree = [](const Pose &)
    {
        return false;
    };
    queries.clearance = [](const Pose &)
    {
        return 0.0;
    };
    queries.isPathFree = [](const Path &)
    {
        return true;
    };
    EXPECT_TRUE(isPathFree(queries, Vehicle(), Path{{}, {{0.1, 5.0}}}));
    queries.isPathFree = [](const Path &)
    {
        return false;
    };
    queries.isFree = [](const Pose &)
    {
        return true;
    };
    EXPECT_FALSE(isPathFree(queries, Vehicle(), Path{{}, {{0.1, 5.0}}}));
}

TEST(FootprintQueries, ClearanceFindsWhatLiesBetweenThePoses)
{
    // Pins of 2 cm that the outer front corner hits on the way, on arcs, clothoids and turns on the spot.
    const Vehicle car;
    const double curvature = 1.0 / car.minTurningRadius();
    for (const PathPiece &piece : {PathPiece(curvature, 2.0), PathPiece(curvature, -2.0),
                                   PathPiece(0.0, 2.0, 0.5 * curvature), PathPiece::turnOnTheSpot(0.5)})
        for (const double share : {0.3, 0.5, 0.77})
        {
            const Path path{{1.0, 2.0, 0.3}, {piece}};
            PathPiece part = piece;
            part.turn *= share;
            const Pose there = advance(path.start, part, share * piece.driven());
            const Eigen::Vector2d corner = car.footprint(there)[1];
            const PolygonWorld world(car, {parking_test::square(corner.x(), corner.y(), 0.01)});
            ASSERT_TRUE(world.isFree(path.start) && world.isFree(path.end()) && !world.isFree(there));
            EXPECT_FALSE(isPathFree(world.queries(), car, path));
        }
}

TEST(FootprintQueries, CoversTheMotionAndNotHalfOfIt)
{
    // Pins that the outer front corner hits half way along arcs of several lengths: the clearances at both ends add up
    // to more than half of the motion for some, never to all of it.
    const Vehicle car;
    const double curvature = 1.0 / car.minTurningRadius();
    int beyondHalf = 0;
    for (double length = 0.2; length < 3.0; length += 0.1)
    {
        const Path path{{}, {{curvature, length}}};
        const Eigen::Vector2d corner = car.footprint(advance(path.start, curvature, 0.5 * length))[1];
        const PolygonWorld world(car, {parking_test::square(corner.x(), corner.y(), 0.004)});
        const double covered = world.clearance(path.start) + world.clearance(path.end());
        const double moved =
            length * (1.0 + curvature * std::hypot(car.wheelbase + car.frontOverhang, 0.5 * car.width));
        if (covered == 0.0)
            continue;
        EXPECT_LT(covered, moved);
        beyondHalf += covered > 0.5 * moved;
        EXPECT_FALSE(isPathFree(world.queries(), car, path)) << length;
    }
    EXPECT_GT(beyondHalf, 0);
}

TEST(FootprintQueries, AgreesWithDenseSampling)
{
    RandomParking random(7);
    int free = 0, blocked = 0;
    for (int i = 0; i < 400; ++i)
    {
        const Vehicle car = random.vehicle();
        const Path path = random.plannerPath(car, 1.0);
        const SampledPath dense = path.sample(0.002);
        std::vector<Polygon> obstacles;
        for (int k = 0; k < 2; ++k)
        {
            const Pose near = dense[static_cast<std::size_t>(random.below(static_cast<int>(dense.size())))].pose;
            const Pose spot = compose(
                near, {random.between(-2.0, 5.0), (random.chance(0.5) ? 1.0 : -1.0) * random.between(1.0, 3.0), 0.0});
            obstacles.push_back(parking_test::square(spot.x, spot.y, random.between(0.01, 0.3)));
        }
        const PolygonWorld world(car, obstacles);
        // Deeper than what a motion of 5 mm between two free poses may graze.
        const PolygonWorld lenient(car, obstacles, 2e-3);
        bool collides = false;
        double least = 1e9;
        for (const PathState &state : dense)
        {
            collides = collides || !lenient.isFree(state.pose);
            least = std::min(least, world.clearance(state.pose));
        }
        const bool found = isPathFree(world.queries(), car, path);
        if (collides)
        {
            EXPECT_FALSE(found) << i;
        }
        else if (least > 5e-3)
        {
            EXPECT_TRUE(found) << i << " although the distance is never below " << least;
        }
        ++(found ? free : blocked);
    }
    EXPECT_GT(free, 60);
    EXPECT_GT(blocked, 60);
}

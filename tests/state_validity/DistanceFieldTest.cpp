#include "state_validity/DistanceField.h"

#include "benchmarks/worlds/RandomWorlds.h"
#include "parking_geometry/Error.h"
#include "tests/state_validity/DistanceByDefinition.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

using namespace parking;
using namespace parking_test;

namespace
{
    void expectBounds(const ObstacleSet &obstacles, const DistanceField &field, std::uint64_t seed)
    {
        Random random(seed);
        const Eigen::Vector2d low = obstacles.bounds().min, high = obstacles.bounds().max;
        for (int i = 0; i < 5000; ++i)
        {
            const Eigen::Vector2d point(random.between(low.x() - 1.0, high.x() + 1.0),
                                        random.between(low.y() - 1.0, high.y() + 1.0));
            const double distance = signedDistance(obstacles, point);
            ASSERT_LE(field.lowerBound(point.x(), point.y()), std::max(0.0, distance) + 1e-12) << point.transpose();
            ASSERT_GE(field.upperBound(point.x(), point.y()), std::max(0.0, distance) - 1e-12) << point.transpose();
            ASSERT_GE(field.closeUpperBound(point.x(), point.y()), std::max(0.0, distance) - 1e-12)
                << point.transpose();
            ASSERT_FALSE(field.isInside(point.x(), point.y()) && distance > 1e-12) << point.transpose();
            ASSERT_FALSE(field.isOutside(point.x(), point.y()) && distance <= 0.0) << point.transpose();
        }
    }
}  // namespace

/** The definition: distances between the centres of cells, each against each and against the ring round the map. */
TEST(DistanceField, IsTheExactDistanceBetweenCentresOfCells)
{
    Random random(1);
    for (int i = 0; i < 40; ++i)
    {
        const double density = std::exp(random.between(std::log(0.002), std::log(0.7)));
        OccupancyGrid map(1 + random.index(40), 1 + random.index(40), random.between(0.05, 1.0));
        for (std::size_t row = 0; row < map.height(); ++row)
            for (std::size_t column = 0; column < map.width(); ++column)
                map.set(column, row, random.chance(density) ? Cell::Occupied : Cell::Free);
        const DistanceField field(ObstacleSet::fromGrid(map));
        const auto isBlocked = [&](int x, int y)
        {
            const int width = static_cast<int>(map.width()), height = static_cast<int>(map.height());
            return x < 0 || y < 0 || x >= width || y >= height ||
                   map.at(static_cast<std::size_t>(x), static_cast<std::size_t>(y)) == Cell::Occupied;
        };
        for (int y = 0; y < static_cast<int>(map.height()); ++y)
            for (int x = 0; x < static_cast<int>(map.width()); ++x)
            {
                double nearest = HUGE_VAL;
                for (int v = -1; v <= static_cast<int>(map.height()); ++v)
                    for (int u = -1; u <= static_cast<int>(map.width()); ++u)
                        if (isBlocked(u, v))
                            nearest = std::min(nearest, std::hypot(x - u, y - v));
                const double expected = map.resolution() * nearest;
                const double atX = (x + 0.5) * map.resolution(), atY = (y + 0.5) * map.resolution();
                ASSERT_EQ(field.isInside(atX, atY), isBlocked(x, y));
                if (nearest > 0.0)
                {
                    ASSERT_NEAR(field.upperBound(atX, atY) - field.errorBound(), expected, 2e-7 * expected);
                }
            }
    }
}

TEST(DistanceField, BoundsHoldInGridWorlds)
{
    for (std::uint64_t seed = 0; seed < 12; ++seed)
    {
        const World world = randomGridWorld(seed);
        expectBounds(world.obstacles, DistanceField(world.obstacles), seed);
    }
}

TEST(DistanceField, BoundsHoldInPolygonWorldsAtEveryResolution)
{
    for (std::uint64_t seed = 0; seed < 12; ++seed)
    {
        const World world = randomPolygonWorld(seed);
        for (const double resolution : {0.0, 0.037, 0.3, 2.0})
            expectBounds(world.obstacles, DistanceField(world.obstacles, resolution), seed);
    }
}

/** The lower bound is reached: cells diagonal to each other, corner to corner. A bound any smaller would be wrong. */
TEST(DistanceField, LowerBoundIsTight)
{
    const double side = 0.25;
    OccupancyGrid grid(64, 64, side);
    grid.set(40, 40, Cell::Occupied);
    const DistanceField field(ObstacleSet::fromGrid(grid));
    for (std::size_t steps = 2; steps < 14; ++steps)
    {
        // The upper right corner of a cell on the diagonal; the blocked cell's lower left corner is at 40 sides.
        const double at = side * static_cast<double>(40 - steps + 1) - 1e-9;
        const double distance = std::sqrt(2.0) * (40.0 * side - at);
        EXPECT_LE(field.lowerBound(at, at), distance);
        EXPECT_GT(field.lowerBound(at, at), distance - 1e-4 * field.errorBound() - 1e-6);
    }
}

/** So is the upper bound: a post in the far corner of its cell, seen from the far corner of a cell. */
TEST(DistanceField, UpperBoundIsTight)
{
    const double side = 0.25;
    const Box bounds{{0.0, 0.0}, {16.0, 16.0}};
    const double far = 40.0 * side + side - 2e-6;
    const Polygon post{{far - 1e-6, far - 1e-6}, {far + 1e-6, far - 1e-6}, {far + 1e-6, far + 1e-6}};
    const ObstacleSet obstacles = ObstacleSet::fromPolygons({post}, bounds);
    const DistanceField field(obstacles, side);
    for (std::size_t steps = 2; steps < 12; ++steps)
    {
        const double at = side * static_cast<double>(40 - steps) + 1e-9;
        const Pose local = obstacles.toLocal({at, at, 0.0});
        const double distance = signedDistance(obstacles, {local.x, local.y});
        EXPECT_GE(field.upperBound(local.x, local.y), distance);
        EXPECT_LT(field.upperBound(local.x, local.y), distance + 1e-4 * field.errorBound() + 1e-5);
    }
}

/** In a grid world, also beside corners, at the ends of the map and wherever cells meet. */
TEST(DistanceField, CloseUpperBoundOfAGridWorldHoldsAtItsTightest)
{
    Random random(23);
    for (int world = 0; world < 40; ++world)
    {
        OccupancyGrid map(8 + random.index(10), 8 + random.index(10), 0.5 + random.between(0.0, 1.0));
        for (std::size_t i = 0; i < 1 + random.index(12); ++i)
            map.set(random.index(map.width()), random.index(map.height()), Cell::Occupied);
        const ObstacleSet obstacles = ObstacleSet::fromGrid(map);
        const DistanceField field(obstacles);
        const double side = obstacles.cellSize();
        for (std::size_t row = 0; row < map.height(); ++row)
            for (std::size_t column = 0; column < map.width(); ++column)
                for (const double dx : {1e-9, 0.25, 0.5, 0.75, 1.0 - 1e-9})
                    for (const double dy : {1e-9, 0.5, 1.0 - 1e-9})
                    {
                        const Eigen::Vector2d at((static_cast<double>(column) + dx) * side,
                                                 (static_cast<double>(row) + dy) * side);
                        const double distance = std::max(0.0, signedDistance(obstacles, at));
                        const double upper = field.closeUpperBound(at.x(), at.y());
                        ASSERT_GE(upper, distance - 1e-12) << at.transpose();
                        ASSERT_GE(field.upperBound(at.x(), at.y()), upper) << at.transpose();
                        // A corner is farther than the circle inside of its cell.
                        ASSERT_LE(upper, distance + (2.0 * std::hypot(dx - 0.5, dy - 0.5) + 0.2072) * side)
                            << at.transpose();
                    }
    }
}

TEST(DistanceField, ThinObstaclesBlockEveryCellThatTheyTouch)
{
    // A wall of 0.1 mm that runs askew through cells of half a metre, and a post of a millimetre.
    const Box bounds{{-10.0, -10.0}, {10.0, 10.0}};
    const Polygon wall = rectangle(12.0, 1e-4, {0.3, -0.2, 0.7});
    const Polygon post = rectangle(1e-3, 1e-3, {-7.123, 6.456, 0.2});
    const ObstacleSet obstacles = ObstacleSet::fromPolygons({wall, post}, bounds);
    const DistanceField field(obstacles, 0.5);
    for (double t = 0.0; t <= 1.0; t += 1e-3)
    {
        const Eigen::Vector2d at = wall[0] + t * (wall[1] - wall[0]);
        EXPECT_FALSE(field.isOutside(at.x(), at.y())) << t;
        EXPECT_EQ(field.lowerBound(at.x(), at.y()), 0.0);
    }
    EXPECT_FALSE(field.isOutside(-7.123, 6.456));
}

TEST(DistanceField, EverythingOutsideOfTheBoundsIsAnObstacle)
{
    const DistanceField field(ObstacleSet::fromGrid(OccupancyGrid(10, 10, 0.5)));
    for (const double beyond : {5.0 + 1e-9, 5.4, 7.0, 1e9, std::numeric_limits<double>::infinity()})
    {
        EXPECT_TRUE(field.isInside(beyond, 1.0));
        EXPECT_TRUE(field.isInside(1.0, beyond));
        EXPECT_EQ(field.lowerBound(-beyond + 5.0, 1.0), 0.0);
        EXPECT_EQ(field.upperBound(beyond, 1.0), 0.0);
    }
    EXPECT_FALSE(field.isInside(5.0 - 1e-9, 1.0));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(field.lowerBound(nan, 1.0), 0.0);
    EXPECT_EQ(field.lowerBound(1.0, nan), 0.0);
}

TEST(DistanceField, ChoosesTenCentimetresUpToAHectareAndAMillionCellsBeyond)
{
    const auto chosen = [](double side)
    {
        return DistanceField(ObstacleSet::fromPolygons({}, {{0.0, 0.0}, {side, side}})).resolution();
    };
    EXPECT_DOUBLE_EQ(chosen(20.0), 0.1);
    EXPECT_DOUBLE_EQ(chosen(100.0), 0.1);
    EXPECT_DOUBLE_EQ(chosen(200.0), 0.2);
}

TEST(DistanceField, RefusesBadInput)
{
    const ObstacleSet empty = ObstacleSet::fromPolygons({}, {{0.0, 0.0}, {100.0, 100.0}});
    for (const double resolution : {-0.1, HUGE_VAL, std::nan(""), 1e-3})  // the last one takes 1e10 cells
        EXPECT_THROW(DistanceField(empty, resolution), Error) << resolution;
}

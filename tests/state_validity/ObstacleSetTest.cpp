#include "state_validity/ObstacleSet.h"

#include "benchmarks/worlds/RandomWorlds.h"
#include "parking_geometry/Error.h"

#include <limits>

#include <gtest/gtest.h>

using namespace parking;
using namespace parking_test;

namespace
{
    const double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();
    const Box BOX{{-20.0, -20.0}, {20.0, 20.0}};
}  // namespace

TEST(ObstacleSet, RectanglesCoverTheOccupiedCellsOnceAndNothingElse)
{
    for (std::uint64_t seed = 0; seed < 10; ++seed)
    {
        const ObstacleSet obstacles = randomGridWorld(seed).obstacles;
        std::vector<int> covered(obstacles.cells().size(), 0);
        for (const Box &rectangle : obstacles.rectangles())
            for (std::size_t row = 0; row < obstacles.rows(); ++row)
                for (std::size_t column = 0; column < obstacles.columns(); ++column)
                {
                    const double x = (static_cast<double>(column) + 0.5) * obstacles.cellSize();
                    const double y = (static_cast<double>(row) + 0.5) * obstacles.cellSize();
                    covered[row * obstacles.columns() + column] += x > rectangle.min.x() && x < rectangle.max.x() &&
                                                                   y > rectangle.min.y() && y < rectangle.max.y();
                }
        for (std::size_t i = 0; i < covered.size(); ++i)
            ASSERT_EQ(covered[i], obstacles.cells()[i] ? 1 : 0) << "cell " << i << " of world " << seed;
    }
}

TEST(ObstacleSet, EdgesOfAGridAreTheLinesBetweenOccupiedAndFreeCells)
{
    for (std::uint64_t seed = 0; seed < 10; ++seed)
    {
        const ObstacleSet obstacles = randomGridWorld(seed).obstacles;
        const auto at = [&](std::size_t column, std::size_t row)
        {
            return obstacles.cells()[row * obstacles.columns() + column] != 0;
        };
        double between = 0.0;
        for (std::size_t row = 0; row < obstacles.rows(); ++row)
            for (std::size_t column = 0; column < obstacles.columns(); ++column)
            {
                between += column > 0 && at(column, row) != at(column - 1, row);
                between += row > 0 && at(column, row) != at(column, row - 1);
            }
        const Eigen::Vector2d size = obstacles.bounds().size();
        double length = -2.0 * size.sum();
        for (const Edge &edge : obstacles.edges())
        {
            EXPECT_TRUE(edge.from.x() == edge.to.x() || edge.from.y() == edge.to.y());
            length += (edge.to - edge.from).norm();
        }
        EXPECT_NEAR(length, between * obstacles.cellSize(), 1e-6);
    }
}

TEST(ObstacleSet, UnknownCellsAreObstaclesUnlessAskedOtherwise)
{
    OccupancyGrid grid(3, 2, 0.5);
    grid.set(1, 1, Cell::Unknown);
    EXPECT_EQ(ObstacleSet::fromGrid(grid).rectangles().size(), 1u);
    EXPECT_TRUE(ObstacleSet::fromGrid(grid, false).rectangles().empty());
}

TEST(ObstacleSet, KeepsPrecisionFarFromTheOrigin)
{
    // At 4e9 m doubles lie half a micrometre apart, yet differences between them are exact.
    const Eigen::Vector2d offset(4.1e9, -7.3e9);
    const Box bounds{offset - Eigen::Vector2d(5.0, 5.0), offset + Eigen::Vector2d(5.0, 5.0)};
    Polygon triangle{{1.0, 1.0}, {3.0, 1.0}, {1.0, 2.0}};
    for (Eigen::Vector2d &corner : triangle)
        corner += offset;
    const ObstacleSet obstacles = ObstacleSet::fromPolygons({triangle}, bounds);
    for (std::size_t i = 0; i < 3; ++i)
    {
        const Pose local = obstacles.toLocal({triangle[i].x(), triangle[i].y(), 0.0});
        EXPECT_EQ(local.x, obstacles.polygons()[0][i].x());
        EXPECT_EQ(local.y, obstacles.polygons()[0][i].y());
        EXPECT_LT(std::abs(local.x), 10.0);
    }
}

TEST(ObstacleSet, DropsRepeatedCornersAndTurnsPolygonsCounterClockwise)
{
    const Polygon square{{0.0, 0.0}, {0.0, 1.0}, {0.0, 1.0}, {1.0, 1.0}, {1.0, 0.0}, {0.0, 0.0}};
    const ObstacleSet obstacles = ObstacleSet::fromPolygons({square}, BOX);
    ASSERT_EQ(obstacles.polygons().size(), 1u);
    EXPECT_EQ(obstacles.polygons()[0].size(), 4u);
    EXPECT_GT(signedArea(obstacles.polygons()[0]), 0.0);
    EXPECT_EQ(obstacles.edges().size(), 8u);
}

TEST(ObstacleSet, RefusesBadInput)
{
    EXPECT_THROW(ObstacleSet::fromGrid(OccupancyGrid()), Error);
    EXPECT_THROW(ObstacleSet::fromPolygons({Polygon()}, BOX), Error);
    EXPECT_THROW(ObstacleSet::fromPolygons({{{0.0, 0.0}, {1.0, 0.0}, {NOT_A_NUMBER, 1.0}}}, BOX), Error);
    EXPECT_THROW(ObstacleSet::fromPolygons({{{0.0, 0.0}, {2.0, 2.0}, {2.0, 0.0}, {0.0, 2.0}}}, BOX), Error)
        << "crosses itself";
    EXPECT_THROW(ObstacleSet::fromPolygons({}, {{0.0, 0.0}, {0.0, 1.0}}), Error);
    EXPECT_THROW(ObstacleSet::fromPolygons({}, {{0.0, 0.0}, {1.0, -1.0}}), Error);
    EXPECT_THROW(ObstacleSet::fromPolygons({}, {{0.0, 0.0}, {NOT_A_NUMBER, 1.0}}), Error);
}

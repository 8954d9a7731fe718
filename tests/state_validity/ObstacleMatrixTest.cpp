#include "state_validity/ObstacleMatrix.h"

#include "parking_geometry/Error.h"

#include <cmath>
#include <limits>
#include <thread>

#include <gtest/gtest.h>

using namespace parking;

namespace
{
    const Bounds BOX{{-5.0, -3.0}, {5.0, 3.0}};

    bool isInDisc(double x, double y)
    {
        return std::hypot(x - 1.0, y) < 2.0;
    }
}  // namespace

TEST(ObstacleMatrix, KnowsNothingUntilAsked)
{
    std::size_t asked = 0;
    ObstacleMatrix matrix(BOX, 0.25,
                          [&asked](double x, double y)
                          {
                              ++asked;
                              return isInDisc(x, y);
                          });
    EXPECT_EQ(matrix.columns(), 40u);
    EXPECT_EQ(matrix.rows(), 24u);
    for (std::size_t row = 0; row < matrix.rows(); ++row)
        for (std::size_t column = 0; column < matrix.columns(); ++column)
            ASSERT_EQ(matrix.known(column, row), Traversability::Unknown);
    EXPECT_EQ(asked, 0u);
    EXPECT_EQ(matrix.evaluations(), 0u);
    EXPECT_EQ(matrix.fillingTime(), 0.0);

    // The cell of a point, once only.
    EXPECT_TRUE(matrix.isTraversableAt(1.1, 0.1));
    EXPECT_TRUE(matrix.isTraversableAt(1.2, 0.2));
    EXPECT_FALSE(matrix.isTraversableAt(-4.0, 0.0));
    EXPECT_EQ(asked, 2u);
    EXPECT_EQ(matrix.evaluations(), 2u);
    EXPECT_EQ(matrix.known(24, 12), Traversability::Traversable);
    EXPECT_EQ(matrix.known(4, 12), Traversability::Impassable);
}

TEST(ObstacleMatrix, LazilyAndEagerlyFilledAreTheSame)
{
    ObstacleMatrix lazy(BOX, 0.3, isInDisc), eager(BOX, 0.3, isInDisc);
    EXPECT_EQ(lazy.columns(), 34u) << "the last column reaches beyond the bounds";
    EXPECT_TRUE(lazy.isTraversable(20, 10));
    lazy.fill();
    eager.fill();
    EXPECT_EQ(lazy.evaluations(), lazy.columns() * lazy.rows());
    EXPECT_EQ(eager.evaluations(), lazy.evaluations());
    std::size_t traversable = 0;
    for (std::size_t row = 0; row < lazy.rows(); ++row)
        for (std::size_t column = 0; column < lazy.columns(); ++column)
        {
            const Eigen::Vector2d middle = lazy.middle(column, row);
            ASSERT_EQ(lazy.isTraversable(column, row), isInDisc(middle.x(), middle.y()));
            ASSERT_EQ(lazy.known(column, row), eager.known(column, row));
            traversable += lazy.isTraversable(column, row);
        }
    EXPECT_GT(traversable, 50u);
    EXPECT_EQ(lazy.evaluations(), lazy.columns() * lazy.rows()) << "nothing is found out twice";
    lazy.clear();
    EXPECT_EQ(lazy.evaluations(), 0u);
    EXPECT_EQ(lazy.fillingTime(), 0.0);
    EXPECT_EQ(lazy.known(20, 10), Traversability::Unknown);
}

TEST(ObstacleMatrix, ReportsTheTimeThatFindingOutTook)
{
    const auto slow = [](double, double)
    {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        return true;
    };
    ObstacleMatrix matrix({{0.0, 0.0}, {1.0, 1.0}}, 0.5, slow);
    matrix.isTraversable(0, 0);
    EXPECT_GE(matrix.fillingTime(), 0.002);
    matrix.fill();
    EXPECT_GE(matrix.fillingTime(), 0.008);
}

TEST(ObstacleMatrix, TheOutsideIsImpassable)
{
    ObstacleMatrix matrix(BOX, 0.25, [](double, double) { return true; });
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double beyond : {5.0, 1e300, -5.0 - 1e-9, nan, std::numeric_limits<double>::infinity()})
        EXPECT_FALSE(matrix.isTraversableAt(beyond, 0.0)) << beyond;
    for (const double beyond : {3.0, -3.0 - 1e-9, nan})
        EXPECT_FALSE(matrix.isTraversableAt(0.0, beyond)) << beyond;
    EXPECT_TRUE(matrix.isTraversableAt(5.0 - 1e-9, 3.0 - 1e-9));
    EXPECT_TRUE(matrix.isTraversableAt(-5.0, -3.0));
}

TEST(ObstacleMatrix, RefusesBadInput)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double resolution : {0.0, -0.1, nan, std::numeric_limits<double>::infinity(), 1e-5})
        EXPECT_THROW(ObstacleMatrix(BOX, resolution, isInDisc), Error) << resolution;
    EXPECT_THROW(ObstacleMatrix({{0.0, 0.0}, {0.0, 1.0}}, 0.1, isInDisc), Error);
    EXPECT_THROW(ObstacleMatrix({{0.0, 0.0}, {nan, 1.0}}, 0.1, isInDisc), Error);
    EXPECT_THROW(ObstacleMatrix(BOX, 0.1, nullptr), Error);
}

#include "parking_geometry/OccupancyGrid.h"

#include "tests/parking_geometry/ExpectError.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

using namespace parking;
using parking_test::expectError;

TEST(OccupancyGrid, CellsAreStoredRowByRowFromTheLowerLeft)
{
    OccupancyGrid grid(3, 2, 0.5);
    EXPECT_EQ(grid.cells().size(), 6u);
    grid.set(2, 0, Cell::Occupied);
    grid.set(0, 1, Cell::Unknown);
    EXPECT_EQ(grid.at(2, 0), Cell::Occupied);
    EXPECT_EQ(grid.cells()[2], Cell::Occupied);
    EXPECT_EQ(grid.cells()[3], Cell::Unknown);
    EXPECT_EQ(grid.at(1, 1), Cell::Free);
}

TEST(OccupancyGrid, OutlineFollowsTheOriginAndItsYaw)
{
    const OccupancyGrid grid(40, 20, 0.5, {1.0, 2.0, 0.5 * PI});
    const std::vector<Eigen::Vector2d> corners = grid.outline();
    ASSERT_EQ(corners.size(), 4u);
    EXPECT_TRUE(corners[0].isApprox(Eigen::Vector2d(1.0, 2.0)));
    EXPECT_TRUE(corners[1].isApprox(Eigen::Vector2d(1.0, 22.0)));
    EXPECT_TRUE(corners[2].isApprox(Eigen::Vector2d(-9.0, 22.0)));
    EXPECT_TRUE(corners[3].isApprox(Eigen::Vector2d(-9.0, 2.0)));
}

TEST(OccupancyGrid, RefusesWhatIsNoMap)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    expectError([] { OccupancyGrid(0, 5, 1.0); }, {"0 x 5"});
    expectError([] { OccupancyGrid(5, 0, 1.0); }, {"5 x 0"});
    expectError([] { OccupancyGrid(std::size_t(1) << 16, (std::size_t(1) << 15) + 1, 1.0); }, {"2^31"});
    expectError([] { OccupancyGrid(std::size_t(1) << 33, std::size_t(1) << 33, 1.0); }, {"2^31"});
    for (const double resolution : {0.0, -0.1, nan, std::numeric_limits<double>::infinity()})
        expectError([resolution] { OccupancyGrid(2, 2, resolution); }, {"resolution", "positive"});
    expectError([nan] { OccupancyGrid(2, 2, 1.0, {0.0, nan, 0.0}); }, {"origin", "nan"});
    EXPECT_NO_THROW(OccupancyGrid(1, 1, 1e-3));
}

// The grid whose memory grows with the area that is touched.

#include "ompl_improved_astar/search/TiledGrid.h"
#include "tests/ompl_improved_astar/TestRandom.h"

#include <gtest/gtest.h>

#include <map>
#include <utility>
#include <vector>

using parking::search::TiledGrid;
using parking_test::TestRandom;

namespace
{
    struct Content
    {
        int value{17};
    };

    using Grid = TiledGrid<Content>;
}  // namespace

TEST(TiledGrid, containsExactlyItsReach)
{
    const std::int32_t last = Grid::REACH - 1;
    EXPECT_TRUE(Grid::contains(-Grid::REACH, last));
    EXPECT_TRUE(Grid::contains(last, -Grid::REACH));
    EXPECT_FALSE(Grid::contains(-Grid::REACH - 1, 0));
    EXPECT_FALSE(Grid::contains(0, -Grid::REACH - 1));
    EXPECT_FALSE(Grid::contains(Grid::REACH, 0));
    EXPECT_FALSE(Grid::contains(0, Grid::REACH));
    EXPECT_TRUE(Grid::contains(-1.0 * Grid::REACH, 1.0 * last));
    EXPECT_FALSE(Grid::contains(1.0 * Grid::REACH, 0.0));
    EXPECT_FALSE(Grid::contains(1e300, 0.0));
}

TEST(TiledGrid, matchesAMapAndForgetsOnClear)
{
    TestRandom random(4);
    Grid grid;
    for (int round = 0; round < 5; ++round)
    {
        std::map<std::pair<std::int32_t, std::int32_t>, int> oracle;
        for (int i = 0; i < 20000; ++i)
        {
            // Across the borders of tiles near the middle, and at the four corners.
            std::int32_t column = static_cast<std::int32_t>(random.index(200)) - 100;
            std::int32_t row = static_cast<std::int32_t>(random.index(200)) - 100;
            if (random.chance(0.1))
            {
                column = random.chance(0.5) ? Grid::REACH - 1 : -Grid::REACH;
                row = random.chance(0.5) ? Grid::REACH - 1 : -Grid::REACH;
            }
            const auto known = oracle.find({column, row});
            ASSERT_EQ(grid.at(column, row).value, known == oracle.end() ? 17 : known->second);
            const int value = static_cast<int>(random.index(1000));
            grid.at(column, row).value = value;
            oracle[{column, row}] = value;
        }
        grid.clear();
    }
}

TEST(TiledGrid, referencesHoldWhileOthersAreMade)
{
    Grid grid;
    Content &kept = grid.at(0, 0);
    kept.value = 1;
    for (std::int32_t i = 1; i < Grid::DIRECTORY / 2; ++i)
        grid.at(i * Grid::TILE, -i * Grid::TILE).value = i;
    EXPECT_EQ(kept.value, 1);
    EXPECT_EQ(&kept, &grid.at(0, 0));
}

// The grid whose memory grows with the area that is touched.

#include "benchmarks/worlds/Random.h"
#include "ompl_improved_astar/search/containers/TiledGrid.h"

#include <gtest/gtest.h>

#include <map>
#include <utility>
#include <vector>

using parking::search::TiledGrid;
using parking_test::Random;

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
    Random random(4);
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

TEST(TiledGrid, neighboursAreTheEightAroundRowByRow)
{
    Random random(5);
    Grid grid;
    const auto number = [](std::int32_t column, std::int32_t row)
    {
        return 10000 * row + column;
    };
    for (int i = 0; i < 3000; ++i)
    {
        // On both sides of the borders of tiles, and away from them.
        const auto column = static_cast<std::int32_t>(random.index(100)) - 50;
        const auto row = static_cast<std::int32_t>(random.index(100)) - 50;
        std::vector<int> expected, visited;
        for (std::int32_t r = row - 1; r <= row + 1; ++r)
            for (std::int32_t c = column - 1; c <= column + 1; ++c)
            {
                grid.at(c, r).value = number(c, r);
                if (c != column || r != row)
                    expected.push_back(number(c, r));
            }
        const bool all = grid.forEachNeighbour(column, row,
                                               [&](Content &cell, std::int32_t c, std::int32_t r, bool diagonal)
                                               {
                                                   ASSERT_EQ(&cell, &grid.at(c, r));
                                                   ASSERT_EQ(diagonal, c != column && r != row);
                                                   visited.push_back(cell.value);
                                               });
        ASSERT_TRUE(all);
        ASSERT_EQ(visited, expected) << column << " " << row;
    }
}

TEST(TiledGrid, neighboursBeyondTheReachAreLeftOut)
{
    Grid grid;
    const std::int32_t last = Grid::REACH - 1;
    const auto count = [&grid](std::int32_t column, std::int32_t row, int expected)
    {
        int visited = 0;
        const bool all = grid.forEachNeighbour(column, row,
                                               [&visited](Content &, std::int32_t c, std::int32_t r, bool)
                                               {
                                                   EXPECT_TRUE(Grid::contains(c, r));
                                                   ++visited;
                                               });
        EXPECT_EQ(visited, expected);
        EXPECT_EQ(all, expected == 8);
    };
    count(last, last, 3);
    count(-Grid::REACH, 0, 5);
    count(0, last, 5);
    count(last - 1, -Grid::REACH + 1, 8);
}

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
            const auto *const found = std::as_const(grid).find(column, row);
            ASSERT_TRUE(known == oracle.end() ? found == nullptr || found->value == 17
                                              : found != nullptr && found->value == known->second);
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
        for (std::int32_t r = row - 1; r <= row + 1; ++r)
            for (std::int32_t c = column - 1; c <= column + 1; ++c)
                grid.at(c, r).value = number(c, r);
        const Grid::Neighbours neighbours(grid, column, row);
        for (std::int32_t r = -1; r <= 1; ++r)
            for (std::int32_t c = -1; c <= 1; ++c)
            {
                ASSERT_EQ(neighbours.at(c, r), &grid.at(column + c, row + r)) << column << " " << row;
                ASSERT_EQ(neighbours.at(c, r)->value, number(column + c, row + r));
            }
    }
}

TEST(TiledGrid, neighboursBeyondTheReachAreNone)
{
    Grid grid;
    const std::int32_t last = Grid::REACH - 1;
    const auto count = [&grid](std::int32_t column, std::int32_t row)
    {
        const Grid::Neighbours neighbours(grid, column, row);
        int known = 0;
        for (std::int32_t r = -1; r <= 1; ++r)
            for (std::int32_t c = -1; c <= 1; ++c)
            {
                EXPECT_EQ(neighbours.at(c, r) != nullptr, Grid::contains(column + c, row + r));
                known += neighbours.at(c, r) != nullptr ? 1 : 0;
            }
        return known;
    };
    EXPECT_EQ(count(last, last), 4);
    EXPECT_EQ(count(-Grid::REACH, 0), 6);
    EXPECT_EQ(count(0, last), 6);
    EXPECT_EQ(count(last - 1, -Grid::REACH + 1), 9);
}

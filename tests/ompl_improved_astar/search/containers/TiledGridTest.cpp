// The grid whose memory grows with the area that is touched.

#include "benchmarks/worlds/Random.h"
#include "ompl_improved_astar/search/containers/TiledGrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>

namespace
{
    struct Content
    {
        int value{17};
    };

    using Grid = parking::search::TiledGrid<Content>;
}  // namespace

TEST(TiledGrid, containsExactlyItsReach)
{
    const std::int32_t reach = Grid::REACH;
    for (const std::int32_t inside : {-reach, 0, reach - 1})
    {
        EXPECT_TRUE(Grid::contains(inside, -1 - inside));
        EXPECT_TRUE(Grid::contains(1.0 * inside, -1.0 - inside));
        for (const std::int32_t outside : {-reach - 1, reach})
            EXPECT_FALSE(Grid::contains(inside, outside) || Grid::contains(outside, inside) ||
                         Grid::contains(1.0 * inside, 1.0 * outside));
    }
    EXPECT_FALSE(Grid::contains(1e300, 0.0) || Grid::contains(0.0, std::nan("")));
}

TEST(TiledGrid, isAMapUntilCleared)
{
    parking_test::Random random(4);
    Grid grid;
    const Content *const kept = &grid.at(0, 0);
    for (int round = 0; round < 5; ++round)
    {
        std::map<std::pair<std::int32_t, std::int32_t>, Content> baseline;
        const auto coordinate = [&]
        {
            // Across the borders of tiles near the middle, and at the four corners.
            const std::int32_t corner = random.chance(0.5) ? Grid::REACH - 1 : -Grid::REACH;
            return random.chance(0.1) ? corner : random.below(200) - 100;
        };
        for (int i = 0; i < 20000; ++i)
        {
            const std::int32_t column = coordinate(), row = coordinate();
            const Content *const found = std::as_const(grid).find(column, row);
            Content &expected = baseline[{column, row}];
            ASSERT_EQ(found == nullptr ? 17 : found->value, expected.value);
            ASSERT_EQ(grid.at(column, row).value, expected.value);
            grid.at(column, row).value = expected.value = random.below(1000);
            ASSERT_TRUE(round > 0 || &grid.at(0, 0) == kept);
        }
        std::size_t visited = 0, cells = 0;
        const auto visit = [&](std::int32_t column, std::int32_t row, const Content &content)
        {
            const auto found = baseline.find({column, row});
            ASSERT_EQ(content.value, found == baseline.end() ? 17 : found->second.value);
            visited += found != baseline.end() ? 1 : 0;
            ++cells;
        };
        grid.forEach(visit);
        EXPECT_EQ(visited, baseline.size());
        EXPECT_EQ(cells * sizeof(Content), grid.bytes());
        grid.clear();
        EXPECT_EQ(grid.bytes(), 0u);
    }
}

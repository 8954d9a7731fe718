// The containers of the search, each against one of the standard library.

#include "benchmarks/worlds/Random.h"
#include "ompl_improved_astar/search/containers/CellTable.h"
#include "ompl_improved_astar/search/containers/ExpansionDensity.h"
#include "ompl_improved_astar/search/containers/MonotoneQueue.h"
#include "ompl_improved_astar/search/containers/TiledGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

using namespace parking;
using namespace parking::search;
using parking_test::Random;
using Baseline = std::priority_queue<std::uint32_t, std::vector<std::uint32_t>, std::greater<>>;

TEST(CellTable, matchesUnorderedMapThroughGenerations)
{
    Random random(3);
    for (const std::size_t slots : {2u, 256u, 4096u})
    {
        CellTable table(slots);
        for (int generation = 0; generation < 20; ++generation)
        {
            std::unordered_map<std::uint64_t, std::uint32_t> oracle;
            // Some generations fill the table beyond where it grows, some hardly touch it.
            for (int i = generation % 3 == 0 ? 30000 : 300; i > 0; --i)
            {
                // Neighbours, as cells are; what differs in the high bits only; anything.
                const std::uint64_t kinds[] = {random.index(200) << 36 | random.index(200) << 12, random.bits() << 48,
                                               random.bits(), 0, ~std::uint64_t{0}};
                const std::uint64_t key = kinds[random.index(std::size(kinds))];
                const auto known = oracle.find(key);
                ASSERT_EQ(table.find(key), known == oracle.end() ? CellTable::NONE : known->second);
                if (random.chance(0.7))
                    table.set(key, oracle[key] = static_cast<std::uint32_t>(random.index(1000000)));
                ASSERT_GE(table.bytes(), oracle.size() * (sizeof(std::uint64_t) + sizeof(std::uint32_t)));
            }
            for (const auto &[key, value] : oracle)
                ASSERT_EQ(table.find(key), value);
            table.clear();
            EXPECT_EQ(table.bytes(), 0u);
            for (const auto &each : oracle)
                ASSERT_EQ(table.find(each.first), CellTable::NONE) << "of an earlier generation";
        }
    }
}

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
    Random random(4);
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

TEST(MonotoneQueue, isAPriorityQueue)
{
    MonotoneQueue<std::uint32_t> queue;  // each item is its own priority
    for (const std::uint32_t ahead : {0u, 3u, 40u, 5000u, 1000000u})
    {
        SCOPED_TRACE(ahead);
        Random random(7);
        Baseline baseline;
        std::uint32_t last = 10, highest = 0;
        queue.clear();
        for (int step = 1; step < 20000; ++step)
        {
            ASSERT_EQ(queue.empty(), baseline.empty());
            ASSERT_EQ(queue.size(), baseline.size());
            ASSERT_GE(queue.bytes(), baseline.size() * sizeof(std::uint32_t));
            if (step % 1000 == 0)
            {
                // Priorities are reversed, and every third item is removed.
                last = 0;
                baseline = {};
                for (const std::uint32_t item : queue.takeAll())
                    if (item % 3 != 0)
                    {
                        queue.push(highest - item, highest - item);
                        baseline.push(highest - item);
                    }
            }
            else if (baseline.empty() || random.chance(step % 2000 < 1000 ? 0.6 : 0.3))
            {
                const std::uint32_t priority = last + static_cast<std::uint32_t>(random.index(ahead + 1));
                highest = std::max(highest, priority);
                queue.push(priority, priority);
                baseline.push(priority);
            }
            else
            {
                last = queue.pop();
                ASSERT_EQ(last, baseline.top());
                baseline.pop();
            }
        }
    }
}

TEST(MonotoneQueue, popsAnItemPushedTooLowNext)
{
    MonotoneQueue<int> queue;
    queue.push(100, 0);
    queue.push(101, 1);
    EXPECT_EQ(queue.pop(), 0);
    queue.push(3, 2);
    EXPECT_EQ(queue.pop(), 2);
    EXPECT_EQ(queue.pop(), 1);
}

TEST(ExpansionDensity, countsBySquaresAndTheNearestOfEightHeadings)
{
    Random random(1);
    ExpansionDensity density;
    for (const double side : {0.4, 2.0, 7.5})
    {
        density.begin(side);
        std::map<std::tuple<double, double, int>, std::uint32_t> oracle;
        for (int i = 0; i < 20000; ++i)
        {
            Pose pose = random.poseIn(-4.0 * side, 4.0 * side);
            // A hair on either side of a border, too, and any number of turns.
            const double hair = random.magnitude(1e-9, 1e-9);
            if (random.chance(0.3))
                pose.x = std::round(pose.x / side) * side + hair;
            if (random.chance(0.3))
                pose.y = std::round(pose.y / side) * side + hair;
            if (random.chance(0.3))
                pose.yaw = (random.below(8) + 0.5) * 0.25 * PI + hair;
            pose.yaw += 2.0 * PI * (random.below(5) - 2);
            int nearest = 0;
            for (int k = 1; k < 8; ++k)
                if (std::cos(pose.yaw - 0.25 * PI * k) > std::cos(pose.yaw - 0.25 * PI * nearest))
                    nearest = k;
            std::uint32_t &count = oracle[{std::floor(pose.x / side), std::floor(pose.y / side), nearest}];
            ASSERT_EQ(density.at(pose), count);
            if (random.chance(0.7))
            {
                density.add(pose);
                ++count;
            }
        }
        EXPECT_GT(density.bytes(), 0u);
    }
    density.begin(1.0);
    for (int i = 0; i < 100; ++i)
        ASSERT_EQ(density.at(random.poseIn(-4.0, 4.0)), 0u) << "of the query before";
}

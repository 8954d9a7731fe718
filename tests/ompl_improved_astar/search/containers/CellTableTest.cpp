// The hash table of cells, against std::unordered_map.

#include "benchmarks/worlds/Random.h"
#include "ompl_improved_astar/search/containers/CellTable.h"

#include <gtest/gtest.h>

#include <unordered_map>

using parking::search::CellTable;
using parking_test::Random;

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

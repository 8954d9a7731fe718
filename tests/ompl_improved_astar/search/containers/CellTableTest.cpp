// The hash table of cells, against std::unordered_map.

#include "benchmarks/worlds/Random.h"
#include "ompl_improved_astar/search/containers/CellTable.h"

#include <gtest/gtest.h>

#include <unordered_map>
#include <vector>

using parking::search::CellTable;
using parking_test::Random;

TEST(CellTable, matchesUnorderedMapThroughGenerations)
{
    Random random(3);
    for (const std::size_t slots : {2u, 256u, 4096u})
    {
        CellTable table(slots);
        EXPECT_EQ(table.find(0), CellTable::NONE);
        EXPECT_EQ(table.find(~0ull), CellTable::NONE);
        for (int generation = 0; generation < 20; ++generation)
        {
            std::unordered_map<std::uint64_t, std::uint32_t> oracle;
            std::vector<std::uint64_t> keys;
            // Some generations fill the table beyond where it grows, some hardly touch it.
            const int operations = generation % 3 == 0 ? 30000 : 300;
            for (int i = 0; i < operations; ++i)
            {
                std::uint64_t key;
                switch (random.index(4))
                {
                    case 0:  // neighbours, as cells are
                        key = (std::uint64_t{random.index(200)} << 36) | (std::uint64_t{random.index(200)} << 12);
                        break;
                    case 1:  // differ in the high bits only
                        key = random.bits() << 48;
                        break;
                    case 2:
                        key = keys.empty() ? 0 : keys[random.index(keys.size())];
                        break;
                    default:
                        key = random.bits();
                }
                const auto known = oracle.find(key);
                ASSERT_EQ(table.find(key), known == oracle.end() ? CellTable::NONE : known->second);
                if (random.chance(0.7))
                {
                    const auto value = static_cast<std::uint32_t>(random.index(1000000));
                    table.set(key, value);
                    oracle[key] = value;
                    keys.push_back(key);
                }
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

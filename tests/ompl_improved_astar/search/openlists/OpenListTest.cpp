// The open list: its order, and that heap and linear list are the same but for their speed.

#include "benchmarks/worlds/Random.h"
#include "ompl_improved_astar/search/openlists/OpenList.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <vector>

using namespace parking::search;
using parking_test::Random;

namespace
{
    std::vector<std::uint32_t> drain(OpenList &list)
    {
        std::vector<std::uint32_t> nodes;
        while (!list.empty())
            nodes.push_back(list.pop().node);
        return nodes;
    }

    class OpenListOrder : public testing::TestWithParam<const char *>
    {
    };
}  // namespace

TEST_P(OpenListOrder, isByFThenHThenInsertion)
{
    const std::unique_ptr<OpenList> made = openLists().make(GetParam());
    OpenList &list = *made;
    list.push(2.0, 0.0, 0);
    list.push(1.0, 5.0, 1);
    list.push(1.0, 4.0, 2);
    list.push(1.0, 4.0, 3);
    list.push(1.0, 4.0, 4);
    list.push(0.5, 9.0, 5);
    list.push(1.0, 5.0, 6);
    EXPECT_EQ(drain(list), (std::vector<std::uint32_t>{5, 2, 3, 4, 1, 6, 0}));
}

TEST_P(OpenListOrder, matchesASortedSetOnRandomPushesAndPops)
{
    Random random(1);
    const std::unique_ptr<OpenList> made = openLists().make(GetParam());
    OpenList &list = *made;
    std::set<std::tuple<double, double, std::uint32_t>> oracle;  // the node numbers rise with the insertions
    std::uint32_t inserted = 0;
    for (int i = 0; i < 20000; ++i)
    {
        if (oracle.empty() || random.chance(0.55))
        {
            // Few different values, so that ties are common.
            const double f = random.index(12), h = random.index(4);
            list.push(f, h, inserted);
            oracle.emplace(f, h, inserted++);
        }
        else
        {
            const auto &[f, h, node] = *oracle.begin();
            const OpenList::Entry entry = list.pop();
            ASSERT_EQ(std::make_tuple(entry.f, entry.h, entry.node), std::make_tuple(f, h, node));
            oracle.erase(oracle.begin());
        }
        ASSERT_EQ(list.size(), oracle.size());
        ASSERT_EQ(list.empty(), oracle.empty());
    }
}

TEST_P(OpenListOrder, rekeySortsAnewAndDropsWhatItIsToldTo)
{
    Random random(2);
    const std::unique_ptr<OpenList> made = openLists().make(GetParam());
    OpenList &list = *made;
    for (std::uint32_t node = 0; node < 500; ++node)
        list.push(random.between(0.0, 1.0), 0.0, node);
    // The order of the numbers backwards, odd ones left out.
    list.rekey(
        [](OpenList::Entry &entry)
        {
            entry.f = -static_cast<double>(entry.node);
            return entry.node % 2 == 0;
        });
    std::vector<std::uint32_t> expected;
    for (std::uint32_t node = 500; node >= 2;)
        expected.push_back(node -= 2);
    EXPECT_EQ(drain(list), expected);
}

TEST_P(OpenListOrder, rekeyedInPartsItIsTheSame)
{
    const auto filled = []
    {
        Random random(3);
        std::unique_ptr<OpenList> list = openLists().make(GetParam());
        for (std::uint32_t node = 0; node < 500; ++node)
            list->push(random.between(0.0, 1.0), random.index(3), node);
        return list;
    };
    const auto key = [](OpenList::Entry &entry)
    {
        entry.f = static_cast<double>(entry.node * 7919 % 97);
        return entry.node % 5 != 0;
    };
    const std::unique_ptr<OpenList> whole = filled();
    EXPECT_TRUE(whole->rekey(key));
    const std::uint64_t comparisons = whole->work().comparisons;
    const std::vector<std::uint32_t> expected = drain(*whole);
    for (const std::size_t most : {1u, 7u, 400u, 499u, 500u})
    {
        SCOPED_TRACE(most);
        const std::unique_ptr<OpenList> list = filled();
        std::size_t keyed = 0, calls = 0;
        bool isDone = false;
        while (!isDone)
        {
            const std::size_t before = keyed;
            isDone = list->rekey(
                [&](OpenList::Entry &entry)
                {
                    ++keyed;
                    return key(entry);
                },
                most);
            ++calls;
            ASSERT_LE(keyed - before, most);
        }
        EXPECT_EQ(keyed, 500u) << "each once";
        EXPECT_GE(calls, (500 + most - 1) / most);
        EXPECT_EQ(list->work().comparisons, comparisons);
        EXPECT_EQ(drain(*list), expected);
    }
}

TEST_P(OpenListOrder, rekeyingMayBeginAnewAtAnyTime)
{
    const auto backwards = [](OpenList::Entry &entry)
    {
        entry.f = -static_cast<double>(entry.node);
        return true;
    };
    for (std::size_t calls = 0; calls <= 5; ++calls)
    {
        SCOPED_TRACE(calls);
        const std::unique_ptr<OpenList> list = openLists().make(GetParam());
        for (std::uint32_t node = 0; node < 50; ++node)
            list->push(1.0, 0.0, node);
        // Every third is dropped, as far as that gets.
        std::uint32_t seen = 0, dropped = 0;
        for (std::size_t call = 0; call < calls; ++call)
            list->rekey(
                [&](OpenList::Entry &entry)
                {
                    entry.f = 7.0;
                    dropped += ++seen % 3 == 0 ? 1 : 0;
                    return seen % 3 != 0;
                },
                12);
        list->beginRekeying();
        EXPECT_TRUE(list->rekey(backwards));
        std::vector<std::uint32_t> nodes = drain(*list);
        EXPECT_EQ(nodes.size(), 50 - dropped);
        EXPECT_TRUE(std::is_sorted(nodes.rbegin(), nodes.rend()));
        EXPECT_EQ(std::unique(nodes.begin(), nodes.end()), nodes.end()) << "none twice";
    }
    // Nor does a list that is cleared remember any of it.
    const std::unique_ptr<OpenList> list = openLists().make(GetParam());
    for (std::uint32_t node = 0; node < 50; ++node)
        list->push(1.0, 0.0, node);
    EXPECT_FALSE(list->rekey(backwards, 12));
    list->clear();
    list->push(1.0, 0.0, 3);
    list->push(1.0, 0.0, 4);
    EXPECT_TRUE(list->rekey(backwards));
    EXPECT_EQ(drain(*list), (std::vector<std::uint32_t>{4, 3}));
}

TEST_P(OpenListOrder, clearBeginsAnew)
{
    const std::unique_ptr<OpenList> made = openLists().make(GetParam());
    OpenList &list = *made;
    list.push(1.0, 1.0, 7);
    list.clear();
    EXPECT_TRUE(list.empty());
    EXPECT_EQ(list.size(), 0u);
    list.push(1.0, 1.0, 8);
    list.push(1.0, 1.0, 9);
    EXPECT_EQ(drain(list), (std::vector<std::uint32_t>{8, 9}));
}

TEST_P(OpenListOrder, countsWhatItDoes)
{
    const std::unique_ptr<OpenList> made = openLists().make(GetParam());
    OpenList &list = *made;
    EXPECT_EQ(list.work().operations, 0u);
    for (std::uint32_t node = 0; node < 1000; ++node)
        list.push(static_cast<double>(node * 7919 % 1000), 0.0, node);
    EXPECT_EQ(list.work().operations, 1000u);
    drain(list);
    EXPECT_EQ(list.work().operations, 2000u);
    const std::uint64_t comparisons = list.work().comparisons;
    if (GetParam() == std::string("linear"))
        EXPECT_EQ(comparisons, 999u * 1000u / 2u);  // every entry but the one that is taken, each time
    else
    {
        EXPECT_GT(comparisons, 1000u);
        EXPECT_LT(comparisons, 3u * 1000u * 10u);  // a few times the height of the heap for each
    }
    list.clear();
    EXPECT_EQ(list.work().comparisons, 0u);
}

INSTANTIATE_TEST_SUITE_P(Kinds, OpenListOrder, testing::Values("binary_heap", "linear"),
                         [](const auto &each) { return std::string(each.param); });

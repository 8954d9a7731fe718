// The open list: every kind against a sorted set.

#include "benchmarks/worlds/Random.h"
#include "ompl_improved_astar/search/OpenList.h"
#include "parking_geometry/Error.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <vector>

using namespace parking::search;
using parking_test::Random;

namespace
{
    /** A list of the kind that is tested beside a set in the order that every list promises. Nodes are numbered in the
        order of insertion. */
    class OpenListOrder : public testing::TestWithParam<const char *>
    {
    protected:
        using Key = std::tuple<double, double, NodeIndex>;

        void push(double f, double h)
        {
            list_->push(f, h, inserted_);
            oracle_.emplace(f, h, inserted_++);
        }

        /** Few different values, so that ties are common. */
        void pushRandom()
        {
            constexpr double INFINITE = std::numeric_limits<double>::infinity();
            push(random_.chance(0.05) ? INFINITE : random_.below(12),
                 random_.chance(0.05) ? INFINITE : random_.below(4));
        }

        void popBoth()
        {
            const OpenList::Entry entry = list_->pop();
            ASSERT_EQ(Key(entry.f, entry.h, entry.node), *oracle_.begin());
            oracle_.erase(oracle_.begin());
        }

        void drain()
        {
            while (!oracle_.empty())
                ASSERT_NO_FATAL_FAILURE(popBoth());
            EXPECT_TRUE(list_->empty());
            EXPECT_EQ(list_->size(), 0u);
        }

        Random random_{1};
        std::unique_ptr<OpenList> list_ = openLists().make(GetParam());
        std::set<Key> oracle_;
        NodeIndex inserted_{0};
    };
}  // namespace

TEST_P(OpenListOrder, isByFThenHThenInsertionAmongPushesPopsAndRekeying)
{
    for (int i = 0; i < 20000; ++i)
    {
        if (oracle_.empty() || random_.chance(0.55))
            pushRandom();
        else
        {
            ASSERT_NO_FATAL_FAILURE(popBoth());
        }
        if (random_.chance(0.002))
        {
            // f and h of a node become others, and some entries are dropped; ties stay in the order of insertion.
            const double shift = random_.below(5);
            const auto rekeyed = [&](Key key)
            {
                return Key(static_cast<double>((std::get<2>(key) * 7919) % 10) + shift,
                           std::get<2>(key) % 3 == 0 ? 1.0 : std::get<1>(key), std::get<2>(key));
            };
            const auto isKept = [](NodeIndex node)
            {
                return node % 5 != 0;
            };
            std::set<Key> changed;
            for (const Key &key : oracle_)
                if (isKept(std::get<2>(key)))
                    changed.insert(rekeyed(key));
            oracle_ = changed;
            EXPECT_TRUE(list_->rekey(
                [&](OpenList::Entry &entry)
                {
                    std::tie(entry.f, entry.h, entry.node) = rekeyed({entry.f, entry.h, entry.node});
                    return isKept(entry.node);
                },
                {}));
        }
        ASSERT_EQ(list_->size(), oracle_.size());
        ASSERT_EQ(list_->empty(), oracle_.empty());
    }
    drain();
}

TEST_P(OpenListOrder, aStoppedRekeyingChangesNothing)
{
    for (int i = 0; i < 20000; ++i)
        pushRandom();
    const auto negated = [](OpenList::Entry &entry)
    {
        entry.f = -static_cast<double>(entry.node);
        return entry.node % 2 == 0;
    };
    for (int polls = 0; polls < 8; ++polls)
    {
        int asked = 0;
        std::uint64_t keyed = 0, keyedBeforeStop = 0;
        EXPECT_FALSE(list_->rekey(
            [&](OpenList::Entry &entry)
            {
                ++keyed;
                return negated(entry);
            },
            [&]
            {
                keyedBeforeStop = keyed;
                return asked++ >= polls;
            }));
        EXPECT_EQ(asked, polls + 1) << "it ends at once";
        EXPECT_EQ(keyed, keyedBeforeStop);
        EXPECT_LT(keyed, oracle_.size()) << "it is polled on the way";
        EXPECT_EQ(list_->size(), oracle_.size());
    }
    drain();
}

TEST_P(OpenListOrder, clearForgetsEntriesOrderAndWork)
{
    for (int round = 0; round < 3; ++round)
    {
        for (int i = 0; i < 100; ++i)
            push(1.0, 1.0);
        list_->clear();
        oracle_.clear();
        inserted_ = 0;
        EXPECT_TRUE(list_->empty());
        EXPECT_EQ(list_->work().operations, 0u);
        EXPECT_EQ(list_->work().comparisons, 0u);
    }
    for (int i = 0; i < 100; ++i)
        pushRandom();
    drain();
    EXPECT_EQ(list_->work().operations, 200u) << "pushed and popped";
    EXPECT_GE(list_->work().comparisons, 99u) << "no order without comparisons";
}

INSTANTIATE_TEST_SUITE_P(Kinds, OpenListOrder, testing::Values("binary_heap", "linear"),
                         [](const auto &each) { return std::string(each.param); });

TEST(OpenLists, aHeapComparesFarLessThanALinearList)
{
    const auto comparisons = [](const char *kind)
    {
        const std::unique_ptr<OpenList> list = openLists().make(kind);
        for (NodeIndex node = 0; node < 1000; ++node)
            list->push(node * 7919 % 1000, 0.0, node);
        while (!list->empty())
            list->pop();
        return list->work().comparisons;
    };
    EXPECT_LT(10 * comparisons("binary_heap"), comparisons("linear"));
}

TEST(OpenLists, anUnknownNameIsRefusedWithThoseThatAreKnown)
{
    try
    {
        openLists().make("binary_heep");
        ADD_FAILURE() << "was taken";
    }
    catch (const parking::Error &error)
    {
        const std::string text = error.what();
        for (const char *part : {"open_list", "'binary_heap'", "linear"})
            EXPECT_NE(text.find(part), std::string::npos) << text;
    }
}

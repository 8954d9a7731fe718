// The open list: every kind against a sorted set.

#include "benchmarks/worlds/Random.h"
#include "ompl_improved_astar/search/OpenList.h"
#include "parking_geometry/Error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <set>
#include <string>
#include <tuple>

using namespace parking::search;
using parking_test::Random;

namespace
{
    /** A list of each kind beside a set in the order that it promises. Nodes are numbered in the order of insertion. */
    class OpenListOrder : public testing::TestWithParam<const char *>
    {
    protected:
        using Key = std::tuple<double, double, NodeIndex>;

        /** Few different values, so that ties are common. */
        void push()
        {
            const double f = random_.chance(0.05) ? HUGE_VAL : random_.below(12), h = random_.below(4);
            list_->push(f, h, inserted_);
            oracle_.emplace(f, h, inserted_++);
        }

        void pop()
        {
            const OpenList::Entry entry = list_->pop();
            ASSERT_EQ(Key(entry.f, entry.h, entry.node), *oracle_.begin());
            oracle_.erase(oracle_.begin());
            ASSERT_EQ(list_->size(), oracle_.size());
            ASSERT_EQ(list_->empty(), oracle_.empty());
        }

        void drain()
        {
            while (!oracle_.empty())
                ASSERT_NO_FATAL_FAILURE(pop());
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
            push();
        else
            ASSERT_NO_FATAL_FAILURE(pop());
        if (!random_.chance(0.002))
            continue;
        // f and h of a node become others, and some entries are dropped; ties stay in the order of insertion.
        const auto rekeyed = [](NodeIndex node, double h)
        {
            return Key(node * 7919 % 10, node % 3 == 0 ? 1.0 : h, node);
        };
        std::set<Key> changed;
        for (const auto &[f, h, node] : oracle_)
            if (node % 5 != 0)
                changed.insert(rekeyed(node, h));
        oracle_ = changed;
        EXPECT_TRUE(list_->rekey(
            [&](OpenList::Entry &entry)
            {
                std::tie(entry.f, entry.h, entry.node) = rekeyed(entry.node, entry.h);
                return entry.node % 5 != 0;
            },
            {}));
    }
    drain();
}

TEST_P(OpenListOrder, aStoppedRekeyingEndsAtOnceAndChangesNothing)
{
    for (int i = 0; i < 20000; ++i)
        push();
    for (int polls = 0; polls < 8; ++polls)
    {
        int asked = 0;
        std::size_t keyed = 0, keyedAtStop = 0;
        EXPECT_FALSE(list_->rekey(
            [&](OpenList::Entry &entry)
            {
                entry.f = -static_cast<double>(entry.node);
                return ++keyed % 2 == 0;
            },
            [&]
            {
                keyedAtStop = keyed;
                return asked++ >= polls;
            }));
        EXPECT_EQ(asked, polls + 1);
        EXPECT_EQ(keyed, keyedAtStop);
        EXPECT_LT(keyed, oracle_.size());
    }
    drain();
}

TEST_P(OpenListOrder, clearForgetsEntriesOrderAndWork)
{
    for (int i = 0; i < 100; ++i)
        push();
    list_->clear();
    oracle_.clear();
    EXPECT_TRUE(list_->empty());
    EXPECT_EQ(list_->work().operations + list_->work().comparisons, 0u);
    for (int i = 0; i < 1000; ++i)
        push();
    drain();
    EXPECT_EQ(list_->work().operations, 2000u) << "pushed and popped";
    // The work of a linear list grows with the square.
    const bool isLinear = GetParam() == std::string("linear");
    EXPECT_EQ(list_->work().comparisons > 1000u * 1000u / 4u, isLinear);
    EXPECT_GT(list_->work().comparisons, 1000u);
}

INSTANTIATE_TEST_SUITE_P(Kinds, OpenListOrder, testing::Values("binary_heap", "linear"),
                         [](const auto &each) { return std::string(each.param); });

TEST(OpenLists, anUnknownNameIsRefusedWithThoseThatAreKnown)
{
    try
    {
        openLists().make("binary_heep");
        ADD_FAILURE() << "was taken";
    }
    catch (const parking::Error &error)
    {
        for (const char *part : {"open_list", "'binary_heap'", "linear"})
            EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
}

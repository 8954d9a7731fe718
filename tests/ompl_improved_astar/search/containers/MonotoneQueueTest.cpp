// The queue of the ways round obstacles, against the standard library's.

#include "benchmarks/worlds/Random.h"
#include "ompl_improved_astar/search/containers/MonotoneQueue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <vector>

using parking::search::MonotoneQueue;
using parking_test::Random;

namespace
{
    struct Item
    {
        std::uint32_t priority;
        std::uint32_t number;
    };

    /** What waits, by priority, in the order in which it came. */
    using Oracle = std::map<std::uint32_t, std::vector<std::uint32_t>>;

    std::uint32_t upTo(Random &random, std::uint32_t most)
    {
        return static_cast<std::uint32_t>(random.index(most + 1));
    }
}  // namespace

TEST(MonotoneQueue, isAPriorityQueue)
{
    // How far ahead of what was taken last items are pushed: nearby, at the border of what is told apart at a time, and
    // far beyond.
    for (const std::uint32_t ahead : {0u, 3u, 40u, 1022u, 1023u, 1024u, 5000u, 1000000u})
    {
        SCOPED_TRACE(ahead);
        Random random(7);
        MonotoneQueue<Item> queue;
        Oracle oracle;
        std::size_t size = 0;
        std::uint32_t last = 10;
        for (std::uint32_t step = 0; step < 20000; ++step)
        {
            ASSERT_EQ(queue.empty(), oracle.empty());
            ASSERT_EQ(queue.size(), size);
            const bool grows = step % 2000 < 1000;
            if (oracle.empty() || random.between(0.0, 1.0) < (grows ? 0.6 : 0.3))
            {
                const std::uint32_t priority = last + upTo(random, ahead);
                queue.push(priority, {priority, step});
                oracle[priority].push_back(step);
                ++size;
                continue;
            }
            const auto least = oracle.begin();
            const Item item = queue.pop();
            ASSERT_EQ(item.priority, least->first) << "step " << step;
            const auto found = std::find(least->second.begin(), least->second.end(), item.number);
            ASSERT_NE(found, least->second.end()) << "each comes out once";
            least->second.erase(found);
            if (least->second.empty())
                oracle.erase(least);
            last = item.priority;
            --size;
        }
    }
}

TEST(MonotoneQueue, takesOfEqualPrioritiesTheLastOne)
{
    MonotoneQueue<Item> queue;
    for (std::uint32_t number = 0; number < 5; ++number)
        queue.push(7, {7, number});
    for (std::uint32_t number = 5; number-- > 0;)
        EXPECT_EQ(queue.pop().number, number);
}

TEST(MonotoneQueue, takesWhatIsPushedTooLowNext)
{
    MonotoneQueue<Item> queue;
    queue.push(100, {100, 0});
    queue.push(101, {101, 1});
    EXPECT_EQ(queue.pop().number, 0u);
    queue.push(3, {3, 2});
    EXPECT_EQ(queue.pop().number, 2u);
    EXPECT_EQ(queue.pop().number, 1u);
    EXPECT_TRUE(queue.empty());
}

TEST(MonotoneQueue, forgetsOnClear)
{
    MonotoneQueue<Item> queue;
    for (int round = 0; round < 3; ++round)
    {
        for (const std::uint32_t priority : {5u, 1u, 90u, 100000u})
            queue.push(priority, {priority, 0});
        EXPECT_EQ(queue.pop().priority, 1u);
        EXPECT_EQ(queue.pop().priority, 5u);
        EXPECT_GT(queue.bytes(), 0u);
        queue.clear();
        EXPECT_TRUE(queue.empty());
        queue.push(2, {2, 1});
        EXPECT_EQ(queue.pop().number, 1u) << "and not what was left in the round before";
        EXPECT_TRUE(queue.empty());
        queue.clear();
    }
}

TEST(MonotoneQueue, takesNewPriorities)
{
    for (const std::uint32_t widest : {20u, 900u, 16000u})
    {
        SCOPED_TRACE(widest);
        Random random(11);
        MonotoneQueue<Item> queue;
        std::vector<std::uint32_t> kept;
        const auto takeLeast = [&]
        {
            const auto least = std::min_element(kept.begin(), kept.end());
            const std::uint32_t expected = *least;
            kept.erase(least);
            return expected;
        };
        for (int round = 0; round < 20; ++round)
        {
            const std::uint32_t first = kept.empty() ? 0 : *std::max_element(kept.begin(), kept.end());
            for (std::uint32_t i = 0; i < 300; ++i)
            {
                const std::uint32_t priority = first + upTo(random, widest);
                queue.push(priority, {priority, i});
                kept.push_back(priority);
            }
            EXPECT_EQ(queue.size(), kept.size());
            for (int i = 0; i < 50; ++i)
                ASSERT_EQ(queue.pop().priority, takeLeast());
            // What was last is first now, and every third priority is dropped.
            const std::uint32_t last = *std::max_element(kept.begin(), kept.end());
            queue.renewAll(
                [last](Item &item, std::uint32_t &priority)
                {
                    const bool isKept = item.priority % 3 != 0;
                    priority = item.priority = last - item.priority;
                    return isKept;
                });
            std::vector<std::uint32_t> left;
            for (const std::uint32_t priority : kept)
                if (priority % 3 != 0)
                    left.push_back(last - priority);
            kept = left;
        }
        while (!kept.empty())
            ASSERT_EQ(queue.pop().priority, takeLeast());
        EXPECT_TRUE(queue.empty());
        queue.renewAll([](Item &, std::uint32_t &) { return true; });
        EXPECT_TRUE(queue.empty());
    }
}

// The queue of the ways round obstacles, against the standard library's.

#include "benchmarks/worlds/Random.h"
#include "ompl_improved_astar/search/containers/MonotoneQueue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <queue>
#include <vector>

using parking::search::MonotoneQueue;
using parking_test::Random;

namespace
{
    struct Item
    {
        std::uint64_t key;
    };

    /** The priority in the upper part of the key, as its users have it. */
    Item itemOf(float priority, std::uint64_t rest)
    {
        return {static_cast<std::uint64_t>(static_cast<double>(priority) * 1024.0) << 20 | rest};
    }

    using Oracle = std::priority_queue<std::uint64_t, std::vector<std::uint64_t>, std::greater<>>;
}  // namespace

TEST(MonotoneQueue, isAPriorityQueue)
{
    // How far ahead of what was taken last items are pushed, in priorities: within a bucket, within those that are told
    // apart at a time, far beyond them, and behind.
    for (const double ahead : {0.01, 3.0, 40.0, 500.0, 20000.0, -3.0})
    {
        SCOPED_TRACE(ahead);
        Random random(7);
        MonotoneQueue<Item> queue;
        Oracle oracle;
        double last = 10.0;
        for (int step = 0; step < 20000; ++step)
        {
            EXPECT_EQ(queue.empty(), oracle.empty());
            const bool grows = step % 2000 < 1000;
            if (oracle.empty() || random.between(0.0, 1.0) < (grows ? 0.6 : 0.3))
            {
                const double away = ahead < 0.0 ? random.between(ahead, 3.0) : random.between(0.0, ahead);
                const auto priority = static_cast<float>(std::max(0.0, last + away));
                const Item item = itemOf(priority, random.index(1000));
                queue.push(priority, item);
                oracle.push(item.key);
                continue;
            }
            ASSERT_EQ(queue.pop().key, oracle.top()) << "step " << step;
            last = static_cast<double>(oracle.top() >> 20) / 1024.0;
            oracle.pop();
        }
        for (; !oracle.empty(); oracle.pop())
            ASSERT_EQ(queue.pop().key, oracle.top());
        EXPECT_TRUE(queue.empty());
    }
}

TEST(MonotoneQueue, forgetsOnClear)
{
    MonotoneQueue<Item> queue;
    for (int round = 0; round < 3; ++round)
    {
        for (const float priority : {5.0f, 0.5f, 90.0f, 1e5f})
            queue.push(priority, itemOf(priority, 0));
        EXPECT_EQ(queue.pop().key, itemOf(0.5f, 0).key);
        EXPECT_EQ(queue.pop().key, itemOf(5.0f, 0).key);
        EXPECT_GT(queue.bytes(), 0u);
        queue.clear();
        EXPECT_TRUE(queue.empty());
        queue.push(1.0f, itemOf(1.0f, 1));
        EXPECT_EQ(queue.pop().key, itemOf(1.0f, 1).key) << "and not what was left in the round before";
        EXPECT_TRUE(queue.empty());
        queue.clear();
    }
}

TEST(MonotoneQueue, takesNewPriorities)
{
    for (const double widest : {0.5, 20.0, 500.0})
    {
        SCOPED_TRACE(widest);
        Random random(11);
        MonotoneQueue<Item> queue;
        std::vector<std::uint64_t> kept;
        for (int round = 0; round < 20; ++round)
        {
            for (std::size_t i = 0; i < 300; ++i)
            {
                const auto priority = static_cast<float>(random.between(0.0, widest));
                const Item item = itemOf(priority, i);
                queue.push(priority, item);
                kept.push_back(item.key);
            }
            EXPECT_EQ(queue.size(), kept.size());
            for (int i = 0; i < 50; ++i)
            {
                const auto least = std::min_element(kept.begin(), kept.end());
                ASSERT_EQ(queue.pop().key, *least);
                kept.erase(least);
            }
            // What was last is first now, and every third item is dropped.
            const auto renewed = [widest](std::uint64_t key)
            {
                const double priority = static_cast<double>(key >> 20) / 1024.0;
                return key % 3 == 0 ? -1.0f : static_cast<float>(widest - priority);
            };
            queue.renewAll(
                [&renewed](Item &item)
                {
                    const float priority = renewed(item.key);
                    item = itemOf(std::max(0.0f, priority), item.key % 1000);
                    return priority;
                });
            std::vector<std::uint64_t> left;
            for (const std::uint64_t key : kept)
                if (const float priority = renewed(key); priority >= 0.0f)
                    left.push_back(itemOf(priority, key % 1000).key);
            kept = left;
        }
        std::sort(kept.begin(), kept.end());
        for (const std::uint64_t key : kept)
            ASSERT_EQ(queue.pop().key, key);
        EXPECT_TRUE(queue.empty());
        queue.renewAll([](Item &) { return 1.0f; });
        EXPECT_TRUE(queue.empty());
    }
}

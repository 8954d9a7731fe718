// The queue of the ways round obstacles, against the standard library's.

#include "benchmarks/worlds/Random.h"
#include "ompl_improved_astar/search/containers/MonotoneQueue.h"

#include <gtest/gtest.h>

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

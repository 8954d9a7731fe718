// The queue of the routes round obstacles, compared with the standard library's.

#include "benchmarks/worlds/Random.h"
#include "ompl_improved_astar/search/containers/MonotoneQueue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <queue>
#include <vector>

using parking::search::MonotoneQueue;
using Baseline = std::priority_queue<std::uint32_t, std::vector<std::uint32_t>, std::greater<>>;

TEST(MonotoneQueue, isAPriorityQueue)
{
    MonotoneQueue<std::uint32_t> queue;  // each item is its own priority
    for (const std::uint32_t ahead : {0u, 3u, 40u, 5000u, 1000000u})
    {
        SCOPED_TRACE(ahead);
        parking_test::Random random(7);
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

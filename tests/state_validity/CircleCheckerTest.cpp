#include "state_validity/CircleChecker.h"

#include <chrono>

#include <gtest/gtest.h>

using namespace parking;

namespace
{
    /** A circle of one metre; a wall ends at x = -1. */
    const CircleChecker &besideAWall()
    {
        static const CircleChecker checker(
            ObstacleSet::fromPolygons({{{-2.0, -5.0}, {-1.0, -5.0}, {-1.0, 5.0}, {-2.0, 5.0}}},
                                      Box{{-10.0, -10.0}, {10.0, 10.0}}),
            1.0);
        return checker;
    }
}  // namespace

TEST(CircleChecker, MayLeaveAWallThatItAllButTouches)
{
    const CircleChecker &checker = besideAWall();
    for (const double gap : {1e-7, 1e-5, 2e-4, 4e-4, 6e-4, 2e-3})
    {
        ASSERT_TRUE(checker.isFree(gap, 0.0));
        EXPECT_EQ(checker.freeShare({gap, 0.0, 0.0}, {3.0, 0.0, 0.0}), 1.0) << gap;
        EXPECT_EQ(checker.freeShare({gap, 0.0, 0.0}, {3.0, 2.0, 0.0}), 1.0) << gap;
        EXPECT_LT(checker.freeShare({gap, 0.0, 0.0}, {-0.5, 0.0, 0.0}), 0.01) << gap;
    }
}

TEST(CircleChecker, ComesNoNearerThanItKeeps)
{
    const CircleChecker &checker = besideAWall();
    // Towards the wall up to a millimetre from it, or not at all from less.
    EXPECT_NEAR(3.0 * checker.freeShare({2.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}), 2.0 - 1e-3, 1e-3);
    EXPECT_LT(3.0 * checker.freeShare({5e-4, 0.0, 0.0}, {-3.0 + 5e-4, 0.0, 0.0}), 1e-3);
    EXPECT_EQ(checker.freeShare({0.0, 0.0, 0.0}, {3.0, 0.0, 0.0}), 0.0);
    // Along the wall steps are as short as the gap, and there are not very many of them.
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_LT(checker.freeShare({1e-8, -2.0, 0.0}, {1e-8, 2.0, 0.0}), 1e-3);
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 1.0);
}

// Whose turn it is among the levels of a frontier.

#include "ompl_improved_astar/search/Frontier.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

using namespace parking::search;

namespace
{
    constexpr std::size_t LEVELS = 4;
    constexpr double RATIO = 4.0;

    /** On all levels something is open, and stays so. */
    void begin(Frontier &frontier)
    {
        frontier.begin("binary_heap", LEVELS, RATIO);
        const NodeIndex root = frontier.addRoot({0.0, 0.0, 0.0});
        for (std::size_t level = 0; level < LEVELS; ++level)
            frontier.push(0, level, 1.0, 1.0, root);
    }

    std::vector<std::size_t> turns(Frontier &frontier, std::size_t count)
    {
        std::vector<std::size_t> levels;
        for (std::size_t i = 0; i < count; ++i)
        {
            levels.push_back(frontier.chooseLevel(0));
            frontier.countTurn(0, levels.back());
        }
        return levels;
    }
}  // namespace

TEST(Frontier, finerLevelsGetTheirShareOfTheTurns)
{
    Frontier frontier(Side::Start);
    begin(frontier);
    std::vector<std::size_t> counts(LEVELS, 0);
    for (const std::size_t level : turns(frontier, 64 + 16 + 4 + 1))
        ++counts[level];
    EXPECT_EQ(counts, (std::vector<std::size_t>{64, 16, 4, 1}));
}

/** A search that ends soon would spend a good part of its expansions on fine levels otherwise. */
TEST(Frontier, aFinerLevelWaitsForItsFirstTurnAsLongAsForTheOthers)
{
    Frontier frontier(Side::Goal);
    begin(frontier);
    std::vector<std::size_t> coarserBefore(LEVELS, 0);
    const std::vector<std::size_t> levels = turns(frontier, 200);
    for (std::size_t level = 1; level < LEVELS; ++level)
        for (std::size_t i = 0; i < levels.size() && levels[i] != level; ++i)
            coarserBefore[level] += levels[i] == level - 1 ? 1 : 0;
    for (std::size_t level = 1; level < LEVELS; ++level)
    {
        EXPECT_GE(coarserBefore[level], 3u) << level;
        EXPECT_LE(coarserBefore[level], 4u) << level;
    }
}

TEST(Frontier, aLevelWithoutOpenNodesIsPassedOver)
{
    Frontier frontier(Side::Start);
    frontier.begin("binary_heap", LEVELS, RATIO);
    frontier.push(0, 2, 1.0, 1.0, frontier.addRoot({0.0, 0.0, 0.0}));
    for (const std::size_t level : turns(frontier, 10))
        EXPECT_EQ(level, 2u);
}

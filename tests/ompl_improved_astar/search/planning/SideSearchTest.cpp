// A search that begins again and again: what it counts is the sum of what separate searches count.

#include "ompl_improved_astar/search/planning/SideSearch.h"
#include "tests/ompl_improved_astar/search/CarProblems.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <tuple>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    void addRoots(Search &search, const CarProblem &problem)
    {
        for (const Pose &start : problem.starts)
            search.addStart(start);
        for (const Pose &goal : problem.goals)
            search.addGoal(goal);
    }

    void expectSame(const SearchStatistics &a, const SearchStatistics &b)
    {
        const auto all = [](const SearchStatistics &each)
        {
            return std::tie(each.expanded, each.generated, each.connections, each.heuristicCells,
                            each.openListOperations, each.openListComparisons);
        };
        EXPECT_EQ(all(a), all(b));
    }
}  // namespace

TEST(SideSearch, countsWhatAllOfThemDidInAQuery)
{
    SideSearch side;
    for (std::uint64_t query = 0; query < 3; ++query)
    {
        side.forget();
        EXPECT_FALSE(side.isUnderWay());
        EXPECT_EQ(side.expanded(), 0u);
        SearchStatistics sum;
        for (std::uint64_t seed = 0; seed < 4; ++seed)
        {
            CarProblem problem = randomProblem(10 * query + seed);
            const SearchParameters parameters = parametersIn(problem);
            Search alone;
            alone.begin(problem.world, parameters);
            addRoots(alone, problem);
            alone.run({}, 50);

            Search &search = side.begin(problem.world, parameters);
            EXPECT_TRUE(side.isUnderWay());
            EXPECT_EQ(&search, &side.search());
            addRoots(search, problem);
            search.run({}, 50);
            sum += alone.statistics();
            expectSame(side.statistics(), sum);
            EXPECT_EQ(side.expanded(), sum.expanded);
            // Some are ended, others are by the next one's beginning.
            if (seed % 2 == 0)
                side.end();
            EXPECT_EQ(side.isUnderWay(), seed % 2 != 0);
            expectSame(side.statistics(), sum);
        }
        EXPECT_GT(sum.expanded, 0u);
        side.end();
        side.end();
        expectSame(side.statistics(), sum);
    }
}

TEST(SideSearch, stillHasWhatOneFoundThatHasEnded)
{
    SideSearch side;
    CarProblem problem = tightSlot();
    addRoots(side.begin(problem.world, parametersIn(problem)), problem);
    ASSERT_EQ(side.search().run({}, 10000), SearchOutcome::Improved);
    const double cost = side.search().bestCost();
    side.end();
    EXPECT_EQ(side.search().bestCost(), cost);
    EXPECT_EQ(faultOf(side.search().bestPath(), problem.world, problem.starts, problem.goals, TURNING_RADIUS), "");
}

// Spreading out: nodes in places that are crowded wait.

#include "ompl_improved_astar/search/Search.h"
#include "tests/ompl_improved_astar/search/CarProblems.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    constexpr std::uint64_t MOST_EXPANSIONS = 6000;

    /** An aisle with a bay on one side, and the car at its closed end. It faces that end, and should at the goal, too,
       at the other end: it can turn round in the bay only. Looking ahead comes to either end with the wrong heading. */
    CarProblem aisleWithABay(double length, double bay, double width = 4.6)
    {
        const Box world{{0.0, 0.0}, {length, width + 7.0}};
        CarProblem problem{DiscCarWorld(world), {{length - 6.0, 0.5 * width, PI}}, {{5.0, 0.5 * width, 0.0}}};
        problem.world.boxes = {{{0.0, width}, {bay, width + 7.0}}, {{bay + 6.5, width}, {length, width + 7.0}}};
        return problem;
    }

    SearchParameters parametersIn(const CarProblem &problem, bool spreadOut)
    {
        SearchParameters parameters = parking_test::parametersIn(problem);
        parameters.spreadOut = spreadOut;
        return parameters;
    }

    std::size_t waiting(const Search &search)
    {
        std::size_t count = 0;
        for (const Side side : {Side::Start, Side::Goal})
            for (const Node &node : search.frontier(side).nodes())
                count += node.wait > 0.0f;
        return count;
    }
}  // namespace

/** Detours and exploration, which lead there, too, when the search is stuck, are off. */
TEST(SearchSpreading, findsWhereToTurnRound)
{
    int sooner = 0, later = 0;
    for (double length = 80.0; length < 150.0; length += 10.0)
        for (double bay = 10.0; bay < 55.0; bay += 5.0)
        {
            SCOPED_TRACE(testing::Message() << length << ' ' << bay);
            CarProblem problem = aisleWithABay(length, bay);
            Search search;
            SearchParameters parameters = parametersIn(problem, true);
            parameters.detours = false;
            isSolved(search, problem, parameters, MOST_EXPANSIONS);
            const std::uint64_t with = search.expanded();
            parameters.spreadOut = false;
            isSolved(search, problem, parameters, MOST_EXPANSIONS);
            EXPECT_EQ(waiting(search), 0u);
            sooner += with < search.expanded() ? 1 : 0;
            later += with > search.expanded() ? 1 : 0;
            for (const bool spreadOut : {true, false})
                EXPECT_TRUE(isSolved(search, problem, parametersIn(problem, spreadOut), MOST_EXPANSIONS));
        }
    EXPECT_GT(sooner, 3 * later);
    EXPECT_GT(sooner, 30);
}

// No longer than for so many expansions, and longer when their turn comes than when they were put into the queue.
TEST(SearchSpreading, waitsHaveAnEndAndGrow)
{
    std::uint64_t growing = 0, fixed = 0;
    double longest = 0.0;
    const SearchTuning tuning;
    const double most = tuning.waitPerExpansion * tuning.mostCrowded * TURNING_RADIUS;
    for (const double bay : {10.0, 30.0, 50.0})
    {
        CarProblem problem = aisleWithABay(120.0, bay);
        SearchParameters parameters = parametersIn(problem, true);
        Search search;
        const Search &searched = search;
        EXPECT_TRUE(isSolved(search, problem, parameters, MOST_EXPANSIONS));
        growing += search.expanded();
        for (const Side side : {Side::Start, Side::Goal})
            for (const Node &node : searched.frontier(side).nodes())
                longest = std::max<double>(longest, node.wait);
        parameters.tuning.longerWait = 1e9;
        EXPECT_TRUE(isSolved(search, problem, parameters, MOST_EXPANSIONS));
        fixed += search.expanded();
    }
    EXPECT_NEAR(longest, most, 1e-3);
    EXPECT_NE(growing, fixed);
}

TEST(SearchSpreading, endsWithTheFirstSolution)
{
    CarProblem problem = aisleWithABay(120.0, 30.0);
    Search search;
    const Search &searched = search;
    ASSERT_TRUE(isSolved(search, problem, parametersIn(problem, true), MOST_EXPANSIONS));
    EXPECT_GT(waiting(search), 0u);
    std::size_t before[2], later = 0;
    for (const Side side : {Side::Start, Side::Goal})
        before[static_cast<std::size_t>(side)] = searched.frontier(side).nodes().size();
    const std::uint64_t most = search.expanded() + 300;
    while (search.run({}, most) == SearchOutcome::Improved)
        continue;
    for (const Side side : {Side::Start, Side::Goal})
    {
        const std::vector<Node> &nodes = searched.frontier(side).nodes();
        for (std::size_t i = before[static_cast<std::size_t>(side)]; i < nodes.size(); ++i, ++later)
            EXPECT_EQ(nodes[i].wait, 0.0f);
    }
    EXPECT_GT(later, 50u);
}

TEST(SearchSpreading, isNotForWhatIsNearestToATarget)
{
    CarProblem problem = aisleWithABay(80.0, 30.0);
    Search search;
    search.begin(problem.world, parametersIn(problem, true));
    search.addStart(problem.starts.front());
    search.setTarget(problem.goals.front());
    search.run({}, 500);
    EXPECT_GT(search.expanded(), 50u);
    EXPECT_EQ(waiting(search), 0u);
}

TEST(SearchSpreading, neverMakesABoundWait)
{
    for (std::uint64_t seed = 1; seed <= 6; ++seed)
    {
        SCOPED_TRACE(seed);
        std::uint64_t expanded[2];
        double cost[2], bound[2];
        for (const bool spreadOut : {false, true})
        {
            CarProblem problem = randomProblem(seed);
            SearchParameters parameters = parametersIn(problem, spreadOut);
            parameters.weights.far = parameters.weights.near = 1.0;
            parameters.weights.tieBreak = 0.0;
            Search search;
            isSolved(search, problem, parameters, MOST_EXPANSIONS);
            EXPECT_EQ(waiting(search), 0u);
            expanded[spreadOut] = search.expanded();
            cost[spreadOut] = search.bestCost();
            bound[spreadOut] = search.lowerBound();
        }
        EXPECT_EQ(expanded[false], expanded[true]);
        EXPECT_EQ(cost[false], cost[true]);
        EXPECT_EQ(bound[false], bound[true]);
    }
}

// Whatever waits, waits for its turn: where there is no way all that was reached is expanded in the end.
TEST(SearchSpreading, leavesNothingOut)
{
    const Box world{{0.0, 0.0}, {60.0, 20.0}};
    CarProblem problem{DiscCarWorld(world, {{{24.0, 0.0}, {25.0, 20.0}}}), {{6.0, 10.0, 0.0}}, {{45.0, 10.0, 0.0}}};
    SearchParameters parameters = parametersIn(problem, true);
    parameters.adaptiveResolution = parameters.obstacleHeuristic = parameters.detours = false;
    Search search;
    problem.begin(search, parameters);
    EXPECT_EQ(search.run({}), SearchOutcome::Exhausted);
    EXPECT_EQ(search.exhaustion(), Exhaustion::SearchedOut);
    EXPECT_GT(waiting(search), 100u);
    std::size_t exhausted = 0;
    const Search &searched = search;
    for (const Side side : {Side::Start, Side::Goal})
        if (const Frontier &frontier = searched.frontier(side); frontier.isExhausted())
        {
            ++exhausted;
            EXPECT_GT(frontier.nodes().size(), 100u);
            for (const Node &node : frontier.nodes())
                EXPECT_TRUE(node.isExpanded());
        }
    EXPECT_GT(exhausted, 0u);
}

TEST(SearchSpreading, solvesWhatIsSolvedWithout)
{
    for (std::uint64_t seed = 1; seed <= 40; ++seed)
    {
        SCOPED_TRACE(seed);
        CarProblem problem = randomProblem(seed, 14);
        Search with, without;
        EXPECT_EQ(isSolved(with, problem, parametersIn(problem, true), MOST_EXPANSIONS),
                  isSolved(without, problem, parametersIn(problem, false), MOST_EXPANSIONS));
    }
}

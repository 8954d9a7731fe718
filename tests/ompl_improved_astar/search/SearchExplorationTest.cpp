// Exploration: a search that is stuck looks where it has not been.

#include "ompl_improved_astar/search/Search.h"
#include "tests/ompl_improved_astar/search/CarProblems.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    constexpr std::uint64_t MOST_EXPANSIONS = 6000;

    /** Walls, one inside of the other, each with a gap: in a side, or at a corner, one further on each time. The way
        from lane to lane turns by a quarter in the gap, and the car may have to get there with the other end first. */
    DiscCarWorld lanes(double lane, double gap, bool atCorners)
    {
        constexpr double SIZE = 56.0, WALL = 0.3;
        DiscCarWorld world({{0.0, 0.0}, {SIZE, SIZE}});
        for (int i = 1; SIZE - 2.0 * i * lane > 2.0 * gap; ++i)
        {
            const double low = i * lane, high = SIZE - low;
            for (int side = 0; side < 4; ++side)
            {
                const double across = side % 2 == 0 ? low : high;
                const auto wall = [&](double from, double to)
                {
                    if (side < 2)
                        world.boxes.push_back({{from, across}, {to, across + WALL}});
                    else
                        world.boxes.push_back({{across, from}, {across + WALL, to}});
                };
                const double middle = atCorners ? high - 0.5 * gap : 0.5 * SIZE;
                const bool isOpen = side == i % 4;
                wall(low, isOpen ? middle - 0.5 * gap : high + WALL);
                if (isOpen)
                    wall(middle + 0.5 * gap, high + WALL);
            }
        }
        return world;
    }

    /** Not exploring, nodes of both sides that are in the same place are still joined. */
    SearchParameters parametersIn(const CarProblem &problem, bool exploring)
    {
        SearchParameters parameters = parking_test::parametersIn(problem);
        if (!exploring)
            parameters.tuning.explorationPeriod = std::numeric_limits<std::uint64_t>::max();
        return parameters;
    }
}  // namespace

TEST(SearchExploration, findsWhatNoGuideShows)
{
    std::uint64_t with = 0, without = 0;
    for (const double lane : {5.0, 5.5})
        for (const double gap : {5.0, 6.0})
            for (const bool atCorners : {false, true})
                for (std::uint64_t seed = 1; seed <= 10; ++seed)
                {
                    CarProblem problem = randomProblemIn(lanes(lane, gap, atCorners), seed);
                    Search search;
                    EXPECT_TRUE(isSolved(search, problem, parametersIn(problem, true), MOST_EXPANSIONS));
                    with += search.expanded();
                    EXPECT_TRUE(isSolved(search, problem, parametersIn(problem, false), MOST_EXPANSIONS));
                    without += search.expanded();
                }
    EXPECT_LT(10 * with, 7 * without);
}

// Where nothing is known of the room, no disc shows another way, either. Of 600 such fields 171 take 60 expansions or
// more; the first three of these are not solved without it, and one (seed 446) only without it. The others are two of
// the next 600.
TEST(SearchExploration, findsWaysWithoutDiscs)
{
    for (const std::uint64_t seed : {185u, 260u, 574u, 911u, 984u})
    {
        SCOPED_TRACE(seed);
        CarProblem problem = randomProblem(seed, 14);
        problem.world.tellsRoom = false;
        Search search;
        EXPECT_TRUE(isSolved(search, problem, parametersIn(problem, true), MOST_EXPANSIONS));
        EXPECT_FALSE(isSolved(search, problem, parametersIn(problem, false), MOST_EXPANSIONS));
    }
}

// The frontier that is not to grow does not grow by being explored.
TEST(SearchExploration, keepsToTheSideThatIsSearched)
{
    int explored = 0;
    for (std::uint64_t seed = 1; seed <= 5; ++seed)
        for (const bool fromGoal : {false, true})
        {
            CarProblem problem = randomProblemIn(lanes(5.0, 5.0, true), seed);
            std::uint64_t expanded[2];
            for (const bool exploring : {false, true})
            {
                SearchParameters parameters = parametersIn(problem, exploring);
                parameters.bidirectional = false;
                parameters.searchFromGoal = fromGoal;
                Search search;
                const Search &searched = search;
                EXPECT_TRUE(isSolved(search, problem, parameters, MOST_EXPANSIONS));
                EXPECT_EQ(searched.frontier(fromGoal ? Side::Start : Side::Goal).nodes().size(), 1u);
                expanded[exploring] = search.expanded();
            }
            explored += expanded[true] != expanded[false];
        }
    EXPECT_GT(explored, 3);
}

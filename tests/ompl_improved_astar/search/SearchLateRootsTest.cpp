// Starts and goals that are added while searching.

#include "ompl_improved_astar/search/Search.h"
#include "tests/ompl_improved_astar/search/CarProblems.h"

#include <gtest/gtest.h>

#include <cstdint>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

TEST(SearchLateRoots, goalsAddedLaterAreReached)
{
    for (const bool bidirectional : {true, false})
        for (const double nearWeight : {3.0, 0.5})
        {
            SCOPED_TRACE(nearWeight);
            CarProblem problem{twoRooms(0.0), {{-9.0, -2.0, 0.5 * PI}}, {{6.0, 0.0, 0.0}}};
            // The new goal stands behind a wall in the start's own room.
            problem.world.boxes.push_back({{-6.0, -6.0}, {-5.6, 2.2}});
            SearchParameters parameters = carParameters();
            parameters.bidirectional = bidirectional;
            parameters.searchFromGoal = false;
            parameters.weights = {3.0, nearWeight, 30.0, 1e-3};
            Search search;
            problem.begin(search, parameters);
            EXPECT_EQ(search.run([&] { return search.statistics().expanded >= 30; }), SearchOutcome::Stopped);
            const Pose goal{-3.5, -4.0, 0.5 * PI};
            ASSERT_GT(problem.world.gap(goal), 0.0);
            search.addGoal(goal);
            ASSERT_EQ(search.run(afterAsking()), SearchOutcome::Improved);
            EXPECT_EQ(faultOf(search.bestPath(), problem.world, problem.starts, {goal}, TURNING_RADIUS), "");
        }
}

TEST(SearchLateRoots, goalsAddedWhenThereIsNothingLeftAreReached)
{
    // The first goal is in a cage, the second in the field with the start: the nodes that are expanded by then have to
    // be joined with it, or no one else will.
    int solved = 0;
    for (std::uint64_t seed = 0; seed < 4; ++seed)
        for (const bool bidirectional : {true, false})
            for (const bool searchFromGoal : {true, false})
            {
                SCOPED_TRACE(seed);
                CarProblem problem = randomProblem(seed, 14);
                const Pose later = problem.goals.front();
                problem.world.inside.max.x() = 40.0;
                problem.world.boxes.insert(problem.world.boxes.end(), {{{12.0, -12.0}, {12.5, 12.0}},
                                                                       {{24.0, -3.0}, {31.0, -2.5}},
                                                                       {{24.0, 2.5}, {31.0, 3.0}},
                                                                       {{24.0, -2.5}, {24.5, 2.5}},
                                                                       {{30.5, -2.5}, {31.0, 2.5}}});
                problem.goals = {{26.0, 0.0, 0.0}};
                ASSERT_GT(problem.world.gap(problem.goals.front()), 0.0);
                SearchParameters parameters = carParameters();
                parameters.bidirectional = bidirectional;
                parameters.searchFromGoal = searchFromGoal;
                parameters.adaptiveResolution = parameters.obstacleHeuristic = false;
                Search search;
                problem.begin(search, parameters);
                ASSERT_EQ(search.run(afterAsking()), SearchOutcome::Exhausted);
                CarProblem alone{problem.world, problem.starts, {later}};
                Search fresh;
                alone.begin(fresh, parameters);
                if (fresh.run(afterAsking()) != SearchOutcome::Improved)
                    continue;
                ++solved;
                search.addGoal(later);
                ASSERT_EQ(search.run(afterAsking()), SearchOutcome::Improved);
                EXPECT_EQ(faultOf(search.bestPath(), problem.world, problem.starts, {later}, TURNING_RADIUS), "");
            }
    EXPECT_GT(solved, 8);
}

TEST(SearchLateRoots, changedHeuristicsDoNotLoseOpenNodes)
{
    // With a weight that falls near the goal, a goal added close by lowers what the open nodes are worth.
    CarProblem problem{twoRooms(0.0), {{-9.0, -2.0, 0.5 * PI}}, {{6.0, 0.0, 0.0}}};
    problem.world.boxes.push_back({{-6.0, -6.0}, {-5.6, 2.2}});
    SearchParameters parameters = carParameters();
    parameters.bidirectional = false;
    parameters.searchFromGoal = false;
    parameters.adaptiveResolution = false;
    parameters.weights = {3.0, 0.1, 9.0, 0.0};
    Search search;
    problem.begin(search, parameters);
    EXPECT_EQ(search.run([&] { return search.statistics().expanded >= 1; }), SearchOutcome::Stopped);
    search.addGoal({-3.5, -4.0, 0.5 * PI});
    EXPECT_EQ(search.run(afterAsking()), SearchOutcome::Improved);
}

TEST(SearchLateRoots, startsAddedLaterAreUsed)
{
    CarProblem problem{twoRooms(0.0), {{-9.0, 0.0, 0.0}}, {{9.0, -2.0, 0.5 * PI}}};
    problem.world.boxes.push_back({{5.6, -6.0}, {6.0, 2.2}});
    SearchParameters parameters = carParameters();
    parameters.inscribedRadius = problem.world.radius;
    Search search;
    problem.begin(search, parameters);
    EXPECT_EQ(search.run(afterAsking()), SearchOutcome::Exhausted);
    const Pose start{3.5, -4.0, 0.5 * PI};
    search.addStart(start);
    ASSERT_EQ(search.run(afterAsking()), SearchOutcome::Improved);
    EXPECT_EQ(faultOf(search.bestPath(), problem.world, {start}, problem.goals, TURNING_RADIUS), "");
}

TEST(SearchLateRoots, aGoalAfterATargetIsReached)
{
    CarProblem problem{twoRooms(3.0), {{-9.0, 0.0, 0.0}}, {}};
    Search search;
    problem.begin(search, carParameters());
    search.setTarget({-11.9, -5.9, 0.0});
    EXPECT_EQ(search.run([&] { return search.statistics().expanded >= 200; }), SearchOutcome::Stopped);
    const Pose goal{9.0, 2.0, 0.5 * PI};
    search.addGoal(goal);
    ASSERT_EQ(search.run([&] { return search.statistics().expanded >= 5000; }), SearchOutcome::Improved);
    EXPECT_EQ(faultOf(search.bestPath(), problem.world, problem.starts, {goal}, TURNING_RADIUS), "");
}

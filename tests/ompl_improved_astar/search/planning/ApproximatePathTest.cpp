// Paths of the planner without OMPL to goals that cannot be reached.

#include "ompl_improved_astar/search/planning/PathPlanner.h"
#include "tests/ompl_improved_astar/search/CarProblems.h"

#include <gtest/gtest.h>

#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;
using Outcome = PathPlanner::Outcome;

TEST(ApproximatePath, endsAsNearAsTheCarComes)
{
    // The goal stands free, but behind a door that is closed or too narrow; or there is no goal at all.
    const std::vector<CarProblem> problems{{twoRooms(0.0), {{-9.0, 0.0, 0.0}}, {{6.0, 0.0, 0.0}}},
                                           {twoRooms(0.0), {{-9.0, 4.0, 1.0}}, {{1.6, -3.0, 0.0}}},
                                           {twoRooms(1.7), {{-9.0, 0.0, 0.0}}, {{6.0, 0.0, 0.0}}}};
    for (std::size_t i = 0; i < problems.size(); ++i)
        for (const bool goalKnown : {true, false})
            for (const bool bidirectional : {true, false})
                for (const bool roomTold : {true, false})
                {
                    SCOPED_TRACE(testing::Message() << "problem " << i << ", goal " << goalKnown << ", bidirectional "
                                                    << bidirectional << ", room " << roomTold);
                    CarProblem problem = problems[i];
                    problem.world.tellsRoom = roomTold;
                    const Pose target = problem.goals.front();
                    if (!goalKnown)
                        problem.goals.clear();
                    PathPlannerParameters parameters = parametersFor(problem);
                    parameters.search.bidirectional = bidirectional;
                    PathPlanner planner;
                    problem.begin(planner, parameters);
                    if (goalKnown)
                    {
                        const Outcome outcome = planner.solve(afterAsking(4000), nullptr);
                        // What the disc in the car surely cannot pass is known to be hopeless at once; a door a
                        // little too narrow for it is not.
                        if (roomTold && i < 2)
                        {
                            ASSERT_EQ(outcome, Outcome::Exhausted);
                        }
                        ASSERT_NE(outcome, Outcome::Solved);
                    }
                    Path path;
                    ASSERT_TRUE(planner.approximate(target, nullptr, path));
                    EXPECT_EQ(faultOf(path, problem.world, problem.starts, {path.end()}, TURNING_RADIUS), "");
                    const double reached = positionDistance(path.end(), target);
                    EXPECT_LE(reached, nearestByFlooding(problem.world, problem.starts.front(), target) + 0.1);
                }
}

TEST(ApproximatePath, isFoundSoonWhereTheDiscComesNoNearer)
{
    // In front of a closed door what the car could gain by going on is millimetres. Where nobody tells how much room
    // there is, there might be a way.
    for (const bool roomTold : {true, false})
    {
        SCOPED_TRACE(roomTold);
        CarProblem problem{twoRooms(0.0), {{-9.0, 0.0, 1.0}}, {}};
        problem.world.tellsRoom = roomTold;
        PathPlanner planner;
        problem.begin(planner, parametersFor(problem));
        Path path;
        ASSERT_TRUE(planner.approximate({6.0, 0.0, 0.0}, afterAsking(1000000), path));
        if (roomTold)
            EXPECT_LT(planner.expanded(), 1500u);
        else
            EXPECT_GT(planner.expanded(), 3000u);
    }
}

TEST(ApproximatePath, countsWhatItExpands)
{
    CarProblem problem{twoRooms(0.0), {{-9.0, 0.0, 0.0}}, {{6.0, 0.0, 0.0}}};
    PathPlanner planner;
    problem.begin(planner, parametersFor(problem));
    ASSERT_EQ(planner.solve(afterAsking(1000000), nullptr), Outcome::Exhausted);
    for (int i = 0; i < 3; ++i)
    {
        const std::uint64_t before = planner.expanded();
        Path path;
        ASSERT_TRUE(planner.approximate(problem.goals.front(), afterAsking(1000000), path));
        EXPECT_GT(planner.expanded(), before);
        EXPECT_EQ(planner.expanded(), planner.statistics().expanded);
    }
}

// The planner without OMPL: anytime, its memory, and paths to what cannot be reached.

#include "ompl_improved_astar/search/planning/PathPlanner.h"
#include "tests/ompl_improved_astar/search/CarWorlds.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;
using Outcome = PathPlanner::Outcome;

namespace
{
    /** Stops once \e planner, which must outlive it, has expanded that many nodes or polled very often. */
    StopFunction afterExpanding(const PathPlanner &planner, std::uint64_t count)
    {
        return [&planner, count, poll = afterPolls(300000)]
        {
            return planner.expanded() >= count || poll();
        };
    }
}  // namespace

TEST(PathPlanner, anytimeReportsFallingCostsAndNeverGetsWorse)
{
    std::size_t improvements = 0;
    for (std::uint64_t seed = 0; seed < 14; ++seed)
    {
        SCOPED_TRACE(seed);
        CarProblem problem = seed < 3 ? maze(1 + static_cast<int>(seed)) : randomProblem(seed, 14);
        PlannerParameters parameters;
        parameters.preferredClearance = seed % 2 == 0 ? 0.0 : 0.3;
        PathPlanner once, planner;
        problem.begin(once, parameters);
        if (once.solve(afterExpanding(once, 800), {}) != Outcome::Solved)
            continue;
        parameters.anytime = true;
        std::vector<double> costs, fineCosts;
        const auto record = [&](const Path &path, double cost)
        {
            EXPECT_EQ(problem.faultOf(path), "");
            EXPECT_NEAR(cost, price(planner.search().cost(), path, problem.world).cost, 1e-6);
            EXPECT_TRUE(costs.empty() || cost < costs.back());
            costs.push_back(cost);
            CostModel bare = planner.search().cost();
            bare.clearanceCost = 0.0;
            fineCosts.push_back(price(bare, path, problem.world).cost +
                                10.0 * metresNearer(problem.world, path, parameters.preferredClearance));
            return false;
        };
        problem.begin(planner, parameters);
        planner.solve(afterExpanding(planner, 800), record);
        ASSERT_FALSE(costs.empty());
        EXPECT_EQ(costs.front(), once.bestCost()) << "the first solution is the same";
        planner.solve(afterExpanding(planner, 1400), record);
        EXPECT_EQ(planner.bestCost(), costs.back());
        // Nothing is gained by being near where the cost does not look.
        for (std::size_t i = 1; i < fineCosts.size(); ++i)
            EXPECT_LT(fineCosts[i], fineCosts[i - 1] + 1.0);
        improvements += costs.size() - 1;

        // Whoever says that a path is good enough gets no other.
        std::size_t reports = 0;
        problem.begin(planner, parameters);
        EXPECT_EQ(planner.solve(afterExpanding(planner, 800), [&](const Path &, double) { return ++reports > 0; }),
                  Outcome::Solved);
        EXPECT_EQ(reports, 1u);
    }
    EXPECT_GT(improvements, 20u);
}

TEST(PathPlanner, keepsToItsMemoryAlsoForAnApproximatePath)
{
    CarProblem problem = walledIn();
    problem.world.tellsRoom = false;
    PathPlanner planner;
    problem.begin(planner, hungryParameters());
    ASSERT_EQ(planner.solve({}, {}), Outcome::Stopped);
    EXPECT_TRUE(planner.search().isFull());
    EXPECT_LT(planner.search().memory(), std::size_t{2 * hungryParameters().maxMemoryMb} << 20) << "but for a step";
    const std::uint64_t expanded = planner.expanded();
    Path path;
    ASSERT_TRUE(planner.approximate(problem.goals[0], {}, path));
    EXPECT_EQ(problem.faultTowards(path), "");
    EXPECT_EQ(planner.expanded(), expanded) << "no second search";
}

TEST(PathPlanner, anApproximatePathEndsAsNearAsTheCarComes)
{
    // The goal is free, but behind a door that is closed or too narrow, or in a block, or outside.
    const std::vector<CarProblem> problems{{twoRooms(0.0), {{-9.0, 0.0, 0.0}}, {{6.0, 0.0, 0.0}}},
                                           {twoRooms(0.0), {{-9.0, 4.0, 1.0}}, {{1.6, -3.0, 0.0}}},
                                           {twoRooms(1.7), {{-9.0, 0.0, 0.0}}, {{6.0, 0.0, 0.0}}},
                                           {slot(3.0), {{-8.0, 8.0, 0.0}}, {{4.0, 2.0, 0.0}}},
                                           {twoRooms(3.0), {{-9.0, 4.0, 0.0}}, {{30.0, 0.0, 0.0}}}};
    for (std::size_t i = 0; i < problems.size(); ++i)
    {
        const Pose target = problems[i].goals[0];
        const double nearest = Flood(problems[i].world, problems[i].starts[0], target, false).nearest;
        for (int j = 0; j < 8; ++j)
        {
            SCOPED_TRACE(testing::Message() << "problem " << i << ", switches " << j);
            CarProblem problem = problems[i];
            problem.world.tellsRoom = j % 2 == 0;
            if (j / 4 == 1 || problem.world.gap(target) <= 0.0)
                problem.goals.clear();
            PlannerParameters parameters;
            parameters.bidirectional = j % 4 < 2;
            PathPlanner planner;
            problem.begin(planner, parameters);
            if (!problem.goals.empty())
            {
                ASSERT_NE(planner.solve(afterExpanding(planner, 1000), {}), Outcome::Solved);
            }
            Path path;
            ASSERT_TRUE(planner.approximate(target, {}, path));
            ASSERT_EQ(problem.faultTowards(path), "");
            ASSERT_LE(positionDistance(path.end(), target), nearest + 0.1);
            ASSERT_EQ(planner.expanded(), planner.statistics().expanded);
        }
    }
}

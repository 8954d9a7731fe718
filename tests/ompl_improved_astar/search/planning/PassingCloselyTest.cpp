// A first path that passes near to obstacles is compared with other ways: when, at what effort, and what comes of it.

#include "ompl_improved_astar/search/planning/PathPlanner.h"
#include "tests/ompl_improved_astar/search/CarProblems.h"
#include "tests/ompl_improved_astar/search/ClearanceWorld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <utility>

using namespace parking;
using namespace parking::search;
using namespace parking_test;
using Outcome = PathPlanner::Outcome;

namespace
{
    constexpr double NO_PATH_IS_SO_CLOSE = 2.0;  // as a share of its cost

    /** From one side of a thick wall to the other, by a door that is hardly wider than the car or by a wide one. */
    CarProblem throughOneOfTwoDoors(std::uint64_t seed)
    {
        Random random(seed);
        CarProblem problem{DiscCarWorld({{-25.0, -12.0}, {25.0, 12.0}}), {}, {}};
        const double half = random.between(2.0, 5.0), narrow = problem.world.radius + random.between(0.02, 0.1),
                     wide = random.between(3.5, 6.0);
        problem.world.boxes.push_back({{-half, -12.0}, {half, -narrow}});
        problem.world.boxes.push_back({{-half, narrow}, {half, wide}});
        problem.world.boxes.push_back({{-half, wide + 4.0}, {half, 12.0}});
        problem.starts.push_back({random.between(-20.0, -12.0), random.between(-6.0, 6.0), random.between(-PI, PI)});
        problem.goals.push_back({random.between(12.0, 20.0), random.between(-6.0, 6.0), random.between(-PI, PI)});
        return problem;
    }

    PathPlannerParameters parametersIn(const DiscCarWorld &world)
    {
        PathPlannerParameters parameters;
        parameters.search = carParameters();
        parameters.search.inscribedRadius = world.radius;
        parameters.search.cost.preferredClearance = 1.0;
        parameters.search.cost.clearanceCost = 10.0;
        // What is mended part by part would hide what the path was before.
        parameters.search.tuning.partsForRoom = 0;
        return parameters;
    }

    Outcome solve(PathPlanner &planner, DiscCarWorld &world, const CarProblem &problem,
                  const PathPlannerParameters &parameters)
    {
        planner.begin(world, parameters);
        for (const Pose &start : problem.starts)
            planner.addStart(start);
        for (const Pose &goal : problem.goals)
            planner.addGoal(goal);
        return planner.solve(afterAsking(6000), nullptr);
    }

    /** Of the cost of a path, for what is near to obstacles farther than a turning radius from both ends. */
    double shareInTheMiddle(const PathPlanner &planner, DiscCarWorld &world)
    {
        const Path &path = planner.bestPath();
        const double end = SearchTuning().closeToEnds * TURNING_RADIUS, length = path.length();
        if (length <= 2.0 * end)
            return 0.0;
        return pathCloseness(planner.search().cost(), path.first(length - end).rest(end), world) / planner.bestCost();
    }

    /** How many paths were compared with others, how many were not, and how many others were taken. */
    struct Counts
    {
        int compared{0}, others{0}, cheaper{0};
    };

    template <class World>
    Counts compare(const PathPlannerParameters &usual)
    {
        Counts counts;
        for (std::uint64_t seed = 0; seed < 130; ++seed)
        {
            SCOPED_TRACE(seed);
            // The last ones are in fields of boxes, where few paths have another way.
            const CarProblem problem = seed < 100 ? throughOneOfTwoDoors(seed) : randomProblem(seed, 20);
            World world(problem.world);
            PathPlannerParameters parameters = usual;
            PathPlanner comparing, plain;
            parameters.search.tuning.dearlyClose = NO_PATH_IS_SO_CLOSE;
            if (solve(plain, world, problem, parameters) != Outcome::Solved)
                continue;
            // What is thought about the bare curve is another matter.
            if (plain.search().expanded() == 0)
                continue;
            EXPECT_EQ(solve(comparing, world, problem, usual), Outcome::Solved);
            EXPECT_EQ(faultOf(comparing.bestPath(), world, problem.starts, problem.goals, TURNING_RADIUS), "");
            const SearchTuning &tuning = usual.search.tuning;
            if (shareInTheMiddle(plain, world) > tuning.dearlyClose)
            {
                ++counts.compared;
                const double effort = static_cast<double>(plain.search().expanded());
                EXPECT_LE(static_cast<double>(comparing.expanded() - plain.expanded()),
                          std::clamp(effort, tuning.leastForRoom, tuning.mostForAnother) + tuning.firstRestart);
                EXPECT_LE(comparing.bestCost(), plain.bestCost());
                counts.cheaper += comparing.bestCost() < plain.bestCost() - 1e-6 ? 1 : 0;
            }
            else
            {
                ++counts.others;
                EXPECT_EQ(comparing.expanded(), plain.expanded());
                EXPECT_EQ(comparing.bestCost(), plain.bestCost());
            }
        }
        return counts;
    }
}  // namespace

TEST(PassingClosely, aSearchThatBeginsAnewFindsCheaperWays)
{
    // That world knows of no clearance that motions keep: there is no search for a way with room.
    const Counts counts = compare<DiscCarWorld>(parametersIn(randomProblem(0, 20).world));
    EXPECT_GT(counts.compared, 20);
    EXPECT_GT(counts.others, 20);
    EXPECT_GT(counts.cheaper, 2);
}

TEST(PassingClosely, aSearchForAWayWithRoomFindsCheaperOnes)
{
    PathPlannerParameters parameters = parametersIn(randomProblem(0, 20).world);
    parameters.search.tuning.firstRestart = 0.0;
    const Counts counts = compare<ClearanceWorld>(parameters);
    EXPECT_GT(counts.compared, 20);
    EXPECT_GT(counts.others, 20);
    EXPECT_GT(counts.cheaper, 2);
}

TEST(PassingClosely, whoeverStopsItHasTheFirstPath)
{
    int stopped = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed)
    {
        SCOPED_TRACE(seed);
        const CarProblem problem = throughOneOfTwoDoors(seed);
        ClearanceWorld world(problem.world);
        PathPlannerParameters parameters = parametersIn(world);
        PathPlanner whole, plain, planner;
        if (solve(whole, world, problem, parameters) != Outcome::Solved)
            continue;
        parameters.search.tuning.dearlyClose = NO_PATH_IS_SO_CLOSE;
        ASSERT_EQ(solve(plain, world, problem, parameters), Outcome::Solved);
        if (whole.expanded() < plain.expanded() + 10)
            continue;
        ++stopped;
        const std::uint64_t most = plain.expanded() + 5;
        planner.begin(world, parametersIn(world));
        planner.addStart(problem.starts[0]);
        planner.addGoal(problem.goals[0]);
        planner.solve([&planner, most] { return planner.expanded() >= most; }, nullptr);
        EXPECT_TRUE(planner.hasSolution());
        EXPECT_LE(planner.expanded(), most);
        EXPECT_EQ(faultOf(planner.bestPath(), world, problem.starts, problem.goals, TURNING_RADIUS), "");
    }
    EXPECT_GT(stopped, 3);
}

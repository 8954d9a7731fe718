// The paper's search on a grid, against plain Dijkstra.

#include "ompl_improved_astar/search/Search.h"
#include "ompl_improved_astar/search/models/GridModel.h"
#include "parking_geometry/Error.h"
#include "tests/ompl_improved_astar/search/GridWorld.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;
using Outcome = SearchOutcome;

namespace
{
    const std::string BOTH[]{"grid8", "grid16"};

    struct Result
    {
        Outcome outcome;
        std::vector<Pose> path;
    };

    Result solve(GridWorld &world, const PlannerParameters &parameters, const Pose &start, const Pose &goal)
    {
        Search search;
        search.begin(world, parameters, world.car());
        search.addStart(start);
        search.addGoal(goal);
        const Outcome outcome = search.run({});
        return {outcome, posesOf(search.bestPath())};
    }

    /** A search from one end with this weight and without tie-breaking: plain A* for 1. */
    PlannerParameters weighted(const GridWorld &world, double weight)
    {
        PlannerParameters parameters = world.parameters();
        parameters.heuristicWeightFar = parameters.heuristicWeightNear = weight;
        parameters.nearGoalDistance = parameters.tieBreak = 0.0;
        parameters.bidirectional = false;
        return parameters;
    }
}  // namespace

TEST(GridModel, findsAPathWhereAFloodDoesAndTheShortestAtWeightOne)
{
    int reachable = 0, unreachable = 0;
    for (const std::string &model : BOTH)
        for (std::uint64_t seed = 0; seed < 200; ++seed)
        {
            SCOPED_TRACE(model + ", seed " + std::to_string(seed));
            GridWorld world = randomGrid(seed, 0.1 + 0.3 * static_cast<double>(seed % 4) / 3.0);
            Random random(seed);
            const Pose start = world.freePose(random), goal = world.freePose(random);
            const double best = shortestByDijkstra(world, start, goal, model == "grid16");
            ++(best < HUGE_VAL ? reachable : unreachable);
            for (const double weight : {1.0, 1.7, 2.5})
                for (const bool both : {false, true})
                    for (const char *from : {"start", "goal"})
                    {
                        PlannerParameters parameters = weighted(world, weight);
                        parameters.motionModel = model;
                        parameters.bidirectional = both;
                        parameters.searchFrom = from;
                        const Result result = solve(world, parameters, start, goal);
                        ASSERT_EQ(result.outcome, best == HUGE_VAL ? Outcome::Exhausted : Outcome::Improved);
                        if (best == HUGE_VAL)
                            continue;
                        ASSERT_EQ(faultOf(result.path, world, start, goal), "");
                        ASSERT_GE(lengthOf(result.path), best - 1e-9);
                        if (!both)
                        {
                            ASSERT_LE(lengthOf(result.path), weight * best + 1e-9) << "the weight bounds the length";
                        }
                    }
        }
    EXPECT_GT(reachable, 200);
    EXPECT_GT(unreachable, 30);
}

TEST(GridModel, pathsAreFreeWhereTheHeadingMatters)
{
    int found = 0;
    for (const std::string model : {"grid8", "grid16", "grid32"})
        for (const bool both : {false, true})
            for (std::uint64_t seed = 0; seed < 200; ++seed)
            {
                SCOPED_TRACE(model + ", seed " + std::to_string(seed));
                GridWorld world = randomGrid(seed, 0.15);
                Random random(seed);
                world.nose = random.between(0.3, 1.5);
                const Pose start = world.freePose(random), goal = world.freePose(random);
                PlannerParameters parameters = world.parameters();
                parameters.motionModel = model;
                parameters.bidirectional = both;
                const Result result = solve(world, parameters, start, goal);
                if (result.outcome != Outcome::Improved)
                    continue;
                ++found;
                ASSERT_EQ(faultOf(result.path, world, start, goal), "");
            }
    EXPECT_GT(found, 300);
}

TEST(GridModel, aStopIsHeededWhileTheMapIsLoadedAndLoadingGoesOn)
{
    GridWorld world(60, 60);
    PlannerParameters parameters = world.parameters();
    parameters.obstacleLoading = "eager";
    Search search;
    search.begin(world, parameters, world.car());
    search.addStart({0.5, 0.5, 0.0});
    search.addGoal({59.5, 59.5, 0.0});
    EXPECT_EQ(search.run([polls = 0]() mutable { return ++polls > 3; }), Outcome::Stopped);
    EXPECT_LT(world.states, 64u);
    EXPECT_EQ(search.run({}), Outcome::Improved);
}

TEST(GridModel, endsAsNearToAnUnreachableTargetAsAFloodGets)
{
    int unreachable = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed)
        for (const bool isTarget : {false, true})
        {
            SCOPED_TRACE(seed);
            GridWorld world = randomGrid(seed, 0.45, 12);
            Random random(seed);
            const Pose start = world.freePose(random), goal = world.freePose(random);
            if (shortestByDijkstra(world, start, goal, false) < HUGE_VAL)
                continue;
            ++unreachable;
            PlannerParameters parameters = world.parameters();
            parameters.bidirectional = seed % 2 == 0;
            Search search;
            search.begin(world, parameters, world.car());
            search.addStart(start);
            isTarget ? search.setTarget(goal) : search.addGoal(goal);
            ASSERT_EQ(search.run({}), Outcome::Exhausted);
            Path path;
            ASSERT_TRUE(search.nearestPath(goal, path));
            const std::vector<Pose> poses = posesOf(path);
            ASSERT_EQ(poses.size() > 1 ? faultOf(poses, world, start, poses.back()) : "", "");
            // The cells of roots stand for these: no path leads through that of a goal that it does not reach.
            GridWorld others = world;
            others.at(static_cast<int>(goal.x), static_cast<int>(goal.y)) = isTarget ? 0 : 1;
            double nearest = positionDistance(start, goal);
            for (int cell = 0; cell < world.columns * world.rows; ++cell)
            {
                const int column = cell % world.columns, row = cell / world.columns;
                const Pose centre{column + 0.5, row + 0.5, 0.0};
                const bool isStart = std::floor(start.x) == column && std::floor(start.y) == row;
                if (others.isPoseFree(centre) && positionDistance(centre, goal) < nearest && !isStart &&
                    shortestByDijkstra(others, start, centre, false) < HUGE_VAL)
                    nearest = positionDistance(centre, goal);
            }
            ASSERT_NEAR(positionDistance(poses.back(), goal), nearest, 1e-9);
        }
    EXPECT_GT(unreachable, 30);
}

TEST(GridModel, severalStartsAndGoalsAreJoinedAsCheaplyAsAnyPair)
{
    for (std::uint64_t seed = 0; seed < 60; ++seed)
    {
        SCOPED_TRACE(seed);
        GridWorld world = randomGrid(seed, 0.25);
        Random random(seed);
        std::vector<Pose> starts, goals;
        Search search;
        search.begin(world, weighted(world, 1.0), world.car());
        for (int i = 0; i < 3; ++i)
            for (std::vector<Pose> *roots : {&starts, &goals})
            {
                // Two roots in one cell would be one node of the lattice.
                const Pose pose = world.freePose(random);
                roots->push_back({std::floor(pose.x) + 0.5, std::floor(pose.y) + 0.5, pose.yaw});
                roots == &starts ? search.addStart(roots->back()) : search.addGoal(roots->back());
            }
        double best = HUGE_VAL;
        for (const Pose &start : starts)
            for (const Pose &goal : goals)
                best = std::min(best, shortestByDijkstra(world, start, goal, false));
        ASSERT_EQ(search.run({}) == Outcome::Improved, best < HUGE_VAL);
        if (best < HUGE_VAL)
        {
            ASSERT_NEAR(lengthOf(posesOf(search.bestPath())), best, 1e-9);
        }
    }
}

TEST(GridModel, refusesStepsWithoutAnOppositeAndGridsBeyondItsReach)
{
    EXPECT_NO_THROW(GridModel({{1, 0}, {-1, 0}}));
    EXPECT_THROW(GridModel({{1, 0}, {-1, 0}, {0, 1}}), Error);
    EXPECT_THROW(GridModel(std::vector<GridStep>(33, {0, 0})), Error);
    GridWorld world(3, 3);
    CarInSpace car = world.car();
    EXPECT_NO_THROW(Search().begin(world, world.parameters(), car));
    for (const double side : {1e12, HUGE_VAL, std::numeric_limits<double>::quiet_NaN()})
    {
        car.bounds.max.x() = side;
        EXPECT_THROW(Search().begin(world, world.parameters(), car), Error) << side;
    }
}

// The search over drivable motions: what it returns, and every switch by itself.

#include "ompl_improved_astar/search/Search.h"
#include "tests/ompl_improved_astar/search/CarProblems.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    // What cannot be solved is searched ever more finely, for longer than a test should take.
    constexpr std::uint64_t MOST_EXPANSIONS = 5000;

    struct Result
    {
        SearchOutcome outcome;
        Path path;
        double cost;
        SearchStatistics statistics;
    };

    Result solve(CarProblem problem, const SearchParameters &parameters)
    {
        Search search;
        problem.begin(search, parameters);
        const SearchOutcome outcome = search.run([&] { return search.statistics().expanded >= MOST_EXPANSIONS; });
        return {outcome, search.bestPath(), search.bestCost(), search.statistics()};
    }

    void expectSame(const Result &a, const Result &b)
    {
        ASSERT_EQ(a.outcome, b.outcome);
        ASSERT_EQ(a.cost, b.cost);
        ASSERT_EQ(a.statistics.expanded, b.statistics.expanded);
        ASSERT_EQ(a.statistics.generated, b.statistics.generated);
        ASSERT_EQ(a.statistics.connections, b.statistics.connections);
        ASSERT_EQ(a.path.pieces.size(), b.path.pieces.size());
        for (std::size_t i = 0; i < a.path.pieces.size(); ++i)
            ASSERT_TRUE(a.path.pieces[i].length == b.path.pieces[i].length &&
                        a.path.pieces[i].curvature == b.path.pieces[i].curvature);
    }
}  // namespace

TEST(Search, pathsAreDrivableFreeAndCostWhatIsSaid)
{
    int searched = 0;
    for (std::uint64_t seed = 0; seed < 80; ++seed)
    {
        SCOPED_TRACE(seed);
        CarProblem problem = randomProblem(seed);
        Random random(seed);
        SearchParameters parameters = carParameters();
        parameters.steeringAngles = 3 + 2 * random.index(3);
        parameters.bidirectional = random.chance(0.5);
        parameters.searchFromGoal = random.chance(0.5);
        parameters.cost = {random.between(0.0, 1.0), random.between(0.0, 2.0), random.between(0.0, 0.3), 0.0, 1.0, 1.0};
        Search search;
        problem.begin(search, parameters);
        CostModel cost = parameters.cost;
        cost.fullLockCurvature = 1.0 / TURNING_RADIUS;
        double last = std::numeric_limits<double>::infinity();
        for (int i = 0; i < 4 && search.statistics().expanded < 3000; ++i)
        {
            const std::uint64_t end = search.statistics().expanded + 1000;
            if (search.run([&] { return search.statistics().expanded >= end; }) != SearchOutcome::Improved)
                break;
            searched += search.statistics().expanded > 0;
            ASSERT_EQ(faultOf(search.bestPath(), problem.world, problem.starts, problem.goals, TURNING_RADIUS), "");
            ASSERT_NEAR(search.bestCost(), pathCost(cost, search.bestPath(), problem.world), 1e-6);
            ASSERT_LT(search.bestCost(), last) << "improved";
            last = search.bestCost();
        }
    }
    EXPECT_GT(searched, 40);
}

TEST(Search, isDeterministicAndAnObjectServesManyQueries)
{
    Search reused;
    for (std::uint64_t seed = 0; seed < 25; ++seed)
    {
        CarProblem problem = randomProblem(seed);
        const Result first = solve(problem, carParameters()), second = solve(problem, carParameters());
        expectSame(first, second);
        problem.begin(reused, carParameters());
        const SearchOutcome outcome = reused.run([&] { return reused.statistics().expanded >= MOST_EXPANSIONS; });
        expectSame(first, {outcome, reused.bestPath(), reused.bestCost(), reused.statistics()});
    }
}

TEST(Search, forwardOnlyNeverReverses)
{
    int found = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed)
    {
        SCOPED_TRACE(seed);
        CarProblem problem = randomProblem(seed, 4);
        SearchParameters parameters = carParameters();
        parameters.forwardOnly = true;
        parameters.bidirectional = seed % 2 == 0;
        parameters.searchFromGoal = seed % 4 < 2;
        Search search;
        problem.begin(search, parameters);
        if (search.run([&] { return search.statistics().expanded > 3000; }) != SearchOutcome::Improved)
            continue;
        ++found;
        ASSERT_EQ(faultOf(search.bestPath(), problem.world, problem.starts, problem.goals, TURNING_RADIUS, true), "");
    }
    EXPECT_GT(found, 15);
    // A goal just behind the car: it has to go round.
    CarProblem behind{DiscCarWorld({{-20.0, -20.0}, {20.0, 20.0}}), {{0.0, 0.0, 0.0}}, {{-1.0, 0.0, 0.0}}};
    SearchParameters parameters = carParameters();
    EXPECT_NEAR(solve(behind, parameters).path.length(), 1.0, 1e-9);
    parameters.forwardOnly = true;
    EXPECT_GT(solve(behind, parameters).path.length(), 2.0 * PI * TURNING_RADIUS);
}

TEST(Search, keepsToTheMostCuspsItIsGiven)
{
    std::size_t fewer = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed)
    {
        SCOPED_TRACE(seed);
        SearchParameters parameters = carParameters();
        parameters.cost.gearChangePenalty = 0.0;
        const std::size_t cusps = solve(randomProblem(seed), parameters).path.cusps();
        if (cusps == 0)
            continue;
        parameters.mostCusps = static_cast<std::uint8_t>(cusps - 1);
        CarProblem problem = randomProblem(seed);
        Search limited;
        problem.begin(limited, parameters);
        const SearchOutcome outcome = limited.run({}, MOST_EXPANSIONS);
        for (const Side side : {Side::Start, Side::Goal})
            for (const Node &node : std::as_const(limited).frontier(side).nodes())
                ASSERT_LE(node.cusps, parameters.mostCusps);
        if (outcome != SearchOutcome::Improved)
            continue;
        ++fewer;
        EXPECT_LT(limited.bestPath().cusps(), cusps);
    }
    EXPECT_GT(fewer, 10U);
}

TEST(Search, heapAndLinearListAreTheSameSearch)
{
    for (std::uint64_t seed = 0; seed < 25; ++seed)
    {
        SearchParameters parameters = carParameters();
        const Result heap = solve(randomProblem(seed), parameters);
        parameters.openList = "linear";
        expectSame(heap, solve(randomProblem(seed), parameters));
    }
}

TEST(Search, everyDirectionOfSearchReachesTheSame)
{
    for (const NamedProblem &each : namedProblems())
        for (const bool bidirectional : {true, false})
            for (const bool fromGoal : {true, false})
            {
                SCOPED_TRACE(each.name);
                SearchParameters parameters = carParameters();
                parameters.bidirectional = bidirectional;
                parameters.searchFromGoal = fromGoal;
                const Result result = solve(each.problem, parameters);
                EXPECT_EQ(result.outcome == SearchOutcome::Improved, each.solvable)
                    << "bidirectional " << bidirectional << ", from goal " << fromGoal;
                if (result.outcome != SearchOutcome::Improved)
                    continue;
                EXPECT_EQ(
                    faultOf(result.path, each.problem.world, each.problem.starts, each.problem.goals, TURNING_RADIUS),
                    "");
            }
}

TEST(Search, aClosedDoorIsRecognisedByTheRoomThereIs)
{
    CarProblem problem{twoRooms(0.0), {{-9.0, 0.0, 0.0}}, {{6.0, 0.0, 0.0}}};
    SearchParameters parameters = carParameters();
    parameters.inscribedRadius = problem.world.radius;
    const Result result = solve(problem, parameters);
    EXPECT_EQ(result.outcome, SearchOutcome::Exhausted);
    EXPECT_EQ(result.statistics.expanded, 0u) << "not even the disc in the car finds a way";
    // A door of just the disc's width says nothing against it.
    problem.world = twoRooms(2.1);
    EXPECT_EQ(solve(problem, parameters).outcome, SearchOutcome::Improved);
}

TEST(Search, withoutAnalyticExpansionNothingIsJoined)
{
    for (const NamedProblem &each : namedProblems())
    {
        SCOPED_TRACE(each.name);
        CarProblem problem = each.problem;
        SearchParameters parameters = carParameters();
        parameters.analyticExpansion = false;
        Search search;
        problem.begin(search, parameters);
        EXPECT_NE(search.run([&] { return search.statistics().expanded > 300; }), SearchOutcome::Improved);
        EXPECT_EQ(search.statistics().connections, 0u);
        EXPECT_FALSE(search.hasSolution());
    }
}

TEST(Search, adaptiveResolutionFindsTheWayOutOfATightSlot)
{
    CarProblem tight = tightParallelSlot();
    SearchParameters parameters = carParameters();
    EXPECT_EQ(solve(tight, parameters).outcome, SearchOutcome::Improved);
    parameters.adaptiveResolution = false;
    EXPECT_NE(solve(tight, parameters).outcome, SearchOutcome::Improved);
    CarProblem wide{twoRooms(5.0), {{-9.0, 0.0, 0.0}}, {{6.0, 2.0, 0.0}}};
    EXPECT_EQ(solve(wide, parameters).outcome, SearchOutcome::Improved);
}

TEST(Search, obstacleHeuristicGuidesAndCanBeLeftOut)
{
    std::uint64_t with = 0, without = 0;
    for (int wall = 0; wall < 3; ++wall)
    {
        CarProblem problem = maze(wall);
        SearchParameters parameters = carParameters();
        parameters.inscribedRadius = problem.world.radius;
        const Result guided = solve(problem, parameters);
        EXPECT_EQ(guided.outcome, SearchOutcome::Improved);
        EXPECT_GT(guided.statistics.heuristicCells, 0u);
        with += guided.statistics.expanded;
        parameters.obstacleHeuristic = false;
        const Result plain = solve(problem, parameters);
        EXPECT_EQ(plain.outcome, SearchOutcome::Improved);
        EXPECT_EQ(plain.statistics.heuristicCells, 0u);
        without += plain.statistics.expanded;
    }
    EXPECT_LT(with, without);
}

TEST(Search, eagerLoadingIsTheSameSearchButForTheLoading)
{
    for (std::uint64_t seed = 0; seed < 15; ++seed)
    {
        const CarProblem problem = randomProblem(seed);
        SearchParameters parameters = carParameters();
        parameters.bounds = {{-12.0, -12.0}, {12.0, 12.0}};
        parameters.inscribedRadius = problem.world.radius;
        const Result lazy = solve(problem, parameters);
        parameters.eagerObstacles = true;
        CarProblem copy = problem;
        Search search;
        copy.begin(search, parameters);
        const auto enough = [&]
        {
            return search.statistics().expanded >= MOST_EXPANSIONS;
        };
        const SearchOutcome outcome = search.run(enough);
        expectSame(lazy, {outcome, search.bestPath(), search.bestCost(), search.statistics()});
        if (search.statistics().expanded > 0)
        {
            EXPECT_GT(search.loadingTime(), 0.0);
        }
        parameters.eagerObstacles = false;
        copy.begin(search, parameters);
        search.run(enough);
        EXPECT_EQ(search.loadingTime(), 0.0);
    }
}

TEST(Search, stopsAndGoesOnToTheSamePath)
{
    for (const NamedProblem &each : namedProblems())
    {
        SCOPED_TRACE(each.name);
        const Result whole = solve(each.problem, carParameters());
        CarProblem problem = each.problem;
        Search search;
        problem.begin(search, carParameters());
        SearchOutcome outcome;
        int pieces = 0;
        do
        {
            int asked = 0;
            outcome = search.run([&asked] { return ++asked > 40; });
            ASSERT_LT(++pieces, 10000);
        } while (outcome == SearchOutcome::Stopped && search.statistics().expanded < whole.statistics.expanded);
        if (whole.outcome == SearchOutcome::Improved)
        {
            expectSame(whole, {outcome, search.bestPath(), search.bestCost(), search.statistics()});
        }
        else
        {
            EXPECT_NE(outcome, SearchOutcome::Improved);
        }
    }
}

// A limit of expansions, unlike a stop, leaves no estimate behind that is what it is for want of time.
TEST(Search, expandsNoMoreThanItMayAndGoesOnAsIfNothingHadBeen)
{
    std::size_t solved = 0;
    std::uint64_t differences = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed)
    {
        SCOPED_TRACE(seed);
        CarProblem problem = randomProblem(seed, 25);
        SearchParameters parameters = parametersIn(problem);
        parameters.tuning.heuristicCell = 1.0 / 60.0;  // floods are long
        Search whole, parts, stopped;
        if (!isSolved(whole, problem, parameters, 2000))
            continue;
        ++solved;
        problem.begin(parts, parameters);
        std::uint64_t most = 0;
        while (parts.run({}, most) == SearchOutcome::Stopped && most < 2000)
            EXPECT_EQ(parts.expanded(), most++);
        EXPECT_EQ(parts.expanded(), whole.expanded());
        EXPECT_EQ(parts.bestCost(), whole.bestCost());
        problem.begin(stopped, parameters);
        most = 0;
        while (stopped.run([&] { return stopped.expanded() >= most; }) == SearchOutcome::Stopped && most < 2000)
            ++most;
        differences += stopped.expanded() != whole.expanded() || stopped.bestCost() != whole.bestCost();
    }
    EXPECT_GT(solved, 20u);
    EXPECT_GT(differences, 0u);  // else there was no flood that a stop could have left
}

TEST(Search, aStopIsHeededBeforeTheNextExpansion)
{
    CarProblem problem = maze(2);
    Search search;
    problem.begin(search, carParameters());
    EXPECT_EQ(search.run([] { return true; }), SearchOutcome::Stopped);
    EXPECT_EQ(search.statistics().expanded, 0u);
    EXPECT_EQ(search.run([&] { return search.statistics().expanded >= 7; }), SearchOutcome::Stopped);
    EXPECT_EQ(search.statistics().expanded, 7u);
}

TEST(Search, joinsTheCheapestPairOfRootsInTheOpen)
{
    for (std::uint64_t seed = 0; seed < 40; ++seed)
    {
        SCOPED_TRACE(seed);
        Random random(seed);
        CarProblem problem{DiscCarWorld({{-60.0, -60.0}, {60.0, 60.0}}), {}, {}};
        for (int i = 0; i < 3; ++i)
        {
            problem.starts.push_back(random.poseIn(-10.0, 10.0));
            problem.goals.push_back(random.poseIn(-10.0, 10.0));
        }
        const Result all = solve(problem, carParameters());
        double cheapest = std::numeric_limits<double>::infinity();
        for (const Pose &start : problem.starts)
            for (const Pose &goal : problem.goals)
                cheapest = std::min(cheapest, solve({problem.world, {start}, {goal}}, carParameters()).cost);
        ASSERT_EQ(all.outcome, SearchOutcome::Improved);
        ASSERT_NEAR(all.cost, cheapest, 1e-9);
    }
}

TEST(Search, farGoalsOfASmallCarAreNotTakenForUnreachable)
{
    // 150 m are 750 turning radii of a model car.
    CarProblem problem{DiscCarWorld({{-20.0, -20.0}, {200.0, 20.0}}), {{0.0, 0.0, 0.0}}, {{150.0, 0.0, 0.0}}};
    problem.world.offsets = {0.0, 0.1};
    problem.world.radius = 0.1;
    problem.world.boxes.push_back({{70.0, -1.0}, {71.0, 1.0}});
    SearchParameters parameters = carParameters();
    parameters.turningRadius = 0.2;
    parameters.inscribedRadius = 0.1;
    Search search;
    problem.begin(search, parameters);
    ASSERT_EQ(search.run([&] { return search.statistics().expanded >= 20000; }), SearchOutcome::Improved);
    EXPECT_EQ(faultOf(search.bestPath(), problem.world, problem.starts, problem.goals, 0.2), "");
}

TEST(Search, comesAsNearToATargetAsTheCarCan)
{
    for (const auto &[name, problem, target] : targetProblems())
    {
        SCOPED_TRACE(name);
        DiscCarWorld world = problem.world;
        Search search;
        search.begin(world, carParameters());
        search.addStart(problem.starts.front());
        search.setTarget(target);
        EXPECT_EQ(search.run(afterAsking()), SearchOutcome::Exhausted);
        Path path;
        ASSERT_TRUE(search.nearestPath(target, path));
        EXPECT_EQ(faultOf(path, world, problem.starts, {path.end()}, TURNING_RADIUS), "");
        const double reached = positionDistance(path.end(), target);
        EXPECT_LE(reached, nearestByFlooding(world, problem.starts.front(), target) + 0.1);
    }
    Path path;
    DiscCarWorld world = twoRooms(3.0);
    Search search;
    search.begin(world, carParameters());
    EXPECT_FALSE(search.nearestPath({}, path)) << "without a start";
}

TEST(Search, nodesFormTreesOfFreeMotions)
{
    for (const NamedProblem &each : namedProblems())
    {
        SCOPED_TRACE(each.name);
        CarProblem problem = each.problem;
        Search search;
        problem.begin(search, carParameters());
        search.run([&] { return search.statistics().expanded > 300; });
        for (const Side side : {Side::Start, Side::Goal})
        {
            const std::vector<Node> &nodes = std::as_const(search).frontier(side).nodes();
            for (std::size_t i = 0; i < nodes.size(); ++i)
            {
                ASSERT_GT(problem.world.gap(nodes[i].pose), 0.0);
                std::size_t at = i;
                for (std::size_t steps = 0; nodes[at].parent != NO_NODE; ++steps)
                {
                    ASSERT_LT(steps, nodes.size()) << "a circle";
                    at = nodes[at].parent;
                }
                ASSERT_LT(at, problem.starts.size() + problem.goals.size());
            }
        }
    }
}

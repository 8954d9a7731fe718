// The planner without OMPL: shortening, anytime improvement, bounds.

#include "ompl_improved_astar/search/planning/PathPlanner.h"
#include "tests/ompl_improved_astar/search/CarProblems.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;
using Outcome = PathPlanner::Outcome;

namespace
{
    constexpr double INFINITE = std::numeric_limits<double>::infinity();

    CostModel costModel(const PathPlannerParameters &parameters)
    {
        CostModel cost = parameters.search.cost;
        cost.fullLockCurvature = 1.0 / parameters.search.turningRadius;
        return cost;
    }
}  // namespace

TEST(PathPlanner, solvesAndReportsWhatItReturns)
{
    int solved = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed)
    {
        SCOPED_TRACE(seed);
        CarProblem problem = randomProblem(seed);
        const PathPlannerParameters parameters = parametersFor(problem);
        PathPlanner planner;
        problem.begin(planner, parameters);
        std::vector<double> costs;
        const Outcome outcome =
            planner.solve(afterAsking(3000),
                          [&](const Path &path, double cost)
                          {
                              costs.push_back(cost);
                              EXPECT_NEAR(cost, pathCost(costModel(parameters), path, problem.world), 1e-6);
                              return false;
                          });
        ASSERT_EQ(planner.hasSolution(), outcome == Outcome::Solved);
        if (outcome != Outcome::Solved)
        {
            EXPECT_TRUE(costs.empty());
            EXPECT_EQ(planner.bestCost(), INFINITE);
            EXPECT_EQ(planner.suboptimalityBound(), INFINITE);
            continue;
        }
        ++solved;
        ASSERT_EQ(costs.size(), 1u);
        EXPECT_EQ(costs.back(), planner.bestCost());
        EXPECT_EQ(faultOf(planner.bestPath(), problem.world, problem.starts, problem.goals, TURNING_RADIUS), "");
        EXPECT_GE(planner.suboptimalityBound(), 1.0);
    }
    EXPECT_GT(solved, 30);
}

TEST(PathPlanner, thinksOnAboutPathsThatStayDear)
{
    std::size_t dear = 0, others = 0, cheaper = 0, whole = 0;
    for (std::uint64_t seed = 0; seed < 150; ++seed)
    {
        SCOPED_TRACE(seed);
        CarProblem problem = randomProblem(seed);
        PathPlannerParameters parameters = parametersFor(problem);
        parameters.shorten = false;
        const SearchTuning tuning = parameters.search.tuning;
        PathPlanner longer;
        problem.begin(longer, parameters);
        parameters.search.tuning.secondAfterthought = 0;
        PathPlanner shorter;
        problem.begin(shorter, parameters);
        if (shorter.solve(afterAsking(3000), {}) != Outcome::Solved)
            continue;
        ASSERT_EQ(longer.solve(afterAsking(3000), {}), Outcome::Solved);
        const double expected = std::max(shorter.search().shortestMotion(), shorter.search().estimate());
        if (shorter.bestCost() > tuning.stillDear * expected)
        {
            ++dear;
            EXPECT_LE(longer.expanded(), shorter.expanded() + tuning.secondAfterthought);
            whole += longer.expanded() == shorter.expanded() + tuning.secondAfterthought ? 1 : 0;
            EXPECT_LE(longer.bestCost(), shorter.bestCost());
            cheaper += longer.bestCost() < shorter.bestCost() ? 1 : 0;
            // Whoever stops it does not wait for the rest.
            const std::uint64_t most = shorter.expanded() + 10;
            PathPlanner stopped;
            parameters.search.tuning = tuning;
            problem.begin(stopped, parameters);
            stopped.solve([&stopped, most] { return stopped.expanded() >= most; }, {});
            EXPECT_TRUE(stopped.hasSolution());
            EXPECT_LE(stopped.expanded(), most);
        }
        else
        {
            ++others;
            EXPECT_EQ(longer.expanded(), shorter.expanded());
            EXPECT_EQ(longer.bestCost(), shorter.bestCost());
        }
    }
    EXPECT_GT(dear, 5u);
    EXPECT_GT(whole, 5u);
    EXPECT_GT(others, 50u);
    EXPECT_GT(cheaper, 1u);
}

TEST(PathPlanner, shorteningNeverCostsAnything)
{
    int cheaper = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed)
    {
        SCOPED_TRACE(seed);
        CarProblem problem = randomProblem(seed);
        PathPlannerParameters parameters = parametersFor(problem);
        parameters.search.cost.clearanceWeight = seed % 2 ? 1.0 : 0.0;
        PathPlanner with, without;
        problem.begin(with, parameters);
        const Outcome outcome = with.solve(afterAsking(3000), nullptr);
        parameters.shorten = false;
        problem.begin(without, parameters);
        ASSERT_EQ(without.solve(afterAsking(3000), nullptr), outcome);
        if (outcome != Outcome::Solved)
            continue;
        EXPECT_EQ(with.statistics().expanded, without.statistics().expanded) << "the search is the same";
        EXPECT_LE(with.bestCost(), without.bestCost() + 1e-9);
        cheaper += with.bestCost() < without.bestCost() - 1e-6;
    }
    EXPECT_GT(cheaper, 5);
}

TEST(PathPlanner, onlyLongPathsFarDearerThanPromisedAreShortenedAgainAndThenNeverCostMore)
{
    int again = 0, cheaper = 0, tooShort = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed)
    {
        SCOPED_TRACE(seed);
        CarProblem problem = randomProblem(seed);
        PathPlannerParameters parameters = parametersFor(problem);
        // What is turned round or relaxed starts from another path.
        parameters.search.tuning.dearTurns = INFINITE;
        parameters.search.tuning.dearToRelax = parameters.search.tuning.dearToRelaxOnce = INFINITE;
        // Few paths of these worlds are longer than usual.
        parameters.search.tuning.shortToShortenAgain = 6.0;
        PathPlanner usual, spared;
        problem.begin(usual, parameters);
        if (usual.solve(afterAsking(3000), nullptr) != Outcome::Solved)
            continue;
        parameters.search.tuning.mostShortenings = 0;
        problem.begin(spared, parameters);
        ASSERT_EQ(spared.solve(afterAsking(3000), nullptr), Outcome::Solved);
        const double promised = std::max(spared.search().shortestMotion(), spared.search().estimate());
        EXPECT_EQ(usual.statistics().expanded, spared.statistics().expanded);
        EXPECT_LE(usual.bestCost(), spared.bestCost());
        const bool isDear = spared.bestCost() > SearchTuning().muchDearer * promised;
        const double shortest = parameters.search.tuning.shortToShortenAgain * TURNING_RADIUS;
        const bool isLong = spared.bestPath().length() > shortest;
        tooShort += isDear && !isLong;
        if (!isDear || !isLong)
        {
            EXPECT_EQ(usual.statistics().connections, spared.statistics().connections);
            EXPECT_EQ(usual.bestCost(), spared.bestCost());
        }
        else
            EXPECT_GT(usual.statistics().connections, spared.statistics().connections);
        again += isDear && isLong;
        cheaper += usual.bestCost() < spared.bestCost() - 1e-6;
    }
    EXPECT_GT(again, 5);
    EXPECT_GT(cheaper, 2);
    EXPECT_GT(tooShort, 5);
}

TEST(PathPlanner, aPathThatCostsHardlyMoreThanPromisedIsNotThoughtOver)
{
    int spared = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed)
    {
        SCOPED_TRACE(seed);
        CarProblem problem = randomProblem(seed, 5);
        PathPlannerParameters parameters = parametersFor(problem);
        parameters.shorten = false;
        PathPlanner usual, thorough;
        problem.begin(usual, parameters);
        if (usual.solve(afterAsking(3000), nullptr) != Outcome::Solved)
            continue;
        parameters.search.tuning.hardlyDearer = 0.0;
        problem.begin(thorough, parameters);
        ASSERT_EQ(thorough.solve(afterAsking(3000), nullptr), Outcome::Solved);
        if (usual.expanded() == thorough.expanded())
            continue;
        ++spared;
        EXPECT_LT(usual.expanded(), thorough.expanded());
        const double promised = std::max(usual.search().shortestMotion(), usual.search().estimate());
        EXPECT_LT(usual.bestCost(), SearchTuning().hardlyDearer * promised);
        EXPECT_LE(usual.bestPath().cusps(), SearchTuning().fewCusps);
    }
    EXPECT_GT(spared, 2);
}

TEST(PathPlanner, theShortestCurveIsThoughtOverOnlyWhereMuchOfItsCostIsForObstacles)
{
    // Along a wall, touching it all the way: not so dear, and dearer.
    CarProblem problem{DiscCarWorld({{-20.0, -1.0}, {20.0, 9.0}}), {{-15.0, 0.0, 0.0}}, {{12.0, 0.0, 0.0}}};
    PathPlannerParameters parameters = parametersFor(problem);
    parameters.search.cost.preferredClearance = 0.2;
    parameters.search.cost.clearanceCost = 0.64;
    parameters.shorten = false;
    PathPlanner planner;
    problem.begin(planner, parameters);
    ASSERT_EQ(planner.solve(afterAsking(3000), nullptr), Outcome::Solved);
    EXPECT_NEAR(planner.bestPath().length(), 27.0, 1e-9);
    EXPECT_GT(planner.bestCost(), 1.6 * 27.0);
    EXPECT_EQ(planner.expanded(), 0u);
    PathPlannerParameters dearer = parameters;
    dearer.search.cost.clearanceCost = 0.7;
    PathPlanner thinking;
    problem.begin(thinking, dearer);
    ASSERT_EQ(thinking.solve(afterAsking(3000), nullptr), Outcome::Solved);
    EXPECT_GT(thinking.expanded(), 0u);

    // Nothing can be replaced: one pass finds that out, and there is no second.
    Path path = planner.bestPath();
    const ReedsShepp curves(TURNING_RADIUS);
    PathShortener shortener(problem.world, curves, planner.search().cost());
    const SearchTuning tuning;
    EXPECT_FALSE(
        shortener.pass(path, tuning.knotSpacing * TURNING_RADIUS, 0.0, INFINITE, CurveChoice::Cheapest, nullptr));
    EXPECT_GT(shortener.connections(), 0u);
    parameters.shorten = true;
    PathPlanner shortening;
    problem.begin(shortening, parameters);
    ASSERT_EQ(shortening.solve(afterAsking(3000), nullptr), Outcome::Solved);
    EXPECT_EQ(shortening.statistics().connections, planner.statistics().connections + shortener.connections());
}

TEST(PathPlanner, anytimeReportsFallingCostsAndKeepsTheBest)
{
    int improvements = 0;
    for (std::uint64_t seed = 0; seed < 12; ++seed)
    {
        SCOPED_TRACE(seed);
        CarProblem problem = seed < 2 ? maze(2 + static_cast<int>(seed)) : randomProblem(seed);
        PathPlannerParameters parameters = parametersFor(problem);
        PathPlanner once;
        problem.begin(once, parameters);
        if (once.solve(afterAsking(3000), nullptr) != Outcome::Solved)
            continue;
        parameters.anytime = true;
        PathPlanner planner;
        problem.begin(planner, parameters);
        std::vector<double> costs;
        const auto record = [&](const Path &path, double cost)
        {
            EXPECT_EQ(faultOf(path, problem.world, problem.starts, problem.goals, TURNING_RADIUS), "");
            EXPECT_NEAR(cost, pathCost(costModel(parameters), path, problem.world), 1e-6);
            costs.push_back(cost);
            return false;
        };
        planner.solve(afterAsking(6000), record);
        ASSERT_FALSE(costs.empty());
        EXPECT_EQ(costs.front(), once.bestCost()) << "the first solution is the same";
        for (std::size_t i = 1; i < costs.size(); ++i)
            ASSERT_LT(costs[i], costs[i - 1]);
        EXPECT_EQ(planner.bestCost(), costs.back());
        EXPECT_EQ(faultOf(planner.bestPath(), problem.world, problem.starts, problem.goals, TURNING_RADIUS), "");
        improvements += static_cast<int>(costs.size()) - 1;

        // Going on never makes it worse.
        const double before = planner.bestCost();
        planner.solve(afterAsking(2000), record);
        EXPECT_LE(planner.bestCost(), before);
        EXPECT_EQ(planner.bestCost(), costs.back());
    }
    EXPECT_GT(improvements, 5);
}

TEST(PathPlanner, anytimeGainsNothingByBeingNearWhereItsCostDoesNotLook)
{
    const double step = 0.005;
    std::size_t improvements = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed)
    {
        SCOPED_TRACE(seed);
        CarProblem problem = randomProblem(seed, 16);
        PathPlannerParameters parameters = parametersFor(problem);
        parameters.anytime = true;
        parameters.search.cost.preferredClearance = 0.3;
        parameters.search.cost.clearanceCost = 10.0;
        PathPlanner planner;
        problem.begin(planner, parameters);
        const auto metresNear = [&](const Path &path)
        {
            double near = 0.0;
            const double whole = path.length();
            for (double driven = 0.5 * step; driven < whole; driven += step)
                near += problem.world.keeps(path.first(driven).end(), 0.3) ? 0.0 : step;
            return near;
        };
        std::vector<double> costs;
        planner.solve(
            afterExpanding(planner, 2000),
            [&](const Path &path, double /*cost*/)
            {
                costs.push_back(costWithoutCloseness(planner.search().cost(), path) + 10.0 * metresNear(path));
                return false;
            });
        // Where a path comes near and where it leaves again either look is wrong by a step of its own.
        for (std::size_t i = 1; i < costs.size(); ++i)
            ASSERT_LT(costs[i], costs[i - 1] + 0.8);
        improvements += costs.empty() ? 0 : costs.size() - 1;
    }
    EXPECT_GT(improvements, 20u);
}

TEST(PathPlanner, anytimeTriesToTurnEachBestPathRoundOnce)
{
    int tried = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed)
    {
        SCOPED_TRACE(seed);
        CarProblem problem = randomProblem(seed, 16);
        PathPlannerParameters parameters = parametersFor(problem);
        parameters.anytime = true;
        parameters.search.tuning.turnKnotSpacing = 0.01;  // so that as many knots as may be are asked about each time
        PathPlanner planner;
        problem.begin(planner, parameters);
        std::uint64_t best = 0;
        planner.solve(afterExpanding(planner, 4000),
                      [&best](const Path & /*path*/, double /*cost*/)
                      {
                          ++best;
                          return false;
                      });
        // The first solution may be tried before it is reported, and once more when it has become another one by then.
        ASSERT_LE(problem.world.turnsAsked, (best + 1) * (parameters.search.tuning.turnKnots + 2));
        tried += problem.world.turnsAsked > 0 ? 1 : 0;
    }
    EXPECT_GT(tried, 5);
}

TEST(PathPlanner, turningRoundKeepsToTheCuspsThatAPathMayHave)
{
    // Cusps cost nothing here. Of these problems, found among 22,500 with one to three cusps, each path would get more.
    struct Case
    {
        std::uint64_t seed;
        std::uint32_t boxes;
        std::uint8_t mostCusps;
        int questions{3000};  // in which it is solved
    };
    const Case cases[]{{30, 10, 1},   {132, 10, 1, 100000}, {328, 10, 1}, {1520, 10, 1},
                       {1654, 10, 1}, {2493, 10, 1},        {845, 16, 1}, {877, 10, 2}};
    for (const Case &each : cases)
    {
        SCOPED_TRACE(each.seed);
        CarProblem problem = randomProblem(each.seed, each.boxes);
        PathPlannerParameters parameters;
        parameters.search = parametersIn(problem);
        parameters.search.cost.gearChangePenalty = 0.0;
        parameters.search.mostCusps = each.mostCusps;
        const auto cuspsOf = [&](double dearTurns)
        {
            parameters.search.tuning.dearTurns = dearTurns;
            PathPlanner planner;
            problem.begin(planner, parameters);
            planner.solve(afterAsking(each.questions), nullptr);
            EXPECT_TRUE(planner.hasSolution());
            return planner.bestPath().cusps();
        };
        ASSERT_LE(cuspsOf(1.0), std::max<std::size_t>(cuspsOf(INFINITE), each.mostCusps));
    }
}

TEST(PathPlanner, endsWhenTheSolutionIsGoodEnough)
{
    CarProblem problem = maze(2);
    PathPlannerParameters parameters = parametersFor(problem);
    parameters.anytime = true;
    PathPlanner planner;
    problem.begin(planner, parameters);
    int reports = 0;
    EXPECT_EQ(planner.solve(nullptr, [&](const Path &, double) { return ++reports == 2; }), Outcome::Solved);
    EXPECT_EQ(reports, 2);
}

TEST(PathPlanner, endsByItselfWithTheBareCurve)
{
    CarProblem problem{DiscCarWorld({{-30.0, -30.0}, {30.0, 30.0}}), {{0.0, 0.0, 0.0}}, {{8.0, 3.0, 1.0}}};
    PathPlannerParameters parameters = parametersFor(problem);
    parameters.search.cost = {0.0, 0.0, 0.0, 0.0, 1.0, 1.0};
    parameters.anytime = true;
    PathPlanner planner;
    problem.begin(planner, parameters);
    EXPECT_EQ(planner.solve(nullptr, nullptr), Outcome::Solved);
    EXPECT_NEAR(planner.bestCost(), ReedsShepp(TURNING_RADIUS).distance(problem.starts[0], problem.goals[0]), 1e-9);
    EXPECT_NEAR(planner.suboptimalityBound(), 1.0, 1e-9);
}

TEST(PathPlanner, theBoundHoldsForTheBestThatIsEverFound)
{
    int bounded = 0;
    for (std::uint64_t seed = 0; seed < 16; ++seed)
    {
        SCOPED_TRACE(seed);
        CarProblem problem = randomProblem(seed);
        PathPlannerParameters parameters = parametersFor(problem);
        parameters.search.weights = {1.0, 1.0, 0.0, 0.0};
        parameters.shorten = false;  // what it finds is outside of the discretised problem
        PathPlanner planner;
        problem.begin(planner, parameters);
        if (planner.solve(afterAsking(3000), nullptr) != Outcome::Solved)
            continue;
        const double cost = planner.bestCost(), bound = planner.suboptimalityBound();
        parameters.anytime = true;
        PathPlanner longer;
        problem.begin(longer, parameters);
        longer.solve(afterExpanding(longer, 20000), nullptr);
        EXPECT_LE(cost / bound, longer.bestCost() + 1e-6);
        bounded += bound < INFINITE;
    }
    EXPECT_GT(bounded, 5);
}

TEST(PathPlanner, solvedOnceIsSolvedAgain)
{
    CarProblem problem = maze(2);
    PathPlanner planner;
    problem.begin(planner, parametersFor(problem));
    EXPECT_EQ(planner.solve(nullptr, nullptr), Outcome::Solved);
    const double cost = planner.bestCost();
    const std::uint64_t expanded = planner.statistics().expanded;
    EXPECT_EQ(planner.solve(nullptr, nullptr), Outcome::Solved);
    EXPECT_EQ(planner.bestCost(), cost);
    EXPECT_EQ(planner.statistics().expanded, expanded);
    // A start nearer by.
    planner.addStart({12.0, 0.0, 0.0});
    EXPECT_EQ(planner.solve(nullptr, nullptr), Outcome::Solved);
    EXPECT_LT(planner.bestCost(), 0.5 * cost);
}

TEST(PathPlanner, stoppedItGoesOn)
{
    CarProblem problem = maze(3);
    const PathPlannerParameters parameters = parametersFor(problem);
    PathPlanner whole, pieces;
    problem.begin(whole, parameters);
    ASSERT_EQ(whole.solve(nullptr, nullptr), Outcome::Solved);
    problem.begin(pieces, parameters);
    EXPECT_EQ(pieces.solve([] { return true; }, nullptr), Outcome::Stopped);
    EXPECT_EQ(pieces.statistics().expanded, 0u);
    int count = 0;
    while (pieces.solve(afterAsking(5), nullptr) == Outcome::Stopped)
        ASSERT_LT(++count, 10000);
    EXPECT_GT(count, 2);
    EXPECT_EQ(faultOf(pieces.bestPath(), problem.world, problem.starts, problem.goals, TURNING_RADIUS), "");
}

TEST(PathPlanner, askingForTheBoundAfterwardsDoesNotNeedTheStopFunctionAnyMore)
{
    CarProblem problem = maze(3);
    PathPlannerParameters parameters = parametersFor(problem);
    PathPlanner planner;
    problem.begin(planner, parameters);
    {
        const auto alive = std::make_unique<bool>(true);
        int called = 0;
        planner.solve(
            [&]
            {
                EXPECT_TRUE(*alive);
                return ++called > 60;
            },
            nullptr);
    }
    EXPECT_GE(planner.suboptimalityBound(), 1.0);  // the address sanitizer would tell
}

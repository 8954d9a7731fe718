// The planner without OMPL: search and improvement together, anytime, stopping, and paths to what cannot be reached.

#include "ompl_improved_astar/search/planning/PathPlanner.h"
#include "tests/ompl_improved_astar/search/CarProblems.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
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

    /** Names and values of parameters, as users write them. */
    using Settings = std::vector<std::pair<std::string, std::string>>;

    PlannerParameters with(const Settings &settings, PlannerParameters parameters = {})
    {
        for (const auto &[name, value] : settings)
            parameterNamed(name).setText(parameters, value);
        return parameters;
    }

    const std::vector<Settings> SWITCHES{
        {},
        {{"bidirectional", "false"}},
        {{"bidirectional", "false"}, {"search_from", "start"}},
        {{"adaptive_resolution", "false"}},
        {{"analytic_expansion", "false"}},
        {{"obstacle_heuristic", "false"}},
        {{"detours", "false"}},
        {{"shortening", "false"}},
        {{"obstacle_loading", "eager"}},
        {{"open_list", "linear"}},
        {{"steering_angles", "7"}},
        {{"heuristic_weight_far", "1"}, {"heuristic_weight_near", "1"}},
        {{"preferred_clearance", "0"}},
        {{"preferred_clearance", "0.5"}, {"clearance_cost", "30"}},
        {{"gear_change_penalty", "3"}, {"reverse_penalty", "1"}, {"steering_change_penalty", "0.5"}}};
}  // namespace

TEST(PathPlanner, everySwitchGivesPathsThatAreFreeAndPricedRight)
{
    constexpr std::uint64_t MAX_EXPANSIONS = 600;
    for (const Settings &settings : SWITCHES)
    {
        const std::string name = settings.empty() ? "defaults" : settings[0].first;
        const PlannerParameters parameters = with(settings);
        std::size_t solved = 0;
        PathPlanner reused;
        for (std::uint64_t seed = 0; seed < 20; ++seed)
        {
            SCOPED_TRACE(testing::Message() << name << ", " << seed);
            CarProblem problem = randomProblem(seed);
            PathPlanner planner;
            double reported = UNREACHED;
            problem.begin(planner, parameters);
            const auto report = [&reported](const Path &, double cost)
            {
                reported = reported < UNREACHED ? -1.0 : cost;  // once only
                return false;
            };
            const Outcome outcome = planner.solve(afterExpanding(planner, MAX_EXPANSIONS), report);
            ASSERT_EQ(planner.hasSolution(), outcome == Outcome::Solved);
            ASSERT_EQ(reported, planner.bestCost());
            // Equal input, equal path, also in memory that has served other problems.
            problem.begin(reused, parameters);
            ASSERT_EQ(reused.solve(afterExpanding(reused, MAX_EXPANSIONS), {}), outcome);
            ASSERT_EQ(reused.bestCost(), planner.bestCost());
            ASSERT_TRUE(isSamePath(reused.bestPath(), planner.bestPath()));
            ASSERT_EQ(planner.suboptimalityBound(planner.bestCost()) < UNREACHED, planner.hasSolution());
            if (!planner.hasSolution())
                continue;
            ++solved;
            const PricedPath priced = price(planner.search().cost(), planner.bestPath(), problem.world);
            ASSERT_EQ(problem.faultOf(planner.bestPath()), "");
            // Without time to price its path again it has the search's price, sampled at the ends of other pieces.
            const CostModel &cost = planner.search().cost();
            const double sampling =
                cost.clearanceCost * cost.sampleSpacing * static_cast<double>(priced.path.pieces.size());
            const double tolerance = planner.expanded() < MAX_EXPANSIONS ? 1e-6 : sampling + 1e-6;
            ASSERT_NEAR(planner.bestCost(), priced.cost, tolerance);
            ASSERT_NEAR(planner.proximityOfBest(), priced.totalProximity(), tolerance);
            ASSERT_GE(planner.suboptimalityBound(planner.bestCost()), 1.0);
        }
        EXPECT_GE(solved, parameters.analyticExpansion ? 12u : 0u) << name;
    }
}

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

TEST(PathPlanner, stopsSoonAndGoesOnToARightPath)
{
    constexpr std::uint64_t MAX_QUESTIONS = 4000;  // of a few pairs of poses that are joined, or a path that is priced
    for (const NamedProblem &each : namedProblems())
        for (const bool anytime : {false, true})
            for (const int polls : {0, 1, 5, 40, 300})
            {
                SCOPED_TRACE(testing::Message() << each.name << ", " << polls << " polls, anytime " << anytime);
                CarProblem problem = each.problem;
                PlannerParameters parameters;
                parameters.anytime = anytime;
                PathPlanner planner;
                problem.begin(planner, parameters);
                double cost = UNREACHED;
                for (int i = 0; i < 10; ++i)
                {
                    MeasuredStop stop{problem.world, afterPolls(polls)};
                    const Outcome outcome = planner.solve(std::ref(stop), {});
                    ASSERT_TRUE(outcome != Outcome::Stopped || stop.isStopped);
                    ASSERT_LE(stop.maxQuestions(), MAX_QUESTIONS);
                    ASSERT_LE(planner.bestCost(), cost);
                    cost = planner.bestCost();
                    ASSERT_TRUE(!planner.hasSolution() || problem.faultOf(planner.bestPath()).empty());
                    ASSERT_GE(planner.suboptimalityBound(cost), 1.0) << "without the stop function";
                }
                planner.solve(afterExpanding(planner, planner.expanded() + 2000), {});
                ASSERT_EQ(planner.hasSolution(), each.isSolvable);
                ASSERT_LE(planner.bestCost(), cost);
                ASSERT_TRUE(!each.isSolvable || problem.faultOf(planner.bestPath()).empty());
            }
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

TEST(PathPlanner, rootsAddedLaterAreUsedAndNothingGetsWorse)
{
    std::size_t better = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed)
    {
        SCOPED_TRACE(seed);
        CarProblem problem = randomProblem(seed, 6);
        Random random(seed);
        PathPlanner planner;
        problem.begin(planner, carParameters());
        planner.solve(afterExpanding(planner, 600), {});
        const double first = planner.bestCost();
        for (int i = 0; i < 4; ++i)
        {
            const double before = planner.bestCost();
            // The last goal is a metre ahead of the first start, if the car can stand there.
            Pose pose = i == 3 ? advance(problem.starts[0], 0.0, 1.0) : problem.world.freePose(random);
            if (problem.world.freeLength(problem.starts[0], {0.0, 1.0}) < 1.0 && i == 3)
                continue;
            (i == 0 ? problem.starts : problem.goals).push_back(pose);
            if (i == 0)
                planner.addStart(pose);
            else
                planner.addGoal(pose);
            planner.solve(afterExpanding(planner, planner.expanded() + 600), {});
            ASSERT_LE(planner.bestCost(), before);
            ASSERT_TRUE(!planner.hasSolution() || problem.faultOf(planner.bestPath()).empty());
            ASSERT_TRUE(i < 3 || planner.bestCost() <= 1.0 + 1e-9);
        }
        better += planner.bestCost() < first;
    }
    EXPECT_GT(better, 20u);
}

TEST(PathPlanner, penaltiesLowerWhatTheyPenalise)
{
    constexpr double CLEARANCE = 0.3;
    double cusps[2]{}, reverse[2]{}, near[2]{}, length = 0.0;
    for (std::uint64_t seed = 0; seed < 30; ++seed)
    {
        CarProblem problem = randomProblem(seed, 7);
        const auto pathWith = [&](const Settings &settings)
        {
            PathPlanner planner;
            problem.begin(planner, with(settings, with({{"anytime", "true"}}, carParameters())));
            planner.solve(afterExpanding(planner, 400), {});
            return planner.bestPath();
        };
        const Path plain = pathWith({{"gear_change_penalty", "0"}}), smooth = pathWith({{"gear_change_penalty", "8"}}),
                   forward = pathWith({{"gear_change_penalty", "0"}, {"reverse_penalty", "3"}}),
                   careful = pathWith({{"preferred_clearance", "0.3"}});
        cusps[0] += static_cast<double>(plain.cusps());
        cusps[1] += static_cast<double>(smooth.cusps());
        reverse[0] += metresInReverse(plain);
        reverse[1] += metresInReverse(forward);
        // The clearance can be kept where a larger car passes without going another way.
        const DiscCarWorld world = problem.world;
        problem.world.radius += CLEARANCE;
        const Path larger = pathWith({});
        if (larger.pieces.empty() || larger.length() > 1.2 * plain.length())
            continue;
        near[0] += metresNearer(world, plain, CLEARANCE);
        near[1] += metresNearer(world, careful, CLEARANCE);
        length += careful.length();
    }
    EXPECT_LT(cusps[1], 0.8 * cusps[0]);
    EXPECT_LT(reverse[1], 0.5 * reverse[0]);
    EXPECT_LT(near[1], 0.3 * near[0]);
    EXPECT_LT(near[1], 0.05 * length);
    EXPECT_GT(length, 100.0);
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

TEST(PathPlanner, anApproximatePathIsThereAlsoWithoutTime)
{
    for (const NamedProblem &each : namedProblems())
    {
        CarProblem problem = each.problem;
        const Pose target = problem.goals[0];
        PathPlanner planner;
        Path path;
        problem.begin(planner, {});
        const Outcome outcome = planner.solve(afterPolls(0), {});
        ASSERT_EQ(outcome == Outcome::Stopped, !planner.hasSolution());
        ASSERT_TRUE(planner.approximate(target, afterPolls(0), path));
        EXPECT_EQ(problem.faultTowards(path), "");
        problem.starts.clear();
        problem.begin(planner, {});
        EXPECT_FALSE(planner.approximate(target, afterPolls(1000), path));
    }
}

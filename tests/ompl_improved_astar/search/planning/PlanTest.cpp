// The stateless call: every outcome with its reason, and that equal requests give equal results.

#include "ompl_improved_astar/search/planning/Plan.h"
#include "parking_geometry/Error.h"
#include "tests/ompl_improved_astar/search/CarWorlds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <thread>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    const Pose NOWHERE{std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0};

    /** Worlds so small that a flood of all motions is quick, many of them without a path. */
    std::vector<CarProblem> smallProblems()
    {
        std::vector<CarProblem> problems;
        for (std::uint64_t seed = 0; seed < 40; ++seed)
            problems.push_back(randomProblem(seed, 5 + static_cast<std::uint32_t>(seed % 10), 7.0));
        for (double width = 2.0; width < 4.5; width += 0.2)
            problems.push_back(corner(width));
        return problems;
    }

    PlanRequest requestFor(const CarProblem &problem)
    {
        PlanRequest request;
        request.starts = problem.starts;
        request.goals = problem.goals;
        request.car = problem.car();
        return request;
    }

    CarProblem openField()
    {
        return {DiscCarWorld({{-30.0, -30.0}, {30.0, 30.0}}), {{0.0, 0.0, 0.0}}, {{8.0, 3.0, 1.0}}};
    }
}  // namespace

TEST(Plan, everyOutcomeComesWithItsReason)
{
    struct Case
    {
        std::string name;
        CarProblem problem;
        PlanOutcome exact, approximate;
        std::string reason;  // a part of it, where there is no solution
        std::function<void(PlanRequest &)> change;
    };
    CarProblem blockedGoal = openField(), blockedStart = openField();
    blockedGoal.world.boxes = {{{5.0, 0.0}, {12.0, 8.0}}};
    blockedStart.starts = {NOWHERE, {29.9, 0.0, 0.0}};
    CarProblem tight = corner(2.0), unknown = walledIn();
    tight.world.tellsBlocked = true;
    unknown.world.tellsRoom = false;
    using Outcome = PlanOutcome;
    const std::vector<Case> cases{
        {"open", openField(), Outcome::Solved, Outcome::Solved, "", {}},
        {"walled in", walledIn(), Outcome::Infeasible, Outcome::Approximate, "disc", {}},
        {"corner", tight, Outcome::Infeasible, Outcome::Approximate, "sideways", {}},
        {"blocked goal", blockedGoal, Outcome::InvalidGoal, Outcome::Approximate, "goal", {}},
        {"blocked start", blockedStart, Outcome::InvalidStart, Outcome::InvalidStart, "start", {}},
        {"stopped", unknown, Outcome::Timeout, Outcome::Approximate, "",
         [](PlanRequest &request)
         {
             request.stop = afterPolls(50);
         }},
        {"stopped at once", maze(3), Outcome::Timeout, Outcome::Approximate, "",
         [](PlanRequest &request)
         {
             request.stop = afterPolls(0);
         }},
        {"limited", maze(3), Outcome::Timeout, Outcome::Approximate, "",
         [](PlanRequest &request)
         {
             request.maxExpansions = 3;
         }},
        {"full", unknown, Outcome::Timeout, Outcome::Approximate, "16 MB",
         [](PlanRequest &request)
         {
             request.parameters = hungryParameters();
         }}};
    for (const Case &each : cases)
        for (const bool approximate : {false, true})
        {
            SCOPED_TRACE(testing::Message() << each.name << ", approximate " << approximate);
            CarProblem problem = each.problem;
            PlanRequest request = requestFor(problem);
            if (each.change)
                each.change(request);
            request.parameters.approximate = approximate;
            const PlanResult result = plan(problem.world, request);
            ASSERT_EQ(result.outcome, approximate ? each.approximate : each.exact) << result.reason;
            EXPECT_EQ(result.reason.empty(), each.reason.empty()) << result.reason;
            EXPECT_NE(result.reason.find(each.reason), std::string::npos) << result.reason;
            const bool isSolved = result.outcome == PlanOutcome::Solved;
            EXPECT_EQ(result.cost < std::numeric_limits<double>::infinity(), isSolved);
            EXPECT_EQ(result.suboptimalityBound < std::numeric_limits<double>::infinity(), isSolved);
            const bool hasPath = isSolved || result.outcome == PlanOutcome::Approximate;
            EXPECT_EQ(hasPath ? isSolved ? problem.faultOf(result.path) : problem.faultTowards(result.path) : "", "");
            EXPECT_TRUE(hasPath || result.path.pieces.empty());
            EXPECT_TRUE(request.maxExpansions == 0 || result.statistics.expanded <= request.maxExpansions);
        }
}

TEST(Plan, solvesWhatAFloodSolvesAndSaysInfeasibleOnlyWhereThatDoes)
{
    std::size_t solved = 0, tight = 0, walledIn = 0, enclosed = 0, number = 0;
    for (CarProblem &problem : smallProblems())
    {
        problem.world.tellsBlocked = true;
        const Flood flood(problem.world, problem.starts[0], problem.goals[0], true);
        ++number;
        for (const double weight : {2.5, 1.0})
        {
            SCOPED_TRACE(testing::Message() << "problem " << number << ", weight " << weight);
            PlanRequest request = requestFor(problem);
            request.parameters = carParameters();
            request.parameters.approximate = false;
            request.parameters.heuristicWeightFar = request.parameters.heuristicWeightNear = weight;
            request.maxExpansions = flood.cheapest < UNREACHED ? 20000 : 3000;
            const PlanResult result = plan(problem.world, request);
            ASSERT_TRUE(result.outcome == PlanOutcome::Solved || flood.cheapest == UNREACHED) << result.reason;
            walledIn += result.reason.find("disc") != std::string::npos;
            enclosed += result.reason.find("sideways") != std::string::npos;
            if (result.outcome != PlanOutcome::Solved)
                continue;
            ++solved;
            const double bound = result.cost / result.suboptimalityBound;
            ASSERT_EQ(problem.faultOf(result.path), "");
            ASSERT_LE(bound, std::min(flood.cheapest, result.cost) + 1e-6);
            tight += bound > 0.6 * std::min(flood.cheapest, result.cost);
            // The improver leaves little to a fine lattice with a curve at its end.
            ASSERT_LE(result.cost, 2.0 * flood.cheapest);
        }
    }
    EXPECT_GT(solved, 40u);
    EXPECT_GT(tight, solved / 2) << "a bound that says little is easily right";
    EXPECT_GT(walledIn, 5u);
    EXPECT_GT(enclosed, 0u);
}

TEST(Plan, refusesWhatIsNoRequest)
{
    const std::vector<std::function<void(PlanRequest &)>> mistakes{
        [](PlanRequest &request) { request.goals.clear(); },
        [](PlanRequest &request) { request.starts.clear(); },
        [](PlanRequest &request) { request.parameters.heuristicWeightFar = -1.0; },
        [](PlanRequest &request) { request.parameters.heuristic = "crystal_ball"; },
        [](PlanRequest &request) { request.parameters.steeringAngles = 4; },
        [](PlanRequest &request)
        {
            request.parameters.motionModel = "boat";
        }};
    CarProblem problem = openField();
    for (const auto &mistake : mistakes)
    {
        PlanRequest request = requestFor(problem);
        mistake(request);
        EXPECT_THROW(plan(problem.world, request), Error);
    }
}

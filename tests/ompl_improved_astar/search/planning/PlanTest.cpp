// The stateless call: every outcome, and that equal requests give equal results.

#include "ompl_improved_astar/search/planning/Plan.h"
#include "parking_geometry/Error.h"
#include "tests/ompl_improved_astar/search/CarProblems.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <thread>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    PlanRequest requestFor(const CarProblem &problem)
    {
        PlanRequest request;
        request.starts = problem.starts;
        request.goals = problem.goals;
        request.car.turningRadius = TURNING_RADIUS;
        request.car.inscribedRadius = problem.world.radius;
        return request;
    }

    CarProblem openField()
    {
        return {DiscCarWorld({{-30.0, -30.0}, {30.0, 30.0}}), {{0.0, 0.0, 0.0}}, {{8.0, 3.0, 1.0}}};
    }

    /** The goal is in a room without a door. */
    CarProblem walledIn()
    {
        CarProblem problem = openField();
        problem.world.boxes = {{{10.0, 10.0}, {25.0, 10.5}},
                               {{10.0, 25.0}, {25.0, 25.5}},
                               {{10.0, 10.0}, {10.5, 25.0}},
                               {{25.0, 10.0}, {25.5, 25.5}}};
        problem.goals = {{17.0, 17.0, 0.0}};
        return problem;
    }
}  // namespace

TEST(Plan, solvesAndSaysWhichGoalItReached)
{
    CarProblem problem = openField();
    problem.goals.insert(problem.goals.begin(), {25.0, 25.0, 0.0});
    const PlanResult result = plan(problem.world, requestFor(problem));
    ASSERT_EQ(result.outcome, PlanOutcome::Solved) << result.reason;
    EXPECT_EQ(result.goal, 1u) << "the nearer one";
    EXPECT_EQ(faultOf(result.path, problem.world, problem.starts, problem.goals, TURNING_RADIUS), "");
    EXPECT_GE(result.cost, result.path.length() - 1e-9);
    EXPECT_GE(result.suboptimalityBound, 1.0);
    EXPECT_LT(result.suboptimalityBound, 2.0);
    EXPECT_TRUE(result.reason.empty());
}

TEST(Plan, endsWhereItsMemoryEnds)
{
    // Fine cells round a goal in a room without a door: more and more of them, without end.
    CarProblem problem = walledIn();
    PlanRequest request = requestFor(problem);
    request.car.inscribedRadius = 0.0;
    request.parameters.obstacleHeuristic = false;
    request.parameters.xyResolution = 0.001;
    request.parameters.headingBins = 1440;
    request.parameters.steeringAngles = 21;
    request.maxExpansions = 1000000;
    std::uint64_t before = 0;
    for (const unsigned int megabytes : {16U, 32U})
    {
        request.parameters.maxMemoryMb = megabytes;
        problem.world.questions = 0;
        const PlanResult result = plan(problem.world, request);
        const std::uint64_t questions = problem.world.questions;
        EXPECT_EQ(result.outcome, PlanOutcome::Approximate) << "where it has got to";
        EXPECT_EQ(faultOf(result.path, problem.world, problem.starts, {result.path.end()}, TURNING_RADIUS), "");
        EXPECT_NE(result.reason.find(std::to_string(megabytes) + " MB"), std::string::npos) << result.reason;
        // About twice the memory for twice the work.
        EXPECT_GT(result.statistics.generated, before + before / 2);
        EXPECT_LT(result.statistics.generated, 500000U * megabytes);
        before = result.statistics.generated;
        PlanRequest exact = request;
        exact.parameters.approximate = false;
        problem.world.questions = 0;
        const PlanResult none = plan(problem.world, exact);
        EXPECT_EQ(none.statistics.generated, before);
        EXPECT_EQ(problem.world.questions, questions) << "no other search, which would take as much memory again";
        EXPECT_EQ(none.outcome, PlanOutcome::Timeout);
    }
}

// Two rows of 50 free slots between pillars, the aisle in the middle. Counted are questions to the world.
TEST(Plan, findsTheNearestOfManyGoalsWithLittleMoreThanOne)
{
    CarProblem problem{DiscCarWorld({{-110.0, -12.0}, {110.0, 12.0}}), {{-20.0, 0.0, 0.0}}, {}};
    std::vector<Pose> slots;
    for (int i = 0; i < 50; ++i)
        for (const double side : {-1.0, 1.0})
        {
            const double x = -100.0 + 4.0 * i;
            if (i % 5 == 0)
                problem.world.boxes.push_back(
                    {{x - 2.6, side > 0.0 ? 5.0 : -12.0}, {x - 1.4, side > 0.0 ? 12.0 : -5.0}});
            slots.push_back({x, 10.0 * side, -0.5 * PI * side});
        }
    std::uint64_t most = 0;
    double shortest = std::numeric_limits<double>::infinity();
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < slots.size(); ++i)
    {
        // Those round the nearest, and some far away.
        if (std::abs(slots[i].x - problem.starts.front().x) > 10.0 && i % 25 != 0)
            continue;
        problem.goals = {slots[i]};
        problem.world.questions = 0;
        const PlanResult one = plan(problem.world, requestFor(problem));
        ASSERT_EQ(one.outcome, PlanOutcome::Solved) << i;
        most = std::max(most, problem.world.questions);
        if (one.cost < shortest)
        {
            shortest = one.cost;
            nearest = i;
        }
    }
    problem.goals = slots;
    problem.world.questions = 0;
    const PlanResult all = plan(problem.world, requestFor(problem));
    ASSERT_EQ(all.outcome, PlanOutcome::Solved);
    EXPECT_LE(problem.world.questions, 2 * most);
    EXPECT_LE(all.cost, 1.15 * shortest) << "the nearest is " << nearest << ", found was " << all.goal;
    EXPECT_TRUE(isSamePose(all.path.end(), slots[all.goal], 1e-6));
    RecordProperty("one", static_cast<int>(most));
    RecordProperty("all", static_cast<int>(problem.world.questions));
}

TEST(Plan, saysWhyThereIsNoWay)
{
    CarProblem problem = walledIn();
    PlanRequest request = requestFor(problem);
    PlanResult result = plan(problem.world, request);
    EXPECT_EQ(result.outcome, PlanOutcome::Approximate);
    EXPECT_NE(result.reason.find("disc"), std::string::npos) << result.reason;
    EXPECT_EQ(faultOf(result.path, problem.world, problem.starts, {result.path.end()}, TURNING_RADIUS), "");
    request.parameters.approximate = false;
    result = plan(problem.world, request);
    EXPECT_EQ(result.outcome, PlanOutcome::Infeasible);
    EXPECT_NE(result.reason.find("disc"), std::string::npos) << result.reason;
    EXPECT_TRUE(result.path.pieces.empty());
    EXPECT_EQ(result.cost, std::numeric_limits<double>::infinity());
}

TEST(Plan, tellsATimeoutFromAnEndlessTask)
{
    CarProblem problem = walledIn();
    problem.world.tellsRoom = false;  // nothing is proven, so the search is stopped
    PlanRequest request = requestFor(problem);
    request.parameters.approximate = false;
    int asked = 0;
    request.stop = [&asked]
    {
        return ++asked > 50;
    };
    const PlanResult result = plan(problem.world, request);
    EXPECT_EQ(result.outcome, PlanOutcome::Timeout);
    EXPECT_TRUE(result.reason.empty());
}

TEST(Plan, namesInvalidEnds)
{
    CarProblem problem = openField();
    problem.world.boxes = {{{5.0, 0.0}, {12.0, 8.0}}};
    PlanRequest request = requestFor(problem);
    request.parameters.approximate = false;
    EXPECT_EQ(plan(problem.world, request).outcome, PlanOutcome::InvalidGoal);
    request.starts = {{std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}, {6.0, 4.0, 0.0}};
    EXPECT_EQ(plan(problem.world, request).outcome, PlanOutcome::InvalidStart);
}

TEST(Plan, refusesWhatIsNoRequest)
{
    CarProblem problem = openField();
    PlanRequest request = requestFor(problem);
    request.goals.clear();
    EXPECT_THROW(plan(problem.world, request), Error);
    request = requestFor(problem);
    request.parameters.heuristicWeightFar = -1.0;
    EXPECT_THROW(plan(problem.world, request), Error);
    request = requestFor(problem);
    request.parameters.heuristic = "crystal_ball";
    EXPECT_THROW(plan(problem.world, request), Error);
}

TEST(Plan, equalRequestsGiveEqualPathsInAnyThread)
{
    for (std::uint64_t seed = 0; seed < 4; ++seed)
    {
        CarProblem problem = randomProblem(seed);
        PlanRequest request = requestFor(problem);
        std::vector<PlanResult> results(3);
        std::vector<CarProblem> copies(3, problem);
        std::vector<std::thread> threads;
        for (std::size_t i = 0; i < results.size(); ++i)
            threads.emplace_back([&, i] { results[i] = plan(copies[i].world, request); });
        for (std::thread &thread : threads)
            thread.join();
        for (const PlanResult &result : results)
        {
            ASSERT_EQ(result.outcome, results[0].outcome);
            ASSERT_EQ(result.cost, results[0].cost);
            ASSERT_EQ(result.path.pieces.size(), results[0].path.pieces.size());
            ASSERT_EQ(result.statistics.expanded, results[0].statistics.expanded);
        }
    }
}

#include "automatic_parking/scenario/ScenarioPlanner.h"

#include "automatic_parking/scenario/SearchTrace.h"
#include "parking_geometry/MakeScenario.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "parking_geometry/referee/Referee.h"
#include "tests/parking_geometry/ExpectError.h"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace
{
    using namespace parking;
    using namespace parking_test;
    using search::PlanOutcome;

    Scenario bundled(const std::string &name)
    {
        return readScenario(std::string(PARKING_SOURCE_DIR) + "/benchmarks/scenarios/" + name + ".yaml");
    }

    /** Between start and goal stands a wall with a gap. */
    Scenario gap(double width)
    {
        Scenario scenario;
        scenario.start = {-10.0, 0.0, 0.0};
        scenario.goals = {{10.0, 0.0, 0.0}};
        scenario.polygons = {{{-0.5, -25.0}, {0.5, -25.0}, {0.5, 2.0}, {-0.5, 2.0}},
                             {{-0.5, 2.0 + width}, {0.5, 2.0 + width}, {0.5, 30.0}, {-0.5, 30.0}}};
        return makeScenario(scenario, "gap");
    }

    TEST(ScenarioPlanner, PlansWhatTheRefereeAccepts)
    {
        for (const char *name : {"perpendicular", "narrow_parallel", "underground_garage"})
        {
            const ScenarioPlanner planner(bundled(name));
            PlanLimits limits;
            limits.time = std::numeric_limits<double>::infinity();
            const ScenarioPlan plan = planner.plan({}, limits);
            ASSERT_EQ(plan.outcome, PlanOutcome::Solved) << name;
            EXPECT_TRUE(check(planner.scenario(), plan.path).valid) << name;
            EXPECT_GT(planner.clearance(plan), 0.0) << name;
            const SampledPath states = planner.states(plan);
            const Pose &goal = planner.scenario().goals[plan.goal], &end = states.back().pose;
            EXPECT_EQ(end.x, goal.x) << name;
            EXPECT_EQ(end.y, goal.y) << name;
            EXPECT_FALSE(planner.trajectory(plan).trajectory.motion.knots.empty()) << name;
        }
    }

    TEST(ScenarioPlanner, TheGridModelsPlanForACircle)
    {
        // The circle is as wide as the car: it fits through a gap that is a little wider, and not through a narrower
        // one.
        PlannerParameters grid;
        grid.motionModel = "grid8";
        grid.xyResolution = 0.25;
        const double width = Vehicle().width;
        const ScenarioPlanner wide(gap(width + 0.6)), narrow(gap(width - 0.1));
        PlanLimits limits;
        limits.time = std::numeric_limits<double>::infinity();
        const ScenarioPlan plan = wide.plan(grid, limits);
        ASSERT_EQ(plan.outcome, PlanOutcome::Solved);
        EXPECT_TRUE(plan.isDisc);
        EXPECT_TRUE(Referee(wide.scenario(), wide.circleRadius()).check(plan.path).valid);
        EXPECT_GT(wide.clearance(plan), 0.0);
        // Round the end of the wall there is always a way.
        EXPECT_LT(plan.path.length(), 25.0);
        EXPECT_GT(narrow.plan(grid, limits).path.length(), 45.0);
    }

    TEST(ScenarioPlanner, ReportsAtOnceThatStartOrGoalTouches)
    {
        // A wall at the rear bumper, at no distance or almost none.
        const Vehicle vehicle;
        for (const double distance : {0.0, 1e-12, 4e-10})
            for (const bool isStart : {true, false})
            {
                const double rear = (isStart ? 0.0 : 12.0) - vehicle.rearOverhang - distance;
                Scenario scenario;
                scenario.goals = {{12.0, 3.0, 0.0}};
                const double y = isStart ? 0.0 : 3.0;
                scenario.polygons = {{{rear - 1.0, y - 1.0}, {rear, y - 1.0}, {rear, y + 1.0}, {rear - 1.0, y + 1.0}}};
                PlannerParameters parameters;
                parameters.approximate = false;
                const ScenarioPlan plan = ScenarioPlanner(makeScenario(scenario, "contact")).plan(parameters, {});
                EXPECT_EQ(plan.outcome, isStart ? PlanOutcome::InvalidStart : PlanOutcome::InvalidGoal) << distance;
            }
    }

    TEST(ScenarioPlanner, EndsWhenItShall)
    {
        const ScenarioPlanner planner(bundled("narrow_parallel"));
        PlanLimits few;
        few.time = std::numeric_limits<double>::infinity();
        few.expansions = 10;
        const ScenarioPlan stopped = planner.plan({}, few);
        EXPECT_NE(stopped.outcome, PlanOutcome::Solved);
        EXPECT_LE(stopped.statistics.expanded, 40u);
        PlanLimits interrupted;
        int asked = 0;
        interrupted.interrupted = [&asked]
        {
            return ++asked > 5;
        };
        EXPECT_NE(planner.plan({}, interrupted).outcome, PlanOutcome::Solved);
        PlanLimits wrong;
        for (const double time : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
        {
            wrong.time = time;
            expectError([&] { planner.plan({}, wrong); }, {"time_limit"});
        }
        PlannerParameters parameters;
        parameters.headingBins = 3;
        expectError([&] { planner.plan(parameters); }, {"heading_bins"});
        EXPECT_EQ(statusName(PlanOutcome::Solved), "exact");
        EXPECT_EQ(statusName(PlanOutcome::Timeout), "timeout");
    }

    TEST(ScenarioPlanner, WithoutAPathThereIsNothingToMeasure)
    {
        Scenario scenario = gap(3.0);
        scenario.start = scenario.goals.front();
        scenario.start.x = 10.0;  // local: in the wall
        const ScenarioPlanner planner(scenario);
        const ScenarioPlan plan = planner.plan({});
        EXPECT_EQ(plan.outcome, PlanOutcome::InvalidStart);
        EXPECT_TRUE(planner.states(plan).empty());
        EXPECT_TRUE(std::isinf(planner.clearance(plan)));
        expectError([&] { planner.trajectory(plan); }, {"no path"});
    }

    TEST(SearchTrace, GrowsAsTheSearchDoes)
    {
        const ScenarioPlanner planner(bundled("narrow_parallel"));
        PlanLimits limits;
        limits.time = std::numeric_limits<double>::infinity();
        const ScenarioPlan plan = planner.plan({}, limits);
        const SearchTrace trace = traceSearch(planner, {}, limits, 1000000);
        ASSERT_FALSE(trace.steps.empty());
        EXPECT_EQ(trace.steps.back().expanded, plan.statistics.expanded);
        EXPECT_TRUE(trace.steps.back().solved);
        EXPECT_EQ(trace.steps.back().start, trace.start.size());
        EXPECT_EQ(trace.steps.back().goal, trace.goal.size());
        for (std::size_t i = 1; i < trace.steps.size(); ++i)
        {
            EXPECT_GT(trace.steps[i].expanded, trace.steps[i - 1].expanded);
            EXPECT_GE(trace.steps[i].start, trace.steps[i - 1].start);
            EXPECT_GE(trace.steps[i].goal, trace.steps[i - 1].goal);
        }
        // Every motion leads from the parent to the node.
        std::size_t roots = 0;
        for (std::size_t i = 0; i < trace.goal.size(); ++i)
        {
            const TraceNode &node = trace.goal[i];
            ASSERT_LT(node.parent, trace.goal.size());
            if (node.parent == i)
                ++roots;
            else
                EXPECT_LT(
                    positionDistance(advance(trace.goal[node.parent].pose, node.curvature, node.length), node.pose),
                    1e-6);
        }
        EXPECT_EQ(roots, planner.scenario().goals.size());
        EXPECT_LE(traceSearch(planner, {}, limits, 20).steps.size(), 20u);
    }
}  // namespace

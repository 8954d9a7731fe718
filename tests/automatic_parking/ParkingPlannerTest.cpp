#include "automatic_parking/ParkingPlanner.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "state_validity/sweeps/PathSweep.h"
#include "tests/automatic_parking/ParkingProblems.h"
#include "tests/support/ExpectRefused.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace
{
    using namespace parking;
    using namespace parking_test;

    void expectAt(const Pose &pose, const Pose &wanted)
    {
        EXPECT_NEAR(pose.x, wanted.x, 1e-6);
        EXPECT_NEAR(pose.y, wanted.y, 1e-6);
        EXPECT_NEAR(wrapAngle(pose.yaw - wanted.yaw), 0.0, 1e-6);
    }

    TEST(ParkingPlannerTest, entersASlotByApproachAndManoeuvre)
    {
        const Scenario scenario = rowOfSlots();
        const ParkingPlan plan = ParkingPlanner().plan(scenario);
        ASSERT_TRUE(plan.found) << plan.message;
        ASSERT_FALSE(plan.manoeuvre.path.pieces.empty());
        expectAt(plan.approach.start, scenario.start);
        expectAt(plan.approach.end(), plan.manoeuvre.path.start);
        expectAt(plan.manoeuvre.path.end(), plan.goal);
        expectAt(plan.goal, scenario.goals.front());
        expectAt(plan.path.start, scenario.start);
        expectAt(plan.path.end(), plan.goal);
        EXPECT_EQ(plan.path.pieces.back().direction(), -1);
        EXPECT_TRUE(isPathFree(ParkingWorld(scenario).footprint(), plan.path));
        EXPECT_NE(plan.message.find("manoeuvre"), std::string::npos);
    }

    TEST(ParkingPlannerTest, withoutManoeuvresTheSearchGoesAllTheWay)
    {
        PlanningParameters parameters;
        parameters.entryMode = EntryMode::Searched;
        const Scenario scenario = rowOfSlots();
        const ParkingPlan plan = ParkingPlanner(parameters).plan(scenario);
        ASSERT_TRUE(plan.found) << plan.message;
        EXPECT_TRUE(plan.manoeuvre.path.pieces.empty());
        expectAt(plan.arcs.end(), scenario.goals.front());
    }

    TEST(ParkingPlannerTest, keepsAGapWhereThereIsRoom)
    {
        const Scenario scenario = rowOfSlots();
        const ParkingPlan plan = ParkingPlanner().plan(scenario);
        ASSERT_TRUE(plan.found);
        EXPECT_GE(plan.gap, 0.25);
        EXPECT_GE(plan.clearance, 0.24);
    }

    TEST(ParkingPlannerTest, goesThroughWhereTheGapDoesNot)
    {
        // A gate that leaves 4 cm on either side of the car.
        Scenario scenario = openGround();
        const double half = 0.5 * scenario.vehicle.width + 0.04;
        scenario.polygons = {box(6.0, half, 8.0, 15.0), box(6.0, -15.0, 8.0, -half)};
        PlanningParameters parameters;
        parameters.timeLimit = 100.0;  // a busy machine must not decide which gap is tried
        const ParkingPlan plan = ParkingPlanner(parameters).plan(scenario);
        ASSERT_TRUE(plan.found) << plan.message;
        EXPECT_GE(plan.gap, 0.015);
        EXPECT_LE(plan.gap, 0.04);
        EXPECT_LE(plan.clearance, 0.0401);
        EXPECT_GT(plan.clearance, 0.01);
    }

    TEST(ParkingPlannerTest, aWideGapIsWorthSomeWayButNotAnyWay)
    {
        // The same gate, wide enough for 10 cm on either side, and a way round it.
        Scenario scenario = openGround();
        const double half = 0.5 * scenario.vehicle.width + 0.1;
        scenario.polygons = {box(6.0, half, 8.0, 9.0), box(6.0, -15.0, 8.0, -half)};
        const ParkingPlan direct = ParkingPlanner().plan(scenario);
        ASSERT_TRUE(direct.found);
        EXPECT_LT(direct.path.length(), 16.0);
        PlanningParameters parameters;
        parameters.gapWeight = 100.0;
        const ParkingPlan round = ParkingPlanner(parameters).plan(scenario);
        ASSERT_TRUE(round.found);
        EXPECT_GT(round.clearance, 0.2);
        EXPECT_GT(round.path.length(), 16.0);
    }

    TEST(ParkingPlannerTest, saysWhyThereIsNoPath)
    {
        Scenario scenario = openGround();
        scenario.polygons = {box(-1.0, -0.5, 0.0, 0.5)};
        EXPECT_EQ(ParkingPlanner().plan(scenario).failure, ParkingStatus::InvalidStart);
        scenario.polygons = {box(14.0, -0.5, 15.0, 0.5)};
        EXPECT_EQ(ParkingPlanner().plan(scenario).failure, ParkingStatus::InvalidGoal);
        scenario.polygons = {box(6.0, -15.0, 8.0, 15.0)};
        const ParkingPlan none = ParkingPlanner().plan(scenario);
        EXPECT_FALSE(none.found);
        EXPECT_EQ(none.failure, ParkingStatus::NoPath);
        EXPECT_NE(none.message.find("no path"), std::string::npos) << none.message;
        EXPECT_TRUE(none.path.pieces.empty());
    }

    TEST(ParkingPlannerTest, aSlotTooTightForOneSweepIsEnteredInStretches)
    {
        // 30 cm wider than the car, on an aisle of 4.5 m, the same world for both: measured, not imagined.
        const Scenario scenario = rowOfSlots(4.5, vehicleByName("vw_golf8").width + 0.3);
        EXPECT_TRUE(ParkingPlanner().plan(scenario).manoeuvre.path.pieces.empty()) << "no sweep fits";
        const ParkingPlan plan = ParkingPlanner(PlanningParameters::intoTightSlots(4.5)).plan(scenario);
        ASSERT_TRUE(plan.found) << plan.message;
        EXPECT_GT(plan.manoeuvre.path.stretches().size(), 1u);
        expectAt(plan.approach.end(), plan.manoeuvre.path.start);
        expectAt(plan.path.end(), plan.goal);
        EXPECT_TRUE(isPathFree(ParkingWorld(scenario).footprint(), plan.path));
        EXPECT_GE(plan.clearance, 0.5 * plan.gap - 1e-3);
    }

    TEST(ParkingPlannerTest, aStartNearerThanTheGapIsLeftWithItsOwnRoom)
    {
        Scenario scenario = rowOfSlots();
        const double side = scenario.start.y + 0.5 * scenario.vehicle.width;
        const ParkingPlanner planner(PlanningParameters::intoTightSlots(6.0));
        for (const double room : {0.03, 0.003})
        {
            scenario.polygons.push_back(box(-10.0, side + room, -9.0, side + 1.0));
            const ParkingPlan plan = planner.plan(scenario);
            EXPECT_EQ(plan.found, room > PlanningParameters::MIN_GAP_IN_STRETCHES) << plan.message;
            if (plan.found)
                EXPECT_NEAR(plan.gap, planner.parameters().tuning.shareOfStartGap * room, 1e-6);
            else
                EXPECT_EQ(plan.failure, ParkingStatus::InvalidStart);
        }
    }

    TEST(ParkingPlannerTest, aCarAtTheGoalStaysThere)
    {
        Scenario scenario = rowOfSlots();
        scenario.start = scenario.goals.front();
        for (const PlanningParameters &parameters : {PlanningParameters{}, PlanningParameters::intoTightSlots(6.0)})
        {
            const ParkingPlan plan = ParkingPlanner(parameters).plan(scenario);
            EXPECT_TRUE(plan.found) << plan.message;
            EXPECT_TRUE(plan.path.pieces.empty());
            EXPECT_EQ(plan.attempts, 0u);
            expectAt(plan.path.end(), plan.goal);
            EXPECT_GT(plan.clearance, 0.0);
        }
    }

    TEST(ParkingPlannerTest, repeatsItself)
    {
        const Scenario scenario = readScenario(bundledFile("parallel"));
        const ParkingPlan a = ParkingPlanner().plan(scenario), b = ParkingPlanner().plan(scenario);
        ASSERT_TRUE(a.found);
        ASSERT_EQ(a.path.pieces.size(), b.path.pieces.size());
        for (std::size_t i = 0; i < a.path.pieces.size(); ++i)
        {
            EXPECT_EQ(a.path.pieces[i].curvature, b.path.pieces[i].curvature);
            EXPECT_EQ(a.path.pieces[i].length, b.path.pieces[i].length);
        }
    }

    TEST(ParkingPlannerTest, theClearanceIsTheLeastAlongThePath)
    {
        const Scenario scenario = readScenario(bundledFile("perpendicular"));
        const ParkingWorld world(scenario);
        const ParkingPlan plan = ParkingPlanner().plan(scenario, world);
        ASSERT_TRUE(plan.found);
        double least = std::numeric_limits<double>::infinity();
        for (const PathState &state : plan.path.sample(0.002))
            least = std::min(least, world.footprint().exactClearance(state.pose));
        EXPECT_NEAR(plan.clearance, least, 0.001 + 0.01 * least);
    }

    TEST(ParkingPlannerTest, refusesBadInput)
    {
        using P = PlanningParameters;
        const double nan = std::nan("");
        expectRefused<P>({{"timeLimit", field(&P::timeLimit), {0.0, nan}},
                          {"expansionsPerGap", field(&P::expansionsPerGap), {0.0}},
                          {"radiusFactor", field(&P::radiusFactor), {0.9, nan}},
                          {"gapWeight", field(&P::gapWeight), {-1.0, nan}},
                          {"gearChangePenalty", field(&P::gearChangePenalty), {-1.0, nan}},
                          {"steeringChangePenalty", field(&P::steeringChangePenalty), {-1.0, nan}},
                          {"preferredClearance", field(&P::preferredClearance), {-1.0, nan}},
                          {"clearanceCost", field(&P::clearanceCost), {-1.0, nan}},
                          {"a gap", [](P &p, double gap) { p.gaps = {gap}; }, {-0.1, nan}},
                          {"gaps", [](P &p, double) { p.gaps.clear(); }, {0.0}}},
                         [](const P &parameters) { ParkingPlanner planner(parameters); });
        Scenario scenario = openGround();
        scenario.goals.clear();
        expectError([&] { ParkingPlanner().plan(scenario); }, {"no goal"});
        scenario = openGround();
        scenario.vehicle.wheelbase = -1.0;
        expectError([&] { ParkingPlanner().plan(scenario); }, {"wheelbase"});
    }
}  // namespace

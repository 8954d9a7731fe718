// Slots that are too tight for one sweep, by the planner's car model; the way from the aisle into them.

#include "automatic_parking/SlotQuestions.h"

#include "benchmarks/worlds/PolygonOracle.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/manoeuvres/SlotSurroundings.h"
#include "tests/parking_geometry/ExpectError.h"
#include "tests/support/PoseGap.h"

#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

using namespace parking;
using parking_test::expectError;
using parking_test::gap;
using parking_test::PolygonOracle;

namespace
{
    constexpr double AISLE = 4.5;

    /** Parallel slots of car length + 50 cm, with 25 cm to the kerb; perpendicular ones of width + 30 cm. */
    ParkingSlot tightSlot(SlotKind kind, const Vehicle &car, SlotSide side = SlotSide::Right)
    {
        ParkingSlot slot;
        slot.kind = kind;
        slot.side = side;
        slot.pose = {3.0, -2.0, 0.4};
        slot.length = car.length() + (kind == SlotKind::Parallel ? 0.5 : 0.3);
        slot.width = car.width + (kind == SlotKind::Parallel ? 0.5 : 0.3);
        return slot;
    }

    ParkingPlanner inAisle(double width)
    {
        return ParkingPlanner(PlanningParameters::intoTightSlots(width));
    }

    /** A slot in a world that is given, and not the one of its size. */
    Scenario inWorld(const Vehicle &car, const ParkingSlot &slot, const Pose &start, std::vector<Polygon> obstacles)
    {
        Scenario scenario;
        scenario.vehicle = car;
        scenario.slot = slot;
        scenario.goals = slot.goals(car);
        scenario.start = start;
        scenario.polygons = std::move(obstacles);
        scenario.bounds = {{-30.0, -30.0}, {30.0, 30.0}};
        return scenario;
    }

    PolygonOracle oracleFor(const ParkingSlot &slot, double aisle)
    {
        return {slotSurroundings(slot, slot.side, aisle), {{-60.0, -60.0}, {60.0, 60.0}}};
    }

    void expectFree(const Path &path, const Vehicle &car, const PolygonOracle &oracle, double margin)
    {
        Pose pose = path.start;
        for (const PathPiece &segment : path.pieces)
        {
            ASSERT_LE(std::abs(segment.curvature), (1.0 + 1e-9) / car.minTurningRadius());
            ASSERT_TRUE(oracle.isArcFree(pose, segment.curvature, segment.length, car, 0.002, margin));
            pose = advance(pose, segment.curvature, segment.length);
        }
    }

    /** A start in the middle of the aisle, \e along metres after the slot. */
    Pose inTheAisle(const ParkingSlot &slot, double along)
    {
        const double mirror = slot.side == SlotSide::Left ? -1.0 : 1.0;
        const Pose lane = slot.kind == SlotKind::Parallel
                              ? Pose{along, mirror * (0.5 * slot.width + 0.5 * AISLE), 0.0}
                              : Pose{0.5 * slot.length + 0.5 * AISLE, -mirror * along, -mirror * 0.5 * PI};
        return compose(slot.pose, lane);
    }

    class TightSlots : public testing::TestWithParam<std::string>
    {
    };
}  // namespace

TEST_P(TightSlots, AreEnteredInStretches)
{
    const Vehicle car = vehicleByName(GetParam());
    for (const SlotKind kind : {SlotKind::Parallel, SlotKind::Perpendicular})
    {
        const bool parallel = kind == SlotKind::Parallel;
        SCOPED_TRACE(parallel ? "parallel" : "perpendicular");
        const ParkingSlot slot = tightSlot(kind, car);
        const ReverseParkingResult result = planSlotEntry(inAisle(AISLE), car, slot);
        if (!parallel && car.name == "mercedes_s_w223")
        {
            // 5.18 m of car, a ladder round a corner: not even sideways would it get in.
            EXPECT_FALSE(result.fits());
            EXPECT_NE(result.message.find("any number of stretches"), std::string::npos) << result.message;
            EXPECT_GT(result.neededAisleWidth, AISLE);
            continue;
        }
        ASSERT_TRUE(result.fits()) << result.message;
        if (parallel)
        {
            EXPECT_GT(result.path.stretches().size(), 1u);
            EXPECT_GT(result.neededSlotLength, slot.length) << "one sweep needs more";
        }
        EXPECT_LT(gap(result.path.end(), slot.goals(car).front()), 1e-9);
        expectFree(result.path, car, oracleFor(slot, AISLE), 0.008);
    }
}

INSTANTIATE_TEST_SUITE_P(Cars, TightSlots, testing::ValuesIn(vehicleNames()),
                         [](const testing::TestParamInfo<std::string> &car) { return car.param; });

TEST(SlotQuestions, NoBodyTurnsWhereTheBoundSaysSo)
{
    // The S-class, slid round the corner without any steering limits.
    const Vehicle car = vehicleByName("mercedes_s_w223");
    for (const double more : {0.28, 0.40})
    {
        ParkingSlot slot = tightSlot(SlotKind::Perpendicular, car);
        slot.pose = {0.0, 0.0, 0.5 * PI};
        slot.width = car.width + more;
        const PolygonOracle oracle = oracleFor(slot, AISLE);
        // For each turn of the body from the slot's axis: can it be anywhere?
        bool always = true;
        for (double turn = 0.3; turn < 0.7 && always; turn += 0.05)
        {
            bool somewhere = false;
            for (double x = -1.2; x < 1.2 && !somewhere; x += 0.02)
                for (double y = 1.0; y < 5.0 && !somewhere; y += 0.02)
                    somewhere = oracle.isFree({x, y, 0.5 * PI - turn}, car, 0.01);
            always = somewhere;
        }
        PlanningParameters parameters = PlanningParameters::intoTightSlots(AISLE);
        parameters.expansionsPerGap = 100;
        const ReverseParkingResult result = planSlotEntry(ParkingPlanner(parameters), car, slot);
        EXPECT_EQ(always, result.message.find("any number of stretches") == std::string::npos) << more;
        EXPECT_EQ(always, more > 0.3);
    }
}

TEST(SlotQuestions, TheWholeWayIsDrivableAndFree)
{
    for (const char *name : {"tpcap", "toyota_yaris"})
        for (const SlotKind kind : {SlotKind::Perpendicular, SlotKind::Parallel})
            for (const SlotSide side : {SlotSide::Right, SlotSide::Left})
                for (const bool tight : {false, true})
                {
                    const Vehicle car = vehicleByName(name);
                    ParkingSlot slot = tightSlot(kind, car, side);
                    SCOPED_TRACE(std::string(name) + (tight ? ", tight" : ", roomy") +
                                 (kind == SlotKind::Parallel ? ", parallel" : ", perpendicular") +
                                 (side == SlotSide::Left ? ", left" : ", right"));
                    const double aisle = tight ? AISLE : 8.0;
                    if (!tight)
                        slot.length += 4.2, slot.width += 0.4;
                    const ParkingPlanner planner = inAisle(aisle);
                    const Pose start = inTheAisle(slot, -8.0);
                    const ParkingPlan plan = planner.plan(slotProblem(planner.parameters(), car, slot, start));
                    ASSERT_TRUE(plan.found) << plan.message;
                    EXPECT_EQ(plan.manoeuvre.path.stretches().size() == 1, !tight);
                    EXPECT_LT(gap(plan.arcs.start, start), 1e-9);
                    EXPECT_LT(gap(plan.arcs.end(), slot.goals(car).front()), 1e-6);
                    const PolygonOracle oracle = oracleFor(slot, aisle);
                    expectFree(plan.arcs, car, oracle, plan.gap - 0.002);
                    EXPECT_TRUE(plan.smooth.free);
                    EXPECT_LT(gap(plan.smooth.path.start, start), 1e-9);
                    EXPECT_LT(gap(plan.smooth.path.end(), plan.arcs.end()), 1e-9);
                    for (const PathState &state : plan.smooth.path.sample(0.01))
                    {
                        ASSERT_TRUE(oracle.isFree(state.pose, car));
                        ASSERT_LE(std::abs(state.curvature), (1.0 + 1e-9) / car.minTurningRadius());
                    }
                }
}

TEST(SlotQuestions, EveryWayInIsAGoal)
{
    // Either entry, either side: which manoeuvre is driven depends on where the car comes from.
    const Vehicle car;
    ParkingSlot slot;
    slot.width = 2.8;
    slot.entry = SlotEntry::Either;
    const double aisle = 8.0;
    const std::vector<Polygon> world = slotSurroundings(slot, SlotSide::Right, aisle);
    const ParkingPlanner planner = inAisle(aisle);
    std::set<std::pair<SlotEntry, SlotSide>> driven;
    for (const double y : {-9.0, 9.0})
        for (const double yaw : {-0.5 * PI, 0.5 * PI})
        {
            const ParkingPlan plan = planner.plan(inWorld(car, slot, {7.0, y, yaw}, world));
            ASSERT_TRUE(plan.found) << plan.message;
            EXPECT_LT(gap(plan.path.end(), plan.manoeuvre.goal), 1e-6);
            EXPECT_LT(gap(plan.smooth.path.end(), plan.manoeuvre.goal), 1e-6);
            driven.emplace(plan.manoeuvre.entry, plan.manoeuvre.side);
        }
    EXPECT_GE(driven.size(), 2u);
}

TEST(SlotQuestions, SmallestSlotIsSmallerThanForOneSweep)
{
    const Vehicle car = vehicleByName("toyota_yaris");
    PlanningParameters parameters = PlanningParameters::intoTightSlots(AISLE);
    parameters.expansionsPerGap = 5000;
    const ParkingPlanner planner(parameters);
    for (const SlotKind kind : {SlotKind::Perpendicular, SlotKind::Parallel})
    {
        ParkingSlot slot = tightSlot(kind, car);
        double ParkingSlot::*const dimension = kind == SlotKind::Parallel ? &ParkingSlot::length : &ParkingSlot::width;
        const double body = kind == SlotKind::Parallel ? car.length() : car.width;
        const double least = smallestSlot(planner, car, slot, 0.1);
        EXPECT_GT(least, body);
        EXPECT_LE(least, slot.*dimension) << "that one fits";
        slot.*dimension = least;
        EXPECT_TRUE(planSlotEntry(planner, car, slot).fits());
        // From a slot that does not fit it looks at larger ones.
        slot.*dimension = body + 0.03;
        EXPECT_NEAR(smallestSlot(planner, car, slot, 0.1), least, 0.25);
    }
}

TEST(SlotQuestions, WhatIsWrongIsNamed)
{
    const Vehicle car;
    ParkingSlot slot;
    slot.side = SlotSide::Right;
    const ParkingPlanner planner = inAisle(6.0);
    ParkingSlot small = slot;
    small.length = 4.5;
    expectError([&] { planSlotEntry(planner, car, small); }, {"slot", "length", "18.9 cm"});
    ParkingSlot negative = slot;
    negative.width = -2.0;
    expectError([&] { planSlotEntry(planner, car, negative); }, {"slot", "width", "-2"});
    ParkingSlot steep = slot;
    steep.kind = SlotKind::Angled;
    steep.angle = 2.0;
    expectError([&] { planSlotEntry(planner, car, steep); }, {"slot", "angle"});

    expectError([&] { smallestSlot(planner, car, slot, 0.0); }, {"smallest slot", "precision is 0"});

    PlanningParameters parameters = PlanningParameters::intoTightSlots();
    parameters.gaps.back() = 0.0;
    expectError([&] { ParkingPlanner tight(parameters); }, {"gap", "0.004"});
    parameters = PlanningParameters::intoTightSlots();
    parameters.sweep.guardLength = -1.0;
    expectError([&] { planSlotEntry(ParkingPlanner(parameters), car, slot); }, {"guard"});

    // A start among obstacles is a status, not an error.
    std::vector<Polygon> obstacles = slotSurroundings(slot, SlotSide::Right, 6.0);
    const Pose start{4.2, 6.0, -0.5 * PI};
    obstacles.push_back({{4.0, 4.0}, {5.0, 4.0}, {5.0, 5.0}, {4.0, 5.0}});
    const ParkingPlan plan = planner.plan(inWorld(car, slot, start, obstacles));
    EXPECT_FALSE(plan.found);
    EXPECT_EQ(plan.failure, ParkingStatus::InvalidStart);
    EXPECT_NE(plan.message.find("start"), std::string::npos) << plan.message;
}

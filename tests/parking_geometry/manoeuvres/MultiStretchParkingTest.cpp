#include "parking_geometry/manoeuvres/MultiStretchParking.h"

#include "benchmarks/worlds/RandomParking.h"
#include "parking_geometry/manoeuvres/SlotSurroundings.h"
#include "tests/parking_geometry/ExpectError.h"
#include "tests/parking_geometry/PolygonWorld.h"
#include "tests/support/PoseGap.h"

#include <cmath>

#include <gtest/gtest.h>

using namespace parking;
using parking_test::expectError;
using parking_test::gap;
using parking_test::PolygonWorld;
using parking_test::RandomParking;

TEST(MultiStretchParking, ExitsLieInTheAisleAndAlongIt)
{
    RandomParking random(31);
    for (int i = 0; i < 3000; ++i)
    {
        const Vehicle car = random.vehicle();
        const ParkingSlot slot = random.slot(car);
        ReverseParkingOptions options;
        options.aisleWidth = random.between(3.0, 7.0);
        const SlotExitTask task = slotExitTask(ReverseParking(car, options), slot, slot.entry, slot.side);
        EXPECT_LT(gap(task.parked, slot.goals(car).front()), 1e-12);
        ASSERT_FALSE(task.exits.empty());
        const PolygonWorld world(car, slotSurroundings(slot, slot.side, options.aisleWidth));
        EXPECT_TRUE(world.isFree(task.parked));
        for (const Pose &exit : task.exits)
        {
            EXPECT_TRUE(world.isFree(exit));
            EXPECT_NEAR(std::sin(exit.yaw - slot.aisleYaw(slot.side)), 0.0, 1e-9);
            for (const Eigen::Vector2d &corner : car.footprint(exit))
                EXPECT_TRUE((corner.array() > task.min.array()).all() && (corner.array() < task.max.array()).all());
        }
        // The single sweep leaves the slot in the direction of these exits.
        const ReverseParkingResult sweep = ReverseParking(car).plan(slot);
        if (sweep.fits())
        {
            EXPECT_NEAR(wrapAngle(sweep.path.start.yaw - task.exits.front().yaw), 0.0, 1e-9);
        }
    }
}

TEST(MultiStretchParking, OneSweepNeedsNoPlanner)
{
    const ReverseParking parking{Vehicle()};
    const ReverseParkingResult result = planInStretches(parking, ParkingSlot(), {},
                                                        [](const SlotExitTask &) -> Path
                                                        {
                                                            ADD_FAILURE() << "asked without need";
                                                            return {};
                                                        });
    EXPECT_TRUE(result.fits());
    EXPECT_EQ(result.path.stretches().size(), 1u);
}

TEST(MultiStretchParking, ThePlannersPathIsReversedAndCounted)
{
    // An aisle that is too narrow for one sweep, and a planner that need not care: there are no callables.
    ReverseParkingOptions options;
    options.aisleWidth = 3.0;
    const ReverseParking parking(Vehicle(), options);
    ParkingSlot slot;
    ASSERT_EQ(parking.plan(slot).status, ReverseParkingStatus::AisleTooNarrow);
    int asked = 0;
    const SlotExitPlanner shunts = [&](const SlotExitTask &task)
    {
        // Straight to and fro, then to the exit by way of its pose: the exit is made to fit the path.
        ++asked;
        Path path{task.parked, {{0.0, 1.0}, {0.0, -0.5}}};
        if (task.side == SlotSide::Left)
            return Path{task.parked, {}};
        const Pose exit = relativeTo(path.end(), task.exits.front());
        // Turn by pi/2 to the right and straight lines: ahead - r, then the arc, then right - r.
        const double radius = 3.1;
        path.append({0.0, exit.x - radius});
        path.append({-1.0 / radius, radius * 0.5 * PI});
        path.append({0.0, -exit.y - radius});
        return path;
    };
    const ReverseParkingResult result = planInStretches(parking, slot, {}, shunts);
    ASSERT_TRUE(result.fits()) << result.message;
    EXPECT_EQ(asked, 2);
    EXPECT_LT(gap(result.path.end(), result.goal), 1e-9);
    EXPECT_EQ(result.path.stretches().size(), result.path.cusps() + 1);
    EXPECT_GE(result.path.stretches().size(), 3u);
    EXPECT_TRUE(result.message.empty());

    // With a way on either side the one with fewer stretches wins, whichever is asked for first.
    for (const SlotSide better : {SlotSide::Right, SlotSide::Left})
    {
        const SlotExitPlanner both = [&](const SlotExitTask &task)
        {
            const double mirror = task.side == SlotSide::Left ? -1.0 : 1.0, radius = 3.1;
            Path path{task.parked, {}};
            if (task.side != better)
                path.pieces = {{0.0, 1.0}, {0.0, -0.5}, {0.0, 0.5}, {0.0, -0.5}};
            const Pose exit = relativeTo(path.end(), task.exits.front());
            path.append({0.0, exit.x - radius});
            path.append({-mirror / radius, radius * 0.5 * PI});
            path.append({0.0, -mirror * exit.y - radius});
            return path;
        };
        EXPECT_EQ(planInStretches(parking, slot, {}, both).side, better);
    }

    const ReverseParkingResult none = planInStretches(parking, slot, {},
                                                      [](const SlotExitTask &task) {
                                                          return Path{task.parked, {}};
                                                      });
    EXPECT_EQ(none.status, ReverseParkingStatus::AisleTooNarrow);

    const auto shifted = [&](const SlotExitTask &task)
    {
        Path path = shunts(task);
        path.start.x += 0.01;
        return path;
    };
    expectError([&] { planInStretches(parking, slot, {}, shifted); }, {"multi-stretch", "begin"});
    const auto elsewhere = [&](const SlotExitTask &task)
    {
        return Path{task.parked, {{0.0, 1.0}}};
    };
    expectError([&] { planInStretches(parking, slot, {}, elsewhere); }, {"multi-stretch", "exits"});
    FootprintQueries closed;
    closed.isPathFree = [](const Path &)
    {
        return false;
    };
    expectError([&] { planInStretches(parking, slot, closed, shunts); }, {"multi-stretch", "free"});
}

#include "parking_geometry/manoeuvres/MultiStretchParking.h"

#include "benchmarks/worlds/RandomParking.h"
#include "parking_geometry/manoeuvres/SlotSurroundings.h"
#include "tests/parking_geometry/ExpectError.h"
#include "tests/parking_geometry/PolygonWorld.h"
#include "tests/support/PoseGap.h"

#include <cmath>
#include <functional>

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
                EXPECT_TRUE((corner.array() > task.bounds.min.array()).all() &&
                            (corner.array() < task.bounds.max.array()).all());
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

namespace
{
    /** \e begun, which ends in the slot headed out of it, and on to the first exit: ahead, a quarter turn into the
        aisle, and straight on. */
    Path toExit(Path begun, const SlotExitTask &task)
    {
        const double mirror = task.side == SlotSide::Left ? -1.0 : 1.0, radius = 3.1;
        const Pose exit = relativeTo(begun.end(), task.exits.front());
        begun.append({0.0, exit.x - radius});
        begun.append({-mirror / radius, radius * 0.5 * PI});
        begun.append({0.0, -mirror * exit.y - radius});
        return begun;
    }
}  // namespace

TEST(MultiStretchParking, ThePlannersPathIsReversedAndCounted)
{
    // An aisle that is too narrow for one sweep, and a planner that need not care: there are no callables.
    ReverseParkingOptions options;
    options.aisleWidth = 3.0;
    const ReverseParking parking(Vehicle(), options);
    const ParkingSlot slot;
    ASSERT_EQ(parking.plan(slot).status, ReverseParkingStatus::AisleTooNarrow);
    int asked = 0;
    const SlotExitPlanner shunts = [&](const SlotExitTask &task)
    {
        ++asked;
        return task.side == SlotSide::Left ? Path{task.parked, {}}
                                           : toExit({task.parked, {{0.0, 1.0}, {0.0, -0.5}}}, task);
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
            return toExit(task.side == better ? Path{task.parked, {}}
                                              : Path{task.parked, {{0.0, 1.0}, {0.0, -0.5}, {0.0, 0.5}, {0.0, -0.5}}},
                          task);
        };
        EXPECT_EQ(planInStretches(parking, slot, {}, both).side, better);
    }

    const auto planned = [&](const FootprintQueries &world, const std::function<void(Path &)> &change)
    {
        return planInStretches(parking, slot, world,
                               [&](const SlotExitTask &task)
                               {
                                   Path path = shunts(task);
                                   change(path);
                                   return path;
                               });
    };
    EXPECT_EQ(planned({}, [](Path &path) { path.pieces.clear(); }).status, ReverseParkingStatus::AisleTooNarrow);
    expectError([&] { planned({}, [](Path &path) { path.start.x += 0.01; }); }, {"multi-stretch", "begin"});
    expectError([&] { planned({}, [](Path &path) { path.pieces = {{0.0, 1.0}}; }); }, {"multi-stretch", "exits"});
    FootprintQueries closed;
    closed.isPathFree = [](const Path &)
    {
        return false;
    };
    expectError([&] { planned(closed, [](Path &) {}); }, {"multi-stretch", "free"});
}

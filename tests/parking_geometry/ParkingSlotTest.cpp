#include "parking_geometry/ParkingSlot.h"

#include "benchmarks/worlds/RandomParking.h"
#include "parking_geometry/manoeuvres/SlotSurroundings.h"
#include "tests/parking_geometry/ExpectError.h"

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

using namespace parking;
using parking_test::expectError;
using parking_test::RandomParking;

namespace
{
    /** Extent of the body along and across the slot, in the slot's frame. */
    struct Extent
    {
        double x0{1e9}, x1{-1e9}, y0{1e9}, y1{-1e9};
    };

    Extent extentOf(const ParkingSlot &slot, const Vehicle &car, const Pose &pose)
    {
        Extent extent;
        for (const Eigen::Vector2d &corner : car.footprint(pose))
        {
            const Pose local = relativeTo(slot.pose, {corner.x(), corner.y(), 0.0});
            extent.x0 = std::min(extent.x0, local.x);
            extent.x1 = std::max(extent.x1, local.x);
            extent.y0 = std::min(extent.y0, local.y);
            extent.y1 = std::max(extent.y1, local.y);
        }
        return extent;
    }
}  // namespace

TEST(ParkingSlot, GoalsPutTheBodyWhereItWasAsked)
{
    RandomParking random(11);
    for (int i = 0; i < 100000; ++i)
    {
        const Vehicle car = random.vehicle();
        ParkingSlot slot = random.slot(car);
        slot.entry = static_cast<SlotEntry>(random.below(3));
        const std::vector<Pose> goals = slot.goals(car);
        ASSERT_EQ(goals.size(), slot.entry == SlotEntry::Either && slot.kind != SlotKind::Parallel ? 2u : 1u);
        for (std::size_t k = 0; k < goals.size(); ++k)
        {
            const bool noseIn =
                slot.kind != SlotKind::Parallel && (slot.entry == SlotEntry::Forward || (k == 1 && goals.size() == 2));
            ASSERT_NEAR(wrapAngle(goals[k].yaw - slot.pose.yaw - (noseIn ? PI : 0.0)), 0.0, 1e-12);
            const Extent body = extentOf(slot, car, goals[k]);
            const double depth = slot.depth.value_or(0.5 * (slot.length - car.length()));
            ASSERT_NEAR(body.x0, -0.5 * slot.length + depth, 1e-9);
            ASSERT_NEAR(body.x1 - body.x0, car.length(), 1e-9);
            ASSERT_NEAR(0.5 * (body.y0 + body.y1), slot.lateralOffset, 1e-9);
            ASSERT_NEAR(body.y1 - body.y0, car.width, 1e-9);
        }
    }
}

TEST(ParkingSlot, WhatIsWrongIsNamed)
{
    // An angled slot half a metre longer and 40 cm wider than the car.
    const Vehicle car;
    const auto spoiled = [&car](const std::function<void(ParkingSlot &)> &spoil)
    {
        ParkingSlot slot;
        slot.kind = SlotKind::Angled;
        slot.length = car.length() + 0.5;
        slot.width = car.width + 0.4;
        spoil(slot);
        return slot;
    };
    const auto good = [&](const std::function<void(ParkingSlot &)> &change)
    {
        EXPECT_EQ(spoiled(change).goals(car).size(), 1u);
    };
    const auto bad = [&](const std::vector<std::string> &words, const std::function<void(ParkingSlot &)> &spoil)
    {
        expectError([&] { spoiled(spoil).goals(car); }, words);
    };
    const double nan = std::numeric_limits<double>::quiet_NaN(), far = std::nextafter(MAX_COORDINATE, 2e10);
    good([&](ParkingSlot &slot) { slot.length = car.length(), slot.width = car.width; });
    good([](ParkingSlot &slot) { slot.depth = 0.5; });
    good([](ParkingSlot &slot) { slot.lateralOffset = -0.2; });
    good([](ParkingSlot &slot) { slot.angle = 0.5 * PI; });
    good([](ParkingSlot &slot) { slot.kind = SlotKind::Perpendicular, slot.angle = -1.0; });
    good([](ParkingSlot &slot) { slot.pose.x = -MAX_COORDINATE, slot.pose.y = MAX_COORDINATE; });
    bad({"slot", "length", "12.3 cm", "4.689 m"}, [&](ParkingSlot &slot) { slot.length = car.length() - 0.123; });
    bad({"slot", "width", "2 cm", "1.942 m"}, [&](ParkingSlot &slot) { slot.width = car.width - 0.02; });
    bad({"depth", "1 cm", "outside", "0.5"}, [](ParkingSlot &slot) { slot.depth = 0.51; });
    bad({"depth", "2 cm", "outside"}, [](ParkingSlot &slot) { slot.depth = -0.02; });
    bad({"lateral offset", "1.5 cm", "0.2"}, [](ParkingSlot &slot) { slot.lateralOffset = 0.215; });
    bad({"slot", "pose x"}, [&](ParkingSlot &slot) { slot.pose.x = nan; });
    bad({"slot", "pose y"}, [](ParkingSlot &slot) { slot.pose.y = HUGE_VAL; });
    bad({"slot", "pose yaw"}, [&](ParkingSlot &slot) { slot.pose.yaw = nan; });
    // Where doubles are too far apart.
    bad({"slot: pose x is 500000000000;", "at most 10000000000 m"}, [](ParkingSlot &slot) { slot.pose.x = 5e11; });
    bad({"slot: pose y is -", "at most 10000000000 m"}, [&](ParkingSlot &slot) { slot.pose.y = -far; });
    for (const double length : {-5.0, 0.0, 1001.0, nan})
    {
        bad({"slot", "length is "}, [&](ParkingSlot &slot) { slot.length = length; });
        bad({"slot", "width is "}, [&](ParkingSlot &slot) { slot.width = length; });
    }
    bad({"slot", "angle"}, [](ParkingSlot &slot) { slot.angle = 0.0; });
    bad({"slot", "angle"}, [](ParkingSlot &slot) { slot.angle = 0.5 * PI + 1e-6; });
    bad({"slot", "depth"}, [&](ParkingSlot &slot) { slot.depth = nan; });
    bad({"slot", "lateral offset"}, [&](ParkingSlot &slot) { slot.lateralOffset = nan; });
}

TEST(ParkingSlot, TheAisleLiesOnTheSideThatWasSaid)
{
    ParkingSlot slot;
    slot.pose.yaw = 0.3;
    slot.kind = SlotKind::Angled;
    slot.angle = 1.0;
    EXPECT_NEAR(slot.aisleYaw(SlotSide::Right), 0.3 - 1.0, 1e-12);
    EXPECT_NEAR(slot.aisleYaw(SlotSide::Left), 0.3 + 1.0, 1e-12);
    slot.kind = SlotKind::Perpendicular;
    EXPECT_NEAR(slot.aisleYaw(SlotSide::Right), 0.3 - 0.5 * PI, 1e-12);
    slot.kind = SlotKind::Parallel;
    EXPECT_NEAR(slot.aisleYaw(SlotSide::Right), 0.3, 1e-12);
    EXPECT_NEAR(slot.aisleYaw(SlotSide::Left), 0.3, 1e-12);
}

TEST(SlotSurroundings, LeaveTheSlotAndTheAisleFree)
{
    RandomParking random(13);
    for (int i = 0; i < 2000; ++i)
    {
        const Vehicle car = random.vehicle();
        const ParkingSlot slot = random.slot(car);
        const double aisle = random.between(2.0, 8.0);
        const std::vector<Polygon> obstacles = slotSurroundings(slot, slot.side, aisle);
        ASSERT_GE(obstacles.size(), 3u);
        const auto covered = [&](double along, double across)
        {
            const Pose point = compose(slot.pose, {along, slot.side == SlotSide::Left ? -across : across, 0.0});
            return std::any_of(obstacles.begin(), obstacles.end(),
                               [&](const Polygon &each) {
                                   return contains(each, {point.x, point.y});
                               });
        };
        for (const Polygon &each : obstacles)
            EXPECT_GT(signedArea(each), 0.0);
        const double x = 0.5 * slot.length, y = 0.5 * slot.width, inside = 1e-6;
        for (const double u : {-x + inside, 0.0, x - inside})
            for (const double v : {-y + inside, 0.0, y - inside})
                EXPECT_FALSE(covered(u, v)) << "a point of the slot";
        if (slot.kind == SlotKind::Parallel)
        {
            EXPECT_TRUE(covered(0.0, -y - inside)) << "kerb";
            EXPECT_TRUE(covered(x + inside, 0.0) && covered(-x - inside, 0.0)) << "neighbours";
            EXPECT_FALSE(covered(0.0, y + aisle - inside));
            EXPECT_TRUE(covered(0.0, y + aisle + inside)) << "wall across";
            continue;
        }
        const double s = std::sin(slot.aisleAngle()), c = std::cos(slot.aisleAngle()), lean = slot.width * c / s;
        EXPECT_TRUE(covered(-x - inside, 0.0)) << "closed end";
        EXPECT_TRUE(covered(x + lean - inside, -y - inside)) << "inner neighbour, up to its corner";
        EXPECT_FALSE(covered(x + lean + inside, -y - inside * 0.1 * s));
        if (x - lean > -x)
        {
            EXPECT_TRUE(covered(x - lean - inside, y + inside)) << "outer neighbour";
            EXPECT_FALSE(covered(x - lean + inside, y + inside));
        }
        // Across the aisle, from the corner of the inner neighbour.
        EXPECT_FALSE(covered(x + lean + (aisle - inside) * s, -y + (aisle - inside) * c));
        EXPECT_TRUE(covered(x + lean + (aisle + inside) * s, -y + (aisle + inside) * c));
    }
}

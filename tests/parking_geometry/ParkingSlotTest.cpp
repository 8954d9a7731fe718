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
    const double nan = std::numeric_limits<double>::quiet_NaN(), far = std::nextafter(FARTHEST_COORDINATE, 2e10);
    good([&](ParkingSlot &slot) { slot.length = car.length(), slot.width = car.width; });
    good([](ParkingSlot &slot) { slot.depth = 0.5; });
    good([](ParkingSlot &slot) { slot.lateralOffset = -0.2; });
    good([](ParkingSlot &slot) { slot.angle = 0.5 * PI; });
    good([](ParkingSlot &slot) { slot.kind = SlotKind::Perpendicular, slot.angle = -1.0; });
    good([](ParkingSlot &slot) { slot.pose.x = -FARTHEST_COORDINATE, slot.pose.y = FARTHEST_COORDINATE; });
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

TEST(SlotSurroundings, RandomStartsAreJudgedLikeTheirFootprints)
{
    RandomParking random(34);
    int inside = 0, beyond = 0, fine = 0;
    for (int i = 0; i < 100000; ++i)
    {
        const Vehicle car = random.vehicle();
        const ParkingSlot slot = random.slot(car);
        const double aisle = random.between(3.0, 9.0);
        const Pose start = compose(slot.pose, random.pose(12.0));
        // Points all over the body, in the frame of the slot: none may lie in the slot, none beyond the aisle. A row
        // of points every few centimetres misses overlaps of less, so that only clear cases are judged.
        constexpr double CLEAR = 0.1;
        const double s = std::sin(slot.aisleAngle()), c = std::cos(slot.aisleAngle());
        const double side = slot.side == SlotSide::Left ? -1.0 : 1.0;
        const double mouth = slot.kind == SlotKind::Parallel
                                 ? 0.5 * slot.width
                                 : s * (0.5 * slot.length + slot.width * c / s) - c * 0.5 * slot.width;
        double deepest = -1e9, farthest = -1e9;
        for (int row = 0; row <= 8; ++row)
            for (int column = 0; column <= 20; ++column)
            {
                const Pose point =
                    relativeTo(slot.pose, compose(start, {column / 20.0 * car.length() - car.rearOverhang,
                                                          (row / 8.0 - 0.5) * car.width, 0.0}));
                deepest = std::max(
                    deepest, std::min(0.5 * slot.length - std::abs(point.x), 0.5 * slot.width - std::abs(point.y)));
                farthest = std::max(farthest, s * point.x + c * side * point.y - mouth - aisle);
            }
        std::string said;
        try
        {
            checkStart(slot, car, start, aisle);
        }
        catch (const Error &error)
        {
            said = error.what();
        }
        const bool saidInside = said.find("into the slot") != std::string::npos;
        const bool saidBeyond = said.find("beyond the aisle") != std::string::npos;
        if (deepest > CLEAR)
        {
            ASSERT_TRUE(saidInside) << said;
            ++inside;
        }
        else if (deepest < -4.0 * CLEAR)
        {
            ASSERT_FALSE(saidInside) << said;
            ASSERT_EQ(saidBeyond, farthest > 1e-9) << said << ' ' << farthest;
            ++(saidBeyond ? beyond : fine);
        }
    }
    EXPECT_GT(inside, 1000);
    EXPECT_GT(beyond, 1000);
    EXPECT_GT(fine, 1000);
}

TEST(SlotSurroundings, AStartInTheSlotOrBeyondTheAisleIsRefused)
{
    const Vehicle car;
    ParkingSlot slot;
    slot.width = 2.5;
    slot.length = 5.0;
    // The aisle runs along y; its near edge is at x = 2.5. A car along it, its side 1 mm off the edge.
    Pose start{2.5 + 0.5 * car.width + 0.001, -4.0, 0.5 * PI};
    EXPECT_NO_THROW(checkStart(slot, car, start, 6.0));
    start.x -= 0.101;
    expectError([&] { checkStart(slot, car, start, 6.0); }, {"start", "10 cm", "into the slot"});
    start.x = 2.5 + 6.0 - 0.5 * car.width - 0.001;
    EXPECT_NO_THROW(checkStart(slot, car, start, 6.0));
    start.x += 0.251;
    expectError([&] { checkStart(slot, car, start, 6.0); }, {"start", "25 cm", "beyond the aisle", "6 m"});
    EXPECT_NO_THROW(checkStart(slot, car, start));
    // Parallel: which side the aisle is on must be known for the second verdict.
    slot.kind = SlotKind::Parallel;
    start = {-10.0, 1.25 + 4.0 - 0.5 * car.width + 0.1, 0.0};
    EXPECT_NO_THROW(checkStart(slot, car, start, 4.0));
    slot.side = SlotSide::Right;
    expectError([&] { checkStart(slot, car, start, 4.0); }, {"start", "10 cm", "beyond the aisle"});
    start.y = -start.y;
    slot.side = SlotSide::Left;
    expectError([&] { checkStart(slot, car, start, 4.0); }, {"start", "10 cm", "beyond the aisle"});
}

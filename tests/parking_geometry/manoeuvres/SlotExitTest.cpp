#include "parking_geometry/manoeuvres/SlotExit.h"

#include "benchmarks/worlds/RandomParking.h"
#include "parking_geometry/manoeuvres/SlotSurroundings.h"
#include "tests/parking_geometry/PolygonWorld.h"

#include <cmath>

#include <gtest/gtest.h>

using namespace parking;
using parking_test::PolygonWorld;
using parking_test::RandomParking;

namespace
{
    /** Height of the body's corners over the line through \e corner along \e direction (its left is up), at most. */
    double highest(const Vehicle &car, const Path &path, const Eigen::Vector2d &corner, double direction)
    {
        double most = -1e9;
        for (const PathState &state : path.sample(0.001))
            for (const Eigen::Vector2d &point : car.footprint(state.pose))
                most = std::max(most, std::cos(direction) * (point.y() - corner.y()) -
                                          std::sin(direction) * (point.x() - corner.x()));
        return most;
    }
}  // namespace

// ReverseParkingTest covers what these functions are for, the best radius; here they must be right for every radius.

TEST(SlotExit, StraightPieceAndAisleOfBaysAreExactForEveryRadius)
{
    RandomParking random(61);
    int shallow = 0, deep = 0;
    for (int i = 0; i < 60; ++i)
    {
        const Vehicle car = random.vehicle();
        ParkingSlot slot = random.slot(car);
        slot.kind = SlotKind::Angled;
        slot.angle = i % 2 == 0 ? random.between(0.2, 0.7) : random.between(0.7, 0.5 * PI);
        slot.pose = {};
        slot.side = SlotSide::Right;
        slot.entry = SlotEntry::Reverse;
        const Pose goal = slot.goals(car).front();
        const double s = std::sin(slot.angle), c = std::cos(slot.angle), lean = slot.width * c / s;
        const Bay bay{slot.angle, 0.5 * slot.length + lean - goal.x, 0.5 * slot.length - lean - goal.x,
                      0.5 * slot.width + goal.y, 0.5 * slot.width - goal.y};
        const ExitBody body{car.wheelbase + car.frontOverhang, car.rearOverhang, 0.5 * car.width};
        const double radius = car.minTurningRadius() * std::exp(random.between(0.0, 1.5));
        const auto out = [&](double straight)
        {
            return Path{goal, {{0.0, straight}, {-1.0 / radius, radius * slot.angle}, {0.0, 4.0}}};
        };
        const double straight = straightBeforeTurn(bay, body, radius);
        const PolygonWorld world(car, slotSurroundings(slot, SlotSide::Right));
        EXPECT_TRUE(world.isPathFree(out(straight + 1e-4))) << i;
        if (straight > 1e-3)
        {
            EXPECT_FALSE(world.isPathFree(out(straight - 1e-3))) << i;
        }
        const Eigen::Vector2d corner(0.5 * slot.length + lean, -0.5 * slot.width);
        for (const double more : {0.0, 0.7})
            EXPECT_NEAR(aisleNeeded(bay, body, radius, straight + more),
                        highest(car, out(straight + more), corner, -slot.angle), 1e-5);
        const double outer = radius + body.halfWidth;
        (slot.angle < std::atan2(body.lead, outer) ? shallow : deep) += 1;
    }
    EXPECT_GT(shallow, 5);
    EXPECT_GT(deep, 5);
}

TEST(SlotExit, LaneOfParallelExitsIsExactForAllRadii)
{
    RandomParking random(62);
    int shallow = 0, deep = 0, turnedRound = 0;
    for (int i = 0; i < 200; ++i)
    {
        const Vehicle car = random.vehicle();
        ParkingSlot slot = random.slot(car);
        slot.kind = SlotKind::Parallel;
        slot.pose = {};
        slot.side = SlotSide::Right;
        slot.entry = SlotEntry::Reverse;
        slot.depth.reset();
        slot.lateralOffset = 0.0;
        slot.width = car.width + random.between(0.4, 1.2);
        const ExitBody body{car.wheelbase + car.frontOverhang, car.rearOverhang, 0.5 * car.width};
        KerbSlot kerb{0.0, 0.5 * slot.width, 0.5 * (slot.width - car.width)};
        const double first =
            std::max(car.minTurningRadius(), kerbRadius(kerb, body)) * std::exp(random.between(0.0, 2.0));
        const double second = car.minTurningRadius() * std::exp(random.between(0.0, 2.8));
        kerb.front = frontNeeded(kerb, body, first) + 1e-3;
        EXPECT_NEAR(cornerRadius({frontNeeded(kerb, body, first), kerb.aisleSide, kerb.kerbGap}, body), first, 1e-6);
        const double rear = car.centreOffset();
        slot.length = 2.0 * (kerb.front - rear);
        const Pose goal = slot.goals(car).front();
        ASSERT_NEAR(0.5 * slot.length - goal.x, kerb.front, 1e-9);
        const PolygonWorld world(car, slotSurroundings(slot, SlotSide::Right, 1e3, 90.0));
        const auto path = [&](const LaneExit &lane)
        {
            return Path{goal,
                        {{1.0 / lane.first, lane.first * lane.turn},
                         {-1.0 / lane.second, lane.second * lane.turn},
                         {0.0, 2.0 * car.length()}}};
        };
        const LaneExit exit = shallowestExit(kerb, body, first, second);
        ASSERT_TRUE(world.isPathFree(path(exit))) << i;
        // Any less of a turn does not get out, or not past P.
        LaneExit less = exit;
        less.turn -= 2e-3;
        EXPECT_FALSE(world.isPathFree(path(less)) && less.offset() >= kerb.aisleSide + body.halfWidth) << i;
        turnedRound += exit.offset() > kerb.aisleSide + body.halfWidth + 1e-9;
        for (const double extra : {0.0, 0.1, 0.25})
        {
            const LaneExit wider = widened(exit, extra);
            EXPECT_NEAR(wider.offset(), exit.offset() + extra, 1e-9);
            EXPECT_TRUE(world.isPathFree(path(wider))) << i << " " << extra;
            EXPECT_NEAR(laneNeeded(kerb, body, wider), highest(car, path(wider), {0.0, kerb.aisleSide}, 0.0), 1e-5);
        }
        (exit.turn < std::atan2(body.lead, second + body.halfWidth) ? shallow : deep) += 1;
    }
    EXPECT_GT(shallow, 10);
    EXPECT_GT(deep, 10);
    EXPECT_GT(turnedRound, 10);
}

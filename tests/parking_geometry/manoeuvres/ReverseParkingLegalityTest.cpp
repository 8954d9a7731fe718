#include "parking_geometry/manoeuvres/ReverseParking.h"

#include "benchmarks/worlds/RandomParking.h"
#include "parking_geometry/manoeuvres/SlotSurroundings.h"
#include "tests/parking_geometry/PolygonWorld.h"
#include "tests/parking_geometry/manoeuvres/ParkingProblems.h"

#include <cmath>

#include <gtest/gtest.h>

using namespace parking;
using parking_test::grazing;
using parking_test::lengthened;
using parking_test::PolygonWorld;
using parking_test::RandomParking;

namespace
{
    /** Finds the smallest argument in [low, high] for which \e fits, which stays true from there on. */
    template <class Predicate>
    double bisect(double low, double high, const Predicate &fits)
    {
        while (high - low > 2e-5)
        {
            const double middle = 0.5 * (low + high);
            (fits(middle) ? high : low) = middle;
        }
        return high;
    }

    /** Height of the body above the line through the slots' mouths, at most, along \e path. */
    double highest(const ParkingSlot &slot, const Vehicle &car, const Path &path)
    {
        const double mirror = slot.side == SlotSide::Left ? -1.0 : 1.0;
        const double s = std::sin(slot.aisleAngle()), c = std::cos(slot.aisleAngle());
        double most = 0.0;
        for (const PathState &state : path.sample(0.002))
            for (const Eigen::Vector2d &corner : car.footprint(state.pose))
            {
                const Pose local = relativeTo(slot.pose, {corner.x(), corner.y(), 0.0});
                const double x = local.x - 0.5 * slot.length - slot.width * c / s;
                const double y = mirror * local.y + 0.5 * slot.width;
                most = std::max(most, s * x + c * y);
            }
        return most;
    }

    /** The narrowest aisle, found on footprints alone: for every radius the shortest straight piece that the neighbours
        allow, by bisection, and how far the body then reaches into the aisle. */
    double narrowestAisle(const ParkingSlot &slot, const Vehicle &car)
    {
        const Pose goal = slot.goals(car).front();
        const double direction = slot.entry == SlotEntry::Forward ? -1.0 : 1.0;
        const double turn = -direction * (slot.side == SlotSide::Left ? -1.0 : 1.0);
        const PolygonWorld world(car, slotSurroundings(slot, slot.side, HUGE_VAL, 20.0));
        const auto out = [&](double radius, double straight)
        {
            return Path{goal,
                        {{0.0, direction * straight},
                         {turn / radius, direction * radius * slot.aisleAngle()},
                         {0.0, direction * 3.0}}};
        };
        const auto needed = [&](double radius)
        {
            const double straight = bisect(
                -1e-5, 12.0, [&](double length) { return world.isPathFree(out(radius, std::max(0.0, length))); });
            return highest(slot, car, out(radius, std::max(0.0, straight)));
        };
        const double smallest = car.minTurningRadius();
        double best = smallest, least = needed(smallest);
        for (double radius = smallest * 1.2; radius < 15.0 * smallest; radius *= 1.2)
            if (const double there = needed(radius); there < least)
            {
                best = radius;
                least = there;
            }
        double low = std::max(smallest, best / 1.2), high = best * 1.2;
        for (int i = 0; i < 18; ++i)
        {
            const double a = low + 0.382 * (high - low), b = high - 0.382 * (high - low);
            const double atA = needed(a), atB = needed(b);
            least = std::min({least, atA, atB});
            (atA < atB ? high : low) = atA < atB ? b : a;
        }
        return least;
    }

    /** Is there a way out of the slot with this first radius, whatever the second radius and the angle? */
    bool hasExit(const ParkingSlot &slot, const Vehicle &car, double first)
    {
        const double direction = slot.entry == SlotEntry::Forward ? -1.0 : 1.0;
        const double side = slot.side == SlotSide::Left ? -1.0 : 1.0;
        const double out = 0.5 * slot.width - side * slot.lateralOffset + 0.5 * car.width;
        const PolygonWorld world(car, slotSurroundings(slot, slot.side, HUGE_VAL, 40.0));
        for (const double factor : {1.0, 3.0})
            for (double turn = 0.1; turn < 1.8; turn += 0.03)
            {
                const double second = factor * car.minTurningRadius();
                if ((first + second) * (1.0 - std::cos(turn)) < out)
                    continue;
                const Path path{slot.goals(car).front(),
                                {{side / first, direction * first * turn},
                                 {-side / second, direction * second * turn},
                                 {0.0, direction * 1.5 * car.length()}}};
                if (world.isPathFree(path))
                    return true;
            }
        return false;
    }

    /** The shortest parallel slot, found on footprints alone: the smallest radius that keeps the tail off the kerb,
       then the shortest slot that has an exit with it. */
    double shortestSlot(const ParkingSlot &slot, const Vehicle &car)
    {
        const double direction = slot.entry == SlotEntry::Forward ? -1.0 : 1.0;
        const double side = slot.side == SlotSide::Left ? -1.0 : 1.0;
        const ParkingSlot endless = lengthened(slot, 120.0);
        const PolygonWorld street(car, slotSurroundings(endless, slot.side, HUGE_VAL, 40.0));
        const auto offTheKerb = [&](double radius)
        {
            return street.isPathFree(
                Path{endless.goals(car).front(), {{side / radius, direction * std::min(radius * 1.2, 40.0)}}});
        };
        const double smallest = car.minTurningRadius();
        const double radius = offTheKerb(smallest) ? smallest : bisect(smallest, 80.0, offTheKerb);
        return bisect(car.length(), 60.0,
                      [&](double length) { return hasExit(lengthened(slot, length), car, radius); });
    }
}  // namespace

TEST(ReverseParkingLegality, TheNarrowestAisleAgreesWithBruteForceOnFootprints)
{
    RandomParking random(24);
    for (int i = 0; i < 8; ++i)
    {
        const Vehicle car = random.vehicle();
        ParkingSlot slot = random.slot(car);
        slot.kind = i % 4 == 0 ? SlotKind::Perpendicular : SlotKind::Angled;
        slot.angle = i % 4 == 1 ? random.between(0.8, 1.5) : random.between(0.3, 0.7);
        const double needed = ReverseParking(car, grazing()).plan(slot).neededAisleWidth;
        EXPECT_NEAR(needed, narrowestAisle(slot, car), 1e-3) << i;
        // The verdict changes there, and the manoeuvre given just above is free.
        const ReverseParkingResult below = ReverseParking(car, grazing(needed - 1e-4)).plan(slot);
        EXPECT_EQ(below.status, ReverseParkingStatus::AisleTooNarrow);
        EXPECT_NEAR(below.missing, 1e-4, 1e-6);
        const ReverseParkingResult above = ReverseParking(car, grazing(needed + 1e-4)).plan(slot);
        ASSERT_TRUE(above.fits());
        const PolygonWorld world(car, slotSurroundings(slot, slot.side, needed + 1e-4, 20.0));
        EXPECT_TRUE(world.isPathFree(above.path));
    }
}

TEST(ReverseParkingLegality, TheShortestParallelSlotAgreesWithBruteForceOnFootprints)
{
    RandomParking random(25);
    for (int i = 0; i < 12; ++i)
    {
        const Vehicle car = random.vehicle();
        ParkingSlot slot = random.slot(car);
        slot.kind = SlotKind::Parallel;
        slot.width = car.width + random.between(0.2, 1.2);
        slot.lateralOffset = random.between(-0.3, 0.3) * (slot.width - car.width);
        slot.entry = i % 6 == 5 ? SlotEntry::Forward : SlotEntry::Reverse;
        slot.depth.reset();
        if (i % 3 == 0)
            slot.depth = slot.entry == SlotEntry::Reverse ? std::optional<double>(0.01) : std::nullopt;
        const double needed = ReverseParking(car, grazing()).plan(slot).neededSlotLength;
        if (needed > 50.0)
            continue;
        EXPECT_NEAR(needed, shortestSlot(slot, car), 1e-3) << i;
        const ReverseParkingResult below = ReverseParking(car, grazing()).plan(lengthened(slot, needed - 1e-4));
        EXPECT_FALSE(below.fits());
        const ParkingSlot enough = lengthened(slot, needed + 1e-4);
        const ReverseParkingResult above = ReverseParking(car, grazing()).plan(enough);
        ASSERT_TRUE(above.fits()) << above.message;
        EXPECT_TRUE(PolygonWorld(car, slotSurroundings(enough, slot.side, HUGE_VAL, 40.0)).isPathFree(above.path));
        // No other pair of radii and angle does better.
        const ParkingSlot shorter = lengthened(slot, needed - 1e-3);
        const PolygonWorld world(car, slotSurroundings(shorter, slot.side, HUGE_VAL, 40.0));
        const double direction = slot.entry == SlotEntry::Forward ? -1.0 : 1.0;
        const double side = slot.side == SlotSide::Left ? -1.0 : 1.0;
        const double out = 0.5 * slot.width - side * slot.lateralOffset + 0.5 * car.width;
        for (int k = 0; k < 1000; ++k)
        {
            const double first = car.minTurningRadius() * std::exp(random.between(0.0, 2.0));
            const double second = car.minTurningRadius() * std::exp(random.between(0.0, 3.0));
            const double turn = random.between(0.05, 1.8);
            if ((first + second) * (1.0 - std::cos(turn)) < out)
                continue;
            ASSERT_FALSE(world.isPathFree(Path{shorter.goals(car).front(),
                                               {{side / first, direction * first * turn},
                                                {-side / second, direction * second * turn},
                                                {0.0, direction * 1.5 * car.length()}}}));
        }
    }
}

TEST(ReverseParkingLegality, LaneNeedOfParallelExitsIsSharp)
{
    RandomParking random(26);
    for (int i = 0; i < 120; ++i)
    {
        const Vehicle car = random.vehicle();
        ParkingSlot slot = random.slot(car);
        slot.kind = SlotKind::Parallel;
        slot.depth.reset();
        slot.entry = SlotEntry::Reverse;
        slot.width = car.width + random.between(0.3, 1.0);
        slot.lateralOffset = 0.0;
        slot =
            lengthened(slot, ReverseParking(car, grazing()).plan(slot).neededSlotLength + random.between(0.001, 8.0));
        const double lane = ReverseParking(car, grazing()).plan(slot).neededAisleWidth;
        const ReverseParkingResult below = ReverseParking(car, grazing(lane - 1e-4)).plan(slot);
        EXPECT_EQ(below.status, ReverseParkingStatus::AisleTooNarrow);
        EXPECT_NEAR(below.missing, 1e-4, 1e-6);
        const ReverseParkingResult above = ReverseParking(car, grazing(lane + 1e-4)).plan(slot);
        ASSERT_TRUE(above.fits());
        EXPECT_TRUE(PolygonWorld(car, slotSurroundings(slot, slot.side, lane + 1e-4, 40.0)).isPathFree(above.path));
        EXPECT_FALSE(PolygonWorld(car, slotSurroundings(slot, slot.side, lane - 1e-3, 40.0)).isPathFree(above.path));
    }
}

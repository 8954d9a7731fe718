#include "parking_geometry/smoothing/PathSmoother.h"

#include "benchmarks/worlds/RandomParking.h"
#include "parking_geometry/curves/ReedsShepp.h"
#include "parking_geometry/manoeuvres/ReverseParking.h"
#include "parking_geometry/manoeuvres/SlotSurroundings.h"
#include "tests/parking_geometry/ExpectError.h"
#include "tests/parking_geometry/PolygonWorld.h"
#include "tests/parking_geometry/smoothing/SmoothPathChecks.h"

#include <cmath>

#include <gtest/gtest.h>

using namespace parking;
using parking_test::expectDrivable;
using parking_test::expectError;
using parking_test::gap;
using parking_test::PolygonWorld;
using parking_test::RandomParking;

namespace
{
    Path reedsShepp(RandomParking &random, const Vehicle &car, double radiusFactor)
    {
        Path path{random.pose(8.0), {}};
        const ReedsSheppCurve curve =
            ReedsShepp(radiusFactor * car.minTurningRadius()).shortest(path.start, random.pose(8.0));
        for (std::size_t i = 0; i < curve.count; ++i)
            path.append(curve.pieces[i]);
        return path;
    }

    /** Small obstacles 5 to 30 cm beside the body somewhere along the path, which stays free. */
    std::vector<Polygon> debris(RandomParking &random, const Vehicle &car, const Path &path, int count)
    {
        std::vector<Polygon> result;
        const SampledPath states = path.sample(0.1);
        for (int i = 0; i < count; ++i)
        {
            const Pose at = states[static_cast<std::size_t>(random.below(static_cast<int>(states.size())))].pose;
            const double side = random.chance(0.5) ? 1.0 : -1.0, radius = 0.2;
            const Pose centre = compose(at, {random.between(-car.rearOverhang, car.wheelbase + car.frontOverhang),
                                             side * (0.5 * car.width + radius + random.between(0.05, 0.3)), 0.0});
            Polygon polygon;
            for (int k = 0; k < 5; ++k)
                polygon.emplace_back(centre.x + radius * std::cos(0.4 * PI * k),
                                     centre.y + radius * std::sin(0.4 * PI * k));
            if (PolygonWorld(car, {polygon}).isPathFree(path))
                result.push_back(polygon);
        }
        return result;
    }

    struct Share
    {
        std::size_t stretches{0}, continuous{0};

        void add(const SmoothPath &path)
        {
            stretches += path.path.stretches().size();
            continuous += parking_test::continuousStretches(path);
        }

        double percent() const
        {
            return 100.0 * static_cast<double>(continuous) / static_cast<double>(stretches);
        }
    };
}  // namespace

TEST(PathSmoother, PlannerPathsBecomeDrivableAndMostlyContinuous)
{
    RandomParking random(41);
    Share roomy, full;
    std::size_t stops = 0;
    for (int i = 0; i < 4000; ++i)
    {
        const Vehicle car = random.vehicle();
        const bool isFull = i % 4 == 0;  // planned at full lock, which leaves little room
        SmoothingOptions options;
        if (!isFull)
            options.speed = random.between(0.3, 2.0);
        const Path path = isFull       ? random.plannerPath(car, 1.0)
                          : i % 2 == 0 ? random.plannerPath(car, 1.03)
                                       : reedsShepp(random, car, 1.03);
        const SmoothPath result = PathSmoother(car, options).smooth(path);
        ASSERT_NO_FATAL_FAILURE(expectDrivable(result, path, car, options)) << i;
        EXPECT_TRUE(result.free);
        (isFull ? full : roomy).add(result);
        stops += result.stops.size();
    }
    EXPECT_GE(roomy.percent(), 99.0);
    EXPECT_GE(full.percent(), 95.0);
    EXPECT_GT(stops, 0u);
}

TEST(PathSmoother, AsksForTheClearanceOfTheCarAsItIsHeadedAlsoInReverse)
{
    for (const double direction : {-1.0, 1.0})
    {
        const Path path{{}, {{0.0, 4.0 * direction}, {0.2, 3.0 * direction}, {-0.2, 3.0 * direction}}};
        FootprintQueries queries;
        queries.isPathFree = [](const Path &)
        {
            return false;  // so that it tries to keep the clearance of the arcs
        };
        int asked = 0;
        queries.clearance = [&asked](const Pose &pose)
        {
            ++asked;
            EXPECT_GT(std::cos(pose.yaw), 0.5);
            return 10.0;
        };
        PathSmoother(Vehicle(), SmoothingOptions()).smooth(path, queries);
        EXPECT_GT(asked, 0);
    }
}

TEST(PathSmoother, AmongObstaclesTheResultIsFreeAndMostlyContinuous)
{
    RandomParking random(43);
    Share share;
    for (int i = 0; i < 600; ++i)
    {
        const Vehicle car = random.vehicle();
        const SmoothingOptions options;
        const Path path = i % 2 == 0 ? random.plannerPath(car, 1.03) : reedsShepp(random, car, 1.03);
        const PolygonWorld world(car, debris(random, car, path, 10));
        FootprintQueries queries = world.queries();
        if (i % 5 == 0)
            queries.clearance = nullptr;
        const SmoothPath result = PathSmoother(car, options).smooth(path, queries);
        ASSERT_NO_FATAL_FAILURE(expectDrivable(result, path, car, options)) << i;
        EXPECT_TRUE(result.free);
        // The oracle, on the exact pieces at 2 cm.
        for (const PathState &state : result.path.sample(0.02))
            ASSERT_TRUE(world.isFree(state.pose) || !queries.clearance) << i;
        share.add(result);
    }
    EXPECT_GE(share.percent(), 97.0);
}

TEST(PathSmoother, ManoeuvresIntoSlotsBecomeContinuous)
{
    RandomParking random(44);
    Share share;
    for (int i = 0; i < 300; ++i)
    {
        const Vehicle car = random.vehicle();
        ParkingSlot slot = random.slot(car);
        slot.entry = SlotEntry::Reverse;
        slot.depth.reset();
        slot.lateralOffset = 0.0;
        slot.length = car.length() + random.between(0.2, 0.8);
        slot.width = car.width + random.between(0.4, 0.8);
        ReverseParkingOptions options;
        if (slot.kind == SlotKind::Parallel)
            slot.length = ReverseParking(car, options).plan(slot).neededSlotLength + 1e-6;
        options.aisleWidth = ReverseParking(car, options).plan(slot).neededAisleWidth + 1e-6;
        const ReverseParkingResult manoeuvre = ReverseParking(car, options).plan(slot);
        ASSERT_TRUE(manoeuvre.fits()) << manoeuvre.message;
        const PolygonWorld world(car, slotSurroundings(slot, slot.side, options.aisleWidth));
        const SmoothPath result = PathSmoother(car).smooth(manoeuvre.path, world.queries());
        ASSERT_NO_FATAL_FAILURE(expectDrivable(result, manoeuvre.path, car, {})) << i;
        EXPECT_TRUE(result.free);
        EXPECT_LT(gap(result.path.end(), manoeuvre.goal), 1e-9);
        share.add(result);
    }
    EXPECT_GE(share.percent(), 99.0) << "the tightest slots and aisles with 5 cm of clearance";
}

TEST(PathSmoother, FullLockFromSideToSideStopsToSteer)
{
    // Two tangent circles of the smallest radius: there is no longer way round that ends at the same pose.
    const Vehicle car;
    const double full = 1.0 / car.minTurningRadius();
    const Path path{{}, {{full, 1.5}, {-full, 1.5}}};
    const SmoothPath result = PathSmoother(car).smooth(path);
    ASSERT_EQ(result.stops.size(), 1u);
    EXPECT_EQ(result.path.pieces.size(), path.pieces.size());
    EXPECT_LT(gap(result.path.part(result.stops[0], 2).start, advance({}, full, 1.5)), 1e-12);
    // A radius 5 % larger leaves the room.
    const Path wider{{}, {{full / 1.05, 1.5}, {-full / 1.05, 1.5}}};
    EXPECT_EQ(PathSmoother(car).smooth(wider).stops.size(), 0u);
    // So does a line at either end, driven in either direction.
    for (const double direction : {1.0, -1.0})
    {
        const Path line{{}, {{full, direction * 1.5}, {-full, direction * 1.5}, {0.0, direction * 2.0}}};
        const SmoothPath smooth = PathSmoother(car).smooth(line);
        EXPECT_EQ(smooth.stops.size(), 0u);
        EXPECT_NE(smooth.path.pieces.front().sharpness, 0.0);
    }
}

TEST(PathSmoother, WithoutRoomTheArcsStay)
{
    // A world in which only the given path is free.
    const Vehicle car;
    RandomParking random(45);
    for (int i = 0; i < 50; ++i)
    {
        const Path path = random.plannerPath(car, 1.03);
        const SampledPath states = path.sample(0.01);
        FootprintQueries queries;
        queries.isFree = [&](const Pose &pose)
        {
            // Within 2 mm and 2 mrad of the arcs.
            return std::any_of(states.begin(), states.end(),
                               [&](const PathState &state)
                               {
                                   const Pose local = relativeTo(state.pose, pose);
                                   return std::abs(local.x) < 0.01 && std::abs(local.y) < 5e-4 &&
                                          std::abs(local.yaw) < 5e-3;
                               });
        };
        SmoothingOptions options;
        options.minSpeed = 0.9;
        const SmoothPath result = PathSmoother(car, options).smooth(path, queries);
        ASSERT_NO_FATAL_FAILURE(expectDrivable(result, path, car, options));
        EXPECT_TRUE(result.free) << i;
        std::size_t joints = 0;
        for (std::size_t k = 1; k < path.pieces.size(); ++k)
            joints += path.pieces[k].length * path.pieces[k - 1].length > 0.0;
        EXPECT_LE(result.stops.size(), joints);
        EXPECT_GE(2 * result.stops.size(), joints) << "hardly a joint has room here";
    }
}

TEST(PathSmoother, SlowerTransitionsDeviateLess)
{
    const Vehicle car;
    const double full = 1.0 / car.minTurningRadius();
    const Path path{{}, {{0.0, 4.0}, {full, 3.0}, {0.0, 4.0}}};
    double last = 1e9;
    for (const double speed : {2.0, 1.0, 0.5, 0.25})
    {
        SmoothingOptions options;
        options.speed = speed;
        const SmoothPath result = PathSmoother(car, options).smooth(path);
        ASSERT_EQ(result.stops.size(), 0u);
        double deviation = 0.0;
        const SampledPath arcs = path.sample(0.01);
        for (const PathState &state : result.path.sample(0.05))
        {
            double nearest = 1e9;
            for (const PathState &arc : arcs)
                nearest = std::min(nearest, positionDistance(state.pose, arc.pose));
            deviation = std::max(deviation, nearest);
        }
        EXPECT_LT(deviation, last);
        EXPECT_LT(deviation, 0.25);
        last = deviation;
    }
}

TEST(PathSmoother, MirroredAndMovedPathsGiveMirroredAndMovedResults)
{
    RandomParking random(46);
    for (int i = 0; i < 200; ++i)
    {
        const Vehicle car = random.vehicle();
        const Path path = random.plannerPath(car, 1.03);
        Path mirrored = path, moved = path;
        mirrored.start = {path.start.x, -path.start.y, -path.start.yaw};
        for (PathPiece &piece : mirrored.pieces)
            piece.curvature = -piece.curvature;
        const Pose motion = random.pose(100.0);
        moved.start = compose(motion, path.start);
        const PathSmoother smoother(car);
        const SmoothPath a = smoother.smooth(path), b = smoother.smooth(mirrored), c = smoother.smooth(moved);
        ASSERT_EQ(a.path.pieces.size(), b.path.pieces.size());
        ASSERT_EQ(a.path.pieces.size(), c.path.pieces.size());
        for (std::size_t k = 0; k < a.path.pieces.size(); ++k)
        {
            const PathPiece &piece = a.path.pieces[k];
            ASSERT_NEAR(piece.length, b.path.pieces[k].length, 1e-7);
            ASSERT_NEAR(piece.curvature, -b.path.pieces[k].curvature, 1e-6);
            ASSERT_NEAR(piece.length, c.path.pieces[k].length, 1e-7);
            ASSERT_NEAR(piece.curvature, c.path.pieces[k].curvature, 1e-6);
        }
        EXPECT_LT(gap(compose(motion, a.path.end()), c.path.end()), 1e-7);
    }
}

TEST(PathSmoother, PathsWithoutMotionStayEmpty)
{
    const SmoothPath none = PathSmoother(Vehicle()).smooth(Path{{1.0, 2.0, 0.5}, {}});
    EXPECT_EQ(none.path.start.x, 1.0);
    EXPECT_TRUE(none.path.pieces.empty());
    EXPECT_TRUE(none.free);
}

TEST(PathSmoother, OnlyArcsAndLinesCanBeSmoothed)
{
    expectError(
        [] {
            PathSmoother(Vehicle()).smooth({{}, {{0.0, 1.0}, {0.0, 1.0, 0.1}}});
        },
        {"smoothing", "piece 1", "clothoid"});
    expectError(
        [] {
            PathSmoother(Vehicle()).smooth({{}, {PathPiece::turnOnTheSpot(1.0), {0.0, 1.0}}});
        },
        {"smoothing", "piece 0", "turns on the spot"});
}

TEST(PathSmoother, BadOptionsAreNamed)
{
    const auto bad = [](double SmoothingOptions::*option, double value, const char *name)
    {
        SmoothingOptions options;
        options.*option = value;
        expectError([&] { PathSmoother smoother(Vehicle(), options); }, {"smoothing", name, "positive"});
    };
    for (const double value : {0.0, -1.0, std::nan("")})
    {
        bad(&SmoothingOptions::speed, value, "speed");
        bad(&SmoothingOptions::minSpeed, value, "min speed");
        bad(&SmoothingOptions::tolerance, value, "tolerance");
    }
    Vehicle car;
    car.maxSteeringRate = 0.0;
    expectError([&] { PathSmoother smoother(car); }, {"max_steering_rate"});
}

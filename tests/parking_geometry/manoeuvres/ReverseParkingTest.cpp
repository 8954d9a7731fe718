#include "parking_geometry/manoeuvres/ReverseParking.h"

#include "benchmarks/worlds/RandomParking.h"
#include "parking_geometry/manoeuvres/SlotSurroundings.h"
#include "tests/parking_geometry/ExpectError.h"
#include "tests/parking_geometry/PolygonWorld.h"
#include "tests/parking_geometry/manoeuvres/ParkingProblems.h"
#include "tests/support/PoseGap.h"

#include <cmath>

#include <gtest/gtest.h>

using namespace parking;
using parking_test::expectError;
using parking_test::gap;
using parking_test::grazing;
using parking_test::lengthened;
using parking_test::PolygonWorld;
using parking_test::RandomParking;

TEST(ReverseParking, ManoeuvresEndInTheSlotTurnTangentiallyAndKeepTheRadius)
{
    RandomParking random(21);
    int fits = 0;
    for (int i = 0; i < 100000; ++i)
    {
        const Vehicle car = random.vehicle();
        ParkingSlot slot = random.slot(car);
        if (slot.kind == SlotKind::Parallel)
            slot = lengthened(slot, slot.length + random.between(0.0, 6.0));
        ReverseParkingOptions options;
        options.clearance = random.chance(0.5) ? 0.0 : random.between(0.0, 0.1);
        options.guardLength = random.between(0.0, 3.0);
        const ReverseParkingResult result = ReverseParking(car, options).plan(slot);
        ASSERT_EQ(gap(result.goal, slot.goals(car).front()), 0.0);
        if (!result.fits())
        {
            ASSERT_TRUE(result.path.pieces.empty());
            ASSERT_GT(result.missing, 0.0);
            ASSERT_NE(result.message.find(" cm"), std::string::npos);
            ASSERT_EQ(result.path.stretches().size(), 0u);
            continue;
        }
        ++fits;
        // Closure. Pieces of constant curvature are tangent by construction; what remains is the goal.
        ASSERT_LT(gap(result.path.end(), result.goal), 1e-9);
        ASSERT_EQ(result.path.stretches().size(), 1u);
        ASSERT_TRUE(result.message.empty());
        const double direction = slot.entry == SlotEntry::Forward ? 1.0 : -1.0;
        for (const PathPiece &piece : result.path.pieces)
        {
            ASSERT_GT(direction * piece.length, 0.0);
            ASSERT_LE(std::abs(piece.curvature), (1.0 + 1e-12) / car.minTurningRadius());
        }
        // P lies along the aisle, headed so that the car drives off in its direction.
        const bool turned = slot.entry == SlotEntry::Forward && slot.kind != SlotKind::Parallel;
        ASSERT_NEAR(wrapAngle(result.path.start.yaw - slot.aisleYaw(slot.side) - (turned ? PI : 0.0)), 0.0, 1e-9);
        if (options.guardLength > 0.0)
        {
            ASSERT_NEAR(std::abs(result.path.pieces.front().length), options.guardLength, 1e-12);
            ASSERT_EQ(result.path.pieces.front().curvature, 0.0);
        }
        if (slot.kind == SlotKind::Parallel)
        {
            ASSERT_GE(result.firstRadius, result.minRadius - 1e-9);
            ASSERT_LE(result.firstRadius, result.maxRadius + 1e-9);
        }
    }
    EXPECT_GT(fits, 50000);
}

TEST(ReverseParking, TheBodyStaysFreeAlongTheWholeManoeuvreAndKeepsTheClearance)
{
    RandomParking random(22);
    int fits = 0;
    for (int i = 0; i < 5000; ++i)
    {
        const Vehicle car = random.vehicle();
        ParkingSlot slot = random.slot(car);
        if (slot.kind == SlotKind::Parallel)
            slot = lengthened(slot, slot.length + random.between(0.0, 6.0));
        ReverseParkingOptions options = grazing(random.between(2.0, 9.0), random.between(0.0, 4.0));
        options.clearance = i % 4 == 0 ? 0.1 : 0.0;
        const ReverseParkingResult result = ReverseParking(car, options).plan(slot);
        if (!result.fits())
            continue;
        ++fits;
        const PolygonWorld world(car, slotSurroundings(slot, slot.side, options.aisleWidth, 30.0));
        if (options.clearance == 0.0)
            ASSERT_TRUE(world.isPathFree(result.path, 1e-3)) << i;
        else
            for (const PathState &state : result.path.sample(0.05))
                ASSERT_GE(world.clearance(state.pose), options.clearance - 1e-6) << i;
    }
    EXPECT_GT(fits, 1000);
}

TEST(ReverseParking, ABayThatIsTooShortForTheClearanceIsRefused)
{
    RandomParking random(30);
    int tested = 0;
    for (int i = 0; i < 300; ++i)
    {
        const Vehicle car = random.vehicle();
        ParkingSlot slot = random.slot(car);
        if (slot.kind == SlotKind::Parallel)
            continue;
        slot.lateralOffset = 0.0;
        slot.length += 0.4;
        slot.width += 0.4;
        ReverseParkingOptions options;
        options.clearance = random.between(0.02, 0.2);
        for (const double change : {-0.01, -1e-6, 1e-6, 0.01})
        {
            slot.depth = options.clearance + change;
            const ReverseParkingResult result = ReverseParking(car, options).plan(slot);
            ASSERT_EQ(result.fits(), change > 0.0) << i << ": " << result.message;
            const PolygonWorld world(car, slotSurroundings(slot, slot.side));
            EXPECT_NEAR(world.clearance(slot.goals(car).front()), *slot.depth, 1e-9);
            if (result.fits())
                continue;
            EXPECT_EQ(result.status, ReverseParkingStatus::SlotTooShort);
            EXPECT_NEAR(result.missing, -change, 1e-9);
            EXPECT_NE(result.message.find("at the closed end"), std::string::npos) << result.message;
            // A world without a wall there has the last word.
            std::vector<Polygon> open = slotSurroundings(slot, slot.side);
            open.pop_back();
            const PolygonWorld kinder(car, open);
            EXPECT_TRUE(ReverseParking(car, options).plan(slot, kinder.queries()).fits());
            ++tested;
        }
    }
    EXPECT_GT(tested, 200);
}

TEST(ReverseParking, MirroredAndMovedSlotsGiveMirroredAndMovedManoeuvres)
{
    RandomParking random(27);
    for (int i = 0; i < 100000; ++i)
    {
        const Vehicle car = random.vehicle();
        ParkingSlot slot = random.slot(car);
        if (slot.kind == SlotKind::Parallel)
            slot.length += 3.0;
        const Pose motion = random.pose(100.0);
        ParkingSlot mirrored = slot, moved = slot;
        mirrored.pose = {slot.pose.x, -slot.pose.y, -slot.pose.yaw};
        mirrored.lateralOffset = -slot.lateralOffset;
        mirrored.side = slot.side == SlotSide::Left ? SlotSide::Right : SlotSide::Left;
        moved.pose = compose(motion, slot.pose);
        const ReverseParking parking(car, grazing(random.between(3.0, 12.0)));
        const ReverseParkingResult a = parking.plan(slot), b = parking.plan(mirrored), c = parking.plan(moved);
        for (const ReverseParkingResult *other : {&b, &c})
        {
            ASSERT_EQ(a.status, other->status);
            ASSERT_NEAR(a.missing, other->missing, 1e-9);
            ASSERT_EQ(a.path.pieces.size(), other->path.pieces.size());
        }
        if (!a.fits())
            continue;
        ASSERT_LT(gap({a.path.start.x, -a.path.start.y, -a.path.start.yaw}, b.path.start), 1e-9);
        ASSERT_LT(gap(compose(motion, a.path.start), c.path.start), 1e-9);
        for (std::size_t k = 0; k < a.path.pieces.size(); ++k)
        {
            ASSERT_NEAR(a.path.pieces[k].curvature, -b.path.pieces[k].curvature, 1e-9);
            ASSERT_NEAR(a.path.pieces[k].length, b.path.pieces[k].length, 1e-9);
            ASSERT_NEAR(a.path.pieces[k].length, c.path.pieces[k].length, 1e-9);
        }
    }
}

TEST(ReverseParking, VerdictsNameWhatIsMissing)
{
    const Vehicle car;
    ReverseParkingOptions options;
    options.clearance = 0.0;
    ParkingSlot slot;
    slot.kind = SlotKind::Parallel;
    slot.side = SlotSide::Right;
    slot.length = 6.0;
    slot.width = 2.3;
    const ReverseParkingResult tooShort = ReverseParking(car, options).plan(slot);
    EXPECT_EQ(tooShort.status, ReverseParkingStatus::SlotTooShort);
    EXPECT_LT(tooShort.maxRadius, car.minTurningRadius());
    EXPECT_NEAR(tooShort.missing, tooShort.neededSlotLength - 6.0, 1e-9);
    EXPECT_NE(tooShort.message.find("R_min is 3.006 m"), std::string::npos) << tooShort.message;
    EXPECT_NE(tooShort.message.find("R_max"), std::string::npos) << tooShort.message;

    slot.length = 12.0;
    slot.width = car.width + 0.02;
    const ReverseParkingResult kerb = ReverseParking(car, options).plan(slot);
    EXPECT_EQ(kerb.status, ReverseParkingStatus::SlotTooNarrow);
    EXPECT_NE(kerb.message.find("kerb"), std::string::npos) << kerb.message;
    // With the kerb as far away as the message asks for, and the car where it was, it fits; with less it does not.
    for (const double change : {-1e-6, 1e-6})
    {
        ParkingSlot wider = slot;
        wider.width += kerb.missing + change;
        wider.lateralOffset = 0.5 * (kerb.missing + change);
        EXPECT_EQ(ReverseParking(car, options).plan(wider).fits(), change > 0.0);
    }

    slot = ParkingSlot();
    slot.width = car.width + 0.06;
    options.clearance = 0.05;
    const ReverseParkingResult narrow = ReverseParking(car, options).plan(slot);
    EXPECT_EQ(narrow.status, ReverseParkingStatus::SlotTooNarrow);
    EXPECT_NEAR(narrow.missing, 0.02, 1e-9);
    EXPECT_NE(narrow.message.find("2 cm"), std::string::npos) << narrow.message;

    slot.width = 2.5;
    options.aisleWidth = 3.0;
    const ReverseParkingResult aisle = ReverseParking(car, options).plan(slot);
    EXPECT_EQ(aisle.status, ReverseParkingStatus::AisleTooNarrow);
    EXPECT_NE(aisle.message.find("aisle, 3 m"), std::string::npos) << aisle.message;
}

TEST(ReverseParking, NonsenseIsAnError)
{
    const Vehicle car;
    ParkingSlot slot;
    slot.length = 4.0;
    expectError([&] { ReverseParking(car).plan(slot); }, {"slot", "length", "68.9 cm"});
    slot.length = -1.0;
    expectError([&] { ReverseParking(car).plan(slot); }, {"slot", "length is -1", "above 0"});
    expectError([&] { ReverseParking(car).planAll(slot); }, {"slot", "length is -1", "above 0"});
    Vehicle bad;
    bad.wheelbase = 0.0;
    expectError([&] { ReverseParking parking(bad); }, {"wheelbase"});
    const auto badOption = [&](double ReverseParkingOptions::*option, double value, const char *name)
    {
        ReverseParkingOptions options;
        options.*option = value;
        expectError([&] { ReverseParking parking(car, options); }, {"reverse parking", name});
    };
    badOption(&ReverseParkingOptions::aisleWidth, 0.0, "aisle width");
    badOption(&ReverseParkingOptions::clearance, -0.01, "clearance");
    badOption(&ReverseParkingOptions::guardLength, -1.0, "guard length");
    badOption(&ReverseParkingOptions::guardLength, HUGE_VAL, "guard length");
    badOption(&ReverseParkingOptions::preferredRadius, -1.0, "preferred radius");
}

TEST(ReverseParking, TheWorldMayBeKinderThanTheModel)
{
    // A parallel slot of 6 m is too short between cars; without the one ahead it is entered in one sweep.
    const Vehicle car;
    ParkingSlot slot;
    slot.kind = SlotKind::Parallel;
    slot.side = SlotSide::Right;
    slot.length = 6.0;
    slot.width = 2.5;
    std::vector<Polygon> obstacles = slotSurroundings(slot, SlotSide::Right);
    const ReverseParking parking(car);
    const PolygonWorld full(car, obstacles);
    EXPECT_EQ(parking.plan(slot, full.queries()).status, ReverseParkingStatus::SlotTooShort);
    obstacles.erase(obstacles.begin());
    const PolygonWorld open(car, obstacles);
    const ReverseParkingResult result = parking.plan(slot, open.queries());
    ASSERT_TRUE(result.fits()) << result.message;
    EXPECT_TRUE(open.isPathFree(result.path));
}

TEST(ReverseParking, TheWorldMayBeHarsherThanTheModel)
{
    const Vehicle car;
    ParkingSlot slot;
    slot.side = SlotSide::Right;
    const ReverseParking parking(car);
    const ReverseParkingResult free = parking.plan(slot);
    ASSERT_TRUE(free.fits());
    std::vector<Polygon> obstacles = slotSurroundings(slot, SlotSide::Right);
    // The inner neighbour sticks out by 60 cm: the turn must begin later.
    const double y = -0.5 * slot.width;
    obstacles.push_back({{2.5, y - 2.0}, {3.1, y - 2.0}, {3.1, y}, {2.5, y}});
    const PolygonWorld crooked(car, obstacles);
    ASSERT_FALSE(crooked.isPathFree(free.path));
    const ReverseParkingResult later = parking.plan(slot, crooked.queries());
    ASSERT_TRUE(later.fits()) << later.message;
    EXPECT_TRUE(crooked.isPathFree(later.path));
    // The guard line is as long as the world leaves it.
    const double front = later.path.start.y - car.wheelbase - car.frontOverhang;
    obstacles.push_back({{3.2, front}, {9.0, front}, {9.0, front + 0.7}, {3.2, front + 0.7}});
    const PolygonWorld closed(car, obstacles);
    const ReverseParkingResult shorter = parking.plan(slot, closed.queries());
    ASSERT_TRUE(shorter.fits()) << shorter.message;
    EXPECT_LT(std::abs(shorter.path.pieces.front().length), parking.options().guardLength);
    EXPECT_TRUE(closed.isPathFree(shorter.path));
    // A wall before the mouth blocks every variant.
    obstacles.push_back({{4.5, -20.0}, {5.0, -20.0}, {5.0, 20.0}, {4.5, 20.0}});
    const PolygonWorld walled(car, obstacles);
    const ReverseParkingResult blocked = parking.plan(slot, walled.queries());
    EXPECT_EQ(blocked.status, ReverseParkingStatus::Blocked);
    EXPECT_TRUE(blocked.path.pieces.empty());
    EXPECT_NE(blocked.message.find("block"), std::string::npos);
}

TEST(ReverseParking, EitherTriesEverySideAndEntry)
{
    const Vehicle car;
    ParkingSlot slot;
    slot.entry = SlotEntry::Either;
    const ReverseParking parking(car);
    const std::vector<ReverseParkingResult> all = parking.planAll(slot);
    ASSERT_EQ(all.size(), 4u);
    EXPECT_EQ(all[0].entry, SlotEntry::Reverse);
    EXPECT_EQ(all[0].side, SlotSide::Right);
    EXPECT_EQ(all[3].entry, SlotEntry::Forward);
    EXPECT_EQ(all[3].side, SlotSide::Left);
    // Right is blocked: plan() takes the left.
    std::vector<Polygon> obstacles = slotSurroundings(slot, SlotSide::Right);
    obstacles.push_back({{2.6, -2.5}, {9.0, -2.5}, {9.0, -2.0}, {2.6, -2.0}});
    const PolygonWorld world(car, obstacles);
    const ReverseParkingResult result = parking.plan(slot, world.queries());
    ASSERT_TRUE(result.fits());
    EXPECT_EQ(result.side, SlotSide::Left);
    EXPECT_TRUE(world.isPathFree(result.path));
}

TEST(ReverseParking, JoinedPathsMeet)
{
    const Path first{{1.0, 2.0, 0.3}, {{0.2, 3.0}}};
    Path second{first.end(), {{0.2, 1.0}, {0.0, -2.0}}};
    const Path path = joined(first, second);
    EXPECT_EQ(path.pieces.size(), 2u) << "equal neighbours are one piece";
    EXPECT_LT(gap(path.end(), second.end()), 1e-9);
    second.start.x += 1e-3;
    expectError([&] { joined(first, second); }, {"apart", "must start where the first ends"});
}

// Bodies that are any simple polygon: poses, clearances, sweeps and proofs against the oracle, which knows nothing of
// convex pieces.
#include "benchmarks/worlds/OutlinedVehicles.h"
#include "benchmarks/worlds/RandomWorlds.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/referee/FreeSpace.h"
#include "state_validity/Body.h"
#include "state_validity/FootprintCells.h"
#include "state_validity/FootprintChecker.h"
#include "state_validity/fcl/FclContactTest.h"
#include "state_validity/sweeps/PathSweep.h"
#include "state_validity/sweeps/PieceFront.h"
#include "tests/parking_geometry/ExpectError.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <vector>

#include <gtest/gtest.h>

using namespace parking;
using namespace parking_test;

namespace
{
    /** The named bodies and as many random ones. */
    std::vector<Vehicle> someVehicles(std::uint64_t seed)
    {
        std::vector<Vehicle> vehicles = outlinedVehicles();
        Random random(seed);
        for (std::size_t i = vehicles.size(); i > 0; --i)
            vehicles.push_back(randomOutlined(random));
        return vehicles;
    }

    World someWorld(std::uint64_t seed)
    {
        return seed % 3 == 2 ? randomGridWorld(seed) : randomPolygonWorld(seed);
    }

    Pose somePose(const World &world, const Vehicle &vehicle, Random &random, int i)
    {
        return i % 3 == 0   ? world.anywhere(random)
               : i % 3 == 1 ? world.touching(random, vehicle, 0.0)
                            : world.touching(random, vehicle, std::abs(random.magnitude(1e-10, 0.5)));
    }

    std::string text(const World &world, const Vehicle &vehicle, const Pose &pose)
    {
        std::ostringstream stream;
        stream << world.name << std::setprecision(17) << " pose " << pose.x << " " << pose.y << " " << pose.yaw
               << " outline";
        for (const Eigen::Vector2d &corner : vehicle.outline)
            stream << " (" << corner.x() << ", " << corner.y() << ")";
        return stream.str();
    }
}  // namespace

TEST(Outline, PosesAreThoseOfTheOracleAndFcl)
{
    int free = 0, poses = 0, inBand = 0;
    CheckCounts counts;
    for (std::uint64_t seed = 1; seed <= 8; ++seed)
    {
        const World world = someWorld(seed);
        for (const Vehicle &vehicle : someVehicles(seed))
        {
            const FootprintChecker checker(world.obstacles, vehicle, 0.0, fclContactTest());
            const FootprintChecker careful(world.obstacles, vehicle);
            const PlainFclChecker fcl(world.obstacles, vehicle);
            Random random(seed);
            for (int i = 0; i < 1100; ++i)
            {
                const Pose pose = somePose(world, vehicle, random, i);
                const bool isFree = checker.isFree(pose, counts);
                const bool surelyFree = world.oracle.isFree(pose, vehicle, 2e-9);
                const bool surelyNot = !surelyFree && !world.oracle.isFree(pose, vehicle, -1e-9);
                ++poses;
                free += surelyFree;
                inBand += !surelyFree && !surelyNot;
                if (!surelyFree && !surelyNot)
                    continue;
                ASSERT_EQ(isFree, surelyFree) << text(world, vehicle, pose);
                ASSERT_EQ(careful.isFree(pose), surelyFree) << text(world, vehicle, pose);
                ASSERT_EQ(fcl.isFree(pose), surelyFree) << text(world, vehicle, pose);
            }
        }
    }
    EXPECT_GT(poses, 100000);
    EXPECT_GT(free, poses / 20);
    EXPECT_LT(free, poses * 19 / 20);
    EXPECT_GT(inBand, 100);
    for (const std::uint64_t count : {counts.byField, counts.byCircles, counts.byEdges})
        EXPECT_GT(count, counts.states / 50);
}

/** The default car as an outline is the default car. */
TEST(Outline, RectangleIsTheRectangle)
{
    const World world = randomPolygonWorld(4);
    const FootprintChecker outline(world.obstacles, rectangularOutline()), rectangle(world.obstacles, {});
    Random random(4);
    for (int i = 0; i < 5000; ++i)
    {
        const Pose pose = world.touching(random, {}, std::abs(random.magnitude(1e-6, 2.0)));
        ASSERT_EQ(outline.isFree(pose), rectangle.isFree(pose));
        ASSERT_NEAR(outline.exactClearance(pose), rectangle.exactClearance(pose), 1e-9);
        const double curvature = random.between(-0.3, 0.3), length = random.between(-3.0, 3.0);
        ASSERT_NEAR(outline.freeLength(pose, curvature, length), rectangle.freeLength(pose, curvature, length), 1e-6)
            << text(world, rectangularOutline(), pose);
    }
}

TEST(Outline, MarginContainsAllWithinItAndLittleMore)
{
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
    {
        const World world = randomPolygonWorld(seed);
        for (const Vehicle &vehicle : someVehicles(seed + 50))
        {
            const double margin = seed == 1 ? 0.02 : 0.2;
            const FootprintChecker checker(world.obstacles, vehicle, margin);
            Random random(seed);
            for (int i = 0; i < 300; ++i)
            {
                const Pose pose = world.touching(random, vehicle, random.between(0.0, 3.0 * margin));
                if (checker.isFree(pose))
                    ASSERT_TRUE(world.oracle.isFree(pose, vehicle, margin * (1.0 - 1e-9)))
                        << text(world, vehicle, pose);
                else
                    ASSERT_FALSE(world.oracle.isFree(pose, vehicle, std::sqrt(2.0) * margin + 1e-9))
                        << text(world, vehicle, pose);
            }
        }
    }
}

TEST(Outline, ClearanceIsThatOfTheOracle)
{
    for (std::uint64_t seed = 1; seed <= 4; ++seed)
    {
        const World world = randomPolygonWorld(seed);
        for (const Vehicle &vehicle : someVehicles(seed + 20))
        {
            const FootprintChecker checker(world.obstacles, vehicle);
            Random random(seed);
            CheckCounts counts;
            for (int i = 0; i < 200; ++i)
            {
                const Pose pose = world.touching(random, vehicle, std::abs(random.magnitude(1e-6, 2.0)));
                const double right = world.oracle.clearance(pose, vehicle);
                ASSERT_NEAR(checker.exactClearance(pose), right, 1e-8) << text(world, vehicle, pose);
                const double bound = checker.clearance(pose);
                ASSERT_LE(bound, right + 1e-9) << text(world, vehicle, pose);
                ASSERT_GE(bound, 0.7 * std::min(right, 1.0) - 1e-9) << text(world, vehicle, pose);
                const double wanted = random.between(0.0, 1.2);
                const bool keeps = checker.keeps(pose, wanted, counts);
                ASSERT_TRUE(!keeps || right >= wanted - 1e-9) << text(world, vehicle, pose);
                ASSERT_TRUE(keeps || wanted > 1.0 || bound < wanted + 1e-9) << text(world, vehicle, pose);
            }
        }
    }
}

TEST(Outline, FreeLengthIsFreeAndStopsAtContact)
{
    constexpr double TOLERANCE = 1e-3;
    int motions = 0, whole = 0, stopped = 0;
    for (std::uint64_t seed = 1; seed <= 8; ++seed)
    {
        const World world = someWorld(seed + 10);
        for (const Vehicle &vehicle : someVehicles(seed + 70))
        {
            const FootprintChecker checker(world.obstacles, vehicle);
            Random random(seed);
            CheckCounts counts;
            for (int i = 0; i < 105;)
            {
                const Pose from = somePose(world, vehicle, random, i % 2 == 0 ? 2 : 0);
                if (!checker.isFree(from))
                    continue;
                ++i;
                ++motions;
                const double curvature = random.chance(0.2)   ? 0.0
                                         : random.chance(0.3) ? random.magnitude(1e-9, 1e-3)
                                                              : random.magnitude(1e-3, 3.0);
                const double length = random.magnitude(0.05, 4.0), wanted = std::abs(length);
                const double free = checker.freeLength(from, curvature, length, TOLERANCE, counts);
                ASSERT_LE(free, wanted);
                const auto about = [&]
                {
                    std::ostringstream stream;
                    stream << text(world, vehicle, from) << std::setprecision(17) << " curvature " << curvature
                           << " length " << length << " free " << free;
                    return stream.str();
                };
                ASSERT_TRUE(world.oracle.isArcFree(from, curvature, std::copysign(free, length), vehicle, 1e-3))
                    << about();
                whole += free >= wanted;
                if (free >= wanted)
                    continue;
                ++stopped;
                const double ahead = std::min(free + TOLERANCE + 1e-6, wanted);
                bool touched = false;
                for (const int looks : {20, 2000})
                    for (int k = 0; k <= looks && !touched; ++k)
                    {
                        const double driven = free + (ahead - free) * k / looks;
                        touched = !world.oracle.isFree(advance(from, curvature, std::copysign(driven, length)), vehicle,
                                                       std::sqrt(2.0) * TOLERANCE + 1e-6);
                    }
                ASSERT_TRUE(touched) << about();
            }
        }
    }
    EXPECT_GT(motions, 10000);
    EXPECT_GT(whole, motions / 10);
    EXPECT_GT(stopped, motions / 10);
}

/** The fast front and the equations that it replaces have the same contacts. */
TEST(Outline, FrontIsTheFirstContact)
{
    Random random(9);
    std::vector<Body> bodies;
    for (const Vehicle &vehicle : someVehicles(9))
        bodies.emplace_back(vehicle, bodies.size() % 2 == 0 ? 0.0 : 0.1);
    int met = 0;
    for (int i = 0; i < 100000; ++i)
    {
        const Body &body = bodies[random.index(bodies.size())];
        const BodyPiece &piece = body.pieces[random.index(body.pieces.size())];
        const double more = random.chance(0.5) ? 0.0 : random.between(0.0, 0.05);
        BoxSweep sweep{0.0,
                       0.0,
                       -body.centreOffset,
                       random.chance(0.2) ? 0.0 : random.magnitude(1e-3, 2.0),
                       random.chance(0.5) ? 1.0 : -1.0,
                       random.between(0.1, 2.0)};
        sweep.length = std::min(sweep.length, 1.0 / (std::abs(sweep.curvature) + 1e-9));
        ASSERT_TRUE(PieceFront::applies(sweep));
        const Eigen::Vector2d a(random.between(-4.0, 4.0), random.between(-3.0, 3.0));
        const Eigen::Vector2d b = a + Eigen::Vector2d(random.magnitude(1e-3, 3.0), random.magnitude(1e-3, 3.0));
        const Eigen::Vector2d along = (b - a).normalized();
        // Only edges that the piece does not touch at the beginning.
        bool isApart = false;
        double low = HUGE_VAL, high = -HUGE_VAL;
        const Eigen::Vector2d normal(-along.y(), along.x());
        for (const BodyPiece::Side &side : piece.sides)
        {
            isApart = isApart || std::min(side.normal.dot(a), side.normal.dot(b)) - side.offset - more > 1e-6;
            const double there = normal.dot(side.corner + more * side.outwards);
            low = std::min(low, there);
            high = std::max(high, there);
        }
        if (!isApart && normal.dot(a) < high + 1e-6 && normal.dot(a) > low - 1e-6)
            continue;
        const double right = firstContact(sweep, piece, more, a.x(), a.y(), b.x(), b.y());
        PieceFront front(piece, more, {0.0, 0.0, 1.0, 0.0, 0.0, 0.0}, sweep,
                         std::sin(std::abs(sweep.curvature) * sweep.length));
        front.meet(a.x(), a.y(), b.x(), b.y(), normal.x(), normal.y());
        const double contact = front.contact();
        if (right < sweep.length - 1e-5 || contact < sweep.length - 1e-5)
        {
            // Grazing contacts depend on rounding; the body stays within a hair of them.
            ASSERT_NEAR(contact, right, 1e-5 + 1e-3 * (std::abs(right - sweep.length) < 1e-3))
                << i << " curvature " << sweep.curvature << " direction " << sweep.direction;
            ++met;
        }
    }
    EXPECT_GT(met, 1500);
}

TEST(Outline, PathsThatAreSweptFreeAreFree)
{
    int free = 0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed)
    {
        const World world = randomPolygonWorld(seed + 30);
        for (const Vehicle &vehicle : outlinedVehicles())
        {
            const FootprintChecker checker(world.obstacles, vehicle);
            Random random(seed);
            for (int i = 0; i < 60; ++i)
            {
                PathPiece clothoid(random.between(-0.3, 0.3), random.between(-1.5, 1.5), random.between(-0.2, 0.2));
                PathPiece turn;
                turn.turn = random.between(-0.5, 0.5);
                const Path path{world.touching(random, vehicle, 0.5), {clothoid, turn}};
                if (!isPathFree(checker, path))
                    continue;
                ++free;
                ASSERT_TRUE(world.oracle.isPathFree(path, vehicle, 1e-3));
            }
        }
    }
    EXPECT_GT(free, 100);
}

TEST(Outline, BlockedCellsCollideThroughout)
{
    int blocked = 0;
    for (std::uint64_t seed = 1; seed <= 2; ++seed)
    {
        const World world = someWorld(seed + 40);
        for (const Vehicle &vehicle : someVehicles(seed + 90))
        {
            const FootprintChecker checker(world.obstacles, vehicle, 0.0, {}, 0.05);
            Random random(seed);
            const double side = random.between(0.02, 0.3);
            const int headings = 32 + random.below(64);
            const FootprintCells cells(checker, side, headings);
            for (int i = 0; i < 100; ++i)
            {
                const Pose at = advance(world.touching(random, vehicle, 0.6), 0.0, vehicle.centreOffset());
                const FootprintCells::Headings bits = cells.blocked(at.x, at.y);
                for (int heading = 0; heading < headings; ++heading)
                {
                    const auto bit = static_cast<std::size_t>(heading);
                    if ((bits[bit / 64] >> (bit % 64) & 1U) == 0)
                        continue;
                    ++blocked;
                    const Pose middle{at.x + 0.5 * side * random.between(-1.0, 1.0),
                                      at.y + 0.5 * side * random.between(-1.0, 1.0),
                                      2.0 * PI * (heading + random.between(0.0, 1.0)) / headings - PI};
                    ASSERT_FALSE(world.oracle.isFree(advance(middle, 0.0, -vehicle.centreOffset()), vehicle))
                        << text(world, vehicle, middle);
                }
            }
        }
    }
    EXPECT_GT(blocked, 1000);
}

/** The referee has code of its own. */
TEST(Outline, RefereeIsTheOracle)
{
    for (std::uint64_t seed = 1; seed <= 4; ++seed)
    {
        const World world = randomPolygonWorld(seed);
        Scenario scenario = world.scenario;
        for (const Vehicle &vehicle : someVehicles(seed + 20))
        {
            scenario.vehicle = vehicle;
            const FreeSpace space(scenario);
            Random random(seed);
            for (int i = 0; i < 300; ++i)
            {
                const Pose pose = somePose(world, vehicle, random, i);
                const bool isFree = space.isFree(pose);
                ASSERT_TRUE(isFree || !world.oracle.isFree(pose, vehicle)) << text(world, vehicle, pose);
                ASSERT_TRUE(!isFree || world.oracle.isFree(pose, vehicle, -2e-6)) << text(world, vehicle, pose);
                ASSERT_NEAR(std::min(2.0, space.clearance(pose, 2.0)),
                            std::min(2.0, world.oracle.clearance(pose, vehicle)), 1e-8)
                    << text(world, vehicle, pose);
            }
        }
    }
}

TEST(Outline, BodyIsRefusedWhereItIsTooLargeOrWrong)
{
    const ObstacleSet world = ObstacleSet::fromPolygons({}, {{0.0, 0.0}, {1.0, 1.0}});
    expectError([&] { FootprintChecker(world, forklift()); }, {"does not fit"});
    Vehicle wrong = forklift();
    wrong.outline.pop_back();
    wrong.outline.push_back({-0.4, -0.7});
    expectError([&] { Body(wrong, 0.0); }, {"outline"});
    expectError([&] { Body(forklift(), -0.1); }, {"safety margin"});
}

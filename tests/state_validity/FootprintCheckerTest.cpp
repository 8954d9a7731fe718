#include "state_validity/FootprintChecker.h"

#include "benchmarks/worlds/RandomWorlds.h"
#include "parking_geometry/Error.h"
#include "state_validity/fcl/FclContactTest.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

using namespace parking;
using namespace parking_test;

namespace
{
    const double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();
    const Box BOX{{-20.0, -20.0}, {20.0, 20.0}};

    ObstacleSet box(const std::vector<Polygon> &polygons = {})
    {
        return ObstacleSet::fromPolygons(polygons, BOX);
    }
}  // namespace

TEST(FootprintChecker, ClearanceIsALowerBoundAndNearlyTheDistance)
{
    int exact = 0;
    for (std::uint64_t seed = 0; seed < 12; ++seed)
    {
        const World world = randomPolygonWorld(seed);
        const Vehicle vehicle;
        const FootprintChecker checker(world.obstacles, vehicle);
        Random random(seed);
        for (int i = 0; i < 4000; ++i)
        {
            const Pose pose =
                i % 2 ? world.anywhere(random) : world.touching(random, vehicle, std::abs(random.magnitude(1e-4, 2.0)));
            const double distance = world.oracle.clearance(pose, vehicle);
            const double clearance = checker.clearance(pose);
            ASSERT_LE(clearance, distance + 1e-12);
            ASSERT_NEAR(checker.exactClearance(pose), distance, 1e-9);
            if (distance < 1.0)
            {
                ASSERT_GE(clearance, 0.7 * distance - 1e-10);
                exact += clearance > 0.0 && clearance > distance - 1e-9;
            }
            else
            {
                ASSERT_GE(clearance, 0.7);
            }
            // Content with less: at least that much when there is, and still a lower bound.
            CheckCounts counts;
            const double enough = random.between(0.0, 1.5);
            const double some = checker.clearance(pose, enough, counts);
            ASSERT_LE(some, distance + 1e-12);
            ASSERT_GE(some, std::min(enough, clearance) - 1e-9);
            // So is the question without a number; both sides of the distance itself.
            for (const double asked : {enough, distance - 1e-9, distance + 1e-9, clearance - 1e-9})
            {
                if (asked <= 0.0)
                    continue;
                const bool keeps = checker.keeps(pose, asked, counts);
                ASSERT_TRUE(!keeps || asked <= distance + 1e-12) << asked << " of " << distance;
                ASSERT_TRUE(keeps || asked > std::min(clearance, 0.9) - 1e-9) << asked << " of " << clearance;
            }
        }
    }
    EXPECT_GT(exact, 5000);
}

TEST(FootprintChecker, ClearanceOnGridsIsALowerBound)
{
    for (std::uint64_t seed = 0; seed < 12; ++seed)
    {
        const World world = randomGridWorld(seed);
        const Vehicle vehicle;
        const FootprintChecker checker(world.obstacles, vehicle);
        Random random(seed);
        for (int i = 0; i < 2000; ++i)
        {
            const Pose pose = world.anywhere(random);
            const double clearance = checker.clearance(pose);
            ASSERT_TRUE(clearance == 0.0 || world.oracle.isFree(pose, vehicle, std::sqrt(0.5) * clearance - 1e-9));
            const double exact = checker.exactClearance(pose);
            ASSERT_GE(exact, clearance - 1e-12);
            ASSERT_EQ(exact > 0.0, checker.isFree(pose));
            CheckCounts counts;
            const double asked = random.between(0.0, 0.9);
            ASSERT_TRUE(std::abs(clearance - asked) < 1e-9 ||
                        checker.keeps(pose, asked, counts) == (clearance > asked));
        }
    }
}

/** The lower bound of a circle that covers part of the body is tight for an obstacle on the diagonal. An obstacle that
   pokes into the body by a thousandth of the radius must be seen: with a radius or an error bound 1 % smaller it is
   not. */
TEST(FootprintChecker, CirclesRoundTheBodyAreNotTooSmall)
{
    const double side = 0.05;
    Vehicle vehicle;
    const double half = vehicle.length() / 12.0;  // of the stretch that each of the six circles covers
    const double middle = vehicle.centreOffset();
    int checked = 0;
    for (const double reach : {0.0, 1.0})
        for (int circle = 0; circle < 6; ++circle)
        {
            // The circle's centre along the body, and a corner of what it covers: the circle round the whole body when
            // `reach` is 1, seen at the body's front left corner.
            const double offset = reach > 0.0 ? 0.0 : -0.5 * vehicle.length() + half * (2 * circle + 1);
            const double along = reach > 0.0 ? 0.5 * vehicle.length() : half;
            const double radius = std::hypot(along, 0.5 * vehicle.width);
            // Turned so that the corner lies on the diagonal, the centre in the far corner of a cell.
            const double yaw = 0.25 * PI - std::atan2(0.5 * vehicle.width, along);
            OccupancyGrid grid(600, 600, side);
            grid.set(400, 400, Cell::Occupied);
            const double corner = 400.0 * side;
            for (int cells = 10; cells < 60; cells += 6)
            {
                // The centre where the cell's upper right corner is as far from the obstacle as the radius, almost.
                const double distance = std::sqrt(2.0) * side * cells;
                Vehicle scaled = vehicle;
                const double scale = distance * (1.0 + 1e-3) / radius;
                scaled.wheelbase *= scale;
                scaled.frontOverhang *= scale;
                scaled.rearOverhang *= scale;
                scaled.width *= scale;
                const double at = corner - side * cells - 1e-7;
                const Pose pose = compose({at, at, yaw}, {-(middle + offset) * scale, 0.0, 0.0});
                const FootprintChecker checker(ObstacleSet::fromGrid(grid), scaled);
                ASSERT_FALSE(PolygonOracle(grid).isFree(pose, scaled)) << circle << " " << cells;
                EXPECT_FALSE(checker.isFree(pose)) << circle << " " << cells;
                ++checked;
            }
        }
    EXPECT_EQ(checked, 108);
}

/** The same for the circles inside of the body: a post just beside the body is no collision. */
TEST(FootprintChecker, CirclesInsideOfTheBodyAreNotTooLarge)
{
    const double side = 0.05;
    const Vehicle vehicle;
    const double middle = vehicle.centreOffset();
    const double half = vehicle.length() / 12.0;
    const Box bounds{{0.0, 0.0}, {30.0, 30.0}};
    int checked = 0;
    for (int circle = 0; circle < 7; ++circle)
    {
        // Near the bumpers the inscribed circle touches the bumper, elsewhere the flank. The seventh is that of the
        // middle.
        const double offset = circle == 6 ? 0.0 : -0.5 * vehicle.length() + half * (2 * circle + 1);
        const double toBumper = 0.5 * vehicle.length() - std::abs(offset);
        const bool bumper = toBumper < 0.5 * vehicle.width;
        const double radius = bumper ? toBumper : 0.5 * vehicle.width;
        // The nearest place of the body's outline lies on the diagonal.
        const double yaw = 0.25 * PI - (bumper ? (offset > 0.0 ? 0.0 : PI) : 0.5 * PI);
        const double far = 400.0 * side + side - 3e-7;  // upper right corner of a cell, of the field's raster too
        const Polygon post{{far - 1e-7, far - 1e-7}, {far + 1e-7, far - 1e-7}, {far, far + 1e-7}};
        for (int cells = 8; cells < 40; ++cells)
        {
            const double at = side * (400.0 - cells) + 1e-7;
            const double distance = std::sqrt(2.0) * (far - 1e-7 - at);
            Vehicle scaled = vehicle;
            const double scale = distance * (1.0 - 1e-3) / radius;
            if (scale > 2.5)
                break;
            scaled.wheelbase *= scale;
            scaled.frontOverhang *= scale;
            scaled.rearOverhang *= scale;
            scaled.width *= scale;
            const Pose pose = compose({at, at, yaw}, {-(middle + offset) * scale, 0.0, 0.0});
            const FootprintChecker checker(ObstacleSet::fromPolygons({post}, bounds), scaled, 0.0, {}, side);
            ASSERT_TRUE(PolygonOracle({post}, bounds).isFree(pose, scaled)) << circle << " " << cells;
            EXPECT_TRUE(checker.isFree(pose)) << circle << " " << cells;
            ++checked;
        }
    }
    EXPECT_GT(checked, 100);
}

TEST(FootprintChecker, TheSpeedFactorIsTheSpeedOfTheFastestCorner)
{
    constexpr double MARGIN = 0.1, STEP = 1e-6;
    Vehicle body;
    const FootprintChecker checker(ObstacleSet::fromPolygons({}, {{-20.0, -20.0}, {20.0, 20.0}}), body, MARGIN);
    body.frontOverhang += MARGIN;
    body.rearOverhang += MARGIN;
    body.width += 2.0 * MARGIN;
    for (const double curvature : {0.0, 0.05, -0.33, 2.0})
    {
        const auto before = body.footprint({}), after = body.footprint(advance({}, curvature, STEP));
        double fastest = 0.0;
        for (std::size_t i = 0; i < before.size(); ++i)
            fastest = std::max(fastest, (after[i] - before[i]).norm() / STEP);
        EXPECT_NEAR(checker.speedFactor(curvature), fastest, 1e-4) << curvature;
    }
}

TEST(FootprintChecker, KnowsExactClearancesInTheMiddleOfALongWorld)
{
    // 32 km, and nothing but the bounds, out of reach of what is gathered round a pose.
    const Vehicle vehicle;
    const FootprintChecker checker(ObstacleSet::fromPolygons({}, {{-10.0, -10.0}, {32010.0, 13.0}}), vehicle);
    Random random(3);
    for (int i = 0; i < 2000; ++i)
    {
        const Pose pose{random.between(50.0, 31950.0), random.between(-5.0, 8.0), random.between(-PI, PI)};
        double room = HUGE_VAL;
        for (const Eigen::Vector2d &corner : vehicle.footprint(pose))
            room = std::min({room, corner.y() + 10.0, 13.0 - corner.y()});
        EXPECT_NEAR(checker.exactClearance(pose), std::max(room, 0.0), 1e-9);
    }
}

TEST(FootprintChecker, SeesObstaclesWithoutArea)
{
    // All corners at one place, there and back, and on a line: whatever looks at them sees them.
    const std::vector<Polygon> outlines{{{5.0, 1.0}, {5.0, 1.0}, {5.0, 1.0}},
                                        {{5.0, 1.0}},
                                        {{5.0, 1.0}, {6.0, 1.5}},
                                        {{5.0, 1.0}, {6.0, 1.5}, {5.0, 1.0}},
                                        {{5.0, 1.0}, {5.5, 1.0}, {6.0, 1.0}}};
    const Vehicle vehicle;
    for (const Polygon &outline : outlines)
    {
        const FootprintChecker checker(box({outline}), vehicle, 0.0, fclContactTest());
        const PolygonOracle oracle({outline}, BOX);
        Random random(7);
        int hits = 0;
        for (int i = 0; i < 5000; ++i)
        {
            const Pose from{random.between(-5.0, 12.0), random.between(-6.0, 8.0), random.between(-PI, PI)};
            const double curvature = random.between(-0.3, 0.3), length = random.between(-5.0, 5.0);
            const double clearance = checker.clearance(from);
            EXPECT_TRUE(clearance > 0.0 || !oracle.isFree(from, vehicle, 1e-4));
            EXPECT_TRUE(!checker.isFree(from) || oracle.isFree(from, vehicle, -1e-4));
            if (!checker.isFree(from) || checker.freeLength(from, curvature, length) < std::abs(length))
            {
                ++hits;
                continue;
            }
            EXPECT_TRUE(oracle.isArcFree(from, curvature, length, vehicle, 0.005, -1e-4))
                << from.x << " " << from.y << " " << from.yaw;
        }
        EXPECT_GT(hits, 300);
    }
}

TEST(FootprintChecker, KnowsTheInsideOfLargeObstacles)
{
    // No outline is anywhere near a car in the middle of a block of 30 m.
    const FootprintChecker checker(box({rectangle(30.0, 30.0, {0.0, 0.0, 0.3})}), {});
    EXPECT_FALSE(checker.isFree({0.0, 0.0, 1.0}));
    EXPECT_EQ(checker.clearance({0.0, 0.0, 1.0}), 0.0);
    EXPECT_EQ(checker.freeLength({0.0, 0.0, 1.0}, 0.0, 1.0), 0.0);
    EXPECT_FALSE(checker.isFree({100.0, 0.0, 1.0})) << "outside of the world";
    EXPECT_EQ(checker.clearance({100.0, 0.0, 1.0}), 0.0);
    EXPECT_EQ(checker.freeLength({100.0, 0.0, 1.0}, 0.0, 1.0), 0.0);
}

TEST(FootprintChecker, AsksTheContactTestOnlyWithinTheBand)
{
    // A wall whose side lies as far from the front bumper as said.
    const Vehicle vehicle;
    const double front = vehicle.wheelbase + vehicle.frontOverhang;
    for (const bool answer : {false, true})
        for (const double gap : {-1e-7, -1e-10, 0.0, 1e-12, 4e-10, 6e-10, 9e-10, 1e-7})
        {
            int made = 0, asked = 0;
            const ContactTestMaker maker = [&](const ObstacleSet &, const Body &body)
            {
                ++made;
                EXPECT_DOUBLE_EQ(body.halfLength, 0.5 * vehicle.length());
                EXPECT_DOUBLE_EQ(body.halfWidth, 0.5 * vehicle.width);
                return [&](const OrientedBox &box)
                {
                    ++asked;
                    EXPECT_DOUBLE_EQ(box.halfLength, 0.5 * vehicle.length());
                    return answer;
                };
            };
            const ObstacleSet obstacles = box({rectangle(0.2, 6.0, {front + 0.1 + gap, 0.0, 0.0})});
            const FootprintChecker checker(obstacles, vehicle, 0.0, maker), careful(obstacles, vehicle);
            EXPECT_EQ(made, 0) << "made before a pose needed it";
            const bool near = std::abs(gap) < FootprintChecker::CONTACT_BAND;
            const bool apart = gap > 0.5 * FootprintChecker::CONTACT_BAND, undecided = near && apart;
            const bool expected = apart && !(undecided && answer);
            CheckCounts counts;
            for (int i = 0; i < 3; ++i)
                EXPECT_EQ(checker.isFree({}, counts), expected) << gap;
            EXPECT_EQ(made, undecided ? 1 : 0) << gap;
            EXPECT_EQ(asked, undecided ? 3 : 0) << gap;
            EXPECT_EQ(counts.byContactTest, near ? 3u : 0u) << gap;
            EXPECT_EQ(careful.isFree({}), apart) << gap;
            // A car can leave a pose if and only if the pose is free.
            EXPECT_EQ(checker.freeLength({}, 0.0, -1.0), expected ? 1.0 : 0.0) << gap;
            EXPECT_EQ(careful.freeLength({}, 0.0, -1.0), apart ? 1.0 : 0.0) << gap;
        }
}

TEST(FootprintChecker, PosesThatAreNotFiniteAreNotFree)
{
    const FootprintChecker checker(box(), {});
    const PlainFclChecker fcl(box(), {});
    for (const double bad : {NOT_A_NUMBER, HUGE_VAL, -HUGE_VAL})
        for (const Pose &pose : {Pose{bad, 0.0, 0.0}, Pose{0.0, bad, 0.0}, Pose{0.0, 0.0, bad}})
        {
            EXPECT_FALSE(checker.isFree(pose));
            EXPECT_FALSE(fcl.isFree(pose));
            EXPECT_EQ(checker.clearance(pose), 0.0);
            EXPECT_EQ(checker.exactClearance(pose), 0.0);
            EXPECT_EQ(checker.freeLength(pose, 0.1, 1.0), 0.0);
        }
    for (const double bad : {NOT_A_NUMBER, HUGE_VAL})
    {
        EXPECT_EQ(checker.freeLength({}, bad, 1.0), 0.0);
        EXPECT_EQ(checker.freeLength({}, 0.1, bad), 0.0);
    }
}

TEST(FootprintChecker, RefusesBadInput)
{
    const auto message = [](auto &&build) -> std::string
    {
        try
        {
            build();
        }
        catch (const Error &error)
        {
            return error.what();
        }
        return "no error";
    };
    const auto expect = [&message](auto &&build, const std::string &part)
    {
        EXPECT_NE(message(build).find(part), std::string::npos) << message(build);
    };
    expect([] { FootprintChecker(box(), {}, -0.1); }, "-0.1");
    expect([] { FootprintChecker(box(), {}, NOT_A_NUMBER); }, "margin");
    expect([] { FootprintChecker(box(), {}, HUGE_VAL); }, "margin");
    expect([] { FootprintChecker(box(), {}, 0.0, {}, -1.0); }, "resolution");
    Vehicle vehicle;
    vehicle.width = 0.0;
    expect([&vehicle] { FootprintChecker(box(), vehicle); }, "width");
    // A body or margin that fits nowhere, upright or lying.
    expect([] { FootprintChecker(box(), {}, 19.1); }, "does not fit");
    EXPECT_EQ(message([] { FootprintChecker(box(), {}, 17.0); }), "no error");
    expect([] { FootprintChecker(ObstacleSet::fromPolygons({}, {{0.0, 0.0}, {1.9, 100.0}}), {}); }, "does not fit");
    EXPECT_EQ(message(
                  [] {
                      FootprintChecker(ObstacleSet::fromPolygons({}, {{0.0, 0.0}, {2.0, 100.0}}), {});
                  }),
              "no error");
}

TEST(FootprintChecker, MovesWithTheMargin)
{
    // A wall 0.5 m ahead of the front bumper.
    const Vehicle vehicle;
    const double front = vehicle.wheelbase + vehicle.frontOverhang;
    const ObstacleSet obstacles = box({rectangle(0.2, 6.0, {front + 0.6, 0.0, 0.0})});
    EXPECT_NEAR(FootprintChecker(obstacles, vehicle).clearance({}), 0.5, 1e-9);
    EXPECT_NEAR(FootprintChecker(obstacles, vehicle, 0.2).clearance({}), 0.3, 1e-9);
    EXPECT_TRUE(FootprintChecker(obstacles, vehicle, 0.4999).isFree({}));
    EXPECT_FALSE(FootprintChecker(obstacles, vehicle, 0.5001).isFree({}));
    EXPECT_NEAR(FootprintChecker(obstacles, vehicle, 0.2).freeLength({}, 0.0, 2.0), 0.3, 2.1e-3);
}

// The referee: where shapes may stand against an exact polygon test and at hand-made touches, and paths that are right
// but for one thing.

#include "parking_geometry/referee/Referee.h"

#include "benchmarks/worlds/PolygonOracle.h"
#include "benchmarks/worlds/Random.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "tests/parking_geometry/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace
{
    using namespace parking;

    Scenario scenarioOf(const std::string &polygons)
    {
        const parking_test::TemporaryFolder folder;
        return readScenario(
            folder.write("world.yaml", "start: [0, 0, 0]\ngoal: [20, 0, 0]\npolygons: " + polygons + "\n"));
    }

    TEST(FreeSpace, TouchesAreFreeAndOverlapsAreNot)
    {
        const Scenario scenario = scenarioOf("[[[10, -1], [11, -1], [11, 1], [10, 1]]]");
        const FreeSpace check(scenario);
        const double front = scenario.vehicle.wheelbase + scenario.vehicle.frontOverhang;
        EXPECT_TRUE(check.isFree({10.0 - front, 0.0, 0.0}));
        EXPECT_FALSE(check.isFree({10.0 - front + 1e-4, 0.0, 0.0}));
        EXPECT_TRUE(check.isFree({11.0 + scenario.vehicle.rearOverhang, 0.0, 0.0}));
        EXPECT_FALSE(check.isFree({10.5, 0.0, 0.0}));  // round the whole obstacle
        EXPECT_FALSE(check.isFree({10.0, 1e6, 0.0}));  // outside of the world
    }

    TEST(FreeSpace, ADiscReachesAsFarAsItsRadius)
    {
        Scenario scenario = scenarioOf("[[[10, -1], [11, -1], [11, 1], [10, 1]]]");
        OccupancyGrid grid(40, 40, 1.0, {-10.0, -21.0, 0.0});
        for (const std::size_t row : {20u, 21u})
            grid.set(20, row, Cell::Occupied);  // the same square
        for (const bool isGrid : {false, true})
        {
            if (isGrid)
                scenario.grid = grid;
            const FreeSpace check(scenario, 1.1);
            for (const auto &[pose, towards] : {std::pair{Pose{8.9, 0.0, 2.0}, Pose{1.0, 0.0, 0.0}},
                                                {Pose{10.4, 2.1, 0.0}, Pose{0.0, -1.0, 0.0}},
                                                {Pose{11.66, 1.88, 0.0}, Pose{-1.0, 0.0, 0.0}}})
            {
                EXPECT_TRUE(check.isFree(pose)) << pose.x;
                EXPECT_FALSE(check.isFree({pose.x + 0.02 * towards.x, pose.y + 0.02 * towards.y, 0.0})) << pose.x;
            }
            EXPECT_FALSE(check.isFree({10.5, 0.0, 0.0}));
        }
    }

    TEST(FreeSpace, WhatLiesInSeveralObstaclesIsNotFree)
    {
        const FreeSpace check(
            scenarioOf("[[[-15, -9], [15, -9], [15, 9], [-15, 9]], [[-14, -8], [14, -8], [14, 8], [-14, 8]]]"));
        EXPECT_FALSE(check.isFree({0.0, 0.0, 0.3}));
    }

    TEST(FreeSpace, AgreesWithTheOracle)
    {
        // Long slanting outlines among them.
        const Scenario worlds[] = {
            scenarioOf("[[[-30, -20], [40, 25], [39, 26], [-31, -19]], [[0, 14], [-2, 27], [-9, 30]],"
                       " [[-30, 9], [25, -20], [-29, 9]]]"),
            readScenario(PARKING_SOURCE_DIR "/benchmarks/scenarios/perpendicular.yaml"),
            readScenario(PARKING_SOURCE_DIR "/benchmarks/scenarios/underground_garage.yaml")};
        parking_test::Random random(5);
        for (const Scenario &scenario : worlds)
        {
            SCOPED_TRACE(scenario.name);
            const FreeSpace check(scenario);
            const parking_test::PolygonOracle oracle(scenario);
            const Box &bounds = scenario.bounds;
            int free = 0;
            for (int i = 0; i < 20000; ++i)
            {
                const Pose pose{random.between(bounds.min.x(), bounds.max.x()),
                                random.between(bounds.min.y(), bounds.max.y()), random.between(-PI, PI)};
                const bool found = check.isFree(pose);
                free += found ? 1 : 0;
                // Up to a hundredth of a millimetre both answers are right.
                const bool surelyFree = oracle.isFree(pose, scenario.vehicle, 1e-5);
                if (surelyFree || !oracle.isFree(pose, scenario.vehicle, -1e-5))
                {
                    EXPECT_EQ(found, surelyFree) << pose.x << " " << pose.y << " " << pose.yaw;
                }
            }
            EXPECT_GT(free, 1000);
            EXPECT_LT(free, 19000);
        }
    }

    constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();

    /** Forwards round a bend, back on a clothoid, and forwards again; with the goal where that ends. */
    Path parkingPath()
    {
        return {{0.0, 0.0, 0.0}, {{0.2, 4.0}, {0.1, -3.0, 0.02}, {-0.15, 5.0, 0.03}, {0.0, 2.0}}};
    }

    Scenario parkingScenario()
    {
        Scenario scenario = scenarioOf("[[[30, -1], [31, -1], [31, 1], [30, 1]]]");
        scenario.goals = {{-3.0, 2.0, 1.0}, parkingPath().end()};
        scenario.bounds = {{-30.0, -30.0}, {45.0, 30.0}};
        return scenario;
    }

    TEST(Referee, FindsWhatLiesBetweenTheStatesOfAPath)
    {
        // A thin post beside the middle of a straight drive of 20 m.
        const Scenario scenario = scenarioOf("[[[7, 0.9], [7.02, 0.9], [7.02, 1.5], [7, 1.5]]]");
        const Referee referee(scenario);
        const Path straight{{0.0, 0.0, 0.0}, {{0.0, 20.0}}};
        const Verdict hit = referee.check(straight);
        EXPECT_FALSE(hit.valid);
        EXPECT_EQ(hit.fault, Fault::Collision);
        EXPECT_GT(hit.collisions, 900U);  // 4.69 m of car pass the post, tested every 5 mm
        EXPECT_NE(hit.reason.find("collision"), std::string::npos);
        EXPECT_EQ(referee.checkLines({straight.start, straight.end()}).collisions, hit.collisions);
        Scenario aside = scenario;
        aside.start.y = aside.goals.front().y = -0.2;
        const Verdict free = check(aside, {{0.0, -0.2, 0.0}, {{0.0, 20.0}}});
        EXPECT_TRUE(free.valid) << free.reason;
        EXPECT_EQ(free.fault, Fault::None);
        EXPECT_GE(free.states, 4000U);
    }

    TEST(Referee, AcceptsWhatIsRight)
    {
        const Scenario scenario = parkingScenario();
        const Verdict verdict = check(scenario, parkingPath());
        EXPECT_TRUE(verdict.valid) << verdict.reason;
        EXPECT_NEAR(verdict.maxCurvature, 0.2, 1e-12);
        // Full turns of the heading are nothing, nor is rounding.
        Path turned = parkingPath();
        turned.start.yaw += 4.0 * PI;
        turned.start.x += 0.5 * Referee::TOLERANCE;
        EXPECT_TRUE(check(scenario, turned).valid);
    }

    TEST(Referee, SaysWhatIsWrong)
    {
        const double nan = NOT_A_NUMBER, infinite = std::numeric_limits<double>::infinity();
        const Referee referee(parkingScenario());
        const auto expect = [&](Fault fault, const std::function<void(Path &)> &change)
        {
            Path path = parkingPath();
            change(path);
            const Verdict verdict = referee.check(path);
            EXPECT_FALSE(verdict.valid);
            EXPECT_EQ(toString(verdict.fault), toString(fault)) << verdict.reason;
            EXPECT_FALSE(verdict.reason.empty());
            // Where a path ends does not matter when it is only to come near.
            EXPECT_EQ(referee.check(path, false).valid, fault == Fault::MissesGoal);
        };
        const auto insert = [](Path &path, std::vector<PathPiece> pieces)
        {
            path.pieces.insert(path.pieces.begin(), pieces.begin(), pieces.end());
        };
        expect(Fault::NotFinite, [=](Path &path) { path.start.yaw = nan; });
        expect(Fault::NotFinite, [=](Path &path) { path.start.x = infinite; });
        expect(Fault::NotFinite, [=](Path &path) { path.start.y = 1e300; });
        expect(Fault::NotFinite, [=](Path &path) { path.pieces[1].length = nan; });
        expect(Fault::NotFinite, [=](Path &path) { path.pieces[1].curvature = nan; });
        expect(Fault::NotFinite, [=](Path &path) { path.pieces[2].sharpness = nan; });
        expect(Fault::NotFinite, [=](Path &path) { path.pieces[3].turn = -infinite; });
        expect(Fault::NotFinite, [=](Path &path) { path.pieces[3].length = 1e300; });
        // Told whatever came before it: nothing was looked at from there on.
        expect(Fault::NotFinite, [=](Path &path) { path.pieces = {{0.0, 50.0}, {nan, 1.0}}; });
        expect(Fault::WrongStart, [=](Path &path) { path.start.x += 2e-4; });
        expect(Fault::WrongStart, [=](Path &path) { path.start.yaw -= 2e-4; });
        expect(Fault::WrongStart, [=](Path &path) { path = path.reversed(); });
        expect(Fault::MissesGoal, [=](Path &path) { path.pieces.clear(); });
        expect(Fault::MissesGoal, [=](Path &path) { path.pieces.pop_back(); });
        expect(Fault::MissesGoal, [=](Path &path) { path.pieces.back().length += 2e-4; });
        expect(Fault::MissesGoal, [=](Path &path) { path.pieces[1].sharpness = 0.0; });
        expect(Fault::MissesGoal, [=](Path &path) { path.pieces[1].length *= -1.0; });
        expect(Fault::NotDrivable, [=](Path &path) { insert(path, {{0.4, 1.0}, {0.4, -1.0}}); });
        expect(Fault::NotDrivable, [=](Path &path) { insert(path, {{0.0, 1.0, 0.4}}); });
        expect(Fault::NotDrivable,
               [=](Path &path) {
                   insert(path, {PathPiece::turnOnTheSpot(0.1), PathPiece::turnOnTheSpot(-0.1)});
               });
        expect(Fault::Collision, [=](Path &path) { insert(path, {{0.0, 28.0}, {0.0, -28.0}}); });
        expect(Fault::Collision, [=](Path &path) { insert(path, {{0.0, -40.0}, {0.0, 40.0}}); });
        EXPECT_FALSE(Verdict().valid);
    }

    TEST(Referee, LinesAreHeldToStartAndGoalToo)
    {
        const Referee referee(scenarioOf("[]"), 0.9);
        const std::vector<Pose> right{{0.0, 0.0, 0.0}, {3.0, 3.0, 0.5}, {20.0, 0.0, 0.0}};
        EXPECT_TRUE(referee.checkLines(right).valid);
        // A disc may turn on the spot.
        EXPECT_TRUE(
            referee.check({{}, {PathPiece::turnOnTheSpot(PI), {0.0, -20.0}, PathPiece::turnOnTheSpot(-PI)}}).valid);
        EXPECT_EQ(referee.checkLines({}).fault, Fault::NoPath);
        EXPECT_EQ(referee.checkLines({right.front()}).fault, Fault::MissesGoal);
        EXPECT_EQ(referee.checkLines({right.back()}).fault, Fault::WrongStart);
        for (const double wrong : {NOT_A_NUMBER, 1e300})
        {
            std::vector<Pose> poses = right;
            poses[1].x = wrong;
            EXPECT_EQ(referee.checkLines(poses).fault, Fault::NotFinite);
            poses[1] = {3.0, 3.0, wrong};
            EXPECT_EQ(referee.checkLines(poses, false).fault, Fault::NotFinite);
        }
    }

    TEST(Referee, DoesNotLookAtALongWayToNowhereForEver)
    {
        Scenario scenario;
        scenario.goals = {{10.0, 0.0, 0.0}};
        scenario.bounds = {{-10.0, -10.0}, {20.0, 10.0}};
        const Referee referee(scenario);
        const Verdict curve = referee.check({scenario.start, {{0.0, 9e5}}});
        const Verdict line = referee.checkLines({scenario.start, {9e5, 0.0, 0.0}});
        for (const Verdict &verdict : {curve, line})
        {
            EXPECT_EQ(verdict.fault, Fault::Collision);
            EXPECT_EQ(verdict.collisions, Referee::MAX_COLLISIONS);
            EXPECT_LT(verdict.states, Referee::MAX_COLLISIONS + 100000);
        }
    }

    TEST(Referee, IntegratesLikeTheGeometry)
    {
        // By code of its own: a thousand random paths end where Path says.
        parking_test::Random random(11);
        Scenario scenario = scenarioOf("[]");
        scenario.bounds = {{-1000.0, -1000.0}, {1000.0, 1000.0}};
        for (int i = 0; i < 1000; ++i)
        {
            Path path{scenario.start, {}};
            for (int k = 0; k < 6; ++k)
            {
                const double begin = random.between(-0.3, 0.3), end = random.between(-0.3, 0.3);
                const double length = random.between(-8.0, 8.0);
                path.pieces.push_back({begin, length, (end - begin) / std::abs(length)});
            }
            scenario.goals = {path.end()};
            const Verdict verdict = check(scenario, path);
            EXPECT_TRUE(verdict.valid) << verdict.reason;
        }
    }
}  // namespace

// The paper's run: its disc, its splines, its controller, and all of them together.

#include "benchmarks/paper/PaperTask.h"

#include "benchmarks/worlds/Random.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/io/ScenarioReader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

using namespace parking;
using parking_test::Random;

namespace
{
    constexpr double CELL = 0.5;  // metres
    constexpr int SIDE = 40;

    ObstacleSet randomCells(Random &random)
    {
        OccupancyGrid grid(SIDE, SIDE, CELL, {-3.0, 2.0, 0.0});
        for (std::size_t row = 0; row < SIDE; ++row)
            for (std::size_t column = 0; column < SIDE; ++column)
                grid.set(column, row, random.chance(0.02) ? Cell::Occupied : Cell::Free);
        return ObstacleSet::fromGrid(grid);
    }

    const Box WORLD{{-3.0, 2.0}, {-3.0 + SIDE * CELL, 2.0 + SIDE *CELL}};

    Pose randomPose(Random &random)
    {
        return {random.between(-4.0, 18.0), random.between(1.0, 23.0), random.between(-PI, PI)};
    }

    Scenario paperMap(const std::string &name)
    {
        return readScenario(std::string(PARKING_SOURCE_DIR) + "/benchmarks/paper/maps/" + name + ".yaml");
    }
}  // namespace

TEST(DiscWorld, scansAndMeasuresToTheSameAnswers)
{
    Random random(3);
    int free = 0, blocked = 0;
    for (int world = 0; world < 4; ++world)
    {
        const ObstacleSet cells = randomCells(random);
        const double radius = random.between(0.4, 1.6), ahead = world % 2 == 0 ? 0.0 : 1.3;
        DiscWorld scan(cells, WORLD, radius, ahead, true), field(cells, WORLD, radius, ahead, false);
        EXPECT_EQ(scan.headingMatters(), ahead != 0.0);
        for (int i = 0; i < 3000; ++i)
        {
            const Pose pose = randomPose(random);
            ASSERT_EQ(scan.isFree(pose), field.isFree(pose));
            (scan.isFree(pose) ? free : blocked) += 1;
        }
    }
    EXPECT_GT(free, 1000);
    EXPECT_GT(blocked, 1000);
}

TEST(DiscWorld, looksAtEveryCellThatTheDiscTouches)
{
    const OccupancyGrid grid(SIDE, SIDE, CELL, {0.0, 0.0, 0.0}, Cell::Free);
    const ObstacleSet cells = ObstacleSet::fromGrid(grid);
    const Box bounds{{0.0, 0.0}, {SIDE * CELL, SIDE * CELL}};
    DiscWorld scan(cells, bounds, 1.25, 0.0, true);
    const Pose at{10.25, 10.25, 0.0};
    EXPECT_TRUE(scan.isFree(at));
    std::uint64_t expected = 0;
    for (int i = -5; i <= 5; ++i)
        for (int j = -5; j <= 5; ++j)
            expected += std::hypot(std::max(0.0, std::abs(i) - 0.5), std::max(0.0, std::abs(j) - 0.5)) * CELL <= 1.25;
    EXPECT_EQ(scan.counts().cells, expected);
    EXPECT_EQ(scan.counts().positions, 1u);
    EXPECT_FALSE(scan.isFree({1.0, 10.0, 0.0}));  // the map ends there
}

TEST(DiscWorld, standsAheadOfTheAxle)
{
    Random random(4);
    const ObstacleSet cells = randomCells(random);
    DiscWorld ahead(cells, WORLD, 1.0, 1.4, true), centred(cells, WORLD, 1.0, 0.0, true);
    for (int i = 0; i < 1000; ++i)
    {
        const Pose pose = randomPose(random), middle = advance(pose, 0.0, 1.4);
        const bool inside = WORLD.contains(pose.x, pose.y) && WORLD.contains(middle.x, middle.y);
        ASSERT_TRUE(!inside || ahead.isFree(pose) == centred.isFree(middle));
    }
}

TEST(DiscWorld, refusesInvalidDiscs)
{
    Random random(5);
    const ObstacleSet cells = randomCells(random);
    EXPECT_THROW(DiscWorld(cells, WORLD, 0.0, 0.0, true), Error);
    EXPECT_THROW(DiscWorld(cells, WORLD, std::nan(""), 0.0, false), Error);
    const ObstacleSet polygons = ObstacleSet::fromPolygons({{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}}, {{-9, -9}, {9, 9}});
    EXPECT_THROW(DiscWorld(polygons, WORLD, 1.0, 0.0, true), Error);
    DiscWorld world(cells, WORLD, 1.0, 0.0, true);
    EXPECT_FALSE(world.isFree({std::nan(""), 5.0, 0.0}));
}

TEST(JointSpline, ofFourControlPointsIsTheCubicBezierCurve)
{
    const std::vector<Eigen::Vector2d> points{{0, 0}, {1, 2}, {3, 2}, {4, -1}};
    for (const std::size_t degree : {BSPLINE, BEZIER})
    {
        const auto curve = splineThrough(points, degree, 1, 0.05);
        for (std::size_t i = 0; i < curve.size(); ++i)
        {
            const double t = static_cast<double>(i) / static_cast<double>(curve.size() - 1), s = 1.0 - t;
            const Eigen::Vector2d wanted =
                s * s * s * points[0] + 3 * s * s * t * points[1] + 3 * s * t * t * points[2] + t * t * t * points[3];
            ASSERT_NEAR((curve[i] - wanted).norm(), 0.0, 1e-12);
        }
    }
}

TEST(JointSpline, beginsAndEndsWithThePointsAndMovesInSteps)
{
    Random random(6);
    for (int round = 0; round < 60; ++round)
    {
        std::vector<Eigen::Vector2d> points;
        for (std::size_t count = 1 + random.index(40); points.size() < count;)
            points.emplace_back(random.between(0.0, 9.0), random.between(0.0, 9.0));
        for (const std::size_t degree : {POLYLINE, BSPLINE, BEZIER})
        {
            const auto curve = splineThrough(points, degree, 1 + random.index(4), 0.1);
            ASSERT_NEAR((curve.front() - points.front()).norm(), 0.0, 1e-9);
            ASSERT_NEAR((curve.back() - points.back()).norm(), 0.0, 1e-9);
            for (std::size_t i = 1; i < curve.size(); ++i)
                ASSERT_LE((curve[i] - curve[i - 1]).norm(), 0.1 + 1e-9);
            ASSERT_LE(lengthOf(curve), lengthOf(points) + 1e-9);
        }
        ASSERT_NEAR(lengthOf(splineThrough(points, POLYLINE, 1, 0.1)), lengthOf(points), 1e-9);
    }
    EXPECT_THROW(splineThrough({}, BSPLINE, 1, 0.1), Error);
    EXPECT_THROW(splineThrough({{0, 0}}, BSPLINE, 0, 0.1), Error);
}

TEST(JointSpline, turnsWithoutItsCusps)
{
    EXPECT_NEAR(turningOf({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, PI), PI, 1e-12);
    EXPECT_NEAR(turningOf({{0, 0}, {2, 0}, {1, 0}, {1, 1}}, 0.75 * PI), 0.5 * PI, 1e-12);
}

TEST(PaperDrive, comesToRestWhereTheWayEndsForwardsAndInReverse)
{
    const Vehicle car = vehicleByName("vw_golf8");
    for (const double end : {12.0, -12.0})
    {
        const auto path = splineThrough({{0, 0}, {end, 0}}, POLYLINE, 1, 0.1);
        const PaperDriveResult drive = drivePaper(car, path, {0, 0, 0}, {end, 0, 0}, {}, {});
        EXPECT_TRUE(drive.stands);
        EXPECT_LT(drive.positionError, 0.1);
        EXPECT_LT(drive.headingError, 0.01);
        EXPECT_EQ(drive.failures, 0u);
        EXPECT_NEAR(drive.travelTime, 12.0, 2.0);
        EXPECT_NEAR(drive.meanSteering, 0.0, 0.01);
        for (const PaperDriveState &state : drive.states)
        {
            ASSERT_LE(std::abs(state.acceleration), car.maxAcceleration + 1e-6);
            ASSERT_LE(std::abs(state.steering), car.maxSteeringAngle + 1e-6);
        }
    }
    EXPECT_THROW(drivePaper(car, {}, {0, 0, 0}, {0, 0, 0}, {}, {}), Error);
}

TEST(PaperTask, joinsTheWayAndTheManoeuvre)
{
    for (const DiscPlace place : {DiscPlace::Middle, DiscPlace::Ahead, DiscPlace::RearAxle})
        for (const char *algorithm : {"basic_astar", "paper_improved_astar"})
        {
            SCOPED_TRACE(algorithm);
            PaperVariant variant;
            variant.place = place;
            const Scenario scenario = paperMap("perpendicular");
            const PaperTask task(scenario, variant);
            const PaperRun run = task.run(parameterSet(algorithm, {}), 5.0, false);
            ASSERT_EQ(run.status, "exact");
            EXPECT_TRUE(run.drive.states.empty());
            ASSERT_FALSE(run.curve.empty());
            EXPECT_NEAR((run.curve.back() - Eigen::Vector2d(run.goal.x, run.goal.y)).norm(), 0.0, 1e-6);
            EXPECT_EQ(run.curve.front(), run.corners.front());
            const auto body = task.vehicle().footprint(run.goal);
            // The car stands in its slot whatever its poses are of.
            Eigen::Vector2d middle(0.0, 0.0);
            for (const Eigen::Vector2d &corner : body)
                middle += 0.25 * corner;
            EXPECT_NEAR((middle - Eigen::Vector2d(scenario.slot->pose.x, scenario.slot->pose.y)).norm(), 0.0, 1e-6);
            EXPECT_NEAR(task.vehicle().minTurningRadius(), scenario.vehicle.minTurningRadius(), 1e-9);
            EXPECT_GT(run.counts.cells, 0u);
            EXPECT_GT(run.statistics.openListOperations, 0u);
        }
}

TEST(PaperTask, loadingEagerlyLooksAtManyMoreCells)
{
    const PaperTask task(paperMap("perpendicular"), {});
    const PaperRun lazy = task.run(parameterSet("paper_improved_astar", {}), 5.0, false);
    const PaperRun eager = task.run(parameterSet("experiment_2", {}), 5.0, false);
    EXPECT_EQ(lazy.statistics.expanded, eager.statistics.expanded);
    EXPECT_EQ(lazy.corners, eager.corners);
    EXPECT_GT(eager.counts.cells, 8u * lazy.counts.cells);
    EXPECT_GT(eager.counts.positions, 40000u);
}

TEST(PaperTask, looksAtEveryHeadingWhereTheDiscIsAhead)
{
    PaperVariant ahead, centred;
    ahead.place = DiscPlace::Ahead;
    centred.place = DiscPlace::RearAxle;
    const PlannerParameters eager = parameterSet("experiment_2", {});
    const PaperRun wide = PaperTask(paperMap("perpendicular"), ahead).run(eager, 5.0, false);
    const PaperRun narrow = PaperTask(paperMap("perpendicular"), centred).run(eager, 5.0, false);
    EXPECT_GT(wide.counts.positions, 8u * 40000u);  // eight neighbours, as many headings
    EXPECT_LT(narrow.counts.positions, 2u * 40000u);
}

TEST(PaperTask, comesAsNearAsTheDiscGetsWithoutASlot)
{
    for (const auto &[map, nearest] : {std::pair("unreachable", 4.1231), std::pair("walled_in", 8.0389)})
    {
        const PaperTask task(paperMap(map), {});
        EXPECT_TRUE(task.run(parameterSet("basic_astar", {}), 5.0, true).curve.empty());
        const PaperRun run = task.run(parameterSet("paper_improved_astar", {}), 5.0, true);
        EXPECT_EQ(run.status, "approximate");
        EXPECT_NEAR(run.approachError, nearest, 1e-3);
        EXPECT_NEAR((run.curve.back() - Eigen::Vector2d(run.goal.x, run.goal.y)).norm(), nearest, 1e-3);
        EXPECT_FALSE(run.drive.states.empty());
    }
    EXPECT_EQ(PaperTask(paperMap("perpendicular_approach"), {})
                  .run(parameterSet("paper_improved_astar", {}), 5.0, false)
                  .status,
              "exact");
}

TEST(PaperTask, refusesWhatIsNotThePapers)
{
    EXPECT_THROW(PaperTask(paperMap("perpendicular"), {}).run(PlannerParameters(), 1.0, false), Error);
}

TEST(PaperTask, saysWhyThereIsNoManoeuvre)
{
    const PaperTask task(paperMap("parallel"), {});
    const PaperRun run = task.run(parameterSet("paper_improved_astar", {}), 1.0, true);
    EXPECT_EQ(run.status, "no_manoeuvre");
    EXPECT_NE(run.reason.find("too short for one sweep"), std::string::npos) << run.reason;
    EXPECT_TRUE(run.curve.empty());
    EXPECT_TRUE(run.drive.states.empty());
}

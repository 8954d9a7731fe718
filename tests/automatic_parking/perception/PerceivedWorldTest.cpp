#include "automatic_parking/perception/PerceivedWorld.h"

#include "automatic_parking/ParkingWorld.h"
#include "automatic_parking/perception/RecordedFrames.h"
#include "automatic_parking/perception/SimulatedSensor.h"
#include "benchmarks/worlds/Random.h"
#include "benchmarks/worlds/RandomWorlds.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/io/ScenarioReader.h"

#include <cmath>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

using namespace parking;
using namespace parking_test;

namespace
{
    /** A sensor that returns the result of a function. */
    struct Scripted : Perception
    {
        explicit Scripted(std::function<GridUpdate()> frame) : frame(std::move(frame))
        {
        }

        GridUpdate observe(double /*time*/, const Pose & /*car*/, const OccupancyGrid & /*map*/) override
        {
            return frame();
        }

        std::function<GridUpdate()> frame;
    };

    Scenario openGround()
    {
        Scenario scenario;
        scenario.bounds = {{-10.0, -5.0}, {10.0, 5.0}};
        scenario.start = {-6.0, 0.0, 0.3};
        scenario.goals = {{5.0, 0.0, 0.0}};
        return scenario;
    }

    std::string messageOf(const std::function<void()> &call)
    {
        try
        {
            call();
        }
        catch (const Error &error)
        {
            return error.what();
        }
        return "";
    }
}  // namespace

TEST(PerceivedWorld, KnowsOnlyTheGroundOfTheCarAtFirst)
{
    const Scenario scenario = openGround();
    const PerceivedWorld closed(scenario, std::make_shared<Scripted>([] { return GridUpdate(); }), {0.1, true});
    const PerceivedWorld open(scenario, std::make_shared<Scripted>([] { return GridUpdate(); }), {0.1, false});
    EXPECT_EQ(closed.map().width(), 200u);
    EXPECT_EQ(closed.map().height(), 100u);
    EXPECT_TRUE(closed.scenario().polygons.empty());
    EXPECT_EQ(closed.scenario().goals.size(), 1u);
    EXPECT_TRUE(ParkingWorld(closed.scenario()).footprint().isFree(scenario.start));
    Pose moved = scenario.start;
    moved.x += 0.15;
    EXPECT_FALSE(ParkingWorld(closed.scenario()).footprint().isFree(moved));
    EXPECT_TRUE(ParkingWorld(open.scenario()).footprint().isFree(moved));
}

TEST(PerceivedWorld, MapHasWholeCellsWithinTheBounds)
{
    Scenario scenario = openGround();
    const auto sensor = std::make_shared<Scripted>([] { return GridUpdate(); });
    EXPECT_EQ(PerceivedWorld(scenario, sensor, {0.3, true}).map().width(), 66u);
    EXPECT_EQ(PerceivedWorld(scenario, sensor, {0.3, true}).map().height(), 33u);
    EXPECT_EQ(PerceivedWorld(scenario, sensor, {10.0, true}).map().height(), 1u);
    EXPECT_THROW(PerceivedWorld(scenario, sensor, {10.0 + 1e-6, true}), Error);
    scenario.bounds = {{-50.0, -50.0}, {50.0, 50.0}};
    const PerceivedWorld paper(scenario, sensor, {0.5, true});
    EXPECT_EQ(paper.map().width(), 200u);
    EXPECT_EQ(paper.map().height(), 200u);
    EXPECT_EQ(paper.scenario().bounds.max.x(), 50.0);
}

/** Whatever a sensor reports: the changes lead from each map to the next one, each cell once. */
TEST(PerceivedWorld, ChangesLeadFromMapToMap)
{
    Random random(1);
    const Scenario scenario = openGround();
    PerceivedWorld world(scenario,
                         std::make_shared<Scripted>(
                             [&random]
                             {
                                 GridUpdate update;
                                 for (std::size_t k = random.index(300); k > 0; --k)
                                     update.push_back({static_cast<std::uint32_t>(random.index(20)),
                                                       static_cast<std::uint32_t>(random.index(10)),
                                                       static_cast<Cell>(random.index(3))});
                                 return update;
                             }),
                         {1.0, true});
    OccupancyGrid map = world.map();
    for (int k = 0; k < 1000; ++k)
    {
        const GridUpdate &changes = world.observe(0.05 * k, scenario.start);
        for (const CellChange &each : changes)
        {
            ASSERT_NE(map.at(each.column, each.row), each.cell);
            map.set(each.column, each.row, each.cell);
        }
        ASSERT_EQ(map.cells(), world.map().cells());
    }
}

/** A drive past obstacles that come and go: the world updated in place equals one made from the perceived map. */
TEST(PerceivedWorld, UpdatedWorldEqualsOneMadeFromTheMap)
{
    for (const bool unseenIsOccupied : {true, false})
    {
        Scenario scenario = randomPolygonWorld(4).scenario;
        scenario.start = {scenario.bounds.min.x() + 3.0, scenario.bounds.min.y() + 3.0, 0.0};
        SensorParameters parameters;
        parameters.range = 8.0;
        parameters.rangeNoise = 0.05;
        const Polygon box = rectangle(2.0, 1.0, {scenario.start.x + 8.0, scenario.start.y + 2.0, 0.4});
        PerceivedWorld seen(
            scenario,
            std::make_shared<SimulatedSensor>(scenario, parameters, std::vector<TimedObstacle>{{box, 0.5, 1.5}}),
            {0.15, unseenIsOccupied});
        ParkingWorld world(seen.scenario(), {}, IndexedObstacles::LOCAL_REACH);
        Random random(7);
        for (int k = 0; k < 40; ++k)
        {
            const Pose car{scenario.start.x + 0.1 * k, scenario.start.y + 0.05 * k, 0.02 * k};
            world.update(seen.observe(0.05 * k, car));
            const ParkingWorld anew(seen.scenario(), {}, IndexedObstacles::LOCAL_REACH);
            const auto enlarged = world.enlarged(0.1), enlargedAnew = anew.enlarged(0.1);
            for (int i = 0; i < 50; ++i)
            {
                const Pose pose{random.between(scenario.bounds.min.x(), scenario.bounds.max.x()),
                                random.between(scenario.bounds.min.y(), scenario.bounds.max.y()),
                                random.between(-PI, PI)};
                ASSERT_EQ(world.footprint().isFree(pose), anew.footprint().isFree(pose));
                ASSERT_EQ(world.footprint().clearance(pose), anew.footprint().clearance(pose));
                ASSERT_EQ(enlarged->isFree(pose), enlargedAnew->isFree(pose));
            }
        }
    }
}

TEST(ParkingWorld, SnapshotStaysAsItIs)
{
    const Scenario scenario = openGround();
    PerceivedWorld seen(scenario,
                        std::make_shared<Scripted>(
                            [] {
                                return GridUpdate{{60, 50, Cell::Occupied}};
                            }),
                        {0.1, false});
    ParkingWorld world(seen.scenario(), {}, IndexedObstacles::LOCAL_REACH);
    const ParkingWorld shared = world, before = world.snapshot();
    const Pose pose{-4.5, 0.0, 0.0};
    world.update(seen.observe(0.0, scenario.start));
    EXPECT_FALSE(world.footprint().isFree(pose));
    EXPECT_FALSE(shared.footprint().isFree(pose));
    EXPECT_TRUE(before.footprint().isFree(pose));
    EXPECT_TRUE(before.enlarged(0.1)->isFree(pose));
}

TEST(PerceivedWorld, RefusesBadInputAndChangesNothing)
{
    const Scenario scenario = openGround();
    GridUpdate frame{{3, 3, Cell::Occupied}};
    std::function<void()> fail = [] {
    };
    PerceivedWorld world(scenario,
                         std::make_shared<Scripted>(
                             [&]
                             {
                                 fail();
                                 return frame;
                             }),
                         {0.1, true});
    const std::vector<Cell> before = world.map().cells();
    const auto observe = [&](double time)
    {
        return messageOf([&] { world.observe(time, scenario.start); });
    };

    frame.push_back({200, 0, Cell::Free});
    EXPECT_EQ(observe(1.0),
              "perception failed at 1 s: changed cell (200, 0) lies outside of the map of 200 x 100 cells");
    frame.back() = {0, 0, static_cast<Cell>(9)};
    EXPECT_NE(observe(1.0), "");
    frame.pop_back();
    fail = []
    {
        throw std::runtime_error("no power");
    };
    EXPECT_EQ(observe(1.0), "perception failed at 1 s: no power");
    fail = []
    {
        throw Error("no light");
    };
    EXPECT_EQ(observe(1.0), "perception failed at 1 s: no light");
    fail = []
    {
        throw 7;
    };
    EXPECT_EQ(observe(1.0), "perception failed at 1 s for an unknown reason");
    fail = [] {
    };
    EXPECT_NE(messageOf([&] { world.observe(1.0, {std::nan(""), 0.0, 0.0}); }), "");
    for (const double time : {HUGE_VAL, std::nan("")})
        EXPECT_NE(observe(time), "");
    EXPECT_EQ(world.map().cells(), before);

    EXPECT_EQ(observe(0.5), "");  // calls that failed do not count
    EXPECT_EQ(observe(0.5), "");
    EXPECT_EQ(observe(0.4), "perception: time is 0.4 s; it must be a finite number of at least 0.5 s");

    const auto sensor = std::make_shared<Scripted>([] { return GridUpdate(); });
    for (const double side : {0.0, -1.0, std::nan(""), HUGE_VAL, 1e-9})
        EXPECT_THROW(PerceivedWorld(scenario, sensor, {side, true}), Error) << side;
    EXPECT_THROW(PerceivedWorld(scenario, nullptr, {}), Error);
    Scenario bad = scenario;
    bad.start.x = std::nan("");
    EXPECT_THROW(PerceivedWorld(bad, sensor, {}), Error);
    bad = scenario;
    bad.bounds.max.x() = HUGE_VAL;
    EXPECT_THROW(PerceivedWorld(bad, sensor, {}), Error);
}

TEST(RecordedFrames, CellsCoverThoseOfEveryFrame)
{
    Random random(3);
    for (int world = 0; world < 40; ++world)
    {
        const bool isAligned = random.chance(0.3);
        OccupancyGrid map(40, 30, 0.5, random.poseIn(-5.0, 5.0), Cell::Unknown);
        const Pose origin = isAligned ? map.origin() : compose(map.origin(), random.poseIn(0.0, 10.0));
        OccupancyGrid frame(20, 20, isAligned ? 0.5 : random.between(0.2, 0.9), origin);
        for (std::size_t k = 0; k < 100; ++k)
            frame.set(random.index(20), random.index(20), random.chance(0.3) ? Cell::Occupied : Cell::Unknown);
        RecordedFrames frames({{0.5, frame}});
        EXPECT_TRUE(frames.observe(0.4, {}, map).empty());
        map.apply(frames.observe(0.5, {}, map));
        EXPECT_TRUE(frames.observe(0.6, {}, map).empty());
        if (isAligned)
            for (std::size_t row = 0; row < 20; ++row)
                for (std::size_t column = 0; column < 20; ++column)
                    ASSERT_EQ(map.at(column, row), frame.at(column, row));
        for (int i = 0; i < 3000; ++i)
        {
            // A point of the frame, and the cell of the map in which it lies.
            const double x = random.between(0.0, 20.0), y = random.between(0.0, 20.0);
            const Pose point = relativeTo(
                map.origin(), compose(frame.origin(), {x * frame.resolution(), y * frame.resolution(), 0.0}));
            if (point.x < 0.0 || point.y < 0.0 || point.x >= 20.0 || point.y >= 15.0)
                continue;
            const Cell seen = map.at(static_cast<std::size_t>(point.x / 0.5), static_cast<std::size_t>(point.y / 0.5));
            const Cell truth = frame.at(static_cast<std::size_t>(x), static_cast<std::size_t>(y));
            ASSERT_TRUE(truth != Cell::Occupied || seen == Cell::Occupied);
            ASSERT_TRUE(truth != Cell::Unknown || seen != Cell::Free);
        }
    }
}

TEST(RecordedFrames, LaterFramesReplaceEarlierOnesWhereTheySee)
{
    const Scenario scenario = openGround();
    const Pose origin{-10.0, -5.0, 0.0};
    OccupancyGrid first(20, 10, 1.0, origin, Cell::Unknown), second = first;
    first.set(1, 1, Cell::Occupied);
    first.set(2, 1, Cell::Occupied);
    second.set(1, 1, Cell::Free);
    PerceivedWorld world(scenario,
                         std::make_shared<RecordedFrames>(std::vector<RecordedFrame>{{0.0, first}, {0.1, second}}),
                         {1.0, true});
    EXPECT_EQ(world.observe(5.0, scenario.start).size(), 2u);
    EXPECT_EQ(world.map().at(1, 1), Cell::Free);
    EXPECT_EQ(world.map().at(2, 1), Cell::Occupied);
}

TEST(RecordedFrames, RefusesBadInput)
{
    const OccupancyGrid grid(2, 2, 1.0);
    EXPECT_THROW(RecordedFrames({{std::nan(""), grid}}), Error);
    EXPECT_THROW(RecordedFrames({{1.0, grid}, {1.0, grid}}), Error);
    EXPECT_THROW(RecordedFrames({{1.0, OccupancyGrid()}}), Error);
    EXPECT_NO_THROW(RecordedFrames({{1.0, grid}, {1.1, grid}}));
}

TEST(RecordedFrames, FramesOfALidarInARow)
{
    std::vector<RecordedFrame> frames;
    for (const char *name : {"00", "03", "05", "08"})
    {
        const std::string file = std::string(PARKING_SHARED_DATA) + "/surroundocc/frame" + name + "_occ_xyzl.npy";
        if (!std::filesystem::exists(file))
            GTEST_SKIP() << file << " is missing";
        frames.push_back({0.5 * static_cast<double>(frames.size()), readSurroundOcc(file)});
    }
    Scenario scenario;
    scenario.bounds = {{-50.0, -50.0}, {50.0, 50.0}};
    scenario.start = {0.0, -0.94, 0.5 * PI};
    PerceivedWorld world(scenario, std::make_shared<RecordedFrames>(frames), {0.5, true});
    ParkingWorld checks(world.scenario(), {}, IndexedObstacles::LOCAL_REACH);
    for (const RecordedFrame &frame : frames)
    {
        const GridUpdate &changes = world.observe(frame.time, scenario.start);
        EXPECT_GT(changes.size(), 100u);
        checks.update(changes);
        EXPECT_TRUE(checks.footprint().isFree(scenario.start));
        for (std::size_t i = 0; i < frame.grid.cells().size(); ++i)
            if (frame.grid.cells()[i] != Cell::Unknown)
            {
                ASSERT_EQ(world.map().cells()[i], frame.grid.cells()[i]);
            }
    }
}

#include "automatic_parking/perception/SimulatedSensor.h"

#include "automatic_parking/perception/PerceivedWorld.h"
#include "benchmarks/worlds/Random.h"
#include "benchmarks/worlds/RandomWorlds.h"
#include "parking_geometry/Error.h"

#include <cmath>
#include <memory>
#include <set>

#include <gtest/gtest.h>

using namespace parking;
using namespace parking_test;

namespace
{
    /** Whether a segment meets the square [left, left + side] x [low, low + side]. */
    bool meetsSquare(const Eigen::Vector2d &a, const Eigen::Vector2d &b, double left, double low, double side)
    {
        // The corners lie on one side of the line, or the boxes are apart.
        int sides[2] = {0, 0};
        for (const double x : {left, left + side})
            for (const double y : {low, low + side})
                ++sides[turn(a, b, {x, y}) > 0.0];
        return sides[0] > 0 && sides[1] > 0 && std::min(a.x(), b.x()) < left + side && std::max(a.x(), b.x()) > left &&
               std::min(a.y(), b.y()) < low + side && std::max(a.y(), b.y()) > low;
    }

    /** Whether an obstacle reaches into a cell that is enlarged by \e more metres on each side. */
    bool isTouched(const std::vector<Polygon> &obstacles, const OccupancyGrid &map, std::size_t column, std::size_t row,
                   double more)
    {
        const double side = map.resolution();
        const double left = map.origin().x + side * static_cast<double>(column) - more,
                     low = map.origin().y + side * static_cast<double>(row) - more;
        for (const Polygon &polygon : obstacles)
        {
            if (contains(polygon, {left + 0.5 * side + more, low + 0.5 * side + more}))
                return true;
            for (std::size_t i = 0; i < polygon.size(); ++i)
                if (meetsSquare(polygon[i], polygon[(i + 1) % polygon.size()], left, low, side + 2.0 * more))
                    return true;
        }
        return false;
    }

    /** Whether a point is in line of sight, by the signs of areas against every edge. */
    bool isVisible(const std::vector<Polygon> &obstacles, const Eigen::Vector2d &eye, const Eigen::Vector2d &point)
    {
        for (const Polygon &polygon : obstacles)
            for (std::size_t i = 0; i < polygon.size(); ++i)
            {
                const Eigen::Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
                if ((turn(eye, point, a) > 0.0) != (turn(eye, point, b) > 0.0) &&
                    (turn(a, b, eye) > 0.0) != (turn(a, b, point) > 0.0))
                    return false;
            }
        return true;
    }

    struct Place
    {
        Scenario scenario;
        SensorParameters sensor;
        double cellSize;
    };

    /** Boxes and stars on 16 m by 12 m, and a car between them. */
    Place randomPlace(std::uint64_t seed)
    {
        Random random(seed);
        Place place;
        const Eigen::Vector2d corner(random.between(-20.0, 20.0), random.between(-20.0, 20.0));
        place.scenario.bounds = {corner, corner + Eigen::Vector2d(16.0, 12.0)};
        place.scenario.start = {corner.x() + random.between(6.0, 10.0), corner.y() + random.between(4.0, 8.0),
                                random.between(-PI, PI)};
        const Pose start = place.scenario.start;
        for (std::size_t k = 0; k < 2 + random.index(6); ++k)
        {
            const double x = corner.x() + random.between(0.0, 16.0), y = corner.y() + random.between(0.0, 12.0);
            if (std::hypot(x - start.x, y - start.y) < 3.0)
                continue;
            place.scenario.polygons.push_back(
                random.chance(0.5) ? star(random, x, y, 1.5)
                                   : rectangle(random.between(0.5, 3.0), random.between(0.5, 2.0),
                                               {x, y, random.chance(0.3) ? 0.0 : random.between(-PI, PI)}));
        }
        place.sensor.mount = {random.between(-0.5, 0.5), 0.0, random.between(-PI, PI)};
        place.sensor.range = random.between(2.0, 25.0);
        place.sensor.fieldOfView = random.chance(0.5) ? 2.0 * PI : random.between(0.2, 6.0);
        place.cellSize = random.between(0.15, 0.4);
        return place;
    }

    /** The map without the ground of the car, which is known without being seen. */
    PerceivedWorld perceivedBy(const Place &place)
    {
        Scenario scenario = place.scenario;
        scenario.start.x += 1e4;
        return PerceivedWorld(scenario, std::make_shared<SimulatedSensor>(place.scenario, place.sensor),
                              {place.cellSize, true});
    }
}  // namespace

/** Occupied cells cover all that is seen, free ones contain nothing, with and without noise. */
TEST(SimulatedSensor, SeenCellsAreOccupiedWhereAnObstacleTouchesThem)
{
    int occupied = 0, phantoms = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed)
    {
        Place place = randomPlace(seed);
        place.sensor.rangeNoise = seed % 2 == 0 ? 0.0 : 0.1;
        PerceivedWorld world = perceivedBy(place);
        world.observe(0.0, place.scenario.start);
        const OccupancyGrid &map = world.map();
        for (std::size_t row = 0; row < map.height(); ++row)
            for (std::size_t column = 0; column < map.width(); ++column)
            {
                if (map.at(column, row) == Cell::Free)
                {
                    ASSERT_FALSE(isTouched(place.scenario.polygons, map, column, row, -1e-8)) << seed;
                }
                if (map.at(column, row) != Cell::Occupied)
                    continue;
                ++occupied;
                if (place.sensor.rangeNoise == 0.0)
                {
                    ASSERT_TRUE(isTouched(place.scenario.polygons, map, column, row, 1e-8)) << seed;
                }
                else
                    phantoms += !isTouched(place.scenario.polygons, map, column, row, 1e-8);
            }
    }
    EXPECT_GT(occupied, 1000);
    EXPECT_GT(phantoms, 100);
}

/** An independent ray caster with more rays: what it cannot see must be unknown, what it sees as a whole known. */
TEST(SimulatedSensor, SeesWhatIsInLineOfSight)
{
    int known = 0, whole = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed)
    {
        const Place place = randomPlace(seed);
        PerceivedWorld world = perceivedBy(place);
        world.observe(3.0, place.scenario.start);
        const OccupancyGrid &map = world.map();
        const double side = map.resolution();
        const Pose sensor = compose(place.scenario.start, place.sensor.mount);
        const Eigen::Vector2d eye(sensor.x, sensor.y);
        const auto isSeen = [&](const Eigen::Vector2d &point, double more)
        {
            const Eigen::Vector2d along = point - eye;
            const double angle = std::abs(wrapAngle(std::atan2(along.y(), along.x()) - sensor.yaw));
            return along.norm() <= place.sensor.range + more &&
                   angle <= 0.5 * place.sensor.fieldOfView + more / std::max(along.norm(), more) &&
                   isVisible(place.scenario.polygons, eye, point);
        };
        for (std::size_t row = 0; row < map.height(); ++row)
            for (std::size_t column = 0; column < map.width(); ++column)
            {
                const Eigen::Vector2d corner(map.origin().x + side * static_cast<double>(column),
                                             map.origin().y + side * static_cast<double>(row));
                bool any = false, all = true;
                for (int i = -1; i <= 9; ++i)
                    for (int k = -1; k <= 9; ++k)
                    {
                        const Eigen::Vector2d point = corner + side / 8.0 * Eigen::Vector2d(i, k);
                        any = any || isSeen(point, 0.15 * side);
                        all = all && isSeen(point, 0.0);
                    }
                const bool isKnown = map.at(column, row) != Cell::Unknown;
                ASSERT_TRUE(any || !isKnown) << seed << ": " << corner.transpose();
                ASSERT_TRUE(isKnown || !all) << seed << ": " << corner.transpose();
                known += isKnown;
                whole += all;
            }
    }
    EXPECT_GT(known, 20000);
    EXPECT_GT(whole, 10000);
}

/** Walls along the borders of cells do not fill the cells beside them, thin ones do not vanish. */
TEST(SimulatedSensor, CellsFitObstaclesAlongTheirBorders)
{
    Scenario scenario;
    scenario.bounds = {{0.0, 0.0}, {10.0, 10.0}};
    scenario.start = {2.0, 5.0, 0.0};
    scenario.polygons = {{{5.0, 4.0}, {6.0, 4.0}, {6.0, 6.0}, {5.0, 6.0}},  // counter-clockwise
                         {{2.0, 8.0}, {2.0, 9.0}, {3.0, 9.0}, {3.0, 8.0}},  // clockwise
                         {{1.0, 2.0}, {3.0, 2.0}}};                         // a segment
    for (const double side : {0.1, 0.25, 0.5, 1.0})
    {
        PerceivedWorld world(scenario, std::make_shared<SimulatedSensor>(scenario), {side, true});
        world.observe(0.0, scenario.start);
        const auto at = [&](double x, double y)
        {
            return world.map().at(static_cast<std::size_t>(x / side), static_cast<std::size_t>(y / side));
        };
        EXPECT_EQ(at(5.0 - 0.5 * side, 5.05), Cell::Free);
        EXPECT_EQ(at(5.0 + 0.5 * side, 5.05), Cell::Occupied);
        EXPECT_EQ(at(2.5, 8.0 - 0.5 * side), Cell::Free);
        EXPECT_EQ(at(2.5, 8.0 + 0.5 * side), Cell::Occupied);
        EXPECT_EQ(at(2.05, 2.0 + 0.5 * side), Cell::Occupied);
    }
}

TEST(SimulatedSensor, SeesTheCellsOfAMapAsTheyAre)
{
    for (std::uint64_t seed = 0; seed < 20; ++seed)
    {
        Random random(seed);
        Scenario scenario;
        scenario.grid = OccupancyGrid(40, 30, 0.3, {random.between(-9.0, 9.0), 2.0, random.between(-PI, PI)});
        for (std::size_t k = 0; k < 60; ++k)
            scenario.grid->set(random.index(40), random.index(30), random.chance(0.5) ? Cell::Occupied : Cell::Unknown);
        scenario.unknownIsOccupied = random.chance(0.5);
        scenario.start = compose(scenario.grid->origin(), {6.0, 4.5, 0.4});
        PerceivedWorld world = perceivedBy({scenario, SensorParameters{}, 0.3});
        world.observe(0.0, scenario.start);
        ASSERT_EQ(world.map().width(), 40u);
        ASSERT_EQ(world.map().height(), 30u);
        const ObstacleSet truth = ObstacleSet::fromScenario(scenario);
        std::size_t known = 0;
        for (std::size_t i = 0; i < truth.cells().size(); ++i)
            if (const Cell cell = world.map().cells()[i]; cell != Cell::Unknown)
            {
                ++known;
                ASSERT_EQ(cell, truth.cells()[i] ? Cell::Occupied : Cell::Free);
            }
        ASSERT_GT(known, 100u);
    }
}

TEST(SimulatedSensor, ObstaclesAppearAndDisappear)
{
    Scenario scenario;
    scenario.bounds = {{0.0, 0.0}, {20.0, 10.0}};
    scenario.start = {3.0, 5.0, 0.0};
    const std::vector<TimedObstacle> timed{{{{10.0, 4.0}, {11.0, 4.0}, {11.0, 6.0}, {10.0, 6.0}}, 1.0, 2.0}};
    PerceivedWorld world(scenario, std::make_shared<SimulatedSensor>(scenario, SensorParameters{}, timed), {});
    const auto at = [&world](std::size_t column)
    {
        return world.map().at(column, 50);
    };
    world.observe(0.95, scenario.start);
    EXPECT_EQ(at(102), Cell::Free);
    EXPECT_EQ(world.observe(0.95, scenario.start).size(), 0u);
    EXPECT_GT(world.observe(1.0, scenario.start).size(), 10u);
    EXPECT_EQ(at(100), Cell::Occupied);
    EXPECT_EQ(at(115), Cell::Free);  // seen earlier, hidden by the obstacle
    world.observe(1.95, scenario.start);
    EXPECT_EQ(at(100), Cell::Occupied);
    world.observe(2.0, scenario.start);
    EXPECT_EQ(at(100), Cell::Free);
}

TEST(SimulatedSensor, SeesAtItsRate)
{
    for (const double rate : {10.0, 20.0, 33.0})
    {
        Scenario scenario;
        scenario.bounds = {{0.0, 0.0}, {50.0, 10.0}};
        SensorParameters parameters;
        parameters.rate = rate;
        parameters.range = 3.0;
        SimulatedSensor sensor(scenario, parameters);
        const OccupancyGrid map(500, 100, 0.1, {}, Cell::Unknown);
        int frames = 0;
        for (int k = 0; k < 300; ++k)
            frames += sensor.observe(7.0 + 0.01 * k, {10.0, 5.0, 0.0}, map).empty() ? 0 : 1;
        EXPECT_EQ(frames, static_cast<int>(3.0 * rate)) << rate;
    }
}

TEST(SimulatedSensor, EqualSeedsGiveEqualFrames)
{
    Place place = randomPlace(5);
    place.sensor.rangeNoise = 0.05;
    const auto cells = [&place](std::uint64_t seed)
    {
        place.sensor.seed = seed;
        PerceivedWorld world = perceivedBy(place);
        for (int k = 0; k < 5; ++k)
            world.observe(0.05 * k, place.scenario.start);
        return world.map().cells();
    };
    EXPECT_EQ(cells(3), cells(3));
    EXPECT_NE(cells(3), cells(4));
}

TEST(SimulatedSensor, SeesNothingFromOutsideOfTheMap)
{
    Scenario scenario;
    scenario.bounds = {{0.0, 0.0}, {10.0, 10.0}};
    scenario.start = {5.0, 5.0, 0.0};
    PerceivedWorld world(scenario, std::make_shared<SimulatedSensor>(scenario), {});
    for (const Pose &pose : {Pose{-9.0, 5.0, 0.0}, Pose{5.0, 1e9, 0.0}, Pose{-1e300, 5.0, 0.0}})
        EXPECT_TRUE(world.observe(0.0, pose).empty());
    EXPECT_FALSE(world.observe(0.1, scenario.start).empty());
}

TEST(SimulatedSensor, RefusesBadInput)
{
    Scenario scenario;
    scenario.bounds = {{0.0, 0.0}, {10.0, 10.0}};
    for (double SensorParameters::*field :
         {&SensorParameters::range, &SensorParameters::fieldOfView, &SensorParameters::rate})
        for (const double bad : {0.0, -1.0, HUGE_VAL, std::nan("")})
        {
            SensorParameters parameters;
            parameters.*field = bad;
            EXPECT_THROW(SimulatedSensor(scenario, parameters), Error) << bad;
        }
    SensorParameters wide, noisy;
    wide.fieldOfView = 2.0 * PI + 1e-9;
    EXPECT_THROW(SimulatedSensor(scenario, wide), Error);
    noisy.rangeNoise = -0.1;
    EXPECT_THROW(SimulatedSensor(scenario, noisy), Error);

    const Polygon post{{5.0, 5.0}};
    EXPECT_NO_THROW(SimulatedSensor(scenario, {}, {{post, 1.0, 2.0}}));
    EXPECT_THROW(SimulatedSensor(scenario, {}, {{post, 2.0, 2.0}}), Error);
    EXPECT_THROW(SimulatedSensor(scenario, {}, {{post, std::nan(""), 2.0}}), Error);
    EXPECT_THROW(SimulatedSensor(scenario, {}, {{Polygon{}, 1.0, 2.0}}), Error);

    SimulatedSensor sensor(scenario);
    sensor.observe(0.0, {5.0, 5.0, 0.0}, OccupancyGrid(100, 100, 0.1));
    EXPECT_THROW(sensor.observe(1.0, {5.0, 5.0, 0.0}, OccupancyGrid(100, 101, 0.1)), Error);
    EXPECT_THROW(sensor.observe(1.0, {5.0, 5.0, 0.0}, OccupancyGrid(100, 100, 0.1, {0.0, 0.0, 0.1})), Error);
}

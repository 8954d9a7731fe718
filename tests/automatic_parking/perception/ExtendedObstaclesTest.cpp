#include "automatic_parking/perception/ExtendedObstacles.h"

#include "benchmarks/worlds/Random.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

using namespace parking;
using namespace parking_test;

namespace
{
    constexpr double SIDE = 0.2;  // metres of a cell

    /** A world of unseen cells of 12 m x 8 m. */
    Scenario unseenGround()
    {
        Scenario scenario;
        scenario.bounds = {{0.0, 0.0}, {12.0, 8.0}};
        scenario.start = {2.0, 4.0, 0.0};
        scenario.goals = {{8.0, 4.0, 0.3}};
        scenario.grid = OccupancyGrid(60, 40, SIDE, {}, Cell::Unknown);
        return scenario;
    }

    /** Whether the body of the car at its start or goal covers a point. */
    bool isNearCar(const Scenario &scenario, const Eigen::Vector2d &point, double margin)
    {
        for (const Pose &pose : {scenario.start, scenario.goals.front()})
        {
            const Pose local = relativeTo(pose, {point.x(), point.y(), 0.0});
            const Vehicle &car = scenario.vehicle;
            if (local.x > -car.rearOverhang - margin && local.x < car.length() - car.rearOverhang + margin &&
                std::abs(local.y) < 0.5 * car.width + margin)
                return true;
        }
        return false;
    }
}  // namespace

/** In random worlds that change: compared with the definition, cell by cell. */
TEST(ExtendedObstacles, ContinueOnUnseenGroundOnly)
{
    Random random(11);
    const Scenario scenario = unseenGround();
    for (const double reach : {0.0, 0.5, 1.0})
    {
        OccupancyGrid seen = *scenario.grid;
        ExtendedObstacles obstacles(scenario, reach);
        for (int round = 0; round < 60; ++round)
        {
            GridUpdate update;
            const auto first = static_cast<std::uint32_t>(random.index(40));
            for (std::uint32_t k = 0; k < 6; ++k)
                update.push_back({first + 3 * k, static_cast<std::uint32_t>(random.index(40)),
                                  random.chance(0.4) ? Cell::Occupied : static_cast<Cell>(random.index(3))});
            seen.apply(update);
            obstacles.update(update);
            for (std::uint32_t row = 0; row < 40; ++row)
                for (std::uint32_t column = 0; column < 60; ++column)
                {
                    const Cell now = obstacles.map().at(column, row), was = seen.at(column, row);
                    if (was != Cell::Unknown)
                    {
                        ASSERT_EQ(now, was);
                        continue;
                    }
                    bool isNear = false;
                    for (std::uint32_t j = 0; j < 40; ++j)
                        for (std::uint32_t i = 0; i < 60; ++i)
                            if (seen.at(i, j) == Cell::Occupied)
                                isNear =
                                    isNear || SIDE * std::hypot(double(i) - column, double(j) - row) <= reach + 1e-9;
                    const Eigen::Vector2d centre(SIDE * (column + 0.5), SIDE * (row + 0.5));
                    if (!isNear || isNearCar(scenario, centre, 0.0))
                    {
                        ASSERT_EQ(now, Cell::Unknown) << column << ' ' << row;
                    }
                    else if (!isNearCar(scenario, centre, SIDE))
                    {
                        ASSERT_EQ(now, Cell::Occupied) << column << ' ' << row;
                    }
                }
        }
    }
}

TEST(ExtendedObstacles, ReportEachChangeOnce)
{
    Random random(5);
    const Scenario scenario = unseenGround();
    ExtendedObstacles obstacles(scenario, 1.0);
    OccupancyGrid map = obstacles.map();
    for (int round = 0; round < 500; ++round)
    {
        GridUpdate update;
        const auto column = static_cast<std::uint32_t>(random.index(50));
        for (std::uint32_t k = 0; k < random.index(10); ++k)
            update.push_back(
                {column + k, static_cast<std::uint32_t>(random.index(40)), static_cast<Cell>(random.index(3))});
        for (const CellChange &each : obstacles.update(update))
        {
            ASSERT_NE(map.at(each.column, each.row), each.cell);
            map.set(each.column, each.row, each.cell);
        }
        ASSERT_EQ(map.cells(), obstacles.map().cells());
    }
}

TEST(ExtendedObstacles, BeginWithWhatHasBeenSeen)
{
    Scenario scenario = unseenGround();
    scenario.grid->set(30, 2, Cell::Occupied);
    scenario.grid->set(31, 2, Cell::Free);
    const ExtendedObstacles obstacles(scenario, 0.4);
    EXPECT_EQ(obstacles.map().at(30, 2), Cell::Occupied);
    EXPECT_EQ(obstacles.map().at(31, 2), Cell::Free);
    EXPECT_EQ(obstacles.map().at(32, 2), Cell::Occupied);
    EXPECT_EQ(obstacles.map().at(33, 2), Cell::Unknown);
    EXPECT_EQ(obstacles.map().at(30, 0), Cell::Occupied);
}

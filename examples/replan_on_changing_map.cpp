// Replanning on a changing map: each call turns a new grid of 200 by 200 cells into a path. The planner reuses its
// memory from map to map.
#include "examples/CarPark.h"

#include <cstdio>

#include <ompl/util/Console.h>
#include <ompl/util/Time.h>

namespace
{
    /** Two rows of parked cars and, from the second map on, a car that has stopped in the aisle. */
    parking::OccupancyGrid seen(int number)
    {
        parking::OccupancyGrid grid(200, 200, 0.15, {-15.0, -15.0, 0.0});
        const auto fill = [&grid](double minX, double minY, double maxX, double maxY)
        {
            for (auto row = static_cast<std::size_t>((minY + 15.0) / 0.15); row < (maxY + 15.0) / 0.15; ++row)
                for (auto column = static_cast<std::size_t>((minX + 15.0) / 0.15); column < (maxX + 15.0) / 0.15;
                     ++column)
                    grid.set(column, row, parking::Cell::Occupied);
        };
        for (int slot = -4; slot <= 4; ++slot)
        {
            if (slot != 1)
                fill(2.7 * slot - 0.9, 0.6, 2.7 * slot + 0.9, 5.0);
            fill(2.7 * slot - 0.9, -12.0, 2.7 * slot + 0.9, -7.6);
        }
        if (number > 0)
            fill(-5.0 + number, -2.8, -1.5 + number, -1.0);
        return grid;
    }
}  // namespace

int main()
{
    ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
    const parking::Vehicle car = parking::vehicleByName("vw_golf8");
    const auto space = parking_examples::spaceFor(car);
    ompl::geometric::SimpleSetup setup(space);
    const auto &si = setup.getSpaceInformation();
    const auto planner = std::make_shared<ompl::geometric::ImprovedAStar>(si);
    setup.setPlanner(planner);
    setup.setStartAndGoalStates(parking_examples::state(space, -11.0, -4.0, 0.0),
                                parking_examples::state(space, 2.7, 4.0, -0.5 * parking::PI));
    for (int number = 0; number < 4; ++number)
    {
        const parking::OccupancyGrid grid = seen(number);
        const ompl::time::point begin = ompl::time::now();
        parking_examples::setObstacles(si, parking::ObstacleSet::fromGrid(grid), car);
        const ompl::time::point ready = ompl::time::now();
        planner->clearQuery();
        setup.getProblemDefinition()->clearSolutionPaths();
        if (setup.solve(5.0) != ompl::base::PlannerStatus::EXACT_SOLUTION || !setup.getSolutionPath().check())
            return 1;
        std::printf("map %d: %.2f ms for the map, %.2f ms for the path of %.1f m\n", number,
                    1e3 * ompl::time::seconds(ready - begin), 1e3 * setup.getLastPlanComputationTime(),
                    setup.getSolutionPath().length());
    }
    return 0;
}

// Checks footprints and plans a path with the core alone: no OMPL, no FCL.
#include <cmath>
#include <iostream>

#include <ompl_improved_astar/search/CarInSpace.h>
#include <ompl_improved_astar/search/planning/FootprintEnvironment.h>
#include <ompl_improved_astar/search/planning/Parameters.h>
#include <ompl_improved_astar/search/planning/PathPlanner.h>
#include <parking_geometry/Vehicle.h>
#include <state_validity/FootprintChecker.h>

int main()
{
    // A wall across the world with a gap of four metres.
    const parking::Vehicle car;
    const parking::Box bounds{{-20.0, -15.0}, {20.0, 15.0}};
    const auto world = parking::ObstacleSet::fromPolygons(
        {{{-0.5, -15.0}, {0.5, -15.0}, {0.5, 2.0}, {-0.5, 2.0}}, {{-0.5, 6.0}, {0.5, 6.0}, {0.5, 15.0}, {-0.5, 15.0}}},
        bounds);
    const parking::FootprintChecker checker(world, car);
    const parking::Pose start{-10.0, -5.0, 0.0}, goal{10.0, -5.0, 0.0}, inTheWall{0.0, 0.0, 0.0};
    if (!checker.isFree(start) || !checker.isFree(goal) || checker.isFree(inTheWall))
    {
        std::cerr << "a footprint is judged wrongly\n";
        return 1;
    }

    parking::FootprintEnvironment environment(checker, bounds, 1e-3);
    parking::search::PathPlanner planner;
    planner.begin(environment, parking::PlannerParameters(), parking::search::carInSpace(car, 0.0, bounds));
    planner.addStart(start);
    planner.addGoal(goal);
    planner.solve([] { return false; }, [](const parking::Path &, double) { return true; });
    if (!planner.hasSolution())
    {
        std::cerr << "no path is found\n";
        return 1;
    }
    const parking::Path path = planner.bestPath();
    const parking::Pose end = path.end();
    if (positionDistance(end, goal) > 1e-6 || !(path.length() > 20.0))
    {
        std::cerr << "the path ends at " << end.x << ' ' << end.y << " after " << path.length() << " m\n";
        return 1;
    }
    std::cout << "planned " << path.length() << " m without OMPL\n";
    return 0;
}

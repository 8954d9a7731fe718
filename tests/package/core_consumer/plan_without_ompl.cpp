// Checks footprints and plans a path with the core alone: no OMPL, no FCL.
#include <cmath>
#include <iostream>

#include <ompl_improved_astar/search/planning/FootprintEnvironment.h>
#include <ompl_improved_astar/search/planning/Plan.h>
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
    parking::FootprintEnvironment environment(checker, bounds, 1e-3);
    parking::search::PlanRequest request;
    request.starts = {{-10.0, -5.0, 0.0}};
    request.goals = {{10.0, -5.0, 0.0}};
    request.car = parking::search::carInSpace(car, 0.0, bounds);
    request.maxExpansions = 100000;
    const parking::search::PlanResult result = parking::search::plan(environment, request);

    if (!checker.isFree(request.starts[0]) || !checker.isFree(request.goals[0]) || checker.isFree({0.0, 0.0, 0.0}))
    {
        std::cerr << "a footprint is judged wrongly\n";
        return 1;
    }
    if (result.outcome != parking::search::PlanOutcome::Solved)
    {
        std::cerr << "no path is found: " << result.reason << '\n';
        return 1;
    }
    const parking::Pose end = result.path.end();
    if (positionDistance(end, request.goals[0]) > 1e-6 || !(result.path.length() > 20.0))
    {
        std::cerr << "the path ends at " << end.x << ' ' << end.y << " after " << result.path.length() << " m\n";
        return 1;
    }
    std::cout << "planned " << result.path.length() << " m without OMPL\n";
    return 0;
}

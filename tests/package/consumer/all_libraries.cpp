// Calls into every library of the package, so that what it needs must be found, compiled and linked.
#include <iostream>
#include <string>

#include <ompl_improved_astar/search/planning/Parameters.h>
#include <parking_geometry/Error.h>
#include <parking_geometry/curves/Path.h>
#include <parking_geometry/io/ScenarioReader.h>
#include <state_validity/FootprintChecker.h>
#include <state_validity/fcl/FclContactTest.h>
#include <state_validity/ompl/FclFootprintChecker.h>
#ifdef HAS_automatic_parking
#include <automatic_parking/AutomaticParking.h>
#endif
#ifdef HAS_path_tracking
#include <path_tracking/control/Mpc.h>
#include <path_tracking/reference/TimedReference.h>
#endif

int main(int argc, char **argv)
{
    if (argc != 2 || std::string(argv[1]) != PACKAGE_VERSION)
    {
        std::cerr << "The package says that its version is " << PACKAGE_VERSION << '\n';
        return 1;
    }

    parking::Path path;
    path.append({0.1, 3.0});
    path.append({-0.1, 3.0});

    const auto world = parking::ObstacleSet::fromPolygons({{{4, -5}, {5, -5}, {5, 5}, {4, 5}}}, {{-20, -20}, {20, 20}});
    const parking::FootprintChecker checker(world, parking::Vehicle(), 0.0, parking::fclContactTest());
    const bool startIsFree = checker.isFree({-5.0, 0.0, 0.0}), wallIsFree = checker.isFree({3.0, 0.0, 0.0});

    bool readerRefuses = false;
    try
    {
        parking::readScenario("there is no such file");
    }
    catch (const parking::Error &)
    {
        readerRefuses = true;
    }

    bool drives = true;
#ifdef HAS_path_tracking
    const parking::TimedReference reference(parking::ReferencePath(path, parking::Vehicle()), parking::SpeedLimits());
    parking::Mpc controller(parking::Vehicle{}, parking::MpcParameters{});
    drives = reference.duration() > 0.0 && !controller.solve(parking::MpcProblem()).usable;
#endif

    bool parks = true;
#ifdef HAS_automatic_parking
    parking::Scenario scenario;
    scenario.goals = {{8.0, 0.0, 0.0}};
    scenario.bounds = {{-10.0, -10.0}, {20.0, 10.0}};
    parks = parking::AutomaticParking().park(scenario).parked();
#endif

    const bool right =
        startIsFree && !wallIsFree && readerRefuses && drives && parks && !parking::parameterSetNames().empty();
    std::cout << (right ? "all libraries answer\n" : "a library gives a wrong answer\n");
    return right ? 0 : 1;
}

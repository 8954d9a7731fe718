// Converts the solution of any OMPL planner in a Reeds-Shepp space, here RRTConnect, into a drivable trajectory. The
// result is the fastest trajectory near the path, as states and controls of OMPL.
#include "automatic_parking/QuickestTrajectory.h"
#include "automatic_parking/ompl/OmplTrajectory.h"
#include "state_validity/ompl/FclFootprintChecker.h"
#include "state_validity/ompl/SweptMotionValidator.h"

#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <cstdio>
#include <memory>

namespace ob = ompl::base;
namespace og = ompl::geometric;

int main()
{
    ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
    ompl::RNG::setSeed(1);
    const parking::Vehicle car = parking::vehicleByName("vw_golf8");
    const parking::Box bounds{{-15.0, -15.0}, {15.0, 15.0}};
    const auto world = parking::ObstacleSet::fromPolygons(
        {{{-4, 0}, {-1.5, 0}, {-1.5, 5}, {-4, 5}}, {{1.5, 0}, {4, 0}, {4, 5}, {1.5, 5}}}, bounds);

    auto space = std::make_shared<ob::ReedsSheppStateSpace>(car.minTurningRadius());
    ob::RealVectorBounds positions(2);
    positions.setLow(-15.0);
    positions.setHigh(15.0);
    space->setBounds(positions);
    og::SimpleSetup setup(space);
    const auto &si = setup.getSpaceInformation();
    si->setStateValidityChecker(std::make_shared<parking::FclFootprintChecker>(si, world, car));
    si->setMotionValidator(std::make_shared<parking::SweptMotionValidator>(si));
    ob::ScopedState<ob::SE2StateSpace> start(space), goal(space);
    start->setXY(-8.0, -3.0), start->setYaw(0.0);
    goal->setXY(0.0, 4.0), goal->setYaw(-1.5708);
    setup.setStartAndGoalStates(start, goal);
    setup.setPlanner(std::make_shared<og::RRTConnect>(si));
    if (setup.solve(20.0) != ob::PlannerStatus::EXACT_SOLUTION)
        return 1;

    const parking::Path path = parking::pathOf(setup.getSolutionPath());
    const parking::FootprintChecker checker(world, car);
    const parking::OptimizedTrajectory found = parking::TrajectoryOptimizer(checker).optimize(path);
    const auto controls = parking::controlPath(found.motion, car, parking::carInformation(car, bounds));
    std::printf("%.1f m with %zu changes of direction, driven in %.1f s by %zu controls\n", path.length(), path.cusps(),
                controls->length(), controls->getControlCount());
    return found.fallback ? 1 : 0;
}

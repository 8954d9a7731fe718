// The program of the README: a car reverses into a slot between two others.

#include <iostream>
#include <memory>

#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>

#include <ompl_improved_astar/ImprovedAStar.h>
#include <state_validity/ompl/FclFootprintChecker.h>
#include <state_validity/ompl/SweptMotionValidator.h>

int main()
{
    const parking::Vehicle car = parking::vehicleByName("vw_golf8");
    const std::vector<parking::Polygon> obstacles = {{{-4, 0}, {-1.3, 0}, {-1.3, 5}, {-4, 5}},
                                                     {{1.3, 0}, {4, 0}, {4, 5}, {1.3, 5}}};
    ompl::base::RealVectorBounds bounds(2);
    bounds.setLow(-15.0);
    bounds.setHigh(15.0);
    auto space = std::make_shared<ompl::base::ReedsSheppStateSpace>(car.minTurningRadius());
    space->setBounds(bounds);

    ompl::geometric::SimpleSetup setup(space);
    const auto &si = setup.getSpaceInformation();
    const auto world = parking::ObstacleSet::fromPolygons(obstacles, {{-15, -15}, {15, 15}});
    si->setStateValidityChecker(std::make_shared<parking::FclFootprintChecker>(si, world, car));
    si->setMotionValidator(std::make_shared<parking::SweptMotionValidator>(si));
    si->setup();

    ompl::base::ScopedState<ompl::base::SE2StateSpace> start(space), goal(space);
    start->setXY(-8.0, -3.0), start->setYaw(0.0);  // in the aisle
    goal->setXY(0.0, 4.0), goal->setYaw(-1.5708);  // in the slot
    setup.setStartAndGoalStates(start, goal);
    setup.setPlanner(std::make_shared<ompl::geometric::ImprovedAStar>(si));

    if (setup.solve(1.0) != ompl::base::PlannerStatus::EXACT_SOLUTION)
        return 1;
    setup.getSolutionPath().printAsMatrix(std::cout);
}

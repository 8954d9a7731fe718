// Three free slots in a row, each with forward and reverse entry. The planner selects the goal of lowest cost.
#include "examples/CarPark.h"

#include <cstdio>

#include <ompl/base/goals/GoalStates.h>
#include <ompl/util/Console.h>

int main()
{
    ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
    const parking::Vehicle car = parking::vehicleByName("vw_golf8");
    const auto space = parking_examples::spaceFor(car);
    ompl::geometric::SimpleSetup setup(space);
    const auto &si = setup.getSpaceInformation();

    // Slots of 2.6 m, numbered from -2 to 4; numbers -1, 1 and 3 are free, the others hold cars.
    std::vector<parking::Polygon> parked;
    const auto goals = std::make_shared<ompl::base::GoalStates>(si);
    for (int slot = -2; slot <= 4; ++slot)
    {
        const double x = 2.6 * slot;
        if (slot == -1 || slot == 1 || slot == 3)
        {
            goals->addState(parking_examples::state(space, x, 4.0, -0.5 * parking::PI));
            goals->addState(parking_examples::state(space, x, 1.5, 0.5 * parking::PI));
        }
        else
            parked.push_back({{x - 0.9, 0.3}, {x + 0.9, 0.3}, {x + 0.9, 4.8}, {x - 0.9, 4.8}});
    }
    parking_examples::setObstacles(si, parking::ObstacleSet::fromPolygons(parked, {{-15, -6}, {15, 15}}), car);

    setup.setStartState(parking_examples::state(space, -9.0, -3.0, 0.0));
    setup.setGoal(goals);
    setup.setPlanner(std::make_shared<ompl::geometric::ImprovedAStar>(si));
    if (setup.solve(5.0) != ompl::base::PlannerStatus::EXACT_SOLUTION)
        return 1;
    const auto *end = setup.getSolutionPath().getStates().back()->as<ompl::base::SE2StateSpace::StateType>();
    std::printf("of %zu goals: the slot at x = %.1f m, %s first, after %.1f m\n", goals->getStateCount(), end->getX(),
                end->getYaw() > 0.0 ? "nose" : "tail", setup.getSolutionPath().length());
    return setup.getSolutionPath().check() ? 0 : 1;
}

// Anytime planning: a first solution, then shorter ones until the time limit or until the path is short enough.
#include "examples/CarPark.h"

#include <cstdio>

#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/util/Console.h>
#include <ompl/util/Time.h>

int main()
{
    namespace ob = ompl::base;
    ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
    const parking::Vehicle car = parking::vehicleByName("vw_golf8");
    const auto space = parking_examples::spaceFor(car);
    ompl::geometric::SimpleSetup setup(space);
    const auto &si = setup.getSpaceInformation();
    const std::vector<parking::Polygon> walls = {{{-3, -10}, {-2, -10}, {-2, 6}, {-3, 6}},
                                                 {{3, -6}, {4, -6}, {4, 10}, {3, 10}}};
    parking_examples::setObstacles(si, parking::ObstacleSet::fromPolygons(walls, {{-15, -15}, {15, 15}}), car);
    setup.setStartAndGoalStates(parking_examples::state(space, -9.0, -5.0, 0.0),
                                parking_examples::state(space, 9.0, 5.0, 3.0));

    const auto objective = std::make_shared<ob::PathLengthOptimizationObjective>(si);
    objective->setCostThreshold(ob::Cost(20.0));  // metres, below every path here: planning ends at the time limit
    setup.setOptimizationObjective(objective);
    const auto planner = std::make_shared<ompl::geometric::ImprovedAStar>(si);
    planner->params()["anytime"] = true;
    setup.setPlanner(planner);

    const ompl::time::point begin = ompl::time::now();
    setup.getProblemDefinition()->setIntermediateSolutionCallback(
        [&begin](const ob::Planner *, const std::vector<const ob::State *> &, const ob::Cost cost)
        { std::printf("%7.1f ms %8.3f m\n", 1e3 * ompl::time::seconds(ompl::time::now() - begin), cost.value()); });
    if (setup.solve(0.5) != ob::PlannerStatus::EXACT_SOLUTION)
        return 1;
    std::printf("%.3f m; no path costs less than 1/%.2f of this one's cost\n", setup.getSolutionPath().length(),
                planner->suboptimalityBound());
    return setup.getSolutionPath().check() ? 0 : 1;
}

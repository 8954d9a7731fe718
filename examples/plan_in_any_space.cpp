// One planner in three state spaces with any validity checker. The checker is a lambda that keeps a point away from a
// pillar. With parking::FclFootprintChecker (see readme_example.cpp) planning is faster.
#include <ompl_improved_astar/ImprovedAStar.h>

#include <cmath>
#include <cstdio>
#include <memory>

#include <ompl/base/spaces/DubinsStateSpace.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/util/Console.h>

namespace ob = ompl::base;
namespace og = ompl::geometric;

namespace
{
    bool plan(const char *name, const std::shared_ptr<ob::SE2StateSpace> &space)
    {
        ob::RealVectorBounds bounds(2);
        bounds.setLow(-12.0);
        bounds.setHigh(12.0);
        space->setBounds(bounds);

        og::SimpleSetup setup(space);
        setup.setStateValidityChecker(
            [](const ob::State *state)
            {
                const auto *pose = state->as<ob::SE2StateSpace::StateType>();
                return std::hypot(pose->getX(), pose->getY()) > 3.0;  // a pillar, enlarged by the size of the car
            });
        setup.getSpaceInformation()->setStateValidityCheckingResolution(0.005);
        ob::ScopedState<ob::SE2StateSpace> start(space), goal(space);
        start->setXY(-8.0, 0.0), start->setYaw(0.0);
        goal->setXY(6.0, 1.0), goal->setYaw(3.0);
        setup.setStartAndGoalStates(start, goal);

        const auto planner = std::make_shared<og::ImprovedAStar>(setup.getSpaceInformation());
        planner->params()["turning_radius"] = 3.0;  // a plain SE2 space does not define a turning radius
        setup.setPlanner(planner);
        if (setup.solve(5.0) != ob::PlannerStatus::EXACT_SOLUTION)
            return false;
        const parking::Path &arcs = *planner->solutionPath();
        std::printf("%-12s %5.1f m, %zu changes of direction, %zu states\n", name, arcs.length(), arcs.cusps(),
                    setup.getSolutionPath().getStateCount());
        return setup.getSolutionPath().check();
    }
}  // namespace

int main()
{
    ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
    const bool solved = plan("SE2", std::make_shared<ob::SE2StateSpace>()) &&
                        plan("Reeds-Shepp", std::make_shared<ob::ReedsSheppStateSpace>(3.0)) &&
                        plan("Dubins", std::make_shared<ob::DubinsStateSpace>(3.0));
    return solved ? 0 : 1;
}

// Prints the path that the planner finds in C++ for a scenario, digit for digit: the states, then the path's pieces.
#include "ompl_improved_astar/ImprovedAStar.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "state_validity/ompl/FclFootprintChecker.h"
#include "state_validity/ompl/OmplPose.h"
#include "state_validity/ompl/SweptMotionValidator.h"

#include <ompl/base/goals/GoalStates.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/util/Console.h>

#include <cstdio>
#include <exception>
#include <memory>

namespace ob = ompl::base;

namespace
{
    int print(const parking::Scenario &scenario)
    {
        const auto space = std::make_shared<ob::ReedsSheppStateSpace>(scenario.vehicle.minTurningRadius());
        space->setBounds(parking::positionBounds(scenario.bounds));
        ompl::geometric::SimpleSetup setup(space);
        const ob::SpaceInformationPtr si = setup.getSpaceInformation();
        setup.setStateValidityChecker(std::make_shared<parking::FclFootprintChecker>(si, scenario));
        si->setMotionValidator(std::make_shared<parking::SweptMotionValidator>(si));
        ob::ScopedState<> state(si);
        parking::setPose(state.get(), scenario.start);
        setup.setStartState(state);
        const auto goals = std::make_shared<ob::GoalStates>(si);
        for (const parking::Pose &goal : scenario.goals)
        {
            parking::setPose(state.get(), goal);
            goals->addState(state);
        }
        setup.setGoal(goals);
        const auto planner = std::make_shared<ompl::geometric::ImprovedAStar>(si);
        setup.setPlanner(planner);
        if (setup.solve(60.0) != ob::PlannerStatus::EXACT_SOLUTION)
            return 1;
        for (const ob::State *each : setup.getSolutionPath().getStates())
        {
            const parking::Pose pose = scenario.toWorld(parking::poseOf(each));
            std::printf("state %a %a %a\n", pose.x, pose.y, pose.yaw);
        }
        for (const parking::PathPiece &piece : planner->solutionPath()->pieces)
            std::printf("piece %a %a %a %a\n", piece.curvature, piece.length, piece.sharpness, piece.turn);
        return 0;
    }
}  // namespace

int main(int count, char **arguments)
{
    if (count != 2)
        return 2;
    ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
    try
    {
        return print(parking::readScenario(arguments[1]));
    }
    catch (const std::exception &error)
    {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}

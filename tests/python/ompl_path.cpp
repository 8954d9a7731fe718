// Prints the path that the planner finds in C++ for a scenario, digit for digit: the states, then the path's pieces.
// With the objective "length" or "driving" also the costs of the path and of motions between its states.
#include "ompl_improved_astar/DrivingCostObjective.h"
#include "ompl_improved_astar/ImprovedAStar.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "state_validity/ompl/FclFootprintChecker.h"
#include "state_validity/ompl/OmplPose.h"
#include "state_validity/ompl/SweptMotionValidator.h"

#include <ompl/base/goals/GoalStates.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/util/Console.h>

#include <cstdio>
#include <exception>
#include <memory>
#include <string>

namespace ob = ompl::base;

namespace
{
    constexpr unsigned int STEP = 7;  // states between the ends of a motion

    ob::OptimizationObjectivePtr objectiveNamed(const std::string &name, const ob::SpaceInformationPtr &si)
    {
        if (name == "length")
            return std::make_shared<ob::PathLengthOptimizationObjective>(si);
        parking::PlannerParameters weights;
        weights.reversePenalty = 0.7;
        weights.gearChangePenalty = 2.5;
        weights.steeringChangePenalty = 0.3;
        weights.preferredClearance = 0.4;
        weights.clearanceCost = 3.0;
        return std::make_shared<parking::DrivingCostObjective>(si, weights);
    }

    void printCosts(const ompl::geometric::PathGeometric &path, const ob::OptimizationObjectivePtr &objective)
    {
        std::printf("cost %a\n", parking::pathCost(path, objective).value());
        for (unsigned int i = STEP; i < path.getStateCount(); ++i)
            std::printf("motion %a %a\n", objective->motionCost(path.getState(i - STEP), path.getState(i)).value(),
                        objective->motionCost(path.getState(i), path.getState(i - STEP)).value());
    }

    int print(const parking::Scenario &scenario, const std::string &objective)
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
        if (!objective.empty())
            setup.setOptimizationObjective(objectiveNamed(objective, si));
        if (setup.solve(60.0) != ob::PlannerStatus::EXACT_SOLUTION)
            return 1;
        for (const ob::State *each : setup.getSolutionPath().getStates())
        {
            const parking::Pose pose = scenario.toWorld(parking::poseOf(each));
            std::printf("state %a %a %a\n", pose.x, pose.y, pose.yaw);
        }
        for (const parking::PathPiece &piece : planner->solutionPath()->pieces)
            std::printf("piece %a %a %a %a\n", piece.curvature, piece.length, piece.sharpness, piece.turn);
        if (!objective.empty())
            printCosts(setup.getSolutionPath(), setup.getOptimizationObjective());
        return 0;
    }
}  // namespace

int main(int count, char **arguments)
{
    if (count != 2 && count != 3)
        return 2;
    ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
    try
    {
        return print(parking::readScenario(arguments[1]), count == 3 ? arguments[2] : "");
    }
    catch (const std::exception &error)
    {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}

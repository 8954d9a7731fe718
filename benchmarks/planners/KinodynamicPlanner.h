#pragma once

#include <ompl/base/Planner.h>
#include <ompl/control/SpaceInformation.h>

#include <functional>
#include <memory>

namespace parking
{
    /** \brief A planner of OMPL's control space (RRT, SST, KPIECE and others) behind the interface of a geometric one,
       with the bicycle model, to its first solution.

       A control is a curvature and a direction: full lock to the left, straight ahead or full lock to the right,
       forwards or in reverse. A drive with one control is an arc of the Reeds-Shepp space, so that the path is checked
       like any other. The motion validator of the space checks each step along its whole length.

       Planners of controls do not reach a pose exactly. They end when the space's own curve from a state to a goal is
       free and at most `goal_reach` metres long; that curve ends the path. */
    class KinodynamicPlanner : public ompl::base::Planner
    {
    public:
        /** \brief Creates the planner of the control space. */
        using Maker = std::function<ompl::base::PlannerPtr(const ompl::control::SpaceInformationPtr &)>;

        /** \brief Requires a Reeds-Shepp space; with any other solve() throws ompl::Exception. */
        KinodynamicPlanner(const ompl::base::SpaceInformationPtr &si, const std::string &name, const Maker &maker);

        /** \brief Plans in control space until there is a solution or \e ptc is true. */
        ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition &ptc) override;
        using ompl::base::Planner::solve;

        /** \brief Clears the search. */
        void clear() override;

        /** \brief The graph of the control-space planner. */
        void getPlannerData(ompl::base::PlannerData &data) const override;

    private:
        double goalReach_{5.0};  // maximum length in metres of the curve to the goal
        double step_{0.3};       // metres of a step of a control, which lasts for one to ten of them
        ompl::control::SpaceInformationPtr controls_;
        ompl::base::PlannerPtr planner_;
    };
}  // namespace parking

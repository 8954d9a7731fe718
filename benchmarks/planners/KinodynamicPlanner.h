#pragma once

#include <ompl/base/Planner.h>
#include <ompl/control/SpaceInformation.h>

#include <functional>
#include <memory>

namespace parking
{
    /** \brief A planner of OMPL's control space (RRT, SST, KPIECE), to its first solution, behind the interface of a
       geometric one, with the bicycle model.

        Its controls are a curvature and a direction: full lock to the left, straight ahead, full lock to the right,
        forwards or in reverse. A drive with one of them is an arc that the Reeds-Shepp space has, too, so that its path
        is judged like any other. Each step is checked along its whole length by the motion validator of the space.

        Planners of controls do not reach a pose. They are done when the space's own curve from a state to a goal is
        free and no longer than `goal_reach` metres; that curve ends the path. */
    class KinodynamicPlanner : public ompl::base::Planner
    {
    public:
        /** \brief Makes the planner that plans in control space. */
        using Maker = std::function<ompl::base::PlannerPtr(const ompl::control::SpaceInformationPtr &)>;

        /** \brief Takes Reeds-Shepp spaces; with any other solve() throws ompl::Exception. */
        KinodynamicPlanner(const ompl::base::SpaceInformationPtr &si, const std::string &name, const Maker &maker);

        /** \brief Plans in control space until there is a solution, or \e ptc says stop. */
        ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition &ptc) override;
        using ompl::base::Planner::solve;

        /** \brief Forgets the search. */
        void clear() override;

        /** \brief The graph of the other planner. */
        void getPlannerData(ompl::base::PlannerData &data) const override;

    private:
        double goalReach_{5.0};  // metres that the curve to the goal is long at most
        double step_{0.3};       // metres of a step of a control, which lasts for one to ten of them
        ompl::control::SpaceInformationPtr controls_;
        ompl::base::PlannerPtr planner_;
    };
}  // namespace parking

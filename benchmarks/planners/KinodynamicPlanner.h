#pragma once

#include "benchmarks/planners/ParameterRange.h"

#include <ompl/base/Planner.h>
#include <ompl/control/SpaceInformation.h>

#include <functional>
#include <memory>

namespace parking
{
    /** \brief A planner of OMPL's control space (RRT, SST, KPIECE) behind the interface of a geometric one, with the
        bicycle model.

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

        /** \brief Metres that the curve to the goal is long at most, from 0.01 to 1000; throws ompl::Exception for
            others. */
        void setGoalReach(double metres)
        {
            ParameterRange{0.01, 1000.0}.require(getName(), "goal_reach", metres);
            goalReach_ = metres;
        }
        /** \brief See setGoalReach(). */
        double getGoalReach() const
        {
            return goalReach_;
        }

        /** \brief Metres of a step of a control, from 0.01 to 10; a control lasts for one to ten of them. Throws
            ompl::Exception for others. */
        void setStep(double metres)
        {
            ParameterRange{0.01, 10.0}.require(getName(), "step", metres);
            step_ = metres;
        }
        /** \brief See setStep(). */
        double getStep() const
        {
            return step_;
        }

    private:
        double goalReach_{5.0};
        double step_{0.3};
        ompl::control::SpaceInformationPtr controls_;
        ompl::base::PlannerPtr planner_;
    };

    /** \brief OMPL's control-space RRT, to the first solution. */
    class ControlRRT : public KinodynamicPlanner
    {
    public:
        /** \brief See KinodynamicPlanner. */
        explicit ControlRRT(const ompl::base::SpaceInformationPtr &si);
    };
    /** \brief OMPL's control-space SST, to the first solution. */
    class ControlSST : public KinodynamicPlanner
    {
    public:
        /** \brief See KinodynamicPlanner. */
        explicit ControlSST(const ompl::base::SpaceInformationPtr &si);
    };
    /** \brief OMPL's control-space KPIECE1, to the first solution. */
    class ControlKPIECE1 : public KinodynamicPlanner
    {
    public:
        /** \brief See KinodynamicPlanner. */
        explicit ControlKPIECE1(const ompl::base::SpaceInformationPtr &si);
    };
}  // namespace parking

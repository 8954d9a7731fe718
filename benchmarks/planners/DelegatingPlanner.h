#pragma once

#include <ompl/base/Planner.h>

namespace parking
{
    /** \brief Another planner behind an interface of one's own: whatever is asked is asked of it.

        What planners of plug-ins are wrapped in, so that they are measured like all others. */
    class DelegatingPlanner : public ompl::base::Planner
    {
    public:
        /** \param planner must not be null */
        explicit DelegatingPlanner(ompl::base::PlannerPtr planner);

        void setProblemDefinition(const ompl::base::ProblemDefinitionPtr &problem) override;
        ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition &ptc) override;
        using ompl::base::Planner::solve;
        void setup() override;
        void clear() override;
        void clearQuery() override;
        void checkValidity() override;
        void getPlannerData(ompl::base::PlannerData &data) const override;

    private:
        ompl::base::PlannerPtr planner_;
    };
}  // namespace parking

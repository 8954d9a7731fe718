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

        /** \brief Hands \e problem to the other planner, too. */
        void setProblemDefinition(const ompl::base::ProblemDefinitionPtr &problem) override;

        /** \brief What the other planner makes of it; it keeps to \e ptc as well as it can. */
        ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition &ptc) override;
        using ompl::base::Planner::solve;

        /** \brief Sets both planners up. */
        void setup() override;

        /** \brief Clears both planners. */
        void clear() override;

        /** \brief Lets the other planner forget the query, but not what it knows of the world. */
        void clearQuery() override;

        /** \brief Throws ompl::Exception when one of the two is not ready to solve. */
        void checkValidity() override;

        /** \brief The other planner's graph. */
        void getPlannerData(ompl::base::PlannerData &data) const override;

    private:
        ompl::base::PlannerPtr planner_;
    };
}  // namespace parking

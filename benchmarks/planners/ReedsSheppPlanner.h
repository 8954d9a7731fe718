#pragma once

#include <ompl/base/Planner.h>

namespace parking
{
    /** \anchor ReedsSheppPlanner
        \brief Baseline for all planners: drives the space's own curve from start to goal, if it is free.

        Attempts every pair of a valid start and a valid goal, shortest curve first. A path has two states. There are no
        approximate solutions: if no curve is free, solve() returns TIMEOUT at once. In a Reeds-Shepp space the curve is
        that of J. A. Reeds and L. A. Shepp, "Optimal paths for a car that goes both forwards and backwards", 1990. In
        other spaces it is the curve that they interpolate along. */
    class ReedsSheppPlanner : public ompl::base::Planner
    {
    public:
        /** \brief Plans in any space, although designed for curves that a car can drive. */
        explicit ReedsSheppPlanner(const ompl::base::SpaceInformationPtr &si);

        /** \brief INVALID_START or INVALID_GOAL when none is valid, UNRECOGNIZED_GOAL_TYPE for a goal that cannot be
            sampled. */
        ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition &ptc) override;

        /** \brief The two states of the solution, if there is one. */
        void getPlannerData(ompl::base::PlannerData &data) const override;
    };
}  // namespace parking

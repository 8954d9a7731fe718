#pragma once

#include "benchmarks/planners/TextbookSearch.h"

#include <ompl/base/Planner.h>

namespace parking
{
    /** \brief Standard Hybrid A* (D. Dolgov, S. Thrun and others, Int. J. Robotics Research 29, 2010), a baseline for
       comparisons.

       One search from the start over a uniform lattice is guided by the maximum of the curve's length and a disc's
       distance to the goal. An analytic expansion is attempted at every n-th node. It shares only the checks of poses
       and motions with the search of this project. The parameters are the usual ones. It requires Reeds-Shepp spaces;
       motions with less than full lock end at the end of their arc and reach it along the space's curve. */
    class TextbookHybridAStar : public ompl::base::Planner
    {
    public:
        /** \brief Creates a planner with usual parameters. */
        explicit TextbookHybridAStar(const ompl::base::SpaceInformationPtr &si);

        /** \brief Searches until there is a solution, the open list is empty, or \e ptc is true. */
        ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition &ptc) override;
        using ompl::base::Planner::solve;

    private:
        TextbookParameters parameters_;
    };
}  // namespace parking

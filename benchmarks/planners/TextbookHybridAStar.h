#pragma once

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
        struct Parameters
        {
            double xyResolution{0.1};  ///< cell size in metres of the lattice and of the disc's distances
            unsigned headingBins{72};  ///< number of headings round the circle
            unsigned steeringAngles{
                3};  ///< number of steering angles, odd: from full left to full right lock, evenly spaced
            double motionLength{0.5};       ///< length of a motion in metres
            double reversePenalty{1.0};     ///< extra cost per metre in reverse
            double gearChangePenalty{1.0};  ///< metres
            double steeringPenalty{0.0};    ///< extra cost per metre at full lock
            unsigned expansionInterval{5};  ///< number of nodes between analytic expansions
            double heuristicWeight{1.0};
            bool obstacleHeuristic{true};
        };

        class Search;

        Parameters parameters_;
    };
}  // namespace parking

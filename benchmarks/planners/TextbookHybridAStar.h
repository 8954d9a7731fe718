#pragma once

#include <ompl/base/Planner.h>

namespace parking
{
    /** \brief Hybrid A* as it is usually written (D. Dolgov, S. Thrun and others, Int. J. Robotics Research 29, 2010):
       one search from the start over a uniform lattice, guided by the larger of the curve's length and the way of a
       disc from the goal, with an analytic expansion at every n-th node.

        For comparisons: shares nothing with the search of this project but the checks of poses and motions, which every
        planner of a comparison has. The parameters are those that people tune. Takes Reeds-Shepp spaces; motions with
       less than full lock end where their arc does, and get there along the space's curve. */
    class TextbookHybridAStar : public ompl::base::Planner
    {
    public:
        /** \brief With parameters as people have them. */
        explicit TextbookHybridAStar(const ompl::base::SpaceInformationPtr &si);

        /** \brief Searches until there is a solution, nothing is left, or \e ptc says stop. */
        ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition &ptc) override;
        using ompl::base::Planner::solve;

    private:
        struct Parameters
        {
            double xyResolution{0.1};       ///< metres, of the lattice and of the disc's ways
            unsigned headingBins{72};       ///< round the circle
            unsigned steeringAngles{3};     ///< full lock either side and straight, and evenly between: odd
            double motionLength{0.5};       ///< metres of a motion
            double reversePenalty{1.0};     ///< extra cost per metre in reverse
            double gearChangePenalty{1.0};  ///< metres
            double steeringPenalty{0.0};    ///< extra cost per metre at full lock
            unsigned expansionInterval{5};  ///< nodes from one analytic expansion to the next
            double heuristicWeight{1.0};
            bool obstacleHeuristic{true};
        };

        class Search;

        Parameters parameters_;
    };
}  // namespace parking

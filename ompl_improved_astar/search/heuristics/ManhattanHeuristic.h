#pragma once

#include "ompl_improved_astar/search/heuristics/StraightHeuristic.h"

#include <cmath>

namespace parking::search
{
    /** \brief The shortest way in steps to four neighbours (paper, "Heuristic Evaluation Function": Manhattan
       distance).

        More than diagonal steps need: no bound, so that paths found with it may be longer than others. As a bound the
        straight distance serves. */
    class ManhattanHeuristic final : public StraightHeuristic
    {
    public:
        bool overestimates() const override
        {
            return true;
        }

    protected:
        double between(const Pose &pose, const Pose &target) const override
        {
            return std::abs(pose.x - target.x) + std::abs(pose.y - target.y);
        }
    };
}  // namespace parking::search

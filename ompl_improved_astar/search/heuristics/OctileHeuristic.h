#pragma once

#include "ompl_improved_astar/search/heuristics/StraightHeuristic.h"

#include <algorithm>
#include <cmath>

namespace parking::search
{
    /** \brief The shortest way in steps to eight neighbours: diagonal as far as it goes, straight for the rest (paper,
        "Heuristic Function Optimization": diagonal distance).

        Between centres of cells no way of `grid8` is shorter. Longer steps, and roots beside the centres, can be: as a
        bound the straight distance serves. */
    class OctileHeuristic final : public StraightHeuristic
    {
    public:
        void begin(const HeuristicQuery &query) override
        {
            StraightHeuristic::begin(query);
            hasLongerSteps_ = query.parameters.motionModel != "grid8";
        }

        bool overestimates() const override
        {
            return hasLongerSteps_;
        }

    protected:
        double between(const Pose &pose, const Pose &target) const override
        {
            const double dx = std::abs(pose.x - target.x), dy = std::abs(pose.y - target.y);
            return std::max(dx, dy) + (std::sqrt(2.0) - 1.0) * std::min(dx, dy);
        }

    private:
        bool hasLongerSteps_{true};
    };
}  // namespace parking::search

#pragma once

#include "ompl_improved_astar/search/Heuristic.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace parking::search
{
    /** \brief The straight distance between the rear axles (paper, "Heuristic Function Optimization": Euclidean). */
    class StraightHeuristic : public Heuristic
    {
    public:
        void begin(const HeuristicQuery &query) override
        {
            roots_ = targets_ = query.targets;
        }

        void aim(const Pose &pose) override
        {
            targets_.assign(1, pose);
        }

        double estimate(const Pose &pose) override
        {
            double least = std::numeric_limits<double>::infinity();
            for (const Pose &target : targets_)
                least = std::min(least, between(pose, target));
            return least;
        }

        double lowerBound(const Pose &pose) override
        {
            double least = std::numeric_limits<double>::infinity();
            for (const Pose &root : roots_)
                least = std::min(least, positionDistance(pose, root));
            return least;
        }

    protected:
        /** \brief The estimate for one target. */
        virtual double between(const Pose &pose, const Pose &target) const
        {
            return positionDistance(pose, target);
        }

    private:
        std::vector<Pose> roots_, targets_;
    };
}  // namespace parking::search

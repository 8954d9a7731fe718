#pragma once

#include <algorithm>

namespace parking::search
{
    /** \brief The weighting of the heuristic: f = g + (w + p) h (paper, section "Heuristic Function Optimization"). */
    struct HeuristicWeights
    {
        double far{2.5};           ///< w where the target is farther than nearDistance
        double near{2.5};          ///< w nearer than that
        double nearDistance{5.0};  ///< metres, straight
        double tieBreak{1e-3};     ///< p

        /** \brief w + p at \e distance metres from the target. */
        double at(double distance) const
        {
            return (distance > nearDistance ? far : near) + tieBreak;
        }

        /** \brief Whether any weight exceeds 1 and can be lowered. */
        bool canBeLowered() const
        {
            return far > 1.0 || near > 1.0;
        }

        /** \brief Multiplies weights above 1 by \e factor, down to 1. */
        HeuristicWeights lowered(double factor) const
        {
            const auto lower = [factor](double weight)
            {
                return weight > 1.0 ? std::max(1.0, factor * weight) : weight;
            };
            return {lower(far), lower(near), nearDistance, tieBreak};
        }
    };
}  // namespace parking::search

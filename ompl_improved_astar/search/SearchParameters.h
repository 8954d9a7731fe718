#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace parking::search
{
    /** \brief How the open list finds its best node. */
    enum class OpenListKind
    {
        BinaryHeap,  ///< logarithmic time
        Linear       ///< a scan of the whole list, as in the plain A* of the paper's comparison
    };

    /** \brief The weighting of the heuristic: f = g + (w + p) h (paper, section "Heuristic Function Optimization"). */
    struct HeuristicWeights
    {
        double far{2.5};           ///< w where the target is farther than nearGoalDistance
        double near{2.5};          ///< w nearer than that
        double nearDistance{5.0};  ///< metres, straight
        double tieBreak{1e-3};     ///< p

        double at(double distance) const
        {
            return (distance > nearDistance ? far : near) + tieBreak;
        }
    };

    /** \brief Asked now and then whether to stop; true stops the search. */
    using StopFunction = std::function<bool()>;

    /** \brief What a search did. */
    struct SearchStatistics
    {
        std::uint64_t expanded{0};        ///< nodes whose motions were tried
        std::uint64_t generated{0};       ///< motions tried
        std::uint64_t connections{0};     ///< analytic connections tried
        std::uint64_t heuristicCells{0};  ///< cells expanded by the obstacle-aware heuristic
    };
}  // namespace parking::search

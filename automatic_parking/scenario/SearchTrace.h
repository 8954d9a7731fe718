#pragma once

#include "automatic_parking/scenario/ScenarioPlanner.h"

#include <cstdint>
#include <vector>

namespace parking
{
    /** \brief A node of a search, for drawing. */
    struct TraceNode
    {
        Pose pose;                ///< of the rear axle, in the scenario's local coordinates
        std::uint32_t parent{0};  ///< index among the nodes of its side; its own for a root
        double curvature{0.0};    ///< 1/m, of the motion from its parent
        double length{0.0};       ///< metres, signed
        float cost{0.0f};         ///< of the path from its root
        float ahead{0.0f};        ///< estimate of the heuristic for the rest
        bool expanded{false};     ///< whether it has been expanded
    };

    /** \brief Sizes of the two trees at a step of the search. */
    struct TraceStep
    {
        std::uint64_t expanded{0};  ///< expansions so far
        std::uint32_t start{0};     ///< nodes of the start's tree
        std::uint32_t goal{0};      ///< nodes of the goal's tree
        bool solved{false};         ///< whether a solution is known
    };

    /** \brief Record of a search, step by step. */
    struct SearchTrace
    {
        std::vector<TraceNode> start,  ///< the tree from the start, in the order in which nodes were reached
            goal;                      ///< the tree from the goals, in the order in which nodes were reached
        std::vector<TraceStep> steps;  ///< one per expansion
    };

    /** \brief Repeats the search of ScenarioPlanner::plan() and records how its trees grow.

        A node that was replaced by a cheaper one appears as the latter.
        \param maxNodes number of nodes at which the recording ends */
    SearchTrace traceSearch(const ScenarioPlanner &planner, const PlannerParameters &parameters,
                            const PlanLimits &limits, std::size_t maxNodes);
}  // namespace parking

#pragma once

#include "automatic_parking/scenario/ScenarioPlanner.h"

#include <cstdint>
#include <vector>

namespace parking
{
    /** \brief A node of a search, to be drawn. */
    struct TraceNode
    {
        Pose pose;                ///< of the rear axle, in the scenario's local coordinates
        std::uint32_t parent{0};  ///< index among the nodes of its side; its own for a root
        double curvature{0.0};    ///< 1/m, of the motion from its parent
        double length{0.0};       ///< metres, signed
        float cost{0.0f};         ///< of the way from its root
        float ahead{0.0f};        ///< what the heuristic thinks is left
        bool expanded{false};     ///< have its successors been looked at?
    };

    /** \brief How far the two trees had grown at a moment of the search. */
    struct TraceStep
    {
        std::uint64_t expanded{0};  ///< expansions so far
        std::uint32_t start{0};     ///< nodes of the start's tree
        std::uint32_t goal{0};      ///< nodes of the goal's tree
        bool solved{false};         ///< a solution is known
    };

    /** \brief How a search went, step by step. */
    struct SearchTrace
    {
        std::vector<TraceNode> start,  ///< the tree that grows from the start, in the order in which nodes were reached
            goal;                      ///< the tree that grows from the goals, likewise
        std::vector<TraceStep> steps;  ///< one for each expansion
    };

    /** \brief Runs the search of ScenarioPlanner::plan() once more and writes down how its trees grow.

        A node that was replaced by a cheaper one is shown as the latter. \param mostNodes ends the recording */
    SearchTrace traceSearch(const ScenarioPlanner &planner, const PlannerParameters &parameters,
                            const PlanLimits &limits, std::size_t mostNodes);
}  // namespace parking

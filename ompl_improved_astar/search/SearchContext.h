#pragma once

#include "ompl_improved_astar/search/CarInSpace.h"
#include "ompl_improved_astar/search/CostModel.h"
#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/planning/Parameters.h"

#include <cstdint>

namespace parking::search
{
    /** \brief What the parts of a search share: world, parameters, car and costs of the query. All outlive it. */
    struct SearchContext
    {
        MotionEnvironment &environment;       ///< the world
        const PlannerParameters &parameters;  ///< of the user
        const CarInSpace &car;                ///< what plans
        const CostModel &cost;                ///< what motions cost
    };

    /** \brief What a search did. */
    struct SearchStatistics
    {
        std::uint64_t expanded{0};             ///< nodes whose motions were tried
        std::uint64_t generated{0};            ///< motions tried
        std::uint64_t connections{0};          ///< pairs of poses that were joined by curves, or tried to be
        std::uint64_t heuristicCells{0};       ///< cells settled by the route round the obstacles
        std::uint64_t openListOperations{0};   ///< entries pushed to, and popped from, the open lists
        std::uint64_t openListComparisons{0};  ///< of their entries with each other, for that

        /** \brief Adds what another search did. */
        SearchStatistics &operator+=(const SearchStatistics &other)
        {
            expanded += other.expanded;
            generated += other.generated;
            connections += other.connections;
            heuristicCells += other.heuristicCells;
            openListOperations += other.openListOperations;
            openListComparisons += other.openListComparisons;
            return *this;
        }
    };
}  // namespace parking::search

#pragma once

#include "ompl_improved_astar/search/CarInSpace.h"
#include "ompl_improved_astar/search/CostModel.h"
#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/planning/Parameters.h"

#include <cstdint>

namespace parking::search
{
    /** \brief A query, as all parts of a search see it. The environment outlives it. */
    struct SearchContext
    {
        MotionEnvironment &environment;  ///< the world
        PlannerParameters parameters;    ///< of the user
        CarInSpace car;                  ///< what plans
        CostModel cost;                  ///< what motions cost
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
        double loadingTime{0.0};               ///< seconds spent on finding out beforehand what is free

        /** \brief Adds what another search did. */
        SearchStatistics &operator+=(const SearchStatistics &other)
        {
            expanded += other.expanded;
            generated += other.generated;
            connections += other.connections;
            heuristicCells += other.heuristicCells;
            openListOperations += other.openListOperations;
            openListComparisons += other.openListComparisons;
            loadingTime += other.loadingTime;
            return *this;
        }
    };
}  // namespace parking::search

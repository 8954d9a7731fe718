#pragma once

#include "ompl_improved_astar/search/CarInSpace.h"
#include "ompl_improved_astar/search/CostModel.h"
#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/planning/Parameters.h"

#include <cstdint>

namespace parking::search
{
    /** \brief Data of a query, shared by all parts of a search. The environment must outlive it. */
    struct SearchContext
    {
        MotionEnvironment &environment;  ///< the world
        PlannerParameters parameters;    ///< parameters of the planner
        CarInSpace car;                  ///< car and space
        CostModel cost;                  ///< cost of motions
    };

    /** \brief Work of a search. */
    struct SearchStatistics
    {
        std::uint64_t expanded{0};             ///< nodes whose motions were tried
        std::uint64_t generated{0};            ///< motions tried
        std::uint64_t connections{0};          ///< pairs of poses between which curves were sought
        std::uint64_t heuristicCells{0};       ///< cells settled by routes around obstacles
        std::uint64_t openListOperations{0};   ///< entries pushed to and popped from open lists
        std::uint64_t openListComparisons{0};  ///< comparisons between entries of open lists
        double loadingTime{0.0};               ///< seconds spent classifying cells before the search

        /** \brief Adds the work of another search. */
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

#pragma once

#include "automatic_parking/scenario/ScenarioPlanner.h"
#include "automatic_parking/scenario/SearchTrace.h"

namespace parking::playground
{
    /** \brief A plan of the textbook's Hybrid A* and the tree of its search. */
    struct TextbookPlan
    {
        ScenarioPlan plan;  ///< as of ScenarioPlanner::plan(); the cost is the length
        SearchTrace trace;  ///< the tree from the start, at most \e maxNodes of it
    };

    /** \brief Plans from the start to the first free goal by a TextbookSearch.

        \param maxNodes number of nodes up to which the tree is recorded; 0: no record
        Throws parking::Error if the world has too many cells. */
    TextbookPlan planByTextbook(const ScenarioPlanner &planner, const PlanLimits &limits, std::size_t maxNodes);
}  // namespace parking::playground

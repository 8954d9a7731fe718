#pragma once

#include "ompl_improved_astar/search/Node.h"
#include "ompl_improved_astar/search/Registry.h"
#include "ompl_improved_astar/search/SearchContext.h"

#include <vector>

namespace parking::search
{
    /** \brief Estimate of the cost from a pose to the nearest target, interchangeable. Each side has its own object. */
    class Heuristic
    {
    public:
        virtual ~Heuristic() = default;

        /** \brief Begins a query. \param side side of the queried poses \param targets roots of the other side, at
least one */
        virtual void begin(const SearchContext &context, Side side, const std::vector<Pose> &targets) = 0;

        /** \brief The estimate that guides the search, in metres. For a pose on the goal's side the car drives from the
            target to the pose. */
        virtual double estimate(const Pose &pose) = 0;

        /** \brief Lower bound of the cost of any path, in metres. */
        virtual double lowerBound(const Pose &pose) = 0;

        /** \brief Replaces the targets by \e pose (see ModelTraits::aims). The default ignores the call. */
        virtual void aim(const Pose & /*pose*/)
        {
        }
    };

    /** \brief The heuristics by name. */
    Registry<Heuristic> &heuristics();
}  // namespace parking::search

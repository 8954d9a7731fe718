#pragma once

#include "ompl_improved_astar/search/Node.h"
#include "ompl_improved_astar/search/Registry.h"
#include "ompl_improved_astar/search/SearchContext.h"

#include <vector>

namespace parking::search
{
    /** \brief An estimate of the cost from a pose to the nearest of some targets: an interchangeable part of the
       search. One object for each side. */
    class Heuristic
    {
    public:
        virtual ~Heuristic() = default;

        /** \brief Begins a query.

            \param side of the poses that are asked about
            \param targets of the other side; at least one, or nothing is asked */
        virtual void begin(const SearchContext &context, Side side, const std::vector<Pose> &targets) = 0;

        /** \brief The estimate that guides the search, in metres. For a pose on the goal's side the car drives from the
            target to the pose. */
        virtual double estimate(const Pose &pose) = 0;

        /** \brief A bound in metres that no path costs less than. */
        virtual double lowerBound(const Pose &pose) = 0;

        /** \brief From now on estimates count to \e pose instead of to the targets (see ModelTraits::aims). Heuristics
            that cannot be aimed again ignore it. */
        virtual void aim(const Pose & /*pose*/)
        {
        }
    };

    /** \brief The heuristics by name. */
    Registry<Heuristic> &heuristics();
}  // namespace parking::search

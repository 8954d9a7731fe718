#pragma once

#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/Node.h"
#include "ompl_improved_astar/search/Registry.h"
#include "ompl_improved_astar/search/SearchParameters.h"

#include <cstdint>
#include <vector>

namespace parking::search
{
    /** \brief What a heuristic is asked about in a query. */
    struct HeuristicQuery
    {
        MotionEnvironment &environment;      ///< the world
        const SearchParameters &parameters;  ///< of the search
        Side side;                           ///< of the poses that are asked about
        const std::vector<Pose> &roots;      ///< of that side
        const std::vector<Pose> &targets;    ///< of the other side; at least one
        const StopFunction &stop;            ///< for what takes long; may be empty
    };

    /** \brief What it costs at least, or about, to get from a pose to the nearest of some targets: the interchangeable
        part of the search that looks ahead. One object for each side. */
    class Heuristic
    {
    public:
        virtual ~Heuristic() = default;

        /** \brief Forgets what was asked before; memory is kept. What the query refers to outlives its questions. */
        virtual void begin(const HeuristicQuery &query) = 0;

        /** \brief The estimate that guides the search, in metres. For a pose on the goal's side the car drives from the
            target to the pose. */
        virtual double estimate(const Pose &pose) = 0;

        /** \brief May estimates exceed what the shortest way costs by more than its steps are rounded? With weights of
           1 the search then leaves out cheaper ways without taking note of them, and bounds its solutions by
            lowerBound() of the roots only. */
        virtual bool overestimates() const
        {
            return false;
        }

        /** \brief A bound in metres that no way costs less than. */
        virtual double lowerBound(const Pose &pose) = 0;

        /** \brief From now on estimates count to \e pose instead of to the targets (see ModelTraits::aims). Heuristics
            that cannot be aimed anew pay no heed. */
        virtual void aim(const Pose & /*pose*/)
        {
        }

        /** \brief Has it been found out, for certain, that there is no way from \e pose? */
        virtual bool provesUnreachable(const Pose & /*pose*/)
        {
            return false;
        }

        /** \brief Cells looked at, for the statistics. */
        virtual std::uint64_t cells() const
        {
            return 0;
        }
    };

    /** \brief The heuristics by name. */
    Registry<Heuristic> &heuristics();
}  // namespace parking::search

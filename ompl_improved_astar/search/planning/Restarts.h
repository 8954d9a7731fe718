#pragma once

#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/SearchParameters.h"
#include "ompl_improved_astar/search/planning/SideSearch.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/Path.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace parking::search
{
    /** \brief Searches that begin anew, one after the other, each with motions of other lengths and other weights.

        A search goes on in the trees that its first decisions have grown: what lies off them comes late, if at all. One
        that begins anew is rid of them (after S. Richter, J. Thayer and W. Ruml, "The joy of forgetting: faster anytime
        search via restarting", 2010), and one whose motions are longer or shorter sees other poses besides. Each search
        may expand more nodes than the one before. Deterministic: equal queries, limits and expansions give equal paths.
     */
    class Restarts
    {
    public:
        /** \brief Forgets everything; \e environment must outlive it. The searches go by \e parameters but for what is
            said above; every other one does not spread out, none loads obstacles beforehand or looks for a proof, and
            none is greedy in its detours. */
        void begin(MotionEnvironment &environment, const SearchParameters &parameters);

        /** \brief Changes SearchParameters::maxMemory of those that are yet to begin. */
        void setMaxMemory(std::size_t bytes)
        {
            parameters_.maxMemory = bytes;
        }

        /** \brief Adds a root, which must be free. The search under way, which does not know it, is ended. */
        void addStart(const Pose &pose)
        {
            starts_.push_back(pose);
            side_.end();
        }

        /** \brief The same for a goal. */
        void addGoal(const Pose &pose)
        {
            goals_.push_back(pose);
            side_.end();
        }

        /** \brief Goes on with the search under way and then begins others, until expanded() or searches() is that
           many.

            \param mostCost a path that costs as much is of no use
            \return whether there is a new path(), cheaper than those that the same search has found before; false also
            when it is stopped */
        bool run(const StopFunction &stop, std::uint64_t mostExpansions, std::uint64_t mostSearches, double mostCost);

        /** \brief What run() has found. */
        const Path &path() const
        {
            return side_.search().bestPath();
        }

        /** \brief What it costs. */
        double cost() const
        {
            return side_.search().bestCost();
        }

        /** \brief Nodes expanded since begin(). */
        std::uint64_t expanded() const
        {
            return side_.expanded();
        }

        /** \brief Searches begun since begin(). */
        std::uint64_t searches() const
        {
            return searches_;
        }

        /** \brief What all searches did since begin(). */
        SearchStatistics statistics() const
        {
            return side_.statistics();
        }

    private:
        bool beginNext(const StopFunction &stop, double mostCost);

        MotionEnvironment *environment_{nullptr};
        SearchParameters parameters_;
        std::vector<Pose> starts_, goals_;
        SideSearch side_;
        HeuristicWeights weights_;  // of the search under way
        std::uint64_t searches_{0};
        std::uint64_t most_{0};  // expansions of the one under way
    };
}  // namespace parking::search

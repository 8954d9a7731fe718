#pragma once

#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/SearchParameters.h"
#include "ompl_improved_astar/search/planning/CloseParts.h"
#include "ompl_improved_astar/search/planning/RoomyEnvironment.h"
#include "ompl_improved_astar/search/planning/SideSearch.h"
#include "parking_geometry/curves/Path.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace parking::search
{
    /** \brief Plans those parts of a path anew that come nearer to obstacles than preferred.

        PathWidener leads a path through a pose beside it. Where that is not enough, as where the car turns round in
        several moves, a search looks for another way, between a pose before the part and one behind it, that keeps the
        preference as a condition (RoomyEnvironment). Deterministic; one object may serve many queries and keeps its
        memory. */
    class PathReplanner
    {
    public:
        /** \brief Begins a new query in \e environment, which must outlive it.

            \param parameters of the search */
        void begin(MotionEnvironment &environment, const SearchParameters &parameters);

        /** \brief What bounds the search for one part. */
        struct Effort
        {
            std::uint64_t expansions;  ///< no more than so many,
            std::size_t memory;        ///< and no more bytes
        };

        /** \brief The path with another way round the \e part of it that is too near.

            \param path costs something for the clearance that it does not keep
            \param part of the path
            \return none when no such way is found that looks cheaper, piece by piece, than what it replaces, when the
                    car cannot keep the preference where the way would have to begin or end, or when it is time to
                    stop */
        std::optional<Path> replan(const Path &path, const ClosePart &part, const Effort &effort,
                                   const StopFunction &stop);

        /** \brief Nodes expanded in this query: statistics().expanded. */
        std::uint64_t expanded() const
        {
            return side_.expanded();
        }

        /** \brief What its searches did in this query, and how many pairs of poses were joined to shorten what they
            found. */
        SearchStatistics statistics() const;

    private:
        /** Can the car keep the preference there and a little farther, forwards or backwards? */
        bool canLeaveWithRoom(const Pose &pose);
        /** Metres along the path to where the new way begins or ends: from \e place on towards \e end, in steps of a
            turning radius, the first where the car can leave with room; none if it is not among the first few. */
        std::optional<double> placeWithRoom(const Path &path, double place, double end);

        MotionEnvironment *environment_{nullptr};
        SearchParameters parameters_;
        std::optional<RoomyEnvironment> roomy_;
        SideSearch side_;
        std::uint64_t connections_{0};  // to shorten what was found in this query
    };
}  // namespace parking::search

#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include <ompl/config.h>

#if OMPL_VERSION_VALUE < 1005000
#error "OMPL 1.5 or later is needed (the package libompl-dev of Debian 12 or Ubuntu 22.04, and later)"
#endif

namespace parking
{
    /** \brief Uniform access to interfaces that differ between the releases 1.5 to 2.0 of OMPL.

        Overloads depend on the members of a type instead of version numbers, because packagers patch releases. */
    namespace ompl_compatibility
    {
        /** \brief The shortest curve of a Reeds-Shepp space by reedsShepp(from, to), up to OMPL 1.6.

            A last argument of 0 selects the overload that exists for the space and the release. */
        template <class Space, class State>
        auto shortestCurve(const Space &space, const State *from, const State *to, int /*preferred*/)
            -> decltype(space.reedsShepp(from, to))
        {
            return space.reedsShepp(from, to);
        }

        /** \brief The shortest curve of a Dubins space by dubins(from, to), up to OMPL 1.6. */
        template <class Space, class State>
        auto shortestCurve(const Space &space, const State *from, const State *to, int /*preferred*/)
            -> decltype(space.dubins(from, to))
        {
            return space.dubins(from, to);
        }

        /** \brief The shortest curve of a Reeds-Shepp or Dubins space by getPath(from, to), from OMPL 1.7. */
        template <class Space, class State>
        auto shortestCurve(const Space &space, const State *from, const State *to, long /*otherwise*/)
            -> decltype(space.getPath(from, to))
        {
            return space.getPath(from, to);
        }

        /** \brief The kind of a piece, for curves with a pointer to the first kind. */
        template <class Kind>
        Kind pieceKind(const Kind *kinds, std::size_t index)
        {
            return kinds[index];
        }

        /** \brief The kind of a piece, for curves with a pointer to a vector of kinds (later releases). */
        template <class Kind>
        Kind pieceKind(const std::vector<Kind> *kinds, std::size_t index)
        {
            return (*kinds)[index];
        }

        /** \brief The status of a problem without a solution, for releases with INFEASIBLE (1.6 and later).

            A last argument of 0 selects the overload that exists for the release. */
        template <class Status>
        auto infeasible(int /*preferred*/) -> decltype(Status(Status::INFEASIBLE))
        {
            return Status::INFEASIBLE;
        }

        /** \brief The status of a problem without a solution, for releases before 1.6: TIMEOUT. */
        template <class Status>
        Status infeasible(long /*otherwise*/)
        {
            return Status::TIMEOUT;
        }

        /** \brief Increments a plain counter atomically, because several threads write OMPL's counters of checked
            motions. */
        inline void countUp(unsigned int &counter)
        {
            __atomic_fetch_add(&counter, 1U, __ATOMIC_RELAXED);
        }

        /** \brief Increments an atomic counter, for releases with atomic counters. */
        template <class Integer>
        void countUp(std::atomic<Integer> &counter)
        {
            counter.fetch_add(1, std::memory_order_relaxed);
        }
    }  // namespace ompl_compatibility
}  // namespace parking

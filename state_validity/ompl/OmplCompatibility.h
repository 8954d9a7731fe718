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
    /** \brief What differs between the releases 1.5 to 2.0 of OMPL, as far as this library meets it.

        Overloads choose by what a type offers, never by a version number: packagers patch releases. */
    namespace ompl_compatibility
    {
        /** \brief The shortest curve of a Reeds-Shepp space: reedsShepp(from, to), as up to OMPL 1.6. Call it with 0 as
            the last argument, here and below, to get the overload that the space and the release have. */
        template <class Space, class State>
        auto shortestCurve(const Space &space, const State *from, const State *to, int /*preferred*/)
            -> decltype(space.reedsShepp(from, to))
        {
            return space.reedsShepp(from, to);
        }

        /** \brief The shortest curve of a Dubins space: dubins(from, to), as up to OMPL 1.6. */
        template <class Space, class State>
        auto shortestCurve(const Space &space, const State *from, const State *to, int /*preferred*/)
            -> decltype(space.dubins(from, to))
        {
            return space.dubins(from, to);
        }

        /** \brief That of either as getPath(from, to), from OMPL 1.7 on. */
        template <class Space, class State>
        auto shortestCurve(const Space &space, const State *from, const State *to, long /*otherwise*/)
            -> decltype(space.getPath(from, to))
        {
            return space.getPath(from, to);
        }

        /** \brief The kind of a piece of a curve, where the curve has a pointer to the first kind. */
        template <class Kind>
        Kind pieceKind(const Kind *kinds, std::size_t index)
        {
            return kinds[index];
        }

        /** \brief The same where, in later releases, the curve has a pointer to a vector of kinds. */
        template <class Kind>
        Kind pieceKind(const std::vector<Kind> *kinds, std::size_t index)
        {
            return (*kinds)[index];
        }

        /** \brief The status of a problem without solution: INFEASIBLE where OMPL has it (1.6 and later), else
            TIMEOUT. */
        template <class Status>
        auto infeasible(int /*preferred*/) -> decltype(Status(Status::INFEASIBLE))
        {
            return Status::INFEASIBLE;
        }

        /** \brief The same for releases before 1.6. */
        template <class Status>
        Status infeasible(long /*otherwise*/)
        {
            return Status::TIMEOUT;
        }

        /** \brief Counts one up. OMPL's counters of checked motions are plain integers that several threads write. */
        inline void countUp(unsigned int &counter)
        {
            __atomic_fetch_add(&counter, 1U, __ATOMIC_RELAXED);
        }

        /** \brief The same where the counters are atomic. */
        template <class Integer>
        void countUp(std::atomic<Integer> &counter)
        {
            counter.fetch_add(1, std::memory_order_relaxed);
        }
    }  // namespace ompl_compatibility
}  // namespace parking

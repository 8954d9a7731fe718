#pragma once

#include "parking_geometry/Box.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/Path.h"
#include "state_validity/sweeps/Escape.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace parking::search
{
    /** \brief Set of headings: one bit per equal part of the circle, the first beginning at minus pi. */
    using HeadingSet = std::array<std::uint64_t, 2>;

    /** \brief Headings at which the body collides for every position of its centre in a square cell around (x, y). */
    using BlockedHeadings = std::function<HeadingSet(double x, double y)>;

    /** \brief The world as seen by the search. One search uses one environment from one thread.

        Poses are those of the rear axle's midpoint in the coordinates of the problem. An environment with slow checks
        polls its own stop function: after that it returns "no" unchecked, and wasInterrupted() is true. */
    class MotionEnvironment
    {
    public:
        virtual ~MotionEnvironment() = default;

        /** \brief Whether the car is free of obstacles at \e pose. */
        virtual bool isFree(const Pose &pose) = 0;

        /** \brief Computes how far the car can drive along each of \e count arcs from a pose while keeping a clearance.

            \param clearance metres. With 0 the result is exact, and \e from must be free. Otherwise it is a lower
            bound, 0 if unknown
            \param lengths receives one length per arc, between 0 and the length of the arc */
        virtual void freeLengths(const Pose &from, const Arc *arcs, std::size_t count, double clearance,
                                 double *lengths) = 0;

        /** \brief freeLengths() of one arc. */
        double freeLength(const Pose &from, const Arc &arc, double clearance = 0.0)
        {
            double length = 0.0;
            freeLengths(from, &arc, 1, clearance, &length);
            return length;
        }

        /** \brief Whether the car provably keeps \e clearance metres from all obstacles at \e pose. */
        virtual bool keeps(const Pose & /*pose*/, double /*clearance*/)
        {
            return false;
        }

        /** \brief Whether a motion with linear position and heading is free: a straight line, a turn on the spot, or
            both. \e from must be free. */
        virtual bool isMotionFree(const Pose &from, const Pose &to) = 0;

        /** \brief Upper bound of the distance between (x, y), a point within the bounds, and the nearest obstacle, in
            metres; infinite if unknown. A car with a larger inscribed circle at the rear axle cannot be there. */
        virtual double roomAt(double x, double y) = 0;

        /** \brief Returns a function that gives the blocked headings of a cell of body positions, for proofs that no
            path exists.

            The arguments are the side of a cell in metres and the number of equal parts of the circle, 8 to 128.
            Returns an empty function if the environment cannot prove collisions. */
        virtual BlockedHeadings blockedHeadings(double /*side*/, int /*headings*/)
        {
            return {};
        }

        /** \brief Motions that lead the car out of a contact at \e pose that is at most \e maxDepth metres deep,
            shortest first; see EscapeFinder. Empty if the environment cannot measure depths. */
        virtual std::vector<Escape> escapes(const Pose & /*pose*/, double /*maxDepth*/, double /*turningRadius*/,
                                            bool /*forwardOnly*/)
        {
            return {};
        }

        /** \brief Final check of a whole path whose pieces are free. */
        virtual bool acceptPath(const Path & /*path*/)
        {
            return true;
        }

        /** \brief Bounds of the rear axle's positions, obstacles aside. */
        virtual Box bounds() const = 0;

        /** \brief Whether clearances are known; otherwise they cost nothing. */
        virtual bool knowsClearance() const
        {
            return true;
        }

        /** \brief Whether isFree() depends on the heading; for the paper's circle it does not. */
        virtual bool headingMatters() const
        {
            return true;
        }

        /** \brief Whether a check returned "no" only because the stop function returned true. */
        virtual bool wasInterrupted() const
        {
            return false;
        }
    };
}  // namespace parking::search

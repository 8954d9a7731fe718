#pragma once

#include "parking_geometry/Box.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/Path.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace parking::search
{
    /** \brief A bit for each part of the circle of headings, the first of which begins at minus pi. */
    using HeadingSet = std::array<std::uint64_t, 2>;

    /** \brief The headings at which the body collides wherever its middle stands in a square cell around (x, y). */
    using BlockedHeadings = std::function<HeadingSet(double x, double y)>;

    /** \brief What the search asks of the world. One search uses one environment from one thread.

        Poses are of the rear axle's midpoint, in the coordinates of the problem. An environment whose answers take long
        polls its own stop function: once the time is up it answers "no" without looking, and wasInterrupted(). */
    class MotionEnvironment
    {
    public:
        virtual ~MotionEnvironment() = default;

        /** \brief Is the car free of obstacles at \e pose? */
        virtual bool isFree(const Pose &pose) = 0;

        /** \brief How far the car can drive along each of some arcs from a pose while it keeps a clearance everywhere.

            \param clearance metres; with 0 the car is free of obstacles, and \e from is known to be free. With more the
            answer is a lower bound, 0 where nothing is known
            \param lengths receives one length for each arc, between 0 and the arc's own, which stands for all of it */
        virtual void freeLengths(const Pose &from, const Arc *arcs, std::size_t count, double clearance,
                                 double *lengths) = 0;

        /** \brief freeLengths() of one arc. */
        double freeLength(const Pose &from, const Arc &arc, double clearance = 0.0)
        {
            double length = 0.0;
            freeLengths(from, &arc, 1, clearance, &length);
            return length;
        }

        /** \brief Does the car surely keep that many metres from all obstacles at \e pose? */
        virtual bool keeps(const Pose & /*pose*/, double /*clearance*/)
        {
            return false;
        }

        /** \brief Is the motion free along which position and heading change evenly: a straight line, a turn on the
            spot, or both at once? \e from is known to be free, \e to may not be. */
        virtual bool isMotionFree(const Pose &from, const Pose &to) = 0;

        /** \brief An upper bound of the distance between the point (x, y), which lies within the bounds, and the
            nearest obstacle, in metres; infinite when it is not known. A car whose inscribed circle at the rear axle is
            larger cannot be there. */
        virtual double roomAt(double x, double y) = 0;

        /** \brief What cells of the body's middle are blocked, for a proof that there is no path.

            The first argument is the side of a cell in metres, the second the number of equal parts of the circle, 8 to
            128. Returns an empty function when it is not known where the body surely collides. */
        virtual BlockedHeadings blockedHeadings(double /*side*/, int /*headings*/)
        {
            return {};
        }

        /** \brief A last word on a whole path whose pieces were all found free. */
        virtual bool acceptPath(const Path & /*path*/)
        {
            return true;
        }

        /** \brief Where the rear axle may be, whatever the obstacles. */
        virtual Box bounds() const = 0;

        /** \brief Is anything known of clearances? Where not, they cost nothing. */
        virtual bool knowsClearance() const
        {
            return true;
        }

        /** \brief Does isFree() depend on the heading? It does not for the paper's circle round the car. */
        virtual bool headingMatters() const
        {
            return true;
        }

        /** \brief Has an answer been "no" only because the time was up? It then says nothing about the world. */
        virtual bool wasInterrupted() const
        {
            return false;
        }
    };
}  // namespace parking::search

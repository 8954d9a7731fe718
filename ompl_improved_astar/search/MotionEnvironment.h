#pragma once

#include "parking_geometry/Box.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/PoseCell.h"
#include "parking_geometry/curves/Path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>

namespace parking::search
{
    /** \brief Where the car's body surely collides, cell by cell, for proofs that there is no way.

        A cell is a square of places of the body's middle and a part of the circle of headings. */
    class BodyCells
    {
    public:
        virtual ~BodyCells() = default;

        /** \brief A bit for each part of the circle, the first of which begins at a heading of minus pi. */
        using Headings = std::array<std::uint64_t, 2>;

        /** \brief The body's middle, about which it turns with the least movement, and the heading. */
        virtual Pose middle(const Pose &rearAxle) const = 0;

        /** \brief The headings of those cells in which the body collides at every place and heading.

            \param x, y middle of the square, whose sides are parallel to the axes */
        virtual Headings blocked(double x, double y) const = 0;

        /** \brief What is known of the body's collisions in a cell. */
        enum class Contact
        {
            None,        ///< the body is free at every place and heading
            Everywhere,  ///< it collides at every place and heading
            Unknown      ///< it may be free at some and collide at others
        };

        /** \brief The same for one cell of any size, more closely. */
        virtual Contact contact(const PoseCell &cell) const = 0;
    };

    /** \brief What the search asks of the world. One search uses one environment from one thread.

        Poses are of the rear axle's midpoint, in the coordinates of the problem. */
    class MotionEnvironment
    {
    public:
        virtual ~MotionEnvironment() = default;

        /** \brief Is the car free of obstacles at \e pose? */
        virtual bool isFree(const Pose &pose) = 0;

        /** \brief A lower bound of the distance to the obstacles in metres; 0 when it is not known. */
        virtual double clearance(const Pose &pose) = 0;

        /** \brief How far the car can drive along an arc from a free pose, free in between.

            \param length signed metres
            \return between 0 and |length|; |length| itself when all of it is free */
        virtual double freeLength(const Pose &from, double curvature, double length) = 0;

        /** \brief The same for several arcs from one pose, which may share some of the work.

            \param free takes one length for each arc */
        virtual void freeLengths(const Pose &from, const Arc *arcs, std::size_t count, double *free)
        {
            for (std::size_t i = 0; i < count; ++i)
                free[i] = freeLength(from, arcs[i].curvature, arcs[i].length);
        }

        /** \brief Is anything known of clearances? Where not, they cost nothing. */
        virtual bool knowsClearance() const
        {
            return true;
        }

        /** \brief Does the car keep so many metres from all obstacles at \e pose? */
        virtual bool keeps(const Pose &pose, double clearance)
        {
            return this->clearance(pose) >= clearance;
        }

        /** \brief How far the car can drive along arcs from one pose and surely keep so many metres from all obstacles.
            What is clear is free: freeLength() is not asked about it.

            \param clear takes a length between 0 and that of the arc for each; 0 where it is not known */
        virtual void clearLengths(const Pose & /*from*/, const Arc * /*arcs*/, std::size_t count, double /*clearance*/,
                                  double *clear)
        {
            std::fill(clear, clear + count, 0.0);
        }

        /** \brief freeLengths() of arcs from one pose of which clearLengths() has told how far they are clear, and free
            therefore: that part need not be looked at again.

            \param clear what clearLengths() said of each arc */
        virtual void freeLengthsBeyond(const Pose &from, const Arc *arcs, std::size_t count, const double *clear,
                                       double *free)
        {
            for (std::size_t i = 0; i < count; ++i)
                free[i] = clear[i] >= std::abs(arcs[i].length)
                              ? std::abs(arcs[i].length)
                              : std::max(clear[i], freeLength(from, arcs[i].curvature, arcs[i].length));
        }

        /** \brief How many of some poses along an arc, each as far from the one before, do not keep a clearance?

            \param first metres driven up to the first of them, not negative
            \param apart metres from one to the next
            \param most more than so many need not be counted */
        virtual std::size_t countNearer(const Pose &from, const Arc &arc, double first, double apart,
                                        std::size_t samples, double clearance, std::size_t most)
        {
            std::size_t nearer = 0;
            for (std::size_t i = 0; i < samples && nearer <= most; ++i)
            {
                const double driven = first + apart * static_cast<double>(i);
                if (!keeps(advance(from, arc.curvature, std::copysign(driven, arc.length)), clearance))
                    ++nearer;
            }
            return nearer;
        }

        /** \brief The pose with the opposite heading at which the body covers the most of the ground that it covers at
            \e pose, as far as the body is known: else the rear axle stays where it is. */
        virtual Pose turnedRound(const Pose &pose) const
        {
            return {pose.x, pose.y, wrapAngle(pose.yaw + PI)};
        }

        /** \brief Where the rear axle may be, whatever the obstacles: everywhere, unless a world says otherwise. */
        virtual Box bounds() const
        {
            constexpr double INFINITE = std::numeric_limits<double>::infinity();
            return {{-INFINITE, -INFINITE}, {INFINITE, INFINITE}};
        }

        /** \brief An upper bound of the distance between the point (x, y), which lies within the bounds, and the
            nearest obstacle, in metres; infinite when it is not known. A car whose inscribed circle at the rear axle is
            larger cannot be there. */
        virtual double roomAt(double x, double y) = 0;

        /** \brief The same, as close to the distance as can be told, for those who ask seldom. */
        virtual double closeRoomAt(double x, double y)
        {
            return roomAt(x, y);
        }

        /** \brief isFree() for a pose of a motion that is tried: like freeLength(), it may say no because the time is
            up. */
        virtual bool isPassable(const Pose &pose)
        {
            return isFree(pose);
        }

        /** \brief Did freeLength(), isPassable(), acceptPath() or what is asked about clearances say less than they
            would have, because the time was up? The search then comes back to what it was at. */
        virtual bool wasInterrupted() const
        {
            return false;
        }

        /** \brief Is the motion free along which position and heading change evenly: a straight line, a turn on the
            spot, or both at once? \e from is known to be free, \e to may not be. */
        virtual bool isMotionFree(const Pose &from, const Pose &to) = 0;

        /** \brief Does isFree() depend on the heading? Not so for the paper's circle round the car. */
        virtual bool headingMatters() const
        {
            return true;
        }

        /** \brief Cells of the body, squares of that side in metres and 8 to 128 equal parts of the circle of headings;
            nullptr when it is not known where the body surely collides. */
        virtual std::unique_ptr<BodyCells> bodyCells(double /*side*/, int /*headings*/)
        {
            return nullptr;
        }

        /** \brief A last word on a whole path whose pieces were all found free. */
        virtual bool acceptPath(const Path & /*path*/)
        {
            return true;
        }
    };
}  // namespace parking::search

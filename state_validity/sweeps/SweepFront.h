#pragma once

#include "parking_geometry/OrientedBox.h"
#include "state_validity/sweeps/SweptBox.h"

#include <cmath>
#include <initializer_list>
#include <limits>

namespace parking
{
    /** \brief First contact of a moving box with many points and edges.

        The result is that of firstContact() at a fraction of the cost. A box that turns about a centre outside of it
        first touches obstacles with its leading outline. This consists of the front side, the inner side ahead of the
        axle, the outer side behind the axle and the three corners between them. All points turn about one centre, so

        - a point can touch the outline at no more than two places, which have the same distance from the centre and
          follow from square roots;
        - a corner can touch an edge only where the edge has the same distance from the centre as the corner: at two
          places.

        Sines replace angles in comparisons, so only the final result requires a trigonometric function.

        The front is the side ahead in the direction of travel, that is the rear bumper of a car in reverse. All members
        use the frame in which the box is given. */
    class SweepFront
    {
    public:
        /** \brief Whether this class supports a motion. For other motions use firstContact().

            Unsupported are nearly straight arcs, a centre within the box or abeam of no point of it, and turns above a
            radian. */
        static bool applies(const BoxSweep &sweep);

        /** \brief A front for the motion of \e box.

            \param middleCosine, middleSine cosine and sine of half the angle of the turn, not negative */
        SweepFront(const OrientedBox &box, const BoxSweep &sweep, double middleCosine, double middleSine);

        /** \brief Whether the moving box may touch a point of the axis-parallel box about (x, y) with the half lengths
            ex, ey. */
        bool mayMeet(double x, double y, double ex, double ey) const;

        /** \brief Lower bounds of the distance between edges from (ax, ay) to (bx, by) and a bounding box of the swept
            area. The moving box cannot touch an edge with a bound above 0. */
        template <class Array>
        Array gap(const Array &ax, const Array &ay, const Array &bx, const Array &by) const
        {
            const Array aux = ax - mx_, auy = ay - my_, bux = bx - mx_, buy = by - my_;
            const Array alongA = aux * mdx_ + auy * mdy_, alongB = bux * mdx_ + buy * mdy_;
            const Array acrossA = auy * mdx_ - aux * mdy_, acrossB = buy * mdx_ - bux * mdy_;
            const Array alongGap = (alongA.min(alongB) - high_).max(low_ - alongA.max(alongB));
            const Array acrossGap = (acrossA.min(acrossB) - left_).max(right_ - acrossA.max(acrossB));
            return alongGap.max(acrossGap);
        }

        /** \brief Records the contact with the point if it precedes all recorded contacts. */
        void meetPoint(double x, double y);

        /** \brief Records the contact of a corner of the box with an edge if it precedes all recorded contacts.

            The edge leads from (ax, ay) to (bx, by) and has the unit normal (nx, ny). */
        void meetEdge(double ax, double ay, double bx, double by, double nx, double ny);

        /** \brief Metres along the motion until the first recorded contact; infinite if there is none. */
        double contact() const;

    private:
        struct Corner
        {
            double x, y;    // from the centre of the arc; for a straight motion from the centre of the box
            double square;  // of the distance from the centre
        };

        void noteTurn(double sineTimesSquare, double cosineTimesSquare, double square)
        {
            if (sineTimesSquare >= 0.0 && sineTimesSquare <= limit_ * square && cosineTimesSquare > 0.0)
            {
                limit_ = sineTimesSquare / square;
                met_ = true;
            }
        }

        void noteDistance(double distance)
        {
            if (distance >= 0.0 && distance <= limit_)
            {
                limit_ = distance;
                met_ = true;
            }
        }

        bool straight_;
        bool met_{false};
        double limit_;    // of the sine of the angle; of the distance if straight
        double radius_;   // of the arc of the axle
        double turning_;  // 1 if the motion turns left, -1 if right
        double cx_, cy_;  // centre of the arc; of the box if straight
        double dx_, dy_;  // direction of travel
        double lx_, ly_;  // towards the centre
        double front_, back_, inner_,
            outer_;  // of the outline: distances of its sides from the axle and from the centre
        double innerSquare_, outerSquare_, nearest_, farthest_;
        Corner frontInner_, frontOuter_, rearOuter_;
        // The frame of the box half way and, in it, a bounding box of the swept area.
        double mx_, my_, mdx_, mdy_;
        double low_, high_, left_, right_;
    };

    inline bool SweepFront::mayMeet(double x, double y, double ex, double ey) const
    {
        const double ux = x - mx_, uy = y - my_;
        const double along = ux * mdx_ + uy * mdy_, across = uy * mdx_ - ux * mdy_;
        const double mdx = std::abs(mdx_), mdy = std::abs(mdy_);
        const double alongReach = ex * mdx + ey * mdy, acrossReach = ey * mdx + ex * mdy;
        if (along - alongReach > high_ || along + alongReach < low_ || across - acrossReach > left_ ||
            across + acrossReach < right_)
            return false;
        if (straight_)
            return true;
        const double wx = std::abs(x - cx_), wy = std::abs(y - cy_);
        const double nearX = wx > ex ? wx - ex : 0.0, nearY = wy > ey ? wy - ey : 0.0;
        const double farX = wx + ex, farY = wy + ey;
        return nearX * nearX + nearY * nearY <= farthest_ && farX * farX + farY * farY >= nearest_;
    }

    inline void SweepFront::meetPoint(double x, double y)
    {
        const double wx = x - cx_, wy = y - cy_;
        const double ux = wx * dx_ + wy * dy_, uy = wx * lx_ + wy * ly_;
        if (straight_)
        {
            if (std::abs(uy) <= outer_)
                noteDistance(ux - front_);
            return;
        }
        const double square = wx * wx + wy * wy;
        if (square < nearest_ || square > farthest_)
            return;
        // The place where the point, seen from the box, reaches either the front or the inner side.
        if (square <= frontOuter_.square)
        {
            const bool onFront = square > frontInner_.square;
            const double root = std::sqrt(square - (onFront ? front_ * front_ : innerSquare_));
            const double qx = onFront ? front_ : root, qy = onFront ? -root : -inner_;
            noteTurn(qx * uy - qy * ux, qx * ux + qy * uy, square);
        }
        if (square >= outerSquare_ && square <= rearOuter_.square)
        {
            const double qx = -std::sqrt(square - outerSquare_);
            noteTurn(qx * uy + outer_ * ux, qx * ux - outer_ * uy, square);
        }
    }

    inline void SweepFront::meetEdge(double ax, double ay, double bx, double by, double nx, double ny)
    {
        const double awx = ax - cx_, awy = ay - cy_, bwx = bx - cx_, bwy = by - cy_;
        if (straight_)
        {
            const double aux = awx * dx_ + awy * dy_, auy = awx * lx_ + awy * ly_;
            const double bux = bwx * dx_ + bwy * dy_, buy = bwx * lx_ + bwy * ly_;
            for (const double side : {-outer_, outer_})
                if ((auy < side) != (buy < side))
                    noteDistance(aux + (bux - aux) * (side - auy) / (buy - auy) - front_);
            return;
        }
        const double distance = nx * awx + ny * awy, square = distance * distance;
        if (square > farthest_)
            return;
        // Places on the edge's line are given by their distance from the foot of the centre, positive to the edge's
        // left.
        constexpr double SLACK = 1e-11;
        const double a = nx * awy - ny * awx, b = nx * bwy - ny * bwx;
        const double from = (a < b ? a : b) - SLACK, to = (a < b ? b : a) + SLACK;
        for (const Corner *corner : {&frontInner_, &frontOuter_, &rearOuter_})
        {
            if (square > corner->square)
                continue;
            const double half = std::sqrt(corner->square - square);
            const double across = corner->x * nx + corner->y * ny, along = corner->y * nx - corner->x * ny;
            if (half >= from && half <= to)
                noteTurn(turning_ * (half * across - distance * along), distance * across + half * along,
                         corner->square);
            if (-half >= from && -half <= to)
                noteTurn(turning_ * (-half * across - distance * along), distance * across - half * along,
                         corner->square);
        }
    }

    inline double SweepFront::contact() const
    {
        if (!met_)
            return std::numeric_limits<double>::infinity();
        return straight_ ? limit_ : std::asin(limit_) * radius_;
    }
}  // namespace parking

#pragma once

#include "parking_geometry/OrientedBox.h"
#include "state_validity/sweeps/SweptBox.h"

#include <cmath>
#include <initializer_list>
#include <limits>

namespace parking
{
    /** \brief The leading side of a moving box, tried against many points and edges for the first contact.

        The same answer as firstContact() at a fraction of the cost. What a box that turns about a centre outside of it
        can meet first is its leading outline only: its front side, its inner side ahead of the axle, its outer side
        behind the axle (which swings out), and the three corners between these. Everything turns about one centre, so

        - a point can meet the box only where its distance from the centre is the distance of a place of that outline:
          at most two places, found by one square root each;
        - a corner can meet an edge only where the edge is as far from the centre as the corner: two places.

        Angles are compared by their sines, so nothing but square roots is computed until the end.

        "Front" is the side ahead in the direction of travel: the bumper at the rear when driving in reverse.

        All members of this class work in the frame in which the box is given. */
    class SweepFront
    {
    public:
        /** \brief Whether a motion is of the kind that this class knows; for the others (nearly straight arcs, a centre
            within the box or abeam of no point of it, more than a radian at a time) there is firstContact(). */
        static bool applies(const BoxSweep &sweep);

        /** \brief \param middleCosine, middleSine of half the angle turned through on the way, not negative */
        SweepFront(const OrientedBox &box, const BoxSweep &sweep, double middleCosine, double middleSine);

        /** \brief Can anything within the axis-parallel box round (x, y) with the half lengths ex, ey be met? */
        bool mayMeet(double x, double y, double ex, double ey) const;

        /** \brief For arrays of edges from (ax, ay) to (bx, by): how far each is at least from a box round all that is
            swept. Those above 0 cannot be met. */
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

        /** \brief Notes when the box meets the point, if it does before everything noted so far. */
        void meetPoint(double x, double y);

        /** \brief Notes when a corner of the box meets the edge from (ax, ay) to (bx, by) with the unit normal (nx,
            ny). */
        void meetEdge(double ax, double ay, double bx, double by, double nx, double ny);

        /** \brief Metres along the motion until the first contact noted; infinite when there was none. */
        double contact() const;

    private:
        struct Corner
        {
            double x, y;    // from the centre; for a straight motion from the middle of the box
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
        double limit_;    // of the sine of the angle, or of the distance when straight
        double radius_;   // of the axle's arc
        double turning_;  // 1 when the motion turns left, -1 right
        double cx_, cy_;  // centre of the arc; of the box when straight
        double dx_, dy_;  // direction of travel
        double lx_, ly_;  // towards the centre
        double front_, back_, inner_,
            outer_;  // of the outline: distances of its sides from the axle and from the centre
        double innerSquare_, outerSquare_, nearest_, farthest_;
        Corner frontInner_, frontOuter_, rearOuter_;
        // The frame of the box half way, and a box in it that holds all that is swept.
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
        // Where the point, seen from the box, comes to lie on the front or on the inner side: one or the other.
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
        // Places on the edge's line are told by how far they are from the foot of the centre, to the edge's left.
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

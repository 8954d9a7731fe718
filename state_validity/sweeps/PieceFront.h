#pragma once

#include "parking_geometry/OrientedBox.h"
#include "state_validity/Body.h"
#include "state_validity/sweeps/SweptBox.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace parking
{
    /** \brief First contact of a moving convex piece of a body with many points and edges; the SweepFront of outlines.

        All points turn about one centre. A side moves outwards only on one side of the foot of the perpendicular from
        this centre, and there its points have different distances from the centre. Therefore

        - a point can touch each leading part of a side at one place, which follows from a square root;
        - a corner of a leading part can touch an edge at two places, as in SweepFront.

        The centre may lie anywhere, also inside of the body. */
    class PieceFront
    {
    public:
        /** \brief Whether this class supports a motion: not nearly straight arcs and turns above a radian. For other
            motions use firstContact(). */
        static bool applies(const BoxSweep &sweep);

        /** \brief A front for the motion of \e piece, given in the frame of \e box and enlarged by \e more metres.

            \param sweep the motion; its half lengths are not used
            \param sineOfTurn sine of the angle of the turn, not negative */
        PieceFront(const BodyPiece &piece, double more, const OrientedBox &box, const BoxSweep &sweep,
                   double sineOfTurn);

        /** \brief Records the contacts of the piece with an edge that precede all recorded contacts.

            The edge leads from (ax, ay) to (bx, by) and has the unit normal (nx, ny). */
        void meet(double ax, double ay, double bx, double by, double nx, double ny);

        /** \brief Metres along the motion until the first recorded contact; infinite if there is none. */
        double contact() const;

    private:
        /** The leading part of a side in the frame of the motion: x along the direction of travel, y towards the
            centre. */
        struct Part
        {
            double nx, ny;     // unit normal, outwards
            double distance;   // of its line from the centre, along the normal
            double low, high;  // squared distances from the centre; of the ends across the motion if straight
            double x, slope;   // position at `low` and growth per metre across the motion, if straight
        };

        struct Corner
        {
            double x, y;    // from the centre; along and across the motion if straight
            double square;  // of the distance from the centre
        };

        void addSide(const Eigen::Vector2d &normal, const Corner &a, const Corner &b, bool &leadsA, bool &leadsB);
        void meetPoint(double ux, double uy);
        void noteTurn(double sineTimesSquare, double cosineTimesSquare, double square);
        void noteDistance(double distance);

        // Acute corners count twice; a convex piece has at most three.
        static constexpr std::size_t MAX_SIDES = Vehicle::MAX_CORNERS + 3;

        bool straight_;
        bool met_{false};
        double limit_;             // of the sine of the angle; of the distance if straight
        double radius_, turning_;  // of the arc of the axle; 1 if the motion turns left, -1 if right
        double cx_, cy_;           // centre of the arc; of the box if straight
        double dx_, dy_;           // direction of travel
        double lx_, ly_;           // towards the centre
        double nearest_, farthest_;
        std::size_t partCount_{0}, cornerCount_{0};
        std::array<Part, MAX_SIDES> parts_;
        std::array<Corner, MAX_SIDES> corners_;
    };
}  // namespace parking

#pragma once

#include "state_validity/Body.h"

namespace parking
{
    /** \brief A motion of a box along a circular arc or a straight line, in the frame of the box at the beginning.

        The box is |x| <= halfLength, |y| <= halfWidth. Its point (axle, 0) follows an arc of the given curvature that
        starts along +x (direction 1) or -x (direction -1). */
    struct BoxSweep
    {
        double halfLength;  ///< half length of the box along x, metres
        double halfWidth;   ///< half width of the box along y, metres
        double axle;        ///< x of the rear axle in the frame of the box, metres
        double curvature;   ///< curvature of the arc, 1/m, positive to the left
        double direction;   ///< 1 forwards, -1 in reverse
        double length;      ///< length of the arc in metres, not negative; curvature * length below pi
    };

    /** \brief Metres beyond the end of a motion up to which SweepFront and EdgeIndex report contacts.

        If a motion is cut in two, rounding must not hide a contact at the cut. */
    constexpr double OVERRUN = 1e-6;

    /** \brief Metres along the arc until the moving box first touches the segment from (ax, ay) to (bx, by); infinite
        without a contact.

        The segment is given in the frame of the box at the beginning, where the box must not touch it. The result is
        exact up to rounding for every curvature. Contact begins when an end of the segment crosses a side of the box or
        a corner of the box crosses the segment. Each case is a quadratic equation in tan(turn / 2) / curvature, a
        length that stays regular for straight lines.

        This function evaluates every side and every corner. SweepFront is the fast version for many segments. */
    double firstContact(const BoxSweep &sweep, double ax, double ay, double bx, double by);

    /** \brief Metres along the arc until a moving convex piece of a body first touches a segment; infinite without a
        contact.

        \param piece in the frame of the box of \e sweep, whose half lengths are not used
        \param more metres by which the piece is enlarged */
    double firstContact(const BoxSweep &sweep, const BodyPiece &piece, double more, double ax, double ay, double bx,
                        double by);
}  // namespace parking

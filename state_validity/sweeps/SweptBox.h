#pragma once

namespace parking
{
    /** \brief A box that is carried along a circular arc or a straight line, in its own frame at the beginning.

        The box is |x| <= halfLength, |y| <= halfWidth; the point (axle, 0) of it follows an arc of the given curvature
        that starts along +x (direction 1) or -x (direction -1). */
    struct BoxSweep
    {
        double halfLength;  ///< metres along x
        double halfWidth;   ///< metres along y
        double axle;        ///< x of the guided point, the rear axle, in the frame of the box
        double curvature;   ///< 1/m, positive to the left
        double direction;   ///< 1 forwards, -1 in reverse
        double length;      ///< metres along the arc, not negative; curvature * length below pi
    };

    /** \brief How far beyond the end of a motion contacts are still reported by SweepFront and EdgeIndex, in metres:
        where a motion is cut in two, a contact at the very cut must not fall between the parts by rounding. */
    constexpr double OVERRUN = 1e-6;

    /** \brief Metres along the arc until the moving box first touches the segment from (ax, ay) to (bx, by), given in
        the frame of the box at the beginning; infinite when it does not within the length.

        Closed form, exact up to rounding for every curvature: contact begins either when an end of the segment crosses
        a side of the box or when a corner of the box crosses the segment, and each of these is a quadratic equation in
        tan(turn / 2) / curvature, a length, which stays regular as the arc becomes a straight line. The box must not
        touch the segment at the beginning.

        This is the plain form that tries every side and every corner; SweepFront is the fast one for many segments. */
    double firstContact(const BoxSweep &sweep, double ax, double ay, double bx, double by);
}  // namespace parking

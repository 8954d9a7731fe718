#pragma once

// Exact geometry of leaving a slot in one sweep, for ReverseParking. In the frame of the leaving car x points along its
// motion out of the slot and y to its left. One set of formulas therefore serves both entries and, mirrored, both
// sides.

#include <limits>

namespace parking
{
    /** \brief Extents of the leaving body relative to its rear axle, in the direction of motion. */
    struct ExitBody
    {
        double lead{0.0};       ///< metres from the rear axle to the leading end
        double trail{0.0};      ///< metres from the rear axle to the trailing end
        double halfWidth{0.0};  ///< metres from the axis to either side
    };

    // ---- perpendicular and angled slots: straight out, then one arc to the right into the aisle --------------------

    /** \brief A perpendicular or angled slot between two neighbours that reach up to the aisle's edge. */
    struct Bay
    {
        double angle{0.0};    ///< angle between the slot's axis and the aisle, radians in (0, pi/2]
        double nearX{0.0};    ///< metres from the parked rear axle to the end of the neighbour on the inner side
        double farX{0.0};     ///< metres from the parked rear axle to the end of the neighbour on the outer side
        double nearGap{0.0};  ///< metres from the car's axis to the neighbour on the inner side
        double farGap{0.0};   ///< metres from the car's axis to the neighbour on the outer side
    };

    /** \brief Metres that the car must drive straight before it may turn with \e radius.

        - Neighbour on the inner side: its corner C must stay within the circle of radius R - w/2 about the turning
          centre O. If the turn ends before C is abeam, C must stay behind the line of the leaving inner side.
        - Neighbour on the outer side: the trailing corner moves on a circle about O. It must not swing past the
          neighbour's side before that neighbour ends. */
    double straightBeforeTurn(const Bay &bay, const ExitBody &body, double radius);

    /** \brief Required width of the aisle for the whole exit, metres, from the line through the mouths of the slots. */
    double aisleNeeded(const Bay &bay, const ExitBody &body, double radius, double straight);

    /** \brief The radius of at least \e minRadius that requires the narrowest aisle. */
    double narrowestAisleRadius(const Bay &bay, const ExitBody &body, double minRadius);

    // ---- parallel slots: two tangent arcs, first to the left -------------------------------------------------------

    /** \brief A parallel slot: neighbours ahead and behind, the lane on the left, a kerb on the right. */
    struct KerbSlot
    {
        double front{0.0};      ///< metres from the parked rear axle to the neighbour ahead
        double aisleSide{0.0};  ///< metres from the car's axis to the lane's edge of the slot; P is (front, aisleSide)
        double kerbGap{0.0};    ///< metres between the body and the kerb
    };

    /** \brief The smallest radius of the first arc at which the trailing corner clears the kerb; infinite without a
        gap. */
    double kerbRadius(const KerbSlot &slot, const ExitBody &body);

    /** \brief R_max of the paper, at which the leading outer corner A and the corner P lie on one circle about the
        turning centre. */
    double cornerRadius(const KerbSlot &slot, const ExitBody &body);

    /** \brief The smallest KerbSlot::front that the body passes with \e radius; the inverse of cornerRadius(). */
    double frontNeeded(const KerbSlot &slot, const ExitBody &body, double radius);

    /** \brief Two tangent arcs of equal angle from the parked pose into the lane. */
    struct LaneExit
    {
        double first{0.0};   ///< radius of the arc that begins in the slot, metres
        double second{0.0};  ///< radius of the arc that ends along the lane, metres
        double turn{0.0};    ///< angle of each arc, radians

        /** \brief Lateral displacement of the car, metres. */
        double offset() const;
    };

    /** \brief Whether an exit that reaches at least the slot's edge passes P.

        The second arc passes P, or P is still ahead of the rear axle at its end and the straight line passes P. An exit
        with a turn of more than a right angle does not pass P. */
    bool passes(const KerbSlot &slot, const ExitBody &body, const LaneExit &exit);

    /** \brief The exit with these radii and the smallest lateral displacement that leaves the slot and passes P with
        the second arc.

        If the arcs would have to turn by more than a right angle, the second radius is increased. Requires first <=
        cornerRadius(). */
    LaneExit shallowestExit(const KerbSlot &slot, const ExitBody &body, double first, double second);

    /** \brief \e exit with \e extra metres of additional lateral displacement, which must be small relative to the
        radii.

        In most cases the result passes P like \e exit. Its second arc ends farther from P to the side, but also farther
        along the lane. */
    LaneExit widened(const LaneExit &exit, double extra);

    /** \brief Required width of the lane for the exit, metres, from the slot's edge. */
    double laneNeeded(const KerbSlot &slot, const ExitBody &body, const LaneExit &exit);

    /** \brief The exit with the first radius \e first, a second one of at least \e minRadius, and the narrowest
        required lane. */
    LaneExit narrowestLaneExit(const KerbSlot &slot, const ExitBody &body, double first, double minRadius);
}  // namespace parking

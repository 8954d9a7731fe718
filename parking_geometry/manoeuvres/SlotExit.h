#pragma once

// Exact geometry of leaving a slot in one sweep, for ReverseParking. Everything is seen from the leaving car: x along
// its motion out of the slot, y to its left, so that one set of formulas serves both entries (a car that leaves in
// reverse leads with its tail) and both sides (mirrored).

#include <limits>

namespace parking
{
    /** \brief The leaving body: what lies ahead of the rear axle in the direction of motion, behind it, and beside
        it. */
    struct ExitBody
    {
        double lead{0.0};       ///< metres
        double trail{0.0};      ///< metres
        double halfWidth{0.0};  ///< metres
    };

    // ---- perpendicular and angled slots: straight out, then one arc to the right into the aisle --------------------

    /** \brief A perpendicular or angled slot between two neighbours that reach up to the aisle's edge. */
    struct Bay
    {
        double angle{0.0};    ///< between the slot's axis and the aisle, radians in (0, pi/2]
        double nearX{0.0};    ///< where the neighbour on the inner side of the turn ends, from the parked rear axle
        double farX{0.0};     ///< where the neighbour on the outer side ends, from the parked rear axle
        double nearGap{0.0};  ///< from the car's axis to the neighbour on the inner side
        double farGap{0.0};   ///< from the car's axis to the neighbour on the outer side
    };

    /** \brief How far the car must drive straight on before it may turn with \e radius, metres.

        Neighbour on the inner side: its corner C must stay within the circle of the inner side, radius R - w/2 about
        the turning centre O; where the turn ends before C is abeam, C must stay behind the line on which the inner
        side leaves. Neighbour on the outer side: the trailing corner, on its circle about O, must not swing past the
        neighbour's side before that neighbour ends. */
    double straightBeforeTurn(const Bay &bay, const ExitBody &body, double radius);

    /** \brief Width of the aisle that the whole exit needs, from the line through the mouths of the slots. */
    double aisleNeeded(const Bay &bay, const ExitBody &body, double radius, double straight);

    /** \brief The radius, at least \e minRadius, that needs the narrowest aisle. */
    double narrowestAisleRadius(const Bay &bay, const ExitBody &body, double minRadius);

    // ---- parallel slots: two tangent arcs, first to the left -------------------------------------------------------

    /** \brief A parallel slot: neighbours ahead and behind, the lane on the left, a kerb on the right. */
    struct KerbSlot
    {
        double front{0.0};  ///< from the parked rear axle to the neighbour ahead
        double aisleSide{
            0.0};  ///< from the car's axis to the lane's edge of the slot: the corner P is (front, aisleSide)
        double kerbGap{0.0};  ///< between the body and the kerb
    };

    /** \brief The smallest radius whose first arc keeps the trailing corner off the kerb; infinite without any gap. */
    double kerbRadius(const KerbSlot &slot, const ExitBody &body);

    /** \brief The paper's R_max: with it the leading outer corner A and the corner P lie on one circle about the
        turning centre. */
    double cornerRadius(const KerbSlot &slot, const ExitBody &body);

    /** \brief Inverse of cornerRadius: the smallest KerbSlot::front that \e radius gets past. */
    double frontNeeded(const KerbSlot &slot, const ExitBody &body, double radius);

    /** \brief Two tangent arcs from the parked pose into the lane; they turn by the same angle. */
    struct LaneExit
    {
        double first{0.0};   ///< radius of the arc that begins in the slot
        double second{0.0};  ///< radius of the arc that ends along the lane
        double turn{0.0};    ///< angle of each, radians

        /** \brief Lateral displacement of the car, metres. */
        double offset() const;
    };

    /** \brief Does an exit that leaves at least along the slot's edge pass P? Either P is still ahead of the rear axle
        when the second arc ends, and the straight line goes past it, or the second arc turns round it. None that turns
        by more than a right angle does. */
    bool passes(const KerbSlot &slot, const ExitBody &body, const LaneExit &exit);

    /** \brief The exit with these radii that moves the least to the side: out of the slot, and with P passed by the
        second arc. Where the arcs would have to turn by more than a right angle to get out, the second is made larger.
        Needs first <= cornerRadius(). */
    LaneExit shallowestExit(const KerbSlot &slot, const ExitBody &body, double first, double second);

    /** \brief \e exit with \e extra metres (small against the radii) more of lateral displacement. Mostly it passes P
        as \e exit does: the second arc ends that much farther from P, but farther on, too. */
    LaneExit widened(const LaneExit &exit, double extra);

    /** \brief Width of the lane that the exit needs, from the slot's edge. */
    double laneNeeded(const KerbSlot &slot, const ExitBody &body, const LaneExit &exit);

    /** \brief The exit with \e first as its first radius and a second one of at least \e minRadius that needs the
        narrowest lane. */
    LaneExit narrowestLaneExit(const KerbSlot &slot, const ExitBody &body, double first, double minRadius);
}  // namespace parking

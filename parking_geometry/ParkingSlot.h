#pragma once

#include "parking_geometry/Polygon.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/Vehicle.h"

#include <optional>
#include <string>
#include <vector>

namespace parking
{
    /** \brief Orientation of a slot relative to the aisle or lane from which cars enter it. */
    enum class SlotKind
    {
        Perpendicular,  ///< at a right angle to the aisle
        Parallel,       ///< along the lane
        Angled          ///< at ParkingSlot::angle to the aisle
    };

    /** \brief Direction in which a car may drive into a slot. */
    enum class SlotEntry
    {
        Reverse,  ///< tail first
        Forward,  ///< nose first
        Either    ///< both directions; planners attempt reverse first
    };

    /** \brief Side of the aisle on which the slot lies, seen along ParkingSlot::aisleYaw(). */
    enum class SlotSide
    {
        Right,  ///< on the right-hand side
        Left,   ///< on the left-hand side
        Either  ///< not given; manoeuvres attempt the right side first, then the left
    };

    /** \brief A parking slot and the required placement of the car in it.

        The slot is a rectangle with \e pose at its centre and +x of the pose along its length.

        For perpendicular and angled slots, +x points out of the slot towards the aisle. A car that reverses in ends
        with the heading pose.yaw, one that drives in forwards with pose.yaw + pi.

        For parallel slots, +x is the direction of travel of the lane. The car ends with the heading pose.yaw. */
    struct ParkingSlot
    {
        SlotKind kind{SlotKind::Perpendicular};  ///< orientation relative to the aisle
        Pose pose;                               ///< centre of the slot
        double length{5.0};                      ///< metres along the parked car
        double width{2.5};                       ///< metres across the parked car
        SlotEntry entry{SlotEntry::Reverse};     ///< direction of entry

        /** Angle between +x of the pose and the aisle, radians in (0, pi/2]. Only angled slots use it. */
        double angle{0.25 * PI};

        /** Side of the aisle on which the slot lies. For parallel slots, Right means that the lane lies on the +y side
            of the pose. */
        SlotSide side{SlotSide::Either};

        /** Gap in metres between the parked body and the closed end of the slot, or the rear end of a parallel slot. If
            it is not set, the body is centred along the slot. */
        std::optional<double> depth;

        /** Displacement of the parked car from the slot's axis to the left (+y of the pose), metres. */
        double lateralOffset{0.0};

        /** \brief Rear-axle poses of \e vehicle parked in the slot at depth and lateralOffset.

            Returns one pose per allowed entry, the preferred one first. A parallel slot has one pose because its
            heading does not depend on the entry.

            Throws parking::Error naming the missing centimetres if the car exceeds the slot, or if depth or
            lateralOffset place a part of it outside. */
        std::vector<Pose> goals(const Vehicle &vehicle) const;

        /** \brief Corners of the slot, counter-clockwise. */
        Polygon outline() const;

        /** \brief Throws parking::Error naming the first field that is not finite or out of range. The pose must lie
            within MAX_COORDINATE, length and width may be up to 1 km. */
        void validate() const;

        /** \brief Angle between +x of the pose and the aisle: 0 for parallel slots, pi/2 for perpendicular ones,
            otherwise \e angle. */
        double aisleAngle() const;

        /** \brief Direction of travel in the aisle for a car that reverses in, radians.

            This is +x of the pose turned by aisleAngle(), clockwise if the slot is on the right.
            \param onSide Right or Left */
        double aisleYaw(SlotSide onSide) const;
    };
}  // namespace parking

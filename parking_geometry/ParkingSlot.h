#pragma once

#include "parking_geometry/Polygon.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/Vehicle.h"

#include <optional>
#include <string>
#include <vector>

namespace parking
{
    /** \brief How a slot lies to the aisle or lane that it is entered from. */
    enum class SlotKind
    {
        Perpendicular,  ///< at a right angle
        Parallel,       ///< along it
        Angled          ///< at ParkingSlot::angle
    };

    /** \brief How a car may drive into a slot. */
    enum class SlotEntry
    {
        Reverse,  ///< tail first
        Forward,  ///< nose first
        Either    ///< whichever works; reverse is tried first
    };

    /** \brief On which side of the aisle the slot lies, seen along ParkingSlot::aisleYaw(). */
    enum class SlotSide
    {
        Right,  ///< on the right-hand side
        Left,   ///< on the left-hand side
        Either  ///< not said: manoeuvres try the right side first, then the left
    };

    /** \brief A parking slot as its user describes it.

        The slot is a rectangle with \e pose at its centre, +x of the pose along the length. For perpendicular and
        angled slots +x points out of the slot towards the aisle, so that a car reversed in ends with the heading
        pose.yaw and a car driven in forwards with pose.yaw + pi. For parallel slots +x is the direction of travel of
        the lane beside it and a car ends with heading pose.yaw. */
    struct ParkingSlot
    {
        SlotKind kind{SlotKind::Perpendicular};  ///< how it lies to the aisle
        Pose pose;                               ///< centre of the slot
        double length{5.0};                      ///< metres along the parked car
        double width{2.5};                       ///< metres across the parked car
        SlotEntry entry{SlotEntry::Reverse};     ///< how it may be entered

        /** Angled slots: between +x of the pose and the aisle, radians in (0, pi/2]. Other kinds ignore it. */
        double angle{0.25 * PI};

        /** On which side of the aisle the slot lies; for parallel slots this says where the aisle is (right: the slot
            is on the right of the lane, which is on the +y side of the pose). */
        SlotSide side{SlotSide::Either};

        /** Free length between the closed end of the slot (parallel: its rear end) and the parked body, metres; not
            set: the body is centred along the slot. */
        std::optional<double> depth;

        /** How far to the left of the slot's axis (+y of the pose) the car stands, metres. */
        double lateralOffset{0.0};

        /** \brief Rear-axle poses of \e vehicle parked in the slot at depth and lateralOffset, one per allowed entry,
            preferred first (a parallel slot has one: the heading does not depend on the entry).

            Throws parking::Error naming the missing centimetres when the car is longer or wider than the slot, or when
            depth or lateralOffset put a part of it outside. */
        std::vector<Pose> goals(const Vehicle &vehicle) const;

        /** \brief Corners of the slot, counter-clockwise. */
        Polygon outline() const;

        /** \brief Throws parking::Error naming the first field that is not finite or out of its range: the pose within
            FARTHEST_COORDINATE, length and width up to 1 km. */
        void validate() const;

        /** \brief Angle between +x of the pose and the aisle: 0 for parallel, pi/2 for perpendicular, else angle. */
        double aisleAngle() const;

        /** \brief Direction of travel in the aisle for a car that reverses in, radians: +x of the pose turned by
            aisleAngle(), clockwise when the slot is on the right. \param onSide Right or Left. */
        double aisleYaw(SlotSide onSide) const;
    };
}  // namespace parking

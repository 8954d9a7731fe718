#pragma once

#include "parking_geometry/ParkingSlot.h"
#include "parking_geometry/Polygon.h"

#include <limits>
#include <vector>

namespace parking
{
    /** \brief Assumed obstacles round a slot, which define the legality of a manoeuvre of ReverseParking.

        - Perpendicular and angled slots: a row of equal slots without gaps, a wall at the closed end and a wall across
          the aisle. The neighbours extend to the line through the outermost corners of the slots' mouths. On the outer
          side of the turn, neighbours in angled rows extend to their own corners.
        - Parallel slots: a kerb, neighbours ahead and behind, and a wall across the lane.

        \param side Right or Left, see ParkingSlot::side
        \param aisleWidth metres from the slots' mouths to the wall across; infinite for no wall
        \param reach metres by which neighbours and walls extend from the slot
        \return convex polygons, counter-clockwise */
    std::vector<Polygon> slotSurroundings(const ParkingSlot &slot, SlotSide side,
                                          double aisleWidth = std::numeric_limits<double>::infinity(),
                                          double reach = 15.0);
}  // namespace parking

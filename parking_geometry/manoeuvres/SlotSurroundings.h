#pragma once

#include "parking_geometry/ParkingSlot.h"
#include "parking_geometry/Polygon.h"

#include <limits>
#include <vector>

namespace parking
{
    /** \brief The obstacles that a slot is taken to have round it where nothing else is known: the world of
        ReverseParking's legality, of examples and of tests.

        A row of equal slots without gaps, every neighbour filled up to the line through the outermost corners of the
        slots' mouths (angled rows: on the outer side of the turn up to the neighbour's own corner), a wall at the
        closed end, and a wall along the other side of the aisle. Parallel: kerb, neighbours ahead and behind, and that
        wall.

        \param side Right or Left, see ParkingSlot::side
        \param aisleWidth metres from the slots' mouths to the wall across; infinite: no wall
        \param reach metres that neighbours and walls extend from the slot
        \return convex polygons, counter-clockwise */
    std::vector<Polygon> slotSurroundings(const ParkingSlot &slot, SlotSide side,
                                          double aisleWidth = std::numeric_limits<double>::infinity(),
                                          double reach = 15.0);
}  // namespace parking

#pragma once

#include "parking_geometry/manoeuvres/ReverseParking.h"

#include <limits>

namespace parking_test
{
    /** \brief A car that may touch the corners of the slot. */
    inline parking::ReverseParkingOptions grazing(double aisleWidth = std::numeric_limits<double>::infinity(),
                                                  double guardLength = 3.0)
    {
        parking::ReverseParkingOptions options;
        options.clearance = 0.0;
        options.aisleWidth = aisleWidth;
        options.guardLength = guardLength;
        return options;
    }

    /** \brief A parallel slot with another length; with a given depth its rear end stays where it is. */
    inline parking::ParkingSlot lengthened(const parking::ParkingSlot &slot, double length)
    {
        parking::ParkingSlot result = slot;
        result.length = length;
        if (slot.depth)
            result.pose = compose(slot.pose, {0.5 * (length - slot.length), 0.0, 0.0});
        return result;
    }
}  // namespace parking_test

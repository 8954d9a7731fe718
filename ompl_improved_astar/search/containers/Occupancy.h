#pragma once

#include <cstdint>

namespace parking::search
{
    /** \brief What a search has found out of a cell so far. Cells begin as unknown: nobody has asked yet.

        The cells of a map (parking::Cell) have values of their own: there, unknown is what the map says, and asking
        again does not change it. */
    enum class Occupancy : std::uint8_t
    {
        Unknown,  ///< not asked yet
        Free,     ///< the car can be there
        Blocked   ///< it cannot
    };
}  // namespace parking::search

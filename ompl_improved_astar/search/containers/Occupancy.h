#pragma once

#include <cstdint>

namespace parking::search
{
    /** \brief Classification of a cell by a search. Cells begin as unknown, that is, not yet checked.

        The cells of a map (parking::Cell) have other values: there, unknown is information of the map. */
    enum class Occupancy : std::uint8_t
    {
        Unknown,  ///< not yet checked
        Free,     ///< the car can be there
        Blocked   ///< the car cannot be there
    };
}  // namespace parking::search

#pragma once

#include <cmath>
#include <cstdint>

namespace parking::search
{
    /** \brief Where a path is cut to be shortened, in units of what the spacing is given in. */
    struct Knots
    {
        double spacing;  ///< from one to the next
        double offset;   ///< of the first one from the start
    };

    /** \brief Spacings from \e least to that and \e range, and offsets, that do not repeat for long: the golden ratio's
        multiples fill the interval. */
    inline Knots otherKnots(std::uint64_t number, double least, double range)
    {
        const double fraction = std::fmod(0.618033988749895 * static_cast<double>(number), 1.0);
        const double spacing = least + range * fraction;
        return {spacing, spacing * std::fmod(7.0 * fraction, 1.0)};
    }
}  // namespace parking::search

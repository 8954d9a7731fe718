#pragma once

#include <cstdint>
#include <cstring>

namespace parking::search
{
    /** \brief The bits of a float that is not negative: numbers in the order of the floats, the highest bit 0. */
    inline std::uint32_t bitsOf(float value)
    {
        std::uint32_t bits = 0;
        static_assert(sizeof(bits) == sizeof(value));
        std::memcpy(&bits, &value, sizeof(bits));
        return bits & 0x7fffffffu;
    }

    /** \brief The float of such bits. */
    inline float floatOf(std::uint32_t bits)
    {
        float value = 0.0f;
        std::memcpy(&value, &bits, sizeof(value));
        return value;
    }
}  // namespace parking::search

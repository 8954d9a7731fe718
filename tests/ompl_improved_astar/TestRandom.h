#pragma once

#include "parking_geometry/Pose.h"

#include <cstdint>
#include <random>

namespace parking_test
{
    /** \brief Random numbers that are the same with every standard library, unlike those of its distributions. */
    class TestRandom
    {
    public:
        explicit TestRandom(std::uint64_t seed) : engine_(seed)
        {
        }

        double between(double low, double high)
        {
            return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1.0p-53);
        }

        /** \brief 0 to count - 1. */
        std::uint32_t index(std::uint64_t count)
        {
            return static_cast<std::uint32_t>(engine_() % count);
        }

        bool chance(double probability)
        {
            return between(0.0, 1.0) < probability;
        }

        std::uint64_t bits()
        {
            return engine_();
        }

        parking::Pose poseIn(double low, double high)
        {
            const double x = between(low, high), y = between(low, high);
            return {x, y, between(-parking::PI, parking::PI)};
        }

    private:
        std::mt19937_64 engine_;
    };
}  // namespace parking_test

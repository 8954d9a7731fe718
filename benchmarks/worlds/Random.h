#pragma once

#include "parking_geometry/Pose.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>

/** \brief Common parts of tests, fuzzers and studies: random worlds, and references to compare results with. */
namespace parking_test
{
    /** \brief A number derived from a text, equal on every machine (Fowler, Noll and Vo's 64 bit hash). */
    inline std::uint64_t seedOf(const std::string &text)
    {
        std::uint64_t hash = 0xcbf29ce484222325U;
        for (const char each : text)
            hash = (hash ^ static_cast<unsigned char>(each)) * 0x100000001b3U;
        return hash;
    }

    /** \brief Random numbers that are equal with every standard library, unlike its distributions. */
    class Random
    {
    public:
        /** \brief Creates a generator; equal seeds give equal numbers. */
        explicit Random(std::uint64_t seed) : engine_(seed)
        {
        }

        /** \brief A number evenly distributed from \e low (included) to \e high (excluded). */
        double between(double low, double high)
        {
            return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1.0p-53);
        }

        /** \brief An index from 0 to count - 1. */
        std::size_t index(std::size_t count)
        {
            return static_cast<std::size_t>(engine_() % count);
        }

        /** \brief A signed number from 0 to count - 1, for arithmetic. */
        int below(int count)
        {
            return static_cast<int>(index(static_cast<std::size_t>(count)));
        }

        /** \brief True with this probability. */
        bool chance(double probability)
        {
            return between(0.0, 1.0) < probability;
        }

        /** \brief 64 random bits. */
        std::uint64_t bits()
        {
            return engine_();
        }

        /** \brief A number of any magnitude between the two, with either sign. */
        double magnitude(double smallest, double largest)
        {
            const double value = std::exp(between(std::log(smallest), std::log(largest)));
            return chance(0.5) ? value : -value;
        }

        /** \brief A pose with x and y between the two, in metres, and any heading. */
        parking::Pose poseIn(double low, double high)
        {
            const double x = between(low, high), y = between(low, high);
            return {x, y, between(-parking::PI, parking::PI)};
        }

    private:
        std::mt19937_64 engine_;
    };
}  // namespace parking_test

#pragma once

#include "parking_geometry/Pose.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>

/** \brief What tests, fuzzers and studies share: random worlds, and oracles that results are compared with. */
namespace parking_test
{
    /** \brief A number that follows from a text, the same everywhere (Fowler, Noll and Vo's 64 bit hash). */
    inline std::uint64_t seedOf(const std::string &text)
    {
        std::uint64_t hash = 0xcbf29ce484222325U;
        for (const char each : text)
            hash = (hash ^ static_cast<unsigned char>(each)) * 0x100000001b3U;
        return hash;
    }

    /** \brief Random numbers that are the same with every standard library: its distributions are not. */
    class Random
    {
    public:
        /** \brief The same seed gives the same numbers. */
        explicit Random(std::uint64_t seed) : engine_(seed)
        {
        }

        /** \brief Evenly distributed from \e low on, below \e high. */
        double between(double low, double high)
        {
            return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1.0p-53);
        }

        /** \brief 0 to count - 1. */
        std::size_t index(std::size_t count)
        {
            return static_cast<std::size_t>(engine_() % count);
        }

        /** \brief 0 to count - 1, with a sign, to reckon with. */
        int below(int count)
        {
            return static_cast<int>(index(static_cast<std::size_t>(count)));
        }

        /** \brief True in this share of all calls. */
        bool chance(double probability)
        {
            return between(0.0, 1.0) < probability;
        }

        /** \brief 64 random bits. */
        std::uint64_t bits()
        {
            return engine_();
        }

        /** \brief Any magnitude between the two, either sign. */
        double magnitude(double smallest, double largest)
        {
            const double value = std::exp(between(std::log(smallest), std::log(largest)));
            return chance(0.5) ? value : -value;
        }

        /** \brief x and y between the two, in metres; any heading. */
        parking::Pose poseIn(double low, double high)
        {
            const double x = between(low, high), y = between(low, high);
            return {x, y, between(-parking::PI, parking::PI)};
        }

    private:
        std::mt19937_64 engine_;
    };
}  // namespace parking_test

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace parking
{
    /** \brief Counts durations in classes 5 % apart, from a tenth of a microsecond to hours: it never grows. */
    class LatencyCounts
    {
    public:
        /** \param time seconds */
        void add(double time);
        LatencyCounts &operator+=(const LatencyCounts &other);

        std::uint64_t count() const;

        /** \brief The duration in seconds, rounded up by at most 5 %, that a \e share of all does not exceed; 0 of
         * none. */
        double quantile(double share) const;

    private:
        static constexpr std::size_t CLASSES = 600;
        std::array<std::uint64_t, CLASSES> counts_{};
    };

    /** \brief What a worker has done. */
    struct SoakFigures
    {
        std::uint64_t worlds{0}, queries{0}, solved{0}, replanned{0}, repeated{0};
        std::uint64_t byOthers{0};  ///< queries put to OMPL's planners, and to the one of this project behind OMPL
        std::uint64_t refusedOfOthers{0};        ///< exact paths of OMPL's planners that the referee does not accept
        LatencyCounts planning;                  ///< processor time of the queries put to plan()
        std::vector<std::string> disagreements;  ///< one line each, the first hundred
        std::uint64_t disagreed{0};

        void disagree(const std::string &what);
        SoakFigures &operator+=(const SoakFigures &other);
    };
}  // namespace parking

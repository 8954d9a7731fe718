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

        /** \brief Adds the counts of \e other. */
        LatencyCounts &operator+=(const LatencyCounts &other);

        /** \brief Number of all durations. */
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
        std::uint64_t worlds{0},    ///< random worlds that were planned in
            queries{0},             ///< random queries put to plan()
            solved{0},              ///< of these, with a path to a goal
            replanned{0},           ///< queries from half way, with a new obstacle on the rest of the path
            repeated{0},            ///< queries put twice: the path must be the same
            seenByOracle{0};        ///< paths that the oracle of the tests has looked at
        std::uint64_t byOthers{0};  ///< queries put to OMPL's planners, and to the one of this project behind OMPL
        std::uint64_t refusedOfOthers{0};        ///< exact paths of OMPL's planners that the referee does not accept
        LatencyCounts planning;                  ///< processor time of the queries put to plan()
        std::vector<std::string> disagreements;  ///< one line each, the first hundred
        std::uint64_t disagreed{0};              ///< number of disagreements, those that are not listed included

        /** \brief Notes a disagreement: what an answer has wrong, on one line. */
        void disagree(const std::string &what);

        /** \brief Adds the figures of \e other. */
        SoakFigures &operator+=(const SoakFigures &other);
    };
}  // namespace parking

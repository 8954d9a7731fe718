#pragma once

#include "benchmarks/planners/SolveRecord.h"
#include "benchmarks/problems/PlannedPath.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace parking
{
    /** \brief A path in few numbers: arcs, or the corners of straight lines. Local coordinates. */
    struct StoredPath
    {
        Pose start;
        std::vector<PathPiece> arcs;
        std::vector<Pose> corners;  ///< without the start; either this or arcs

        static StoredPath of(const PlannedPath &path);

        /** \brief States at most \e step apart. */
        SampledPath sample(double step) const;
    };

    /** \brief Everything that is kept of one run: a line in the file of results. */
    struct RunRecord
    {
        std::string experiment;
        std::string planner;
        std::size_t run{0};
        std::uint32_t seed{0};
        /** What OMPL's benchmark and we measured, by OMPL's names with types, for example "time REAL". */
        std::map<std::string, std::string> properties;
        /** Of the planner, by OMPL's names. */
        std::map<std::string, std::string> parameters;
        std::vector<Improvement> progress;
        bool hasPath{false};
        bool exact{false};
        StoredPath path;

        /** \brief A property as a number; NaN when there is none. */
        double number(const std::string &property) const;

        /** \brief Exact, and valid when checked once more. */
        bool solved() const;

        nlohmann::json toJson() const;

        /** \brief Throws parking::Error, or an exception of nlohmann's, when \e json is no record. */
        static RunRecord fromJson(const nlohmann::json &json);
    };
}  // namespace parking

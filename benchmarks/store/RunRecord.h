#pragma once

#include "benchmarks/plan/PlanRun.h"
#include "benchmarks/planners/SolveRecord.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

namespace parking
{
    /** \brief A figure of a run, of any type of OMPL's logs; enumerations are whole numbers here. */
    using FigureValue = std::variant<bool, std::int64_t, double>;

    /** \brief A figure as a value of this type. */
    template <class Number>
    FigureValue figureOf(Number value)
    {
        if constexpr (std::is_same_v<Number, bool> || std::is_floating_point_v<Number>)
            return value;
        else
            return static_cast<std::int64_t>(value);
    }

    /** \brief All data stored of one run: a row of the database. */
    struct RunRecord
    {
        std::string experiment;   ///< name of the experiment
        std::string planner;      ///< name of the planner in the results, see PlannerSpec::name
        std::string fingerprint;  ///< digest of everything that the run depends on
        std::string reason;       ///< one line on why there is no solution; empty if unknown
        /** Figures by the names of runColumns(), without those that were not measured. The planner's own progress
            properties have the planner's names, with '_' as blanks. */
        std::map<std::string, FigureValue> figures;
        std::map<std::string, std::string> parameters;  ///< parameters of the planner, by OMPL's names
        std::vector<Improvement> progress;              ///< each better solution, in order of time
        bool hasPath{false};                            ///< whether there is a path, exact or not
        bool exact{false};                              ///< whether the planner reports that the path ends at a goal
        Path path;                                      ///< the path in local coordinates

        /** \brief Sets the figure of a column. Throws parking::Error naming the column when it is unknown or its type
            cannot hold the value. */
        void setFigure(const std::string &column, const FigureValue &value);

        /** \brief Sets a figure from a value of any type. */
        template <class Value>
        void set(const std::string &column, const Value &value)
        {
            setFigure(column, figureOf(value));
        }

        /** \brief Sets a figure unless the value is missing. */
        template <class Value>
        void set(const std::string &column, const std::optional<Value> &value)
        {
            if (value)
                set(column, *value);
        }

        /** \brief A figure as a number; NaN when it was not measured. */
        double number(const std::string &column) const;

        /** \brief Whether a figure was measured and is true. */
        bool is(const std::string &column) const
        {
            return number(column) == 1.0;
        }

        /** \brief Whether the path is exact, valid in the recheck, and in time. */
        bool isSuccess() const
        {
            return is("success");
        }

        /** \brief Number of the run, from 0. */
        std::size_t run() const
        {
            return static_cast<std::size_t>(number("run"));
        }

        /** \brief Outcome of the run: exact, approximate, or the reason for a missing path. */
        std::optional<PlanStatus> outcome() const;

        /** \brief Format in which processes transfer a record. */
        nlohmann::json toJson() const;

        /** \brief Reads the output of toJson(). Throws parking::Error, or an exception of nlohmann's library, for other
            input. */
        static RunRecord fromJson(const nlohmann::json &json);
    };
}  // namespace parking

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
    /** \brief A figure of a run, of any type that OMPL's logs know; enumerations are whole numbers here. */
    using FigureValue = std::variant<bool, std::int64_t, double>;

    /** \brief A figure with its type, whatever number it was measured as. */
    template <class Number>
    FigureValue figureOf(Number value)
    {
        if constexpr (std::is_same_v<Number, bool> || std::is_floating_point_v<Number>)
            return value;
        else
            return static_cast<std::int64_t>(value);
    }

    /** \brief Everything that is kept of one run: a row of the database. */
    struct RunRecord
    {
        std::string experiment;   ///< its name
        std::string planner;      ///< what results call the planner, see PlannerSpec::name
        std::string fingerprint;  ///< of everything that the run depends on
        std::string reason;       ///< one line on why there is no solution; empty where nobody tells
        /** By the names of runColumns(); what was not measured is not there. The planner's own progress properties are
            there under the names that it gives them, with blanks for underscores. */
        std::map<std::string, FigureValue> figures;
        std::map<std::string, std::string> parameters;  ///< of the planner, by OMPL's names
        std::vector<Improvement> progress;              ///< each better solution, in order of time
        bool hasPath{false};                            ///< is there a path, exact or not?
        bool exact{false};                              ///< does the planner say that it ends at a goal?
        Path path;                                      ///< in local coordinates

        /** \brief Sets the figure of a column. Throws parking::Error naming the column when there is none of this name,
            or its type cannot hold the value. */
        void setFigure(const std::string &column, const FigureValue &value);

        /** \brief The same for a value of any type. */
        template <class Value>
        void set(const std::string &column, const Value &value)
        {
            setFigure(column, figureOf(value));
        }

        /** \brief The same for a value that may be missing; then nothing is set. */
        template <class Value>
        void set(const std::string &column, const std::optional<Value> &value)
        {
            if (value)
                set(column, *value);
        }

        /** \brief A figure as a number; NaN when it was not measured. */
        double number(const std::string &column) const;

        /** \brief Is it there and true? */
        bool is(const std::string &column) const
        {
            return number(column) == 1.0;
        }

        /** \brief Exact, valid when checked once more, and in time. */
        bool isSuccess() const
        {
            return is("success");
        }

        /** \brief Number of the run, from 0. */
        std::size_t run() const
        {
            return static_cast<std::size_t>(number("run"));
        }

        /** \brief Exact, approximate, or why there is no path. */
        std::optional<PlanStatus> outcome() const;

        /** \brief As a process hands it to another, and the database keeps it once it is not of use any more. */
        nlohmann::json toJson() const;

        /** \brief Throws parking::Error, or an exception of nlohmann's, when \e json is no record. */
        static RunRecord fromJson(const nlohmann::json &json);
    };
}  // namespace parking

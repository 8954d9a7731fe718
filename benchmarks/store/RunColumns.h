#pragma once

#include "benchmarks/store/RunRecord.h"

#include <optional>
#include <string>
#include <vector>

namespace parking
{
    /** \brief Type of a column in OMPL's logs. */
    enum class ColumnType
    {
        Boolean,  ///< true or false
        Integer,  ///< a whole number
        Real,     ///< any number
        Enum      ///< a whole number with a name in the table `enums`
    };

    /** \brief Statistic of a column over the runs of a planner on an experiment. */
    enum class Statistic
    {
        Median,              ///< median over the successful runs
        MedianWithInterval,  ///< median over the successful runs, with its confidence interval
        Distribution,  ///< median over all runs, infinite for those without success: quartiles and interval with its
                       ///< level
        Share          ///< share of the successful runs for which it is true
    };

    /** \brief Position of a column in the summary. */
    struct InSummary
    {
        const char *heading;  ///< heading of the column on the terminal and in Markdown
        Statistic statistic;  ///< statistic of the runs' values
        int decimals;         ///< decimals on the terminal; times have three digits instead
        bool inTable{true};   ///< whether the terminal and summary.md show it, too; otherwise only summary.csv
    };

    /** \brief Position of a column in the HTML report, in addition to those that the report finds by name.
        The report shows the median over the solved runs, or the share for true or false. */
    struct InReport
    {
        const char *heading;  ///< heading of the column, without its unit
        double factor;        ///< factor from the column's unit to the displayed one
        const char *unit;     ///< unit as displayed
        bool folded{false};   ///< whether it belongs to the table of further figures below that of the problem
    };

    /** \brief A figure of a run as it appears in files, tables and documents. */
    struct RunColumn
    {
        const char *name;  ///< as in OMPL's logs, but without type; in the database '_' replaces blanks
        ColumnType type;   ///< type of its values
        const char *unit;  ///< unit of its values; empty for counts and booleans
        const char *text;  ///< meaning, for docs/benchmark-reference.md
        std::optional<InSummary> summary{};  ///< if missing, the summary does not show the column
        std::optional<InReport> report{};    ///< if missing, the report shows the column only if it finds it by name

        /** \brief The value in this column's type. Throws parking::Error naming the column for a value out of its
            range. */
        FigureValue checked(const FigureValue &value) const;
    };

    /** \brief Name of the type in OMPL's logs: BOOLEAN, INTEGER, REAL or ENUM. */
    std::string toString(ColumnType type);

    /** \brief All columns: the only definition of their names, types, units and meanings.

        The database, OMPL's logs, the summary, the report's further columns and the table in
        docs/benchmark-reference.md are generated from it. To add a figure, add a row here, and set it where it is
        measured. */
    const std::vector<RunColumn> &runColumns();

    /** \brief The column of this name; null when there is none. */
    const RunColumn *findRunColumn(const std::string &name);

    /** \brief The column of this name. Throws parking::Error when there is none. */
    const RunColumn &runColumn(const std::string &name);
}  // namespace parking

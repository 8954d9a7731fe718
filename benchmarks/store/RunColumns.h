#pragma once

#include "benchmarks/store/RunRecord.h"

#include <optional>
#include <string>
#include <vector>

namespace parking
{
    /** \brief Type of a column, as OMPL's logs know it. */
    enum class ColumnType
    {
        Boolean,  ///< yes or no
        Integer,  ///< a count
        Real,     ///< any number
        Enum      ///< a whole number that has a name in the table `enums`
    };

    /** \brief How a column is summed up over the runs of a planner on an experiment. */
    enum class Statistic
    {
        Median,              ///< over the successful runs
        MedianWithInterval,  ///< the same, with the confidence interval of the median
        Distribution,  ///< over all runs, those without success being infinite: quartiles and interval with its level
        Share          ///< of the successful runs for which it is true
    };

    /** \brief A column's place in the summary. */
    struct InSummary
    {
        const char *heading;  ///< of the column on the terminal and in Markdown
        Statistic statistic;  ///< what is shown of the runs' values
        int decimals;         ///< on the terminal; times have three digits instead
        bool inTable{true};   ///< on the terminal and in summary.md, too; otherwise in summary.csv only
    };

    /** \brief A column's place in the HTML report, beside those that the report knows by name: a median over the solved
        runs, of what is yes or no the share of them. */
    struct InReport
    {
        const char *heading;  ///< of the column, without its unit
        double factor;        ///< from the column's unit to the one shown
        const char *unit;     ///< as shown
        bool folded{false};   ///< in the table of further figures below that of the problem
    };

    /** \brief A figure of a run as it appears in files, tables and documents. */
    struct RunColumn
    {
        const char *name;  ///< as in OMPL's logs, but without type; in the database '_' stands for blanks
        ColumnType type;   ///< of its values
        const char *unit;  ///< empty for counts and what is yes or no
        const char *text;  ///< what it means, for docs/benchmark-reference.md
        std::optional<InSummary> summary{};  ///< without it the summary does not show the column
        std::optional<InReport> report{};    ///< without it the report shows the column only where it knows its name

        /** \brief The value as one of this column's type. Throws parking::Error naming the column for a value that it
            cannot hold. */
        FigureValue checked(const FigureValue &value) const;
    };

    /** \brief OMPL's word: BOOLEAN, INTEGER, REAL or ENUM. */
    std::string toString(ColumnType type);

    /** \brief All columns: the one place that knows their names, types, units and meanings.

        The database and OMPL's logs, the summary, the report's further columns and the table in
       docs/benchmark-reference.md are loops over it. Whoever adds a figure adds a row here, and sets it where it is
       measured. */
    const std::vector<RunColumn> &runColumns();

    /** \brief The column of this name; null when there is none. */
    const RunColumn *findRunColumn(const std::string &name);

    /** \brief The same. Throws parking::Error when there is none. */
    const RunColumn &runColumn(const std::string &name);
}  // namespace parking

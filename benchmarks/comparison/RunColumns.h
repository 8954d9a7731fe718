#pragma once

#include "benchmarks/comparison/RunRecord.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace parking
{
    /** \brief The member of RunRecord that a column shows; its type is the column's type. */
    using RunMember = std::variant<std::optional<bool> RunRecord::*, std::optional<std::uint64_t> RunRecord::*,
                                   std::optional<double> RunRecord::*, std::optional<PlanStatus> RunRecord::*,
                                   std::optional<ompl::base::PlannerStatus::StatusType> RunRecord::*,
                                   std::size_t RunRecord::*, std::uint32_t RunRecord::*>;

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
        RunMember member;  ///< where a RunRecord holds the figure
        const char *unit;  ///< empty for counts and what is yes or no
        const char *text;  ///< what it means, for docs/comparison.md
        std::optional<InSummary> summary;  ///< without it the summary does not show the column
        std::optional<InReport> report;    ///< without it the report shows the column only where it knows its name

        /** \brief OMPL's: BOOLEAN, INTEGER, REAL or ENUM. */
        const char *type() const;

        /** \brief With its type, as OMPL writes it: "time REAL". */
        std::string typedName() const;

        /** \brief The figure of a run; nothing when it was not measured. */
        std::optional<FigureValue> valueOf(const RunRecord &record) const;

        /** \brief The figure as a number; NaN when it was not measured. */
        double numberOf(const RunRecord &record) const;

        /** \brief Sets the figure of a run. Throws parking::Error naming the column for a value that its type cannot
            hold. */
        void set(RunRecord &record, const FigureValue &value) const;
    };

    /** \brief All columns: the one place that knows their names, units and meanings.

        The lines of runs.jsonl, OMPL's logs and with them the database, the summary, the report's further columns and
        the table in docs/comparison.md are loops over it. */
    const std::vector<RunColumn> &runColumns();

    /** \brief The column of this name. Throws parking::Error when there is none. */
    const RunColumn &runColumn(std::string_view name);

    /** \brief All that \e record holds as OMPL's benchmark keeps it: typed names, values as text. */
    std::map<std::string, std::string> omplProperties(const RunRecord &record);

    /** \brief Takes over what OMPL's benchmark has measured: into columns that have no value yet; what no column is for
        becomes reported. */
    void takeOmplProperties(RunRecord &record, const std::map<std::string, std::string> &properties);
}  // namespace parking

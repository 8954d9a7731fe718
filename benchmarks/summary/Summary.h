#pragma once

#include "benchmarks/config/Experiment.h"
#include "benchmarks/store/RunColumns.h"
#include "benchmarks/store/RunRecord.h"

#include <string>
#include <string_view>
#include <vector>

namespace parking
{
    /** \brief A column of the runs summed up over those of one planner on one experiment, as its Statistic says: NaN
        where no run counts, infinite where too many runs do. */
    struct SummaryFigure
    {
        const RunColumn *column;  ///< one that has a place in the summary
        double median;            ///< in the column's unit
        double low;               ///< first quartile
        double high;              ///< third quartile
        double begin;             ///< of the confidence interval of the median
        double end;               ///< of the same interval
        double level;             ///< of certainty that the interval has; 0 for the range of too few values
    };

    /** \brief How one planner did on one experiment. Times in seconds, lengths in metres. */
    struct SummaryRow
    {
        std::string experiment;              ///< its name
        std::string planner;                 ///< what results call the planner
        std::size_t runs{0};                 ///< all that are there, finished or failed
        std::size_t solved{0};               ///< exact and densely valid
        std::size_t invalid{0};              ///< exact in the planner's view, but not valid when checked again
        std::size_t approximate{0};          ///< other paths: they end short of the goals, or came too late
        std::vector<SummaryFigure> figures;  ///< of all columns that the summary has, in their order

        /** \brief The figure of a column. Throws parking::Error when the summary does not have it. */
        const SummaryFigure &figure(std::string_view column) const;
    };

    /** \brief A row for each planner of each experiment, in their order. */
    std::vector<SummaryRow> summarize(const BenchmarkConfig &config, const std::vector<Experiment> &experiments,
                                      const std::vector<RunRecord> &records);

    /** \brief A table for the terminal. */
    std::string summaryText(const std::vector<SummaryRow> &rows);

    /** \brief The same as a Markdown table. */
    std::string summaryMarkdown(const std::vector<SummaryRow> &rows);

    /** \brief What happened in a run in which the planner itself failed, on one line. */
    std::string failureText(const RunRecord &record);

    /** \brief A list of the planners that failed, with how often and why; empty when none did. */
    std::string failuresText(const std::vector<RunRecord> &records);

    /** \brief With all figures, as comma-separated values. Infinite and missing values are empty. */
    std::string summaryCsv(const std::vector<SummaryRow> &rows);
}  // namespace parking

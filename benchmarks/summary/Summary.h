#pragma once

#include "benchmarks/config/Experiment.h"
#include "benchmarks/store/RunColumns.h"
#include "benchmarks/store/RunRecord.h"

#include <string>
#include <string_view>
#include <vector>

namespace parking
{
    /** \brief A column summed up over the runs of one planner on one experiment by its Statistic.
        NaN if no run counts, infinite if too many runs are infinite. */
    struct SummaryFigure
    {
        const RunColumn *column;  ///< a column of the summary
        double median;            ///< value in the column's unit
        double low;               ///< first quartile
        double high;              ///< third quartile
        double begin;             ///< lower end of the median's confidence interval
        double end;               ///< upper end of the median's confidence interval
        double level;             ///< certainty of the interval; 0 for the range of too few values
    };

    /** \brief Results of one planner on one experiment. Times in seconds, lengths in metres. */
    struct SummaryRow
    {
        std::string experiment;      ///< name of the experiment
        std::string planner;         ///< name of the planner in the results
        std::size_t runs{0};         ///< number of all runs, including failed ones
        std::size_t solved{0};       ///< number of exact and densely valid paths
        std::size_t invalid{0};      ///< number of paths exact by the planner's report, but invalid in the recheck
        std::size_t approximate{0};  ///< number of other paths: short of the goals, or after the time limit
        bool solvable{true};         ///< whether start and a goal are free; otherwise no path exists
        std::size_t refused{0};      ///< without a solution: runs that ended before the time limit and claimed no path
        double refusal{0.0};         ///< median time of these; infinite if half of the runs are others
        std::vector<SummaryFigure> figures;  ///< all columns of the summary, in their order

        /** \brief The figure of a column. Throws parking::Error for a column outside of the summary. */
        const SummaryFigure &figure(std::string_view column) const;
    };

    /** \brief One row for each planner of each experiment, in their order. */
    std::vector<SummaryRow> summarize(const BenchmarkConfig &config, const std::vector<Experiment> &experiments,
                                      const std::vector<RunRecord> &records);

    /** \brief Tables for a terminal of 80 columns. Problems without a solution have one of their own.
        \param colours whether the terminal shows colours */
    std::string summaryText(const std::vector<SummaryRow> &rows, bool colours = false);

    /** \brief The tables as Markdown, with quartiles. */
    std::string summaryMarkdown(const std::vector<SummaryRow> &rows);

    /** \brief The failure of a planner in a run, on one line. */
    std::string failureText(const RunRecord &record);

    /** \brief A list of the planners that failed, with number and reason; empty without failures. */
    std::string failuresText(const std::vector<RunRecord> &records);

    /** \brief All figures as comma-separated values. Infinite and missing values are empty. */
    std::string summaryCsv(const std::vector<SummaryRow> &rows);
}  // namespace parking

#pragma once

#include "benchmarks/comparison/Experiment.h"
#include "benchmarks/comparison/RunRecord.h"
#include "benchmarks/summary/Statistics.h"

#include <string>
#include <vector>

namespace parking
{
    /** \brief How one planner did on one experiment. Times in seconds, lengths in metres. */
    struct SummaryRow
    {
        std::string experiment;
        std::string planner;
        std::size_t runs{0};
        std::size_t solved{0};   ///< exact and densely valid
        std::size_t invalid{0};  ///< exact in the planner's view, but not valid when checked again
        std::size_t approximate{0};
        // Over all runs; those without a valid exact solution count as infinite.
        double timeMedian, timeLow, timeHigh;  ///< of the first solution: median and quartiles
        ConfidenceInterval timeInterval;       ///< of the median
        // Over solved runs; NaN without one.
        double length, cusps, clearance;  ///< medians
        ConfidenceInterval lengthInterval;
    };

    /** \brief A row for each planner of each experiment, in their order. */
    std::vector<SummaryRow> summarize(const BenchmarkConfig &config, const std::vector<Experiment> &experiments,
                                      const std::vector<RunRecord> &records);

    /** \brief A table for the terminal. */
    std::string summaryText(const std::vector<SummaryRow> &rows);

    /** \brief The same as a Markdown table. */
    std::string summaryMarkdown(const std::vector<SummaryRow> &rows);

    /** \brief With all figures, as comma-separated values. Infinite and missing values are empty. */
    std::string summaryCsv(const std::vector<SummaryRow> &rows);
}  // namespace parking

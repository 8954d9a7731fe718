#include "benchmarks/summary/Summary.h"

#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace parking
{
    namespace
    {
        constexpr double MS = 1e3;
        constexpr double INFINITE = std::numeric_limits<double>::infinity();

        using Cells = std::vector<std::string>;

        const Cells HEADINGS{"problem",   "planner", "solved", "near",      "first solution",
                             "quartiles", "length",  "cusps",  "clearance", "valid"};

        std::string shown(double value, int decimals)
        {
            if (std::isnan(value))
                return "-";
            if (std::isinf(value))
                return "inf";
            char text[64];
            std::snprintf(text, sizeof text, "%.*f", decimals, value);
            return text;
        }

        /** Milliseconds with three digits that say something. */
        std::string shownTime(double seconds)
        {
            const double value = MS * seconds;
            return shown(value, value < 10.0 ? 2 : value < 100.0 ? 1 : 0);
        }

        Cells cellsOf(const SummaryRow &row)
        {
            return {row.experiment,
                    row.planner,
                    std::to_string(row.solved) + "/" + std::to_string(row.runs),
                    row.approximate > 0 ? std::to_string(row.approximate) : "-",
                    std::isinf(row.timeMedian) ? "-" : shownTime(row.timeMedian) + " ms",
                    std::isinf(row.timeLow) ? "-" : shownTime(row.timeLow) + " .. " + shownTime(row.timeHigh),
                    std::isnan(row.length) ? "-" : shown(row.length, 2) + " m",
                    shown(row.cusps, 0),
                    std::isnan(row.clearance) ? "-" : shown(row.clearance, 3) + " m",
                    row.invalid > 0  ? "NO (" + std::to_string(row.invalid) + ")"
                    : row.solved > 0 ? "yes"
                                     : "-"};
        }

        std::string csvNumber(double value)
        {
            return std::isfinite(value) ? formatNumber(value) : "";
        }
    }  // namespace

    std::vector<SummaryRow> summarize(const BenchmarkConfig &config, const std::vector<Experiment> &experiments,
                                      const std::vector<RunRecord> &records)
    {
        std::vector<SummaryRow> rows;
        for (const Experiment &experiment : experiments)
            for (const std::size_t index : experiment.planners)
            {
                SummaryRow row{};
                row.experiment = experiment.name;
                row.planner = config.planners[index].name;
                std::vector<double> times, lengths, cusps, clearances;
                for (const RunRecord &record : records)
                {
                    if (record.experiment != row.experiment || record.planner != row.planner)
                        continue;
                    ++row.runs;
                    const bool solved = record.solved();
                    times.push_back(solved ? record.number("first solution time REAL") : INFINITE);
                    if (solved)
                    {
                        ++row.solved;
                        lengths.push_back(record.number("path length REAL"));
                        cusps.push_back(record.number("cusps INTEGER"));
                        clearances.push_back(record.number("least clearance REAL"));
                    }
                    else if (record.number("densely valid BOOLEAN") == 0.0 && record.exact)
                        ++row.invalid;
                    else if (record.hasPath)
                        ++row.approximate;
                }
                if (row.runs == 0)
                    continue;
                row.timeMedian = quantile(times, 0.5);
                row.timeLow = quantile(times, 0.25);
                row.timeHigh = quantile(times, 0.75);
                row.timeInterval = medianInterval(times);
                row.length = quantile(lengths, 0.5);
                row.cusps = quantile(cusps, 0.5);
                row.clearance = quantile(clearances, 0.5);
                row.lengthInterval = medianInterval(lengths);
                rows.push_back(std::move(row));
            }
        return rows;
    }

    std::string summaryText(const std::vector<SummaryRow> &rows)
    {
        std::vector<Cells> table{HEADINGS};
        for (const SummaryRow &row : rows)
            table.push_back(cellsOf(row));
        std::vector<std::size_t> widths(HEADINGS.size(), 0);
        for (const Cells &cells : table)
            for (std::size_t i = 0; i < cells.size(); ++i)
                widths[i] = std::max(widths[i], cells[i].size());
        std::string text;
        std::string last;
        for (std::size_t line = 0; line < table.size(); ++line)
        {
            Cells cells = table[line];
            if (line > 0 && cells[0] == last)
                cells[0].clear();
            else if (line > 0)
            {
                last = cells[0];
                text += "\n";
            }
            std::string each;
            for (std::size_t i = 0; i < cells.size(); ++i)
            {
                const std::string padding(widths[i] - cells[i].size(), ' ');
                // Names to the left, figures to the right.
                each += (i < 2 ? cells[i] + padding : padding + cells[i]) + "  ";
            }
            text += each.substr(0, each.find_last_not_of(' ') + 1) + "\n";
        }
        return text;
    }

    std::string summaryMarkdown(const std::vector<SummaryRow> &rows)
    {
        std::string text = "|";
        for (const std::string &heading : HEADINGS)
            text += " " + heading + " |";
        text += "\n| --- | --- |";
        for (std::size_t i = 2; i < HEADINGS.size(); ++i)
            text += " ---: |";
        text += "\n";
        for (const SummaryRow &row : rows)
        {
            text += "|";
            for (const std::string &cell : cellsOf(row))
                text += " " + cell + " |";
            text += "\n";
        }
        return text;
    }

    std::string summaryCsv(const std::vector<SummaryRow> &rows)
    {
        std::string text =
            "problem,planner,runs,solved,invalid,approximate,first_solution_median_s,first_solution_q1_s,"
            "first_solution_q3_s,first_solution_ci_low_s,first_solution_ci_high_s,first_solution_ci_level,length_"
            "median_m,"
            "length_ci_low_m,length_ci_high_m,cusps_median,clearance_median_m\n";
        for (const SummaryRow &row : rows)
        {
            text += row.experiment + "," + row.planner + "," + std::to_string(row.runs) + "," +
                    std::to_string(row.solved) + "," + std::to_string(row.invalid) + "," +
                    std::to_string(row.approximate);
            for (const double value : {row.timeMedian, row.timeLow, row.timeHigh, row.timeInterval.low,
                                       row.timeInterval.high, row.timeInterval.level, row.length,
                                       row.lengthInterval.low, row.lengthInterval.high, row.cusps, row.clearance})
                text += "," + csvNumber(value);
            text += "\n";
        }
        return text;
    }
}  // namespace parking

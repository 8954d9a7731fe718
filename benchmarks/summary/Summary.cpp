#include "benchmarks/summary/Summary.h"

#include "benchmarks/summary/Statistics.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>
#include <tuple>

namespace parking
{
    namespace
    {
        constexpr double MS = 1e3;

        using Cells = std::vector<std::string>;

        Cells headings()
        {
            Cells cells{"problem", "planner", "solved", "near"};
            for (const RunColumn &column : runColumns())
            {
                if (!column.summary || !column.summary->inTable)
                    continue;
                cells.emplace_back(column.summary->heading);
                if (column.summary->statistic == Statistic::Distribution)
                    cells.emplace_back("quartiles");
            }
            cells.emplace_back("valid");
            return cells;
        }

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

        /** Milliseconds with three significant digits. */
        std::string shownTime(double seconds)
        {
            const double value = MS * seconds;
            return shown(value, value < 10.0 ? 2 : value < 100.0 ? 1 : 0);
        }

        bool isTime(const RunColumn &column)
        {
            return column.unit == std::string_view("s");
        }

        std::string shownFigure(const RunColumn &column, double value)
        {
            return isTime(column) ? shownTime(value) : shown(value, column.summary->decimals);
        }

        Cells cellsOf(const SummaryRow &row)
        {
            Cells cells{row.experiment, row.planner, std::to_string(row.solved) + "/" + std::to_string(row.runs),
                        row.approximate > 0 ? std::to_string(row.approximate) : "-"};
            for (const SummaryFigure &figure : row.figures)
            {
                const RunColumn &column = *figure.column;
                if (!column.summary->inTable)
                    continue;
                const bool distribution = column.summary->statistic == Statistic::Distribution;
                const bool nothing = std::isnan(figure.median) || (distribution && std::isinf(figure.median));
                const std::string unit = isTime(column) ? "ms" : column.unit;
                cells.push_back(nothing        ? "-"
                                : unit.empty() ? shownFigure(column, figure.median)
                                               : shownFigure(column, figure.median) + " " + unit);
                if (distribution)
                    cells.push_back(std::isinf(figure.low)
                                        ? "-"
                                        : shownFigure(column, figure.low) + " .. " + shownFigure(column, figure.high));
            }
            cells.push_back(row.invalid > 0  ? "NO (" + std::to_string(row.invalid) + ")"
                            : row.solved > 0 ? "yes"
                                             : "-");
            return cells;
        }

        std::string csvNumber(double value)
        {
            return std::isfinite(value) ? formatNumber(value) : "";
        }

        /** Text of a column in the CSV file. */
        struct CsvFigure
        {
            const char *name;
            bool hasUnit;
            double SummaryFigure::*value;
        };

        std::vector<CsvFigure> csvFigures(Statistic statistic)
        {
            const CsvFigure median{"median", true, &SummaryFigure::median}, low{"q1", true, &SummaryFigure::low},
                high{"q3", true, &SummaryFigure::high}, begin{"ci_low", true, &SummaryFigure::begin},
                end{"ci_high", true, &SummaryFigure::end}, level{"ci_level", false, &SummaryFigure::level};
            switch (statistic)
            {
                case Statistic::Distribution:
                    return {median, low, high, begin, end, level};
                case Statistic::MedianWithInterval:
                    return {median, begin, end};
                case Statistic::Share:
                    return {{"share", false, &SummaryFigure::median}};
                case Statistic::Median:
                    break;
            }
            return {median};
        }

        /** Name such as first_solution_median_s. */
        std::string csvHeading(const RunColumn &column, const CsvFigure &figure)
        {
            std::string text = std::string(column.summary->heading) + "_" + figure.name;
            std::replace(text.begin(), text.end(), ' ', '_');
            return figure.hasUnit && column.unit[0] != '\0' ? text + "_" + column.unit : text;
        }

        SummaryFigure figureOf(const RunColumn &column, const std::vector<const RunRecord *> &records)
        {
            std::vector<double> values;
            for (const RunRecord *record : records)
                if (record->isSuccess())
                    values.push_back(record->number(column.name));
                else if (column.summary->statistic == Statistic::Distribution)
                    values.push_back(HUGE_VAL);
            // Only runs with the figure count: a path without a trajectory has no figures of one.
            values.erase(std::remove_if(values.begin(), values.end(), [](double value) { return std::isnan(value); }),
                         values.end());
            if (column.summary->statistic == Statistic::Share)
            {
                const double share =
                    std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
                return {&column, share, share, share, share, share, 0.0};
            }
            const ConfidenceInterval interval = medianInterval(values);
            return {&column,      quantile(values, 0.5), quantile(values, 0.25), quantile(values, 0.75),
                    interval.low, interval.high,         interval.level};
        }

        /** Summary of all runs of one planner on one experiment. */
        SummaryRow summaryOf(const std::vector<const RunRecord *> &records)
        {
            SummaryRow row;
            row.experiment = records.front()->experiment;
            row.planner = records.front()->planner;
            row.runs = records.size();
            for (const RunRecord *record : records)
                if (record->isSuccess())
                    ++row.solved;
                else if (record->exact && record->number("densely valid") == 0.0)
                    ++row.invalid;
                else if (record->hasPath)
                    ++row.approximate;
            for (const RunColumn &column : runColumns())
                if (column.summary)
                    row.figures.push_back(figureOf(column, records));
            return row;
        }
    }  // namespace

    const SummaryFigure &SummaryRow::figure(std::string_view column) const
    {
        for (const SummaryFigure &each : figures)
            if (column == each.column->name)
                return each;
        throw Error("the summary has no column " + inQuotes(column));
    }

    std::vector<SummaryRow> summarize(const BenchmarkConfig &config, const std::vector<Experiment> &experiments,
                                      const std::vector<RunRecord> &records)
    {
        std::vector<SummaryRow> rows;
        for (const Experiment &experiment : experiments)
            for (const std::size_t index : experiment.planners)
            {
                std::vector<const RunRecord *> own;
                for (const RunRecord &record : records)
                    if (record.experiment == experiment.name && record.planner == config.planners[index].name)
                        own.push_back(&record);
                if (!own.empty())
                    rows.push_back(summaryOf(own));
            }
        return rows;
    }

    std::string summaryText(const std::vector<SummaryRow> &rows)
    {
        std::vector<Cells> table{headings()};
        for (const SummaryRow &row : rows)
            table.push_back(cellsOf(row));
        std::vector<std::size_t> widths(table.front().size(), 0);
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
                // Names aligned to the left, figures to the right.
                each += (i < 2 ? cells[i] + padding : padding + cells[i]) + "  ";
            }
            text += each.substr(0, each.find_last_not_of(' ') + 1) + "\n";
        }
        return text;
    }

    std::string summaryMarkdown(const std::vector<SummaryRow> &rows)
    {
        std::string text = "|";
        const Cells titles = headings();
        for (const std::string &title : titles)
            text += " " + title + " |";
        text += "\n| --- | --- |";
        for (std::size_t i = 2; i < titles.size(); ++i)
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

    std::string failureText(const RunRecord &record)
    {
        return record.planner + " on " + record.experiment + ", run " + std::to_string(record.run()) + ": " +
               toString(*record.outcome()) + ": " + oneLine(record.reason);
    }

    std::string failuresText(const std::vector<RunRecord> &records)
    {
        struct Failures
        {
            std::size_t count{0};
            const RunRecord *first{nullptr};
        };
        std::map<std::tuple<std::string, std::string, PlanStatus>, Failures> all;
        for (const RunRecord &record : records)
            if (const auto outcome = record.outcome(); outcome && isFailure(*outcome))
            {
                Failures &same = all[{record.planner, record.experiment, *outcome}];
                if (same.count++ == 0)
                    same.first = &record;
            }
        if (all.empty())
            return "";
        std::string text = "\nPlanners that failed:\n\n";
        for (const auto &[key, same] : all)
            text += "- " + std::to_string(same.count) + " times " + failureText(*same.first) + "\n";
        return text;
    }

    std::string summaryCsv(const std::vector<SummaryRow> &rows)
    {
        std::string text = "problem,planner,runs,solved,invalid,approximate";
        for (const RunColumn &column : runColumns())
            if (column.summary)
                for (const CsvFigure &each : csvFigures(column.summary->statistic))
                    text += "," + csvHeading(column, each);
        text += "\n";
        for (const SummaryRow &row : rows)
        {
            text += row.experiment + "," + row.planner + "," + std::to_string(row.runs) + "," +
                    std::to_string(row.solved) + "," + std::to_string(row.invalid) + "," +
                    std::to_string(row.approximate);
            for (const SummaryFigure &figure : row.figures)
                for (const CsvFigure &each : csvFigures(figure.column->summary->statistic))
                    text += "," + csvNumber(figure.*each.value);
            text += "\n";
        }
        return text;
    }
}  // namespace parking

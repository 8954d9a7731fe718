#include "benchmarks/summary/Summary.h"

#include "benchmarks/summary/Statistics.h"
#include "benchmarks/system/Terminal.h"
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
        constexpr double FULL = 0.99;  // share of the time limit beyond which a run used it up

        constexpr const char *UNSOLVABLE = "Problems without a solution: right is to end early and to claim no path.";
        constexpr const char *POPULATIONS = "Times are medians over all runs, other figures over the solved ones.";
        constexpr std::size_t TERMINAL_WIDTH = 80, NAME_WIDTH = 24;  // characters

        using Cells = std::vector<std::string>;

        std::vector<const RunColumn *> tableColumns()
        {
            std::vector<const RunColumn *> columns;
            for (const RunColumn &column : runColumns())
                if (column.summary && column.summary->inTable)
                    columns.push_back(&column);
            return columns;
        }

        Cells headings()
        {
            Cells cells{"problem", "planner", "solved", "near"};
            for (const RunColumn *column : tableColumns())
            {
                cells.emplace_back(column->summary->heading);
                if (column->summary->statistic == Statistic::Distribution)
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

        std::string ofAll(std::size_t count, const SummaryRow &row)
        {
            return std::to_string(count) + "/" + std::to_string(row.runs);
        }

        /** The median with its unit; "-" without one, or for an infinite time. */
        std::string medianText(const SummaryFigure &figure)
        {
            const RunColumn &column = *figure.column;
            const bool distribution = column.summary->statistic == Statistic::Distribution;
            if (std::isnan(figure.median) || (distribution && std::isinf(figure.median)))
                return "-";
            const std::string unit = isTime(column) ? "ms" : column.unit;
            return shownFigure(column, figure.median) + (unit.empty() ? "" : " " + unit);
        }

        std::string refusalText(const SummaryRow &row)
        {
            return std::isfinite(row.refusal) ? shownTime(row.refusal) + " ms" : "-";
        }

        Cells cellsOf(const SummaryRow &row)
        {
            Cells cells{row.experiment, row.planner, ofAll(row.solved, row),
                        row.approximate > 0 ? std::to_string(row.approximate) : "-"};
            for (const RunColumn *column : tableColumns())
            {
                const SummaryFigure &figure = row.figure(column->name);
                cells.push_back(medianText(figure));
                if (column->summary->statistic == Statistic::Distribution)
                    cells.push_back(std::isinf(figure.low) ? "-"
                                                           : shownFigure(*column, figure.low) + " .. " +
                                                                 shownFigure(*column, figure.high));
            }
            cells.push_back(row.invalid > 0  ? "NO (" + std::to_string(row.invalid) + ")"
                            : row.solved > 0 ? "yes"
                                             : "-");
            return cells;
        }

        /** Lines of a table for the terminal, under the names of their problems. */
        struct Lines
        {
            Cells titles;  ///< of all cells but the last
            /** Cells; the last is a remark, and red if it is about a fault. */
            std::vector<std::pair<const SummaryRow *, Cells>> rows;
        };

        /** A title in two lines. */
        std::pair<std::string, std::string> divided(const std::string &title)
        {
            const std::size_t blank = title.rfind(' ');
            return blank == std::string::npos ? std::make_pair(std::string(), title)
                                              : std::make_pair(title.substr(0, blank), title.substr(blank + 1));
        }

        std::vector<std::size_t> widthsOf(const Lines &lines)
        {
            std::vector<std::size_t> widths;
            for (const std::string &title : lines.titles)
                widths.push_back(std::max(divided(title).first.size(), divided(title).second.size()));
            for (const auto &[row, cells] : lines.rows)
                for (std::size_t i = 0; i < widths.size(); ++i)
                    widths[i] = std::max(widths[i], cells[i].size());
            widths.front() = std::min(widths.front(), NAME_WIDTH);
            return widths;
        }

        /** Names aligned to the left, figures to the right. */
        std::string alignedLine(const Cells &cells, const std::vector<std::size_t> &widths)
        {
            std::string line;
            for (std::size_t i = 0; i < widths.size(); ++i)
            {
                const std::string padding(widths[i] - std::min(widths[i], cells[i].size()), ' ');
                line += "  " + (i == 0 ? cells[i] + padding : padding + cells[i]);
            }
            return line.substr(0, line.find_last_not_of(' ') + 1);
        }

        std::string textOf(const Lines &lines, bool colours)
        {
            if (lines.rows.empty())
                return "";
            const std::vector<std::size_t> widths = widthsOf(lines);
            Cells upper, lower;
            for (const std::string &title : lines.titles)
            {
                upper.push_back(divided(title).first);
                lower.push_back(divided(title).second);
            }
            std::string text = alignedLine(upper, widths) + "\n" + alignedLine(lower, widths) + "\n";
            std::string problem;
            for (auto [row, cells] : lines.rows)
            {
                if (row->experiment != problem)
                    text += styled(row->experiment, terminal_style::BOLD, colours) + "\n";
                problem = row->experiment;
                if (cells.front().size() > widths.front())
                {
                    text += "  " + cells.front() + "\n";
                    cells.front().clear();
                }
                const std::string line = alignedLine(cells, widths);
                text += line;
                if (const std::string &remark = cells.back(); !remark.empty())
                    text += (line.size() + 2 + remark.size() > TERMINAL_WIDTH ? "\n    " : "  ") +
                            styled(remark, terminal_style::RED, colours && row->invalid > 0);
                text += "\n";
            }
            return text;
        }

        /** Such as "1 INVALID, 2 near". */
        std::string remarkOn(const SummaryRow &row)
        {
            std::string text = row.invalid > 0 ? std::to_string(row.invalid) + " INVALID" : "";
            if (row.solvable && row.approximate > 0)
                text += (text.empty() ? "" : ", ") + std::to_string(row.approximate) + " near";
            return text;
        }

        std::string markdownTable(const Cells &titles, const std::vector<Cells> &rows)
        {
            const auto line = [](const Cells &cells)
            {
                std::string text = "|";
                for (const std::string &cell : cells)
                    text += " " + cell + " |";
                return text + "\n";
            };
            std::string text = line(titles) + "| --- | --- |";
            for (std::size_t i = 2; i < titles.size(); ++i)
                text += " ---: |";
            text += "\n";
            for (const Cells &cells : rows)
                text += line(cells);
            return text;
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

        /** Whether a run ended by itself without claiming a path. */
        bool isRefusal(const RunRecord &record, double timeLimit)
        {
            return !record.exact && record.outcome() && !isFailure(*record.outcome()) &&
                   record.number("planning time") < FULL * timeLimit;
        }

        /** Summary of all runs of one planner on one experiment. */
        SummaryRow summaryOf(const std::vector<const RunRecord *> &records, bool solvable, double timeLimit)
        {
            SummaryRow row;
            row.solvable = solvable;
            std::vector<double> refusals;
            for (const RunRecord *record : records)
            {
                const bool refused = !solvable && isRefusal(*record, timeLimit);
                row.refused += refused ? 1 : 0;
                refusals.push_back(refused ? record->number("planning time") : HUGE_VAL);
            }
            row.refusal = quantile(refusals, 0.5);
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
        {
            const bool solvable =
                std::none_of(records.begin(), records.end(),
                             [&experiment](const RunRecord &record)
                             { return record.experiment == experiment.name && record.number("solvable") == 0.0; });
            for (const std::size_t index : experiment.planners)
            {
                std::vector<const RunRecord *> own;
                for (const RunRecord &record : records)
                    if (record.experiment == experiment.name && record.planner == config.planners[index].name)
                        own.push_back(&record);
                if (!own.empty())
                    rows.push_back(summaryOf(own, solvable, config.timeLimit));
            }
        }
        return rows;
    }

    std::string summaryText(const std::vector<SummaryRow> &rows, bool colours)
    {
        Lines solvable{{"planner", "solved"}, {}}, others{{"planner", "refused", "after"}, {}};
        for (const RunColumn *column : tableColumns())
            solvable.titles.emplace_back(column->summary->heading);
        for (const SummaryRow &row : rows)
        {
            Cells cells{row.planner, ofAll(row.solvable ? row.solved : row.refused, row)};
            if (row.solvable)
                for (const RunColumn *column : tableColumns())
                    cells.push_back(medianText(row.figure(column->name)));
            else
                cells.push_back(refusalText(row));
            cells.push_back(remarkOn(row));
            (row.solvable ? solvable : others).rows.emplace_back(&row, std::move(cells));
        }
        std::string text = textOf(solvable, colours);
        if (!text.empty())
            text += std::string("\n") + POPULATIONS + "\n";
        if (!others.rows.empty())
            text += (text.empty() ? "" : "\n") + std::string(UNSOLVABLE) + "\n" + textOf(others, colours);
        return text;
    }

    std::string summaryMarkdown(const std::vector<SummaryRow> &rows)
    {
        std::vector<Cells> solvable, others;
        for (const SummaryRow &row : rows)
            if (row.solvable)
                solvable.push_back(cellsOf(row));
            else
                others.push_back({row.experiment, row.planner, ofAll(row.refused, row), refusalText(row),
                                  row.invalid > 0 ? std::to_string(row.invalid) : "-"});
        std::string text = solvable.empty() ? "" : markdownTable(headings(), solvable) + "\n" + POPULATIONS + "\n";
        if (!others.empty())
            text += (text.empty() ? "" : "\n") + std::string(UNSOLVABLE) + "\n\n" +
                    markdownTable({"problem", "planner", "refused", "after", "claimed a path"}, others);
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
        text += ",solvable,refused,refusal_median_s\n";
        for (const SummaryRow &row : rows)
        {
            text += row.experiment + "," + row.planner + "," + std::to_string(row.runs) + "," +
                    std::to_string(row.solved) + "," + std::to_string(row.invalid) + "," +
                    std::to_string(row.approximate);
            for (const SummaryFigure &figure : row.figures)
                for (const CsvFigure &each : csvFigures(figure.column->summary->statistic))
                    text += "," + csvNumber(figure.*each.value);
            text += std::string(",") + (row.solvable ? "1," : "0,") + std::to_string(row.refused) + "," +
                    csvNumber(row.refusal) + "\n";
        }
        return text;
    }
}  // namespace parking

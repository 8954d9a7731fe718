#include "benchmarks/store/OmplLog.h"

#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

namespace parking
{
    namespace
    {
        using Statement = Database::Statement;

        std::string figure(const Statement &row, int column)
        {
            const SqlValue value = row.value(column);
            const auto *real = std::get_if<double>(&value);
            return real != nullptr ? formatNumber(*real) : row.text(column);
        }

        std::string withBlanks(std::string name)
        {
            std::replace(name.begin(), name.end(), '_', ' ');
            return name;
        }

        /** A list after its number of entries. */
        std::string counted(const std::vector<std::string> &lines, const std::string &what)
        {
            std::string text = std::to_string(lines.size()) + " " + what + "\n";
            for (const std::string &line : lines)
                text += line + "\n";
            return text;
        }

        /** Name and values of each enumeration, one per line. */
        std::vector<std::string> enumerations(const Database &database)
        {
            std::vector<std::string> lines;
            std::string last;
            Statement values(database, "SELECT name, description FROM enums ORDER BY name DESC, value");
            for (; values.step(); lines.back() += "|" + values.text(1))
                if (values.text(0) != std::exchange(last, values.text(0)))
                    lines.push_back(last);
            return lines;
        }

        /** The head of an experiment's log, without its planners. */
        std::string head(const Database &database, const std::string &experiment)
        {
            Statement row(database, "SELECT * FROM experiments WHERE name = ?", {experiment});
            row.step();
            const std::vector<std::string> names = row.names();
            std::map<std::string, std::string> values;
            for (std::size_t i = 0; i < names.size(); ++i)
                values[names[i]] = figure(row, static_cast<int>(i));
            std::string library = values["version"];
            library.insert(std::min(library.find(' '), library.size()), " version");
            return library + "\nExperiment " + experiment + "\n0 experiment properties\n" + "Running on " +
                   values["hostname"] + "\nStarting at " + values["date"] + "\n<<<|\n" + values["setup"] +
                   "|>>>\n<<<|\n" + values["cpuinfo"] + "|>>>\n" + values["seed"] + " is the random seed\n" +
                   values["timelimit"] + " seconds per run\n" + values["memorylimit"] + " MB per run\n" +
                   values["runcount"] + " runs per planner\n" + values["totaltime"] +
                   " seconds spent to collect the data\n" + counted(enumerations(database), "enum types");
        }

        /** Columns for which a run of the planner has a figure, as names and typed names. */
        std::vector<std::pair<std::string, std::string>> columnsOf(const Database &database, const std::string &runs)
        {
            std::vector<std::pair<std::string, std::string>> columns;
            Statement all(database,
                          "SELECT name, type FROM pragma_table_info('runs') WHERE name NOT IN "
                          "('id', 'experimentid', 'plannerid') ORDER BY name");
            std::vector<std::pair<std::string, std::string>> found;
            std::string counts;
            while (all.step())
            {
                found.emplace_back(quotedName(all.text(0)), withBlanks(all.text(0)) + " " + all.text(1));
                counts += (counts.empty() ? "SELECT COUNT(" : "), COUNT(") + found.back().first;
            }
            Statement count(database, counts + ") FROM runs" + runs);
            count.step();
            for (std::size_t i = 0; i < found.size(); ++i)
                if (count.number(static_cast<int>(i)) > 0)
                    columns.push_back(found[i]);
            return columns;
        }

        /** \param ids of its rows in plannerConfigs, separated by commas */
        std::string planner(const Database &database, const std::string &name, const std::string &ids,
                            const std::string &experiment)
        {
            const std::string runs = " WHERE experimentid = " + experiment + " AND plannerid IN (" + ids + ")";
            // A run that fails early has no parameters.
            std::vector<std::string> parameters;
            std::istringstream settings(std::get<std::string>(
                database.valueOf("SELECT MAX(settings) FROM plannerConfigs WHERE id IN (" + ids + ")")));
            for (std::string line; std::getline(settings, line) && line != ";";)
                parameters.push_back(line.substr(line.front() == ';' ? 1 : 0));

            std::vector<std::string> names, figures, steps;
            std::string selection;
            for (const auto &[column, typed] : columnsOf(database, runs))
            {
                names.push_back(typed);
                selection += (selection.empty() ? "" : ", ") + column;
            }
            Statement rows(database, "SELECT " + selection + " FROM runs" + runs + " ORDER BY run");
            while (rows.step())
            {
                std::string &line = figures.emplace_back();
                for (int i = 0; i < static_cast<int>(names.size()); ++i)
                    line += figure(rows, i) + "; ";
            }
            Statement progress(
                database,
                "SELECT id, progress.time, progress.best_cost FROM runs LEFT JOIN progress ON progress.runid = id" +
                    runs + " ORDER BY run, progress.time");
            for (std::int64_t last = 0; progress.step();)
            {
                if (progress.number(0) != std::exchange(last, progress.number(0)))
                    steps.emplace_back();
                if (const std::string time = figure(progress, 1), cost = figure(progress, 2); !time.empty())
                    steps.back() += (cost.empty() ? "inf" : cost) + "," + time + ",;";
            }
            return name + "\n" + counted(parameters, "common properties") + counted(names, "properties for each run") +
                   counted(figures, "runs") +
                   counted({"best cost REAL", "time REAL"}, "progress properties for each run") +
                   counted(steps, "runs") + ".\n";
        }
    }  // namespace

    std::string omplLog(const Database &database, const std::string &experiment)
    {
        std::string text;
        int count = 0;
        Statement planners(database,
                           "SELECT name, GROUP_CONCAT(id), experimentid FROM plannerConfigs JOIN (SELECT DISTINCT "
                           "experimentid, plannerid FROM runs WHERE experimentid = (SELECT id FROM experiments WHERE "
                           "name = ?)) ON plannerid = id GROUP BY name ORDER BY MIN(id)",
                           {experiment});
        for (; planners.step(); ++count)
            text += planner(database, planners.text(0), planners.text(1), planners.text(2));
        return head(database, experiment) + std::to_string(count) + " planners\n" + text;
    }
}  // namespace parking

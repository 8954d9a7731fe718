#include "benchmarks/comparison/RunStore.h"

#include "benchmarks/comparison/RunColumns.h"
#include "benchmarks/problems/PathJson.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <ompl/base/PlannerStatus.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>
#include <utility>

namespace fs = std::filesystem;
using nlohmann::json;

namespace parking
{
    namespace
    {
        constexpr std::int64_t FORMAT = 3;        // of the tables; earlier ones were files of lines
        constexpr double PROGRESS_STEP = 0.05;    // seconds between samples of the best cost
        const std::string PREFIX = "geometric_";  // of planners' names, as OMPL's benchmark puts it

        /** OMPL's, as ompl_benchmark_statistics makes them, and the comparison's own two. */
        const char *const TABLES = R"(
            CREATE TABLE experiments (id INTEGER PRIMARY KEY AUTOINCREMENT, name VARCHAR(512),
                totaltime REAL, timelimit REAL, memorylimit REAL, runcount INTEGER,
                version VARCHAR(128), hostname VARCHAR(1024), cpuinfo TEXT,
                date DATETIME, seed VARCHAR(24), setup TEXT);
            CREATE TABLE plannerConfigs (id INTEGER PRIMARY KEY AUTOINCREMENT,
                name VARCHAR(512) NOT NULL, settings TEXT);
            CREATE TABLE enums (name VARCHAR(512), value INTEGER, description TEXT, PRIMARY KEY (name, value));
            CREATE TABLE runs (id INTEGER PRIMARY KEY AUTOINCREMENT, experimentid INTEGER, plannerid INTEGER,
                run INTEGER, seed INTEGER, time REAL,
                FOREIGN KEY (experimentid) REFERENCES experiments(id) ON DELETE CASCADE,
                FOREIGN KEY (plannerid) REFERENCES plannerConfigs(id) ON DELETE CASCADE);
            CREATE INDEX runsOfPlanners ON runs (experimentid, plannerid);
            CREATE TABLE progress (runid INTEGER, time REAL, best_cost REAL, PRIMARY KEY (runid, time),
                FOREIGN KEY (runid) REFERENCES runs(id) ON DELETE CASCADE);
            CREATE TABLE details (runid INTEGER PRIMARY KEY, fingerprint TEXT, reason TEXT, path TEXT,
                FOREIGN KEY (runid) REFERENCES runs(id) ON DELETE CASCADE);
            CREATE TABLE superseded (id INTEGER PRIMARY KEY, run TEXT);)";

        std::int64_t numberOf(const SqlValue &cell)
        {
            const auto *number = std::get_if<std::int64_t>(&cell);
            return number == nullptr ? 0 : *number;
        }

        std::string textOf(const SqlValue &cell)
        {
            const auto *text = std::get_if<std::string>(&cell);
            return text == nullptr ? "" : *text;
        }

        std::string withSmallLetters(std::string text)
        {
            for (char &letter : text)
                letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
            return text;
        }

        /** What a figure is called in the database. Names that a planner has made up may be those of keys. */
        std::string columnOf(const std::string &figure)
        {
            std::string name = oneLine(figure);
            std::replace(name.begin(), name.end(), ' ', '_');
            const std::string key = withSmallLetters(name);
            return key == "id" || key == "experimentid" || key == "plannerid" ? name + "_" : name;
        }

        std::string figureOfColumn(std::string name)
        {
            std::replace(name.begin(), name.end(), '_', ' ');
            return name;
        }

        std::string typeOf(const std::string &figure, const FigureValue &value)
        {
            constexpr ColumnType TYPES[] = {ColumnType::Boolean, ColumnType::Integer, ColumnType::Real};
            const RunColumn *column = findRunColumn(figure);
            return toString(column != nullptr ? column->type : TYPES[value.index()]);
        }

        SqlValue cellOf(const FigureValue &value)
        {
            if (const auto *real = std::get_if<double>(&value))
                return std::isnan(*real) ? SqlValue(nullptr) : SqlValue(*real);
            return std::visit([](auto each) { return SqlValue(static_cast<std::int64_t>(each)); }, value);
        }

        void setFigure(RunRecord &record, const std::string &column, const std::string &type, const SqlValue &cell)
        {
            const std::string name = figureOfColumn(column);
            if (std::holds_alternative<std::nullptr_t>(cell))
                return;
            if (std::holds_alternative<std::string>(cell))
                throw Error("the column " + inQuotes(column) + " holds a text");
            const auto *whole = std::get_if<std::int64_t>(&cell);
            const FigureValue value = whole == nullptr    ? FigureValue(std::get<double>(cell))
                                      : type == "BOOLEAN" ? FigureValue(*whole != 0)
                                                          : FigureValue(*whole);
            if (findRunColumn(name) != nullptr)
                record.setFigure(name, value);
            else
                record.figures[name] = value;
        }

        /** As ompl_benchmark_statistics joins the lines of a log. */
        std::string settingsOf(const RunRecord &record)
        {
            std::string text;
            for (const auto &[name, value] : record.parameters)
                text += oneLine(name) + " = " + oneLine(value) + "\n;";
            return text;
        }

        std::map<std::string, std::string> parametersFrom(const std::string &settings)
        {
            std::map<std::string, std::string> parameters;
            std::istringstream lines(settings);
            for (std::string line; std::getline(lines, line);)
            {
                const std::size_t begin = line.front() == ';' ? 1 : 0, sign = line.find(" = ");
                if (sign != std::string::npos)
                    parameters[line.substr(begin, sign - begin)] = line.substr(sign + 3);
            }
            return parameters;
        }

        /** Cost over time as Planner Arena plots it: at regular times and at each improvement. */
        std::map<double, SqlValue> progressOf(const RunRecord &record)
        {
            std::map<double, SqlValue> costs;
            const double total = record.number("time");
            for (int i = 1; i * PROGRESS_STEP <= total; ++i)
                costs[i * PROGRESS_STEP] = nullptr;
            for (const Improvement &each : record.progress)
                costs[each.time] = each.cost;
            SqlValue last = nullptr;
            for (auto &[time, cost] : costs)
            {
                if (std::holds_alternative<std::nullptr_t>(cost))
                    cost = last;
                last = cost;
            }
            return costs;
        }

        void requireFormat(const Database &database)
        {
            if (numberOf(database.ask("PRAGMA user_version")) != FORMAT)
                throw DatabaseDamage(oneLine(database.file()) +
                                     ": is no database of runs that this version of parking_benchmark can read");
        }

        /** Runs with their ids, as they were finished. */
        std::vector<std::pair<std::int64_t, RunRecord>> readRuns(const Database &database, const std::string &order)
        {
            std::map<std::int64_t, std::vector<Improvement>> progress;
            Database::Statement steps(
                database,
                "SELECT runid, time, best_cost FROM progress WHERE best_cost IS NOT NULL ORDER BY runid, time");
            while (steps.step())
            {
                std::vector<Improvement> &own = progress[steps.number(0)];
                const double cost = steps.real(2);
                if (own.empty() || cost < own.back().cost)
                    own.push_back({steps.real(1), cost});
            }
            std::vector<std::pair<std::int64_t, RunRecord>> runs;
            Database::Statement rows(
                database,
                "SELECT runs.id, experiments.name, plannerConfigs.name, plannerConfigs.settings, details.fingerprint, "
                "details.reason, details.path, runs.* FROM runs JOIN experiments ON experimentid = experiments.id "
                "JOIN plannerConfigs ON plannerid = plannerConfigs.id "
                "JOIN details ON details.runid = runs.id ORDER BY " +
                    order);
            constexpr int FIRST = 10;  // behind those and the three ids
            std::vector<std::string> names, types;
            for (int i = 0; i < rows.columns(); ++i)
            {
                names.push_back(rows.name(i));
                types.push_back(rows.type(i));
            }
            while (rows.step())
            {
                const std::int64_t id = rows.number(0);
                RunRecord record;
                record.experiment = rows.text(1);
                record.planner = rows.text(2).substr(PREFIX.size());
                record.parameters = parametersFrom(rows.text(3));
                record.fingerprint = rows.text(4);
                record.reason = rows.text(5);
                record.progress = std::move(progress[id]);
                try
                {
                    for (int i = FIRST; i < rows.columns(); ++i)
                        setFigure(record, names[i], types[i], rows.cell(i));
                    if (const std::string path = rows.text(6); !path.empty())
                    {
                        const json text = json::parse(path);
                        record.hasPath = true;
                        text.at("exact").get_to(record.exact);
                        record.path = pathFromJson(text);
                    }
                }
                catch (const std::exception &error)
                {
                    throw DatabaseDamage(oneLine(database.file()) + ": run " + std::to_string(id) +
                                         " of the table runs: " + oneLine(error.what()));
                }
                runs.emplace_back(id, std::move(record));
            }
            return runs;
        }

        /** A name that nothing has yet. */
        std::string nameAside(const std::string &file)
        {
            const fs::path path(file);
            const std::string base = (path.parent_path() / ("previous-" + path.stem().string())).string();
            for (int number = 1;; ++number)
            {
                std::string name = base + (number > 1 ? "-" + std::to_string(number) : "") + path.extension().string();
                if (!fs::exists(fs::symlink_status(name)))
                    return name;
            }
        }
    }  // namespace

    RunStore::RunStore(const std::string &file, const IsOfUse &isOfUse, bool fresh) : file_(file)
    {
        lock_.emplace(file_);
        try
        {
            open();
            const bool isEmpty = std::holds_alternative<std::nullptr_t>(
                database_->ask("SELECT 1 FROM runs UNION SELECT 1 FROM superseded"));
            if (isEmpty || (!fresh && sortOut(isOfUse)))
                return;
        }
        catch (const DatabaseDamage &error)
        {
            if (!fresh)
                throw Error(error.what() + std::string("; --fresh sets it aside, or name another --output"));
        }
        makeRoom();
    }

    void RunStore::open()
    {
        database_.emplace(file_, lock_->isLocked() ? Database::Access::Write : Database::Access::WriteUnlocked);
        database_->runAll("PRAGMA foreign_keys = ON");
        if (numberOf(database_->ask("SELECT COUNT(*) FROM sqlite_master")) != 0)
            return requireFormat(*database_);
        Database::Transaction transaction(*database_);
        database_->runAll(TABLES);
        const auto addNames = [this](const char *type, std::size_t count, const auto &nameOf)
        {
            for (std::size_t i = 0; i < count; ++i)
                database_->run("INSERT INTO enums VALUES (?, ?, ?)", {type, static_cast<std::int64_t>(i), nameOf(i)});
        };
        using Status = ompl::base::PlannerStatus;
        addNames("status", Status::TYPE_COUNT,
                 [](std::size_t i) { return Status(static_cast<Status::StatusType>(i)).asString(); });
        addNames("outcome", PLAN_STATUSES, [](std::size_t i) { return toString(static_cast<PlanStatus>(i)); });
        database_->runAll("PRAGMA user_version = " + std::to_string(FORMAT));
        transaction.commit();
    }

    void RunStore::makeRoom()
    {
        insertions_.clear();
        columns_.clear();
        known_.clear();
        database_.reset();
        setAside_ = nameAside(file_);
        fs::rename(file_, setAside_);
        lock_.reset();
        lock_.emplace(file_);
        open();
    }

    bool RunStore::sortOut(const IsOfUse &isOfUse)
    {
        const auto runs = readRuns(*database_, "runs.id");
        std::map<std::int64_t, RunRecord> earlier;
        Database::Statement rows(*database_, "SELECT id, run FROM superseded");
        while (rows.step())
            earlier.emplace(rows.number(0), RunRecord::fromJson(json::parse(rows.text(1))));
        const auto counts = [&isOfUse](const auto &each)
        {
            return isOfUse(each.second);
        };
        if (std::none_of(runs.begin(), runs.end(), counts) && std::none_of(earlier.begin(), earlier.end(), counts))
            return false;
        Database::Transaction transaction(*database_);
        for (const auto &[id, record] : runs)
        {
            known_.emplace(keyOf(record), id);
            if (!isOfUse(record))
                supersede(record);
        }
        for (const auto &[id, record] : earlier)
            if (isOfUse(record) && known_.count(keyOf(record)) == 0)
            {
                insert(record);
                database_->run("DELETE FROM superseded WHERE id = ?", {id});
            }
        transaction.commit();
        return true;
    }

    void RunStore::supersede(const RunRecord &record)
    {
        const auto run = known_.find(keyOf(record));
        database_->run("INSERT INTO superseded (run) VALUES (?)",
                       {record.toJson().dump(-1, ' ', false, json::error_handler_t::replace)});
        database_->run("DELETE FROM runs WHERE id = ?", {run->second});
        known_.erase(run);
    }

    void RunStore::setExperiments(const std::vector<Row> &experiments)
    {
        // What the configuration says; all else is of the beginning.
        const std::set<std::string> configured{"timelimit", "memorylimit", "runcount", "seed"};
        Database::Transaction transaction(*database_);
        std::set<std::string> names;
        for (const Row &row : experiments)
        {
            const SqlValue name = row.at("name");
            names.insert(textOf(name));
            if (numberOf(database_->ask("SELECT id FROM experiments WHERE name = ?", {name})) == 0)
                insert("experiments", {{"name", name}});
            for (const auto &[column, value] : row)
            {
                grow("experiments", column, "INTEGER");  // of versions; the others are there
                database_->run("UPDATE experiments SET " + quotedName(column) + " = " +
                                   (configured.count(column) > 0 ? "?" : "COALESCE(" + quotedName(column) + ", ?)") +
                                   " WHERE name = ?",
                               {value, name});
            }
        }
        Database::Statement all(*database_, "SELECT id, name FROM experiments");
        while (all.step())
            if (names.count(all.text(1)) == 0)
                database_->run("DELETE FROM experiments WHERE id = ?", {all.number(0)});
        database_->runAll(
            "DELETE FROM plannerConfigs WHERE id NOT IN (SELECT plannerid FROM runs);"
            "UPDATE experiments SET totaltime = (SELECT TOTAL(time) FROM runs WHERE experimentid = experiments.id)");
        transaction.commit();
    }

    RunStore::Key RunStore::keyOf(const RunRecord &record)
    {
        return {record.experiment, record.planner, record.run()};
    }

    bool RunStore::has(const std::string &experiment, const std::string &planner, std::size_t run) const
    {
        return known_.count({experiment, planner, run}) > 0;
    }

    void RunStore::add(const RunRecord &record)
    {
        Database::Transaction transaction(*database_);
        insert(record);
        transaction.commit();
    }

    void RunStore::grow(const std::string &table, const std::string &column, const std::string &type)
    {
        std::set<std::string> &known = columns_[table];
        if (known.empty())
        {
            Database::Statement columns(*database_, "SELECT name FROM pragma_table_info(?)");
            columns.bind({table});
            while (columns.step())
                known.insert(withSmallLetters(columns.text(0)));
        }
        if (known.insert(withSmallLetters(column)).second)
            database_->run("ALTER TABLE " + table + " ADD " + quotedName(column) + " " + type);
    }

    std::int64_t RunStore::insert(const std::string &table, const Row &row)
    {
        std::string names, marks;
        std::vector<SqlValue> values;
        for (const auto &[column, value] : row)
        {
            names += (names.empty() ? "" : ", ") + quotedName(column);
            marks += marks.empty() ? "?" : ", ?";
            values.push_back(value);
        }
        const std::string text = "INSERT INTO " + table + " (" + names + ") VALUES (" + marks + ")";
        std::unique_ptr<Database::Statement> &statement = insertions_[text];
        if (!statement)
            statement = std::make_unique<Database::Statement>(*database_, text);
        statement->bind(values);
        statement->step();
        return database_->lastRow();
    }

    void RunStore::insert(const RunRecord &record)
    {
        const auto idOf = [this](const std::string &table, const Row &row)
        {
            std::string query = "SELECT id FROM " + table + " WHERE 1";
            std::vector<SqlValue> values;
            for (const auto &[column, value] : row)
            {
                query += " AND " + column + " = ?";
                values.push_back(value);
            }
            const std::int64_t id = numberOf(database_->ask(query, values));
            return id != 0 ? id : insert(table, row);
        };
        Row row{{"experimentid", idOf("experiments", {{"name", record.experiment}})},
                {"plannerid",
                 idOf("plannerConfigs", {{"name", PREFIX + record.planner}, {"settings", settingsOf(record)}})}};
        std::set<std::string> taken;
        for (const auto &[figure, value] : record.figures)
        {
            const std::string column = columnOf(figure);
            if (!taken.insert(withSmallLetters(column)).second)
                continue;  // names that differ in their capitals only
            grow("runs", column, typeOf(figure, value));
            row[column] = cellOf(value);
        }
        const std::int64_t id = insert("runs", row);
        for (const auto &[time, cost] : progressOf(record))
            insert("progress", {{"runid", id}, {"time", time}, {"best_cost", cost}});
        json path = record.hasPath ? toJson(record.path) : json();
        if (record.hasPath)
            path["exact"] = record.exact;
        insert("details", {{"runid", id},
                           {"fingerprint", record.fingerprint},
                           {"reason", record.reason},
                           {"path", record.hasPath ? SqlValue(path.dump()) : SqlValue(nullptr)}});
        if (const double time = record.number("time"); time > 0.0)
            database_->run("UPDATE experiments SET totaltime = totaltime + ? WHERE id = ?",
                           {time, row.at("experimentid")});
        known_[keyOf(record)] = id;
    }

    void RunStore::merge(const StoredRuns &part, const IsOfUse &wanted)
    {
        std::map<Key, RunRecord> there;
        for (auto &[id, record] : readRuns(*database_, "runs.id"))
            there.emplace(keyOf(record), std::move(record));
        Database::Transaction transaction(*database_);
        for (const RunRecord &record : part.records)
        {
            const auto same = there.find(keyOf(record));
            if (!wanted(record) || (same != there.end() && same->second.toJson() == record.toJson()))
                continue;
            if (same != there.end())
                supersede(same->second);
            insert(record);
        }
        for (const Row &row : part.experiments)
            mergeExperiment(row);
        transaction.commit();
    }

    void RunStore::mergeExperiment(Row row)
    {
        const SqlValue name = row.at("name");
        const auto own = [&](const std::string &column)
        {
            return textOf(database_->ask("SELECT " + column + " FROM experiments WHERE name = ?", {name}));
        };
        const std::string date = own("date");
        std::set<std::string> hosts;
        for (const std::string &names : {own("hostname"), textOf(row["hostname"])})
        {
            std::istringstream each(names);
            for (std::string host; std::getline(each, host, '+');)
                hosts.insert(host);
        }
        std::string together;
        for (const std::string &host : hosts)
            together += (together.empty() ? "" : "+") + host;
        if (!date.empty() && date <= textOf(row["date"]))
            row = {};
        row["hostname"] = together;
        for (const auto &[column, value] : row)
            if (column != "id" && column != "name")
            {
                grow("experiments", column, "INTEGER");
                database_->run("UPDATE experiments SET " + quotedName(column) + " = ? WHERE name = ?", {value, name});
            }
    }

    std::vector<RunRecord> RunStore::records() const
    {
        std::vector<RunRecord> records;
        for (auto &[id, record] : readRuns(*database_, "experiments.name, plannerConfigs.name, runs.run"))
            records.push_back(std::move(record));
        return records;
    }

    StoredRuns RunStore::read(const std::string &file)
    {
        const Database database(file, Database::Access::Read);
        requireFormat(database);
        StoredRuns stored;
        for (auto &[id, record] : readRuns(database, "runs.id"))
            stored.records.push_back(std::move(record));
        Database::Statement rows(database, "SELECT * FROM experiments");
        while (rows.step())
        {
            Row &row = stored.experiments.emplace_back();
            for (int i = 0; i < rows.columns(); ++i)
                row[rows.name(i)] = rows.cell(i);
        }
        return stored;
    }
}  // namespace parking

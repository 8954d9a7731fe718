#include "benchmarks/store/RunStore.h"

#include "benchmarks/plan/PathJson.h"
#include "benchmarks/store/RunColumns.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/NearestName.h"
#include "parking_geometry/text/Text.h"

#include <ompl/base/PlannerStatus.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <utility>

using nlohmann::json;

namespace parking
{
    namespace
    {
        constexpr std::int64_t FORMAT = 4;        // version of the tables
        constexpr int SAMPLES = 100;              // of the best cost of a run; Planner Arena crashes with few
        constexpr double BRIEF = 0.01;            // seconds after the first solution that show no progress
        const std::string PREFIX = "geometric_";  // prefix of planners' names in OMPL's benchmark

        /** The tables have OMPL's columns; views replace OMPL's tables of experiments, planners and runs. Planner Arena
            takes further columns of experiments for parameters of the problem, and draws the column status for each
            enumeration. */
        const char *const TABLES = R"(
            CREATE TABLE all_experiments (id INTEGER PRIMARY KEY AUTOINCREMENT, name VARCHAR(512),
                totaltime REAL, timelimit REAL, memorylimit REAL, runcount INTEGER,
                version VARCHAR(128), hostname VARCHAR(1024), cpuinfo TEXT,
                date DATETIME, seed VARCHAR(24), setup TEXT);
            CREATE TABLE all_plannerConfigs (id INTEGER PRIMARY KEY AUTOINCREMENT,
                name VARCHAR(512) NOT NULL, settings TEXT);
            CREATE TABLE enums (name VARCHAR(512), value INTEGER, description TEXT, PRIMARY KEY (name, value));
            CREATE TABLE outcomes (value INTEGER PRIMARY KEY, name TEXT);
            CREATE TABLE all_runs (id INTEGER PRIMARY KEY AUTOINCREMENT,
                experimentid INTEGER REFERENCES all_experiments(id) ON DELETE CASCADE,
                plannerid INTEGER REFERENCES all_plannerConfigs(id) ON DELETE CASCADE,
                run INTEGER, seed INTEGER, time REAL);
            CREATE INDEX runs_of_experiments ON all_runs (experimentid, plannerid);
            CREATE INDEX runs_of_planners ON all_runs (plannerid);
            CREATE TABLE progress (runid INTEGER REFERENCES all_runs(id) ON DELETE CASCADE, time REAL, best_cost REAL,
                PRIMARY KEY (runid, time));
            CREATE TABLE details (runid INTEGER PRIMARY KEY REFERENCES all_runs(id) ON DELETE CASCADE,
                fingerprint TEXT, reason TEXT, improvements TEXT, path TEXT);
            CREATE TABLE selection (fingerprint TEXT PRIMARY KEY, count INTEGER);
            CREATE VIEW runs AS SELECT all_runs.* FROM all_runs JOIN details ON runid = all_runs.id
                JOIN selection ON selection.fingerprint = details.fingerprint WHERE all_runs.run < count;
            CREATE VIEW experiments AS SELECT id, name, totaltime, timelimit, memorylimit, runcount, version, hostname,
                cpuinfo, date, seed, setup FROM all_experiments
                WHERE EXISTS (SELECT 1 FROM runs WHERE experimentid = all_experiments.id);
            CREATE VIEW plannerConfigs AS SELECT * FROM all_plannerConfigs
                WHERE EXISTS (SELECT 1 FROM runs WHERE plannerid = all_plannerConfigs.id);)";

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

        bool isKey(const std::string &column)
        {
            const std::string name = lowerCase(column);
            return name == "id" || name == "experimentid" || name == "plannerid";
        }

        /** Name of a figure in the database. Names defined by a planner may collide with those of keys. */
        std::string columnOf(const std::string &figure)
        {
            std::string name = oneLine(figure);
            std::replace(name.begin(), name.end(), ' ', '_');
            return isKey(name) ? name + "_" : name;
        }

        std::string figureOfColumn(std::string name)
        {
            if (name.back() == '_' && isKey(name.substr(0, name.size() - 1)))
                name.pop_back();
            std::replace(name.begin(), name.end(), '_', ' ');
            return name;
        }

        std::string typeOf(const std::string &figure, const FigureValue &value)
        {
            constexpr ColumnType TYPES[] = {ColumnType::Boolean, ColumnType::Integer, ColumnType::Real};
            const RunColumn *column = findRunColumn(figure);
            return toString(column != nullptr ? column->type : TYPES[value.index()]);
        }

        SqlValue valueOf(const FigureValue &value)
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
                throw Error("the column " + inQuotes(column) + " contains a text");
            const auto *whole = std::get_if<std::int64_t>(&cell);
            const FigureValue value = whole == nullptr    ? FigureValue(std::get<double>(cell))
                                      : type == "BOOLEAN" ? FigureValue(*whole != 0)
                                                          : FigureValue(*whole);
            if (findRunColumn(name) != nullptr)
                record.setFigure(name, value);
            else
                record.figures[name] = value;
        }

        /** Joins the lines of a log like ompl_benchmark_statistics. */
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

        /** Cost over time for Planner Arena: at regular times between the first solution and the end. Planners that end
            with their first solution have none. */
        std::map<double, double> progressOf(const RunRecord &record)
        {
            std::map<double, double> costs;
            if (record.progress.empty())
                return costs;
            const double first = record.progress.front().time, total = record.number("time");
            if (!(total - first > BRIEF))
                return costs;
            std::size_t last = 0;
            for (int i = 0; i < SAMPLES; ++i)
            {
                const double time = first + i * (total - first) / (SAMPLES - 1);
                while (last + 1 < record.progress.size() && record.progress[last + 1].time <= time)
                    ++last;
                costs[time] = record.progress[last].cost;
            }
            return costs;
        }

        json improvementsOf(const RunRecord &record)
        {
            json list = json::array();
            for (const Improvement &each : record.progress)
                list.push_back({each.time, each.cost});
            return list;
        }

        void requireFormat(const Database &database)
        {
            if (numberOf(database.valueOf("PRAGMA user_version")) != FORMAT)
                throw Error(database.file() +
                            ": is not a database of runs in this version of parking_benchmark; move it, or "
                            "choose another --output");
        }

        /** \param condition text after WHERE, with values for its `?` */
        std::vector<RunRecord> readRuns(const Database &database, const std::string &condition,
                                        const std::vector<SqlValue> &values)
        {
            std::vector<RunRecord> runs;
            Database::Statement rows(
                database,
                "SELECT runs.id, e.name, p.name, p.settings, details.fingerprint, details.reason, details.path, "
                "details.improvements, runs.* "
                "FROM runs JOIN all_experiments e ON experimentid = e.id JOIN all_plannerConfigs p ON plannerid = p.id "
                "JOIN details ON details.runid = runs.id WHERE " +
                    condition + " ORDER BY e.name, p.name, runs.run",
                values);
            const std::vector<std::string> names = rows.names();
            const int first = 11, end = static_cast<int>(names.size());  // columns after those and the three ids
            while (rows.step())
            {
                RunRecord &record = runs.emplace_back();
                record.experiment = rows.text(1);
                record.planner = rows.text(2).substr(PREFIX.size());
                record.parameters = parametersFrom(rows.text(3));
                record.fingerprint = rows.text(4);
                record.reason = rows.text(5);
                try
                {
                    for (const json &each : json::parse(rows.text(7)))
                        record.progress.push_back({each.at(0), each.at(1)});
                    for (int i = first; i < end; ++i)
                        setFigure(record, names[i], rows.type(i), rows.value(i));
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
                    throw Error(database.file() + ": run " + rows.text(0) +
                                " of the table all_runs: " + oneLine(error.what()));
                }
            }
            return runs;
        }

        std::string beginningOf(const std::string &fingerprint)
        {
            return fingerprint.substr(0, fingerprint.find('+'));
        }
    }  // namespace

    RunStore::RunStore(const std::string &file) : database_(file, Database::Access::Write)
    {
        if (numberOf(database_.valueOf("SELECT COUNT(*) FROM sqlite_master")) != 0)
        {
            requireFormat(database_);
            return;
        }
        database_.run("BEGIN IMMEDIATE");
        database_.run(TABLES);
        using Status = ompl::base::PlannerStatus;
        for (std::int64_t i = 0; i < Status::TYPE_COUNT; ++i)
            insert("enums", {{"name", "status"},
                             {"value", i},
                             {"description", Status(static_cast<Status::StatusType>(i)).asString()}});
        for (std::size_t i = 0; i < PLAN_STATUSES; ++i)
            insert("outcomes",
                   {{"value", static_cast<std::int64_t>(i)}, {"name", toString(static_cast<PlanStatus>(i))}});
        database_.run("PRAGMA user_version = " + std::to_string(FORMAT));
        database_.run("COMMIT");
    }

    void RunStore::forget()
    {
        database_.run("UPDATE details SET fingerprint = ''");
    }

    void RunStore::select(const std::vector<std::string> &fingerprints, std::size_t count)
    {
        selected_ = {fingerprints.begin(), fingerprints.end()};
        count_ = static_cast<std::int64_t>(count);
        database_.run("BEGIN IMMEDIATE");
        std::vector<std::string> last;
        for (Database::Statement shown(database_, "SELECT fingerprint FROM selection"); shown.step();)
            last.push_back(shown.text(0));
        database_.run("DELETE FROM selection");
        for (const std::string &fingerprint : fingerprints)
            insert("selection", {{"fingerprint", fingerprint}, {"count", count_}});
        for (const std::string &fingerprint : last)
            selectIfBegun(fingerprint);
        database_.run("COMMIT");
        known_.clear();
        Database::Statement runs(database_,
                                 "SELECT e.name, p.name, runs.run FROM runs JOIN all_experiments e ON "
                                 "experimentid = e.id JOIN all_plannerConfigs p ON plannerid = p.id");
        while (runs.step())
            known_.insert({runs.text(0), runs.text(1).substr(PREFIX.size()), runs.number(2)});
    }

    bool RunStore::selectIfBegun(const std::string &fingerprint)
    {
        if (selected_.count(fingerprint) > 0)
            return true;
        if (selected_.count(beginningOf(fingerprint)) == 0)
            return false;
        database_.valueOf("INSERT OR IGNORE INTO selection VALUES (?, ?)", {fingerprint, count_});
        return true;
    }

    void RunStore::describe(const std::vector<Row> &experiments)
    {
        // Settings of the configuration are updated; the rest stays as at the beginning.
        const std::set<std::string> configured{"timelimit", "memorylimit", "runcount", "seed"};
        database_.run("BEGIN IMMEDIATE");
        for (const Row &row : experiments)
        {
            const SqlValue &name = row.at("name");
            const std::int64_t id = idOf("all_experiments", {{"name", name}});
            const bool isShown = numberOf(database_.valueOf("SELECT id FROM experiments WHERE id = ?", {id})) != 0;
            for (const auto &[column, value] : row)
                if (!isShown || configured.count(column) > 0)
                    setColumn("all_experiments", id, column, value);
        }
        database_.run(
            "UPDATE all_experiments SET totaltime = "
            "(SELECT TOTAL(time) FROM runs WHERE experimentid = all_experiments.id)");
        database_.run("COMMIT");
    }

    void RunStore::setColumn(const std::string &table, std::int64_t id, const std::string &column,
                             const SqlValue &value)
    {
        grow(table, column, "INTEGER");  // a version; the other columns exist
        database_.valueOf("UPDATE " + table + " SET " + quotedName(column) + " = ? WHERE id = ?", {value, id});
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
        database_.run("BEGIN IMMEDIATE");
        insert(record);
        database_.run("COMMIT");
    }

    void RunStore::grow(const std::string &table, const std::string &column, const std::string &type)
    {
        std::set<std::string> &known = columns_[table];
        if (known.empty())
        {
            Database::Statement columns(database_, "SELECT name FROM pragma_table_info(?)", {table});
            while (columns.step())
                known.insert(lowerCase(columns.text(0)));
        }
        if (known.insert(lowerCase(column)).second)
            database_.run("ALTER TABLE " + table + " ADD " + quotedName(column) + " " + type);
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
            statement = std::make_unique<Database::Statement>(database_, text);
        statement->bind(values);
        statement->step();
        return database_.lastRow();
    }

    std::int64_t RunStore::idOf(const std::string &table, const Row &row)
    {
        std::string query = "SELECT id FROM " + table + " WHERE 1";
        std::vector<SqlValue> values;
        for (const auto &[column, value] : row)
        {
            query += " AND " + column + " = ?";
            values.push_back(value);
        }
        const std::int64_t id = numberOf(database_.valueOf(query, values));
        return id != 0 ? id : insert(table, row);
    }

    void RunStore::insert(const RunRecord &record)
    {
        Row row{{"experimentid", idOf("all_experiments", {{"name", record.experiment}})},
                {"plannerid",
                 idOf("all_plannerConfigs", {{"name", PREFIX + record.planner}, {"settings", settingsOf(record)}})}};
        std::set<std::string> taken;
        for (const auto &[figure, value] : record.figures)
        {
            const std::string column = columnOf(figure);
            if (!taken.insert(lowerCase(column)).second)
                continue;  // names that differ only in capitals
            grow("all_runs", column, typeOf(figure, value));
            row[column] = valueOf(value);
        }
        const std::int64_t id = insert("all_runs", row);
        for (const auto &[time, cost] : progressOf(record))
            insert("progress", {{"runid", id}, {"time", time}, {"best_cost", cost}});
        json path = toJson(record.path);
        path["exact"] = record.exact;
        insert("details", {{"runid", id},
                           {"fingerprint", record.fingerprint},
                           {"reason", record.reason},
                           {"improvements", improvementsOf(record).dump()},
                           {"path", record.hasPath ? SqlValue(path.dump()) : SqlValue(nullptr)}});
        if (const double time = record.number("time"); time > 0.0)
            database_.valueOf("UPDATE all_experiments SET totaltime = totaltime + ? WHERE id = ?",
                              {time, row.at("experimentid")});
        known_.insert(keyOf(record));
    }

    void RunStore::merge(const StoredRuns &part)
    {
        std::map<Key, RunRecord> there;
        for (RunRecord &record : readRuns(database_, "1", {}))
            there.emplace(keyOf(record), std::move(record));
        database_.run("BEGIN IMMEDIATE");
        for (const RunRecord &record : part.records)
        {
            const auto same = there.find(keyOf(record));
            if (!selectIfBegun(record.fingerprint) || (same != there.end() && same->second.toJson() == record.toJson()))
                continue;
            if (same != there.end())
                database_.valueOf(
                    "UPDATE details SET fingerprint = '' WHERE runid IN (SELECT runs.id FROM runs JOIN "
                    "all_experiments e ON experimentid = e.id JOIN all_plannerConfigs p ON plannerid = p.id "
                    "WHERE e.name = ? AND p.name = ? AND runs.run = ?)",
                    {record.experiment, PREFIX + record.planner, static_cast<std::int64_t>(record.run())});
            insert(record);
        }
        for (const Row &row : part.experiments)
            mergeExperiment(row);
        database_.run("COMMIT");
    }

    void RunStore::mergeExperiment(Row row)
    {
        const std::int64_t id = idOf("all_experiments", {{"name", row.at("name")}});
        const auto own = [&](const std::string &column)
        {
            return textOf(database_.valueOf("SELECT " + column + " FROM all_experiments WHERE id = ?", {id}));
        };
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
        if (const std::string date = own("date"); !date.empty() && date <= textOf(row["date"]))
            row.clear();
        row.erase("id");
        row["hostname"] = together;
        for (const auto &[column, value] : row)
            setColumn("all_experiments", id, column, value);
    }

    std::vector<RunRecord> RunStore::read(const std::string &experiment) const
    {
        return readRuns(database_, "e.name = ?", {experiment});
    }

    StoredRuns RunStore::readFile(const std::string &file)
    {
        const Database database(file, Database::Access::Read);
        requireFormat(database);
        StoredRuns stored{{}, readRuns(database, "1", {})};
        Database::Statement rows(database, "SELECT * FROM all_experiments WHERE id IN (SELECT id FROM experiments)");
        const std::vector<std::string> names = rows.names();
        while (rows.step())
            for (std::size_t i = 0; i < names.size(); ++i)
                (i == 0 ? stored.experiments.emplace_back() : stored.experiments.back())[names[i]] =
                    rows.value(static_cast<int>(i));
        return stored;
    }
}  // namespace parking

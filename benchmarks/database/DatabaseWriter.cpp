#include "benchmarks/database/DatabaseWriter.h"

#include "benchmarks/database/MemoryDatabase.h"
#include "benchmarks/database/StatisticsLog.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/ReadFile.h"
#include "parking_geometry/text/Text.h"

#include <cstdint>
#include <filesystem>
#include <set>
#include <utility>

namespace parking
{
    namespace
    {
        constexpr std::size_t LARGEST_LOG = std::size_t(4) << 30;  // bytes

        /** The schema of ompl_benchmark_statistics; further columns come from the logs. */
        const char *const TABLES = R"(
            CREATE TABLE experiments (id INTEGER PRIMARY KEY AUTOINCREMENT, name VARCHAR(512),
                totaltime REAL, timelimit REAL, memorylimit REAL, runcount INTEGER,
                version VARCHAR(128), hostname VARCHAR(1024), cpuinfo TEXT,
                date DATETIME, seed VARCHAR(24), setup TEXT);
            CREATE TABLE plannerConfigs (id INTEGER PRIMARY KEY AUTOINCREMENT,
                name VARCHAR(512) NOT NULL, settings TEXT);
            CREATE TABLE enums (name VARCHAR(512), value INTEGER, description TEXT, PRIMARY KEY (name, value));
            CREATE TABLE runs (id INTEGER PRIMARY KEY AUTOINCREMENT, experimentid INTEGER, plannerid INTEGER,
                FOREIGN KEY (experimentid) REFERENCES experiments(id) ON DELETE CASCADE,
                FOREIGN KEY (plannerid) REFERENCES plannerConfigs(id) ON DELETE CASCADE);
            CREATE TABLE progress (runid INTEGER, time REAL, PRIMARY KEY (runid, time),
                FOREIGN KEY (runid) REFERENCES runs(id) ON DELETE CASCADE);)";

        /** A table that gets further columns as logs bring them. */
        class GrowingTable
        {
        public:
            GrowingTable(MemoryDatabase &database, std::string name, std::set<std::string> columns)
              : database_(database),
                name_(std::move(name)),
                columns_(std::move(columns))
            {
            }

            void grow(const LogColumn &column)
            {
                if (columns_.insert(column.name).second)
                    database_.run("ALTER TABLE " + name_ + " ADD " + quotedName(column.name) + " " +
                                  std::string(column.type));
            }

            /** INSERT for \e fixed columns and then those of a log. */
            std::string insertion(const std::string &fixed, const std::vector<LogColumn> &columns)
            {
                std::string names = fixed, marks = "?";
                for (const char letter : fixed)
                    marks += letter == ',' ? ",?" : "";
                for (const LogColumn &column : columns)
                {
                    grow(column);
                    names += "," + quotedName(column.name);
                    marks += ",?";
                }
                // Of two moments of the same time the first one counts.
                return "INSERT OR IGNORE INTO " + name_ + " (" + names + ") VALUES (" + marks + ")";
            }

        private:
            MemoryDatabase &database_;
            std::string name_;
            std::set<std::string> columns_;
        };

        /** Text becomes a number where the column is one: SQLite knows from its type. */
        void bind(MemoryDatabase::Statement &statement, const std::vector<std::string_view> &cells)
        {
            for (const std::string_view cell : cells)
                if (cell.empty() || cell == "nan" || cell == "inf")
                    statement << nullptr;
                else
                    statement << cell;
        }

        double numberOf(std::string_view text)
        {
            double value = 0.0;
            parseNumber(text, value);
            return value;
        }

        class StatisticsTables
        {
        public:
            StatisticsTables()
            {
                database_.run(TABLES);
                database_.run("BEGIN");
            }

            void add(const StatisticsLog &log)
            {
                addEnumerations(log);
                const std::int64_t experiment = addExperiment(log);
                for (const LogPlanner &planner : log.planners)
                    addRuns(planner, experiment);
            }

            std::string bytes()
            {
                database_.run("COMMIT");
                return database_.bytes();
            }

        private:
            void addEnumerations(const StatisticsLog &log)
            {
                MemoryDatabase::Statement insert(database_, "INSERT INTO enums VALUES (?,?,?)");
                for (const StatisticsLog::Enumeration &each : log.enumerations)
                    if (enumerations_.insert(std::string(each.name)).second)
                        for (std::size_t i = 0; i < each.values.size(); ++i)
                            (insert << each.name << static_cast<std::int64_t>(i) << each.values[i]).run();
            }

            std::int64_t addExperiment(const StatisticsLog &log)
            {
                std::vector<LogColumn> columns;
                for (const StatisticsLog::Property &property : log.properties)
                    columns.push_back(property.column);
                MemoryDatabase::Statement insert(
                    database_, experiments_.insertion("name,totaltime,timelimit,memorylimit,runcount,version,hostname,"
                                                      "cpuinfo,date,seed,setup",
                                                      columns));
                insert << log.experiment << numberOf(log.totalTime) << numberOf(log.timeLimit)
                       << numberOf(log.memoryLimit) << log.runCount << log.version << log.host << log.cpu << log.date
                       << log.seed << log.setup;
                for (const StatisticsLog::Property &property : log.properties)
                    insert << property.value;
                insert.run();
                return database_.lastRow();
            }

            std::int64_t planner(const LogPlanner &planner)
            {
                MemoryDatabase::Statement find(database_, "SELECT id FROM plannerConfigs WHERE name=? AND settings=?");
                if ((find << planner.name << planner.settings).run())
                    return find.number();
                MemoryDatabase::Statement insert(database_, "INSERT INTO plannerConfigs VALUES (NULL,?,?)");
                (insert << planner.name << planner.settings).run();
                return database_.lastRow();
            }

            void addRuns(const LogPlanner &each, std::int64_t experiment)
            {
                const std::int64_t plannerId = planner(each);
                MemoryDatabase::Statement run(database_, runs_.insertion("experimentid,plannerid", each.runs.columns));
                MemoryDatabase::Statement moment(database_, progress_.insertion("runid", each.progressColumns));
                for (std::size_t i = 0; i < each.runs.rows.size(); ++i)
                {
                    run << experiment << plannerId;
                    bind(run, each.runs.rows[i]);
                    run.run();
                    const std::int64_t id = database_.lastRow();
                    if (i >= each.progress.size())
                        continue;
                    for (const std::vector<std::string_view> &cells : each.progress[i])
                    {
                        moment << id;
                        bind(moment, cells);
                        moment.run();
                    }
                }
            }

            MemoryDatabase database_;
            GrowingTable experiments_{database_,
                                      "experiments",
                                      {"id", "name", "totaltime", "timelimit", "memorylimit", "runcount", "version",
                                       "hostname", "cpuinfo", "date", "seed", "setup"}};
            GrowingTable runs_{database_, "runs", {"id", "experimentid", "plannerid"}};
            GrowingTable progress_{database_, "progress", {"runid", "time"}};
            std::set<std::string> enumerations_;
        };
    }  // namespace

    DatabaseWriter::DatabaseWriter(std::string database) : database_(std::move(database))
    {
        unfinished_.emplace(database_ + ".new");
    }

    DatabaseWriter::~DatabaseWriter()
    {
        std::error_code ignored;
        if (unfinished_ && unfinished_->name() != database_)
            std::filesystem::remove(unfinished_->name(), ignored);
    }

    void DatabaseWriter::write(const std::vector<std::string> &logs)
    {
        StatisticsTables tables;
        for (const std::string &log : logs)
        {
            const std::string text = readFile(log, LARGEST_LOG);
            tables.add(parseStatisticsLog(text, log));
        }
        // In memory until it is whole: the disk sees one write, and no journal is ever left behind.
        unfinished_->cutTo(0);
        unfinished_->append(tables.bytes());
        unfinished_->rename(database_);
    }
}  // namespace parking

// A run's figures are those of the columns; runs go from one process to another as text, and into the database of a
// comparison: what is added stays, what is not of use is kept, what is something else is refused.

#include "benchmarks/compare/UnitRunner.h"
#include "benchmarks/store/RunColumns.h"
#include "benchmarks/store/RunStore.h"
#include "benchmarks/summary/ComparisonPictures.h"
#include "tests/parking_geometry/ExpectError.h"
#include "tests/parking_geometry/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace
{
    using namespace parking;
    using parking_test::contentOf;
    using parking_test::expectError;

    constexpr double INFINITE = std::numeric_limits<double>::infinity();

    /** A run that has a figure in each column, and a path. */
    RunRecord recordOf(const std::string &planner, std::size_t run, const std::string &fingerprint = "1")
    {
        RunRecord record;
        record.experiment = "garage";
        record.planner = planner;
        record.fingerprint = fingerprint;
        record.reason = "none";
        std::int64_t number = 0;
        for (const RunColumn &column : runColumns())
            record.setFigure(column.name, column.type == ColumnType::Boolean ? FigureValue(run % 2 == 0)
                                          : column.type == ColumnType::Real  ? FigureValue(0.1 + number)
                                          : column.type == ColumnType::Enum  ? FigureValue(std::int64_t(1))
                                                                             : FigureValue(number++));
        record.set("run", run);
        record.set("seed", 4000000000U);
        record.set("time", 0.25);
        record.set("least clearance", INFINITE);
        record.figures.insert({{"best cost", 12.5}, {"rewired", std::int64_t(-7)}, {"lazy", true}, {"Id", 3.0}});
        record.parameters = {{"goal_bias", "0.05"}, {"range", "3"}};
        record.progress = {{0.1, 20.0}, {0.2, 15.0}};
        record.hasPath = record.exact = true;
        record.path = Path{{1.0 / 3.0, 2.0, 0.5}, {{0.2, 3.0}, {0.0, -2.5}, {-0.25, 1.25, 0.1}}};
        record.path.append(PathPiece::turnOnTheSpot(0.7));
        return record;
    }

    RunRecord bareRecord(const std::string &planner = "b", std::size_t run = 1)
    {
        RunRecord record;
        record.experiment = "garage";
        record.planner = planner;
        record.fingerprint = "2";
        record.set("run", run);
        record.set("seed", 4000000000U);
        return record;
    }

    RunRecord throughText(const RunRecord &record)
    {
        return RunRecord::fromJson(nlohmann::json::parse(record.toJson().dump()));
    }

    Row experimentOf(const std::string &date = "2026-01-01", const std::string &host = "here")
    {
        return {{"name", "garage"}, {"hostname", host}, {"date", date}, {"cores", std::int64_t(2)}};
    }

    std::vector<std::string> texts(const std::vector<RunRecord> &records)
    {
        std::vector<std::string> result;
        for (const RunRecord &record : records)
            result.push_back(record.toJson().dump());
        return result;
    }

    TEST(RunColumns, HaveNamesOfTheirOwnAndMeanings)
    {
        std::set<std::string> names;
        for (const RunColumn &column : runColumns())
        {
            EXPECT_TRUE(names.insert(column.name).second) << column.name;
            EXPECT_FALSE(std::string(column.text).empty()) << column.name;
            EXPECT_EQ(&runColumn(column.name), &column);
        }
        expectError([] { runColumn("colour"); }, {"colour"});
    }

    TEST(RunRecord, GoesThroughText)
    {
        const RunRecord record = recordOf("a", 0), back = throughText(record);
        EXPECT_EQ(back.figures, record.figures);
        EXPECT_EQ(back.toJson(), record.toJson());
        EXPECT_TRUE(back.exact);
        EXPECT_EQ(back.path.pieces.size(), 4U);
        EXPECT_EQ(back.path.pieces[2].sharpness, 0.1);
        EXPECT_EQ(back.path.pieces[3].turn, 0.7);
    }

    TEST(RunRecord, WhatWasNotMeasuredStaysSo)
    {
        const RunRecord back = throughText(bareRecord());
        EXPECT_EQ(back.figures.size(), 2U);
        EXPECT_EQ(back.run(), 1U);
        EXPECT_TRUE(std::isnan(back.number("path length")));
        EXPECT_FALSE(back.isSuccess() || back.hasPath || back.outcome());
    }

    TEST(RunRecord, RefusesWhatAColumnCannotHold)
    {
        RunRecord record;
        const auto refuse =
            [&record](const std::string &column, const FigureValue &value, const std::vector<std::string> &parts)
        {
            SCOPED_TRACE(column);
            expectError([&] { record.setFigure(column, value); }, parts);
        };
        refuse("cusps", 1.5, {"cusps", "INTEGER", "1.5"});
        refuse("cusps", std::int64_t(-1), {"cusps", "-1"});
        refuse("success", std::int64_t(1), {"success", "BOOLEAN"});
        refuse("path length", true, {"path length", "REAL"});
        refuse("outcome", std::int64_t(11), {"outcome", "11"});
        refuse("colour", 1.0, {"colour"});
        EXPECT_TRUE(record.figures.empty());
    }

    TEST(RunRecord, RefusesTextThatIsNoRun)
    {
        RunRecord record = bareRecord();
        record.hasPath = true;
        record.path = {{}, {{0.0, 1.0}}};
        const std::string whole = record.toJson().dump();
        EXPECT_NO_THROW(RunRecord::fromJson(nlohmann::json::parse(whole)));
        for (const auto &[part, instead] :
             std::vector<std::pair<std::string, std::string>>{{R"("run":1,)", ""},
                                                              {R"("run":1)", R"("run":true)"},
                                                              {R"("run":1)", R"("run":1,"outcome":"x")"},
                                                              {"[0.0,1.0]", "[]"},
                                                              {"[0.0,1.0]", "[1,2,3,4]"},
                                                              {"[0.0,1.0]", "7"},
                                                              {R"("exact":false)", R"("exact":0)"},
                                                              {R"("progress":[])", R"("progress":[[1]])"},
                                                              {R"("planner":"b")", R"("planner":[])"}})
        {
            std::string text = whole;
            ASSERT_NE(text.find(part), std::string::npos) << part;
            text.replace(text.find(part), part.size(), instead);
            EXPECT_ANY_THROW(RunRecord::fromJson(nlohmann::json::parse(text))) << text;
        }
    }

    TEST(RunRecord, WhatWasMeasuredIsKeptOverOmpls)
    {
        RunRecord record;
        record.set("time", 0.5);
        takeOmplProperties(record, {{"time REAL", "0.6"},
                                    {"memory REAL", "3"},
                                    {"graph states INTEGER", "7"},
                                    {"solved BOOLEAN", "x"},
                                    {"approximate solution BOOLEAN", "1"},
                                    {"odd", "1"},
                                    {"best_cost REAL", "inf"},
                                    {"cusps REAL", "1"}});
        const std::map<std::string, FigureValue> expected{{"time", 0.5},
                                                          {"memory", 3.0},
                                                          {"graph states", std::int64_t(7)},
                                                          {"approximate solution", true},
                                                          {"best cost", INFINITE}};
        EXPECT_EQ(record.figures, expected);
    }

    TEST(RunRecord, TheBestRunIsTheShortestThatIsSolved)
    {
        const auto run = [](bool success, bool exact, double length)
        {
            RunRecord record;
            record.hasPath = true;
            record.exact = exact;
            record.set("success", success);
            record.set("path length", length);
            return record;
        };
        const RunRecord near = run(false, false, 1.0), invalid = run(false, true, 2.0), longer = run(true, true, 9.0),
                        shorter = run(true, true, 8.0);
        RunRecord nothing;
        EXPECT_EQ(bestRun({&near, &longer, &invalid, &nothing, &shorter}), &shorter);
        EXPECT_EQ(bestRun({&near, &invalid}), &invalid);
        EXPECT_EQ(bestRun({&nothing, &near}), &near);
        EXPECT_EQ(bestRun({&nothing}), nullptr);
    }

    class RunStoreTest : public ::testing::Test
    {
    protected:
        /** The runs that a comparison finds, which is closed again. */
        std::vector<RunRecord> recordsFor(const std::vector<std::string> &fingerprints, std::size_t count = 10)
        {
            RunStore store(file_);
            store.select(fingerprints, count);
            return store.read("garage");
        }

        void add(const std::vector<RunRecord> &records)
        {
            RunStore store(file_);
            store.select({"1", "2"}, 10);
            store.describe({experimentOf()});
            for (const RunRecord &record : records)
                store.add(record);
        }

        const parking_test::TemporaryFolder folder_;
        const std::string file_ = folder_.path("benchmark.db");
    };

    TEST_F(RunStoreTest, WhatIsAddedIsReadBack)
    {
        const std::vector<RunRecord> records{recordOf("a", 0), recordOf("a", 1), bareRecord()};
        add(records);
        const StoredRuns stored = RunStore::readFile(file_);
        EXPECT_EQ(texts(stored.records), texts(records));
        ASSERT_EQ(stored.experiments.size(), 1U);
        EXPECT_EQ(std::get<std::string>(stored.experiments[0].at("hostname")), "here");
        EXPECT_EQ(std::get<std::int64_t>(stored.experiments[0].at("cores")), 2);
        EXPECT_EQ(std::get<double>(stored.experiments[0].at("totaltime")), 0.5);
        RunStore store(file_);
        store.select({"1", "2"}, 10);
        EXPECT_TRUE(store.has("garage", "b", 1));
        EXPECT_FALSE(store.has("garage", "b", 0));
        // From the first solution at 0.1 s to the end at 0.25 s; the second one came at 0.2 s.
        const auto count = [&store](const std::string &condition)
        {
            return std::get<std::int64_t>(store.database().valueOf("SELECT COUNT(*) FROM progress WHERE " + condition));
        };
        EXPECT_EQ(count("runid = 1"), 100);
        EXPECT_EQ(count("runid = 1 AND best_cost = CASE WHEN time < 0.2 THEN 20.0 ELSE 15.0 END"), 100);
        EXPECT_EQ(count("runid = 1 AND (time = 0.1 OR time = 0.25)"), 2);
        EXPECT_EQ(count("runid = 3"), 0);
    }

    TEST_F(RunStoreTest, PlannersThatEndWithTheirFirstSolutionHaveNoProgress)
    {
        RunRecord record = recordOf("a", 0);
        record.progress = {{0.249, 20.0}};
        add({record});
        EXPECT_EQ(RunStore::readFile(file_).records[0].progress.size(), 1U);
        const RunStore store(file_);
        EXPECT_EQ(std::get<std::int64_t>(store.database().valueOf("SELECT COUNT(*) FROM progress")), 0);
    }

    TEST_F(RunStoreTest, NamesOfPlannersFiguresAreOnlyNames)
    {
        RunRecord odd = bareRecord();
        odd.figures.insert({{"a\"b select", 1.0},
                            {"order", true},
                            {"'; DROP TABLE runs; --", 2.0},
                            {"Time", 4.0},
                            {"RUN", 9.0},
                            {"\xff", 5.0}});
        add({odd});
        const RunRecord back = RunStore::readFile(file_).records.at(0);
        EXPECT_EQ(back.number("a\"b select"), 1.0);
        EXPECT_TRUE(back.is("order"));
        EXPECT_EQ(back.number("'; DROP TABLE runs; --"), 2.0);
        EXPECT_EQ(back.number("?"), 5.0);
    }

    TEST_F(RunStoreTest, ShowsWhatIsSelectedAndKeepsAllElse)
    {
        add({recordOf("a", 0, "1"), recordOf("a", 1, "1"), recordOf("b", 0, "2")});
        const std::vector<std::string> all = texts(RunStore::readFile(file_).records);
        EXPECT_EQ(recordsFor({"1"}).size(), 2U);
        EXPECT_EQ(recordsFor({"1", "2"}, 1).size(), 2U);
        {
            RunStore store(file_);
            store.select({"1", "3"}, 10);
            EXPECT_TRUE(store.has("garage", "a", 0));
            EXPECT_FALSE(store.has("garage", "b", 0));
            store.add(recordOf("b", 0, "3"));
            EXPECT_EQ(std::get<std::int64_t>(store.database().valueOf("SELECT COUNT(*) FROM plannerConfigs")), 2);
        }
        EXPECT_EQ(recordsFor({"1", "3"}).size(), 3U);
        EXPECT_EQ(texts(recordsFor({"1", "2"})), all);
        EXPECT_TRUE(recordsFor({"4"}).empty());
        EXPECT_TRUE(RunStore::readFile(file_).experiments.empty());
        RunStore(file_).forget();
        EXPECT_TRUE(recordsFor({"1", "2", "3"}).empty());
        EXPECT_EQ(std::get<std::int64_t>(RunStore(file_).database().valueOf("SELECT COUNT(*) FROM all_runs")), 4);
    }

    TEST_F(RunStoreTest, ShowsTheRunsOfOneProgramAtATime)
    {
        for (const char *program : {"1+old", "1+new"})
        {
            RunStore store(file_);
            store.select({program}, 10);
            store.add(recordOf("a", 0, program));
        }
        const std::vector<RunRecord> shown = recordsFor({"1"});
        ASSERT_EQ(shown.size(), 1U);
        EXPECT_EQ(shown[0].fingerprint, "1+new");
    }

    TEST_F(RunStoreTest, MachineAndDateAreThoseOfTheBeginning)
    {
        add({recordOf("a", 0)});
        RunStore store(file_);
        const auto hostAndLimit = [&store]
        {
            Row row = experimentOf("2027-01-01", "there");
            row["timelimit"] = 3.0;
            store.describe({row});
            return std::get<std::string>(store.database().valueOf("SELECT hostname || timelimit FROM all_experiments"));
        };
        EXPECT_EQ(hostAndLimit(), "here3.0");
        store.select({"4"}, 10);  // of which there is nothing yet
        EXPECT_EQ(hostAndLimit(), "there3.0");
    }

    TEST_F(RunStoreTest, OneProcessWritesAndOthersRead)
    {
        add({recordOf("a", 0)});
        RunStore first(file_);
        expectError([this] { RunStore second(file_); }, {"benchmark.db", "another parking_benchmark"});
        first.add(recordOf("a", 1));
        EXPECT_EQ(RunStore::readFile(file_).records.size(), 2U);
    }

    TEST_F(RunStoreTest, WhatIsSomethingElseIsRefused)
    {
        const auto refuse = [this](const std::string &content, const std::string &part)
        {
            SCOPED_TRACE(part);
            folder_.write("benchmark.db", content);
            expectError(
                [this]
                {
                    RunStore store(file_);
                    store.select({"1"}, 10);
                    store.read("garage");
                },
                {"benchmark.db", part});
            expectError([this] { RunStore::readFile(file_); }, {"benchmark.db", part});
        };
        add({recordOf("a", 0)});
        const std::string whole = contentOf(file_);
        refuse(std::string(1000, 'x'), "not a database");
        refuse(whole.substr(0, 5 * 4096), "malformed");
        Database(folder_.path("other.db"), Database::Access::Write).run("CREATE TABLE runs (id INTEGER)");
        refuse(contentOf(folder_.path("other.db")), "not a database of runs");
        for (const char *damage : {"UPDATE details SET path = '{\"start\": 3}'", "UPDATE all_runs SET cusps = 'many'",
                                   "UPDATE all_runs SET outcome = 11", "UPDATE all_runs SET cusps = 1.5"})
        {
            folder_.write("benchmark.db", whole);
            Database(file_, Database::Access::Write).run(damage);
            refuse(contentOf(file_), "run 1 of the table all_runs");
        }
        expectError([this] { RunStore::readFile(folder_.path("missing")); }, {"missing"});
        expectError([this] { RunStore store(folder_.path("no/where")); }, {"cannot be written"});
    }

    TEST_F(RunStoreTest, PartsAreMerged)
    {
        RunStore store(file_);
        store.select({"1"}, 10);
        const StoredRuns late{{experimentOf("2026-01-03", "there")}, {recordOf("a", 0, "1+x"), recordOf("b", 0, "2")}},
            early{{experimentOf("2026-01-02", "here")}, {recordOf("a", 1, "1+y")}};
        for (int times = 0; times < 2; ++times)
            for (const StoredRuns &part : {late, early})
                store.merge(part);
        store.describe({{{"name", "garage"}, {"timelimit", 3.0}}});
        ASSERT_EQ(store.read("garage").size(), 2U);
        EXPECT_EQ(store.read("garage")[1].run(), 1U);
        const Database &database = store.database();
        EXPECT_EQ(std::get<std::int64_t>(database.valueOf("SELECT COUNT(*) FROM all_runs")), 2);
        EXPECT_EQ(std::get<std::string>(database.valueOf("SELECT hostname FROM experiments")), "here+there");
        EXPECT_EQ(std::get<std::string>(database.valueOf("SELECT date FROM experiments")), "2026-01-02");
        EXPECT_EQ(std::get<double>(database.valueOf("SELECT totaltime FROM experiments")), 0.5);
        // The same run measured again takes the place of the first, which is kept.
        RunRecord again = recordOf("a", 0, "1+x");
        again.set("time", 0.5);
        store.merge({{}, {again}});
        ASSERT_EQ(store.read("garage").size(), 2U);
        EXPECT_EQ(store.read("garage")[0].number("time"), 0.5);
        EXPECT_EQ(std::get<std::int64_t>(database.valueOf("SELECT COUNT(*) FROM all_runs")), 3);
    }
}  // namespace

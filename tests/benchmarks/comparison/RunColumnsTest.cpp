// Every column of a run goes through all files and back: line of JSON, record, OMPL's log, database.

#include "benchmarks/comparison/ExperimentLog.h"
#include "benchmarks/comparison/RunColumns.h"
#include "benchmarks/database/DatabaseWriter.h"
#include "benchmarks/system/Subprocess.h"
#include "tests/parking_geometry/ExpectError.h"
#include "tests/parking_geometry/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>

namespace
{
    using namespace parking;
    using parking_test::expectError;

    constexpr double INFINITE = std::numeric_limits<double>::infinity();

    /** A record that has a value in each column, none like another's; those of two runs differ, too. */
    RunRecord fullRecord(std::size_t run)
    {
        RunRecord record;
        record.experiment = "garage";
        record.planner = "rrt";
        std::int64_t number = 100 * static_cast<std::int64_t>(run);
        for (const RunColumn &column : runColumns())
        {
            ++number;
            const std::string type = column.type();
            if (type == "BOOLEAN")
                column.set(record, run % 2 == 0);
            else if (type == "REAL")
                column.set(record, 0.1 + static_cast<double>(number));
            else
                column.set(record, std::string_view("outcome") == column.name || type == "ENUM"
                                       ? static_cast<std::int64_t>(run + 1)
                                       : number);
        }
        record.run = run;
        record.reported = {
            {"best cost", 12.5 + static_cast<double>(run)}, {"rewired", std::int64_t(-7)}, {"lazy", true}};
        return record;
    }

    RunRecord throughText(const RunRecord &record)
    {
        return RunRecord::fromJson(nlohmann::json::parse(record.toJson().dump()));
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

    TEST(RunColumns, AreMembersOfTheirOwn)
    {
        for (const RunColumn &column : runColumns())
        {
            RunRecord record;
            column.set(record, column.type() == std::string("BOOLEAN") ? FigureValue(true) : std::int64_t(1));
            std::size_t set = 0;
            for (const RunColumn &each : runColumns())
                set += each.numberOf(record) == 1.0 ? 1 : 0;
            EXPECT_EQ(set, 1U) << column.name;
        }
    }

    TEST(RunColumns, EachSurvivesALineOfJson)
    {
        const RunRecord before = fullRecord(0), after = throughText(before);
        for (const RunColumn &column : runColumns())
        {
            ASSERT_TRUE(column.valueOf(before)) << column.name;
            EXPECT_EQ(column.valueOf(after), column.valueOf(before)) << column.name;
        }
        EXPECT_EQ(after.reported, before.reported);
    }

    TEST(RunColumns, WhatWasNotMeasuredStaysSo)
    {
        const RunRecord after = throughText(RunRecord());
        for (const RunColumn &column : runColumns())
            if (column.name != std::string("run") && column.name != std::string("seed"))
            {
                EXPECT_FALSE(column.valueOf(after)) << column.name;
                EXPECT_TRUE(std::isnan(column.numberOf(after))) << column.name;
            }
        EXPECT_EQ(omplProperties(after).size(), 2U);
        EXPECT_FALSE(after.isSuccess());
    }

    TEST(RunColumns, InfinityIsAFigure)
    {
        RunRecord record;
        record.leastClearance = INFINITE;
        record.reported["best cost"] = INFINITE;
        const RunRecord after = throughText(record);
        EXPECT_EQ(after.leastClearance, INFINITE);
        EXPECT_EQ(omplProperties(after).at("least clearance REAL"), "inf");
        EXPECT_EQ(omplProperties(after).at("best cost REAL"), "inf");
    }

    TEST(RunColumns, EachComesBackFromWhatOmplKeeps)
    {
        const RunRecord before = fullRecord(1);
        RunRecord after;
        after.run = before.run;
        after.seed = before.seed;
        takeOmplProperties(after, omplProperties(before));
        for (const RunColumn &column : runColumns())
            EXPECT_EQ(column.valueOf(after), column.valueOf(before)) << column.name;
        EXPECT_EQ(after.reported, before.reported);
    }

    TEST(RunColumns, WhatWeMeasuredIsKeptOverOmpls)
    {
        RunRecord record;
        record.time = 0.5;
        takeOmplProperties(record, {{"time REAL", "0.6"}, {"memory REAL", "3"}, {"solved BOOLEAN", "x"}, {"odd", "1"}});
        EXPECT_EQ(record.time, 0.5);
        EXPECT_EQ(record.memory, 3.0);
        EXPECT_FALSE(record.solved);
        EXPECT_TRUE(record.reported.empty());
    }

    TEST(RunColumns, RefuseWhatTheyCannotHold)
    {
        RunRecord record;
        expectError([&] { runColumn("cusps").set(record, 1.5); }, {"cusps", "INTEGER", "1.5"});
        expectError([&] { runColumn("cusps").set(record, std::int64_t(-1)); }, {"cusps", "-1"});
        expectError([&] { runColumn("success").set(record, std::int64_t(1)); }, {"success", "BOOLEAN"});
        expectError([&] { runColumn("path length").set(record, true); }, {"path length", "REAL"});
        expectError([&] { runColumn("outcome").set(record, std::int64_t(11)); }, {"outcome", "11"});
        expectError([&] { runColumn("seed").set(record, std::int64_t(1) << 33); }, {"seed"});
        nlohmann::json line = fullRecord(0).toJson();
        line["figures"].erase("run");
        EXPECT_ANY_THROW(RunRecord::fromJson(line));
        line = fullRecord(0).toJson();
        line["figures"]["colour"] = 3;
        expectError([&] { RunRecord::fromJson(line); }, {"colour"});
    }

    TEST(RunColumns, EachIsInLogAndDatabase)
    {
        BenchmarkConfig config;
        config.planners = {{"rrt", "RRT", {}, {}, {}}};
        config.runCount = 2;
        const Experiment experiment{"garage", "garage.yaml", {}, {0}, "x", {}};
        const nlohmann::json header{{"setups", nlohmann::json::object()}, {"parameters", nlohmann::json::object()}};
        const RunRecord records[]{fullRecord(0), fullRecord(1)};
        const std::string log = experimentLog(config, experiment, header, {&records[0], &records[1]});
        for (const RunColumn &column : runColumns())
            EXPECT_NE(log.find("\n" + column.typedName() + "\n"), std::string::npos) << column.name;

        const parking_test::TemporaryFolder folder;
        const std::string database = folder.path("benchmark.db");
        DatabaseWriter(database).write({folder.write("garage.log", log)});
        const ProcessResult rows =
            runProcess({"python3", "-c",
                        "import sqlite3, sys\n"
                        "connection = sqlite3.connect(sys.argv[1])\n"
                        "connection.row_factory = sqlite3.Row\n"
                        "for row in connection.execute('SELECT * FROM runs ORDER BY run'):\n"
                        "    for name in row.keys(): print(row['run'], name, row[name], file=sys.stderr)\n",
                        database});
        ASSERT_EQ(rows.status, 0) << rows.errors;
        std::map<std::string, std::string> found;
        std::istringstream lines(rows.errors);
        for (std::string run, name, value; lines >> run >> name >> value;)
            found[run + " " + name] = value;
        for (const RunRecord &record : records)
            for (const RunColumn &column : runColumns())
            {
                std::string name = std::to_string(record.run) + " " + column.name;
                std::replace(name.begin() + 2, name.end(), ' ', '_');
                ASSERT_EQ(found.count(name), 1U) << name;
                EXPECT_EQ(std::stod(found[name]), column.numberOf(record)) << name;
            }
        EXPECT_EQ(found["1 best_cost"], "13.5");
        EXPECT_EQ(found["0 rewired"], "-7");
    }
}  // namespace

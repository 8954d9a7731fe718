// A run's figures are those of the columns, and go from one process to another as text.

#include "benchmarks/compare/UnitRunner.h"
#include "benchmarks/store/RunColumns.h"
#include "benchmarks/summary/ComparisonPictures.h"
#include "tests/parking_geometry/ExpectError.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace
{
    using namespace parking;
    using parking_test::expectError;

    constexpr double INFINITE = std::numeric_limits<double>::infinity();

    RunRecord smallRecord()
    {
        RunRecord record;
        record.set("run", 3);
        record.set("seed", 4000000000U);
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

    TEST(RunRecord, GoesThroughText)
    {
        RunRecord record = smallRecord();
        for (const RunColumn &column : runColumns())
            record.setFigure(column.name, column.type == ColumnType::Boolean ? FigureValue(true)
                                          : column.type == ColumnType::Real  ? FigureValue(1.0 / 3.0)
                                                                             : FigureValue(std::int64_t(2)));
        record.set("least clearance", INFINITE);
        record.figures.insert({{"best cost", -INFINITE}, {"rewired", std::int64_t(-7)}, {"lazy", false}});
        record.parameters = {{"range", "3"}};
        record.progress = {{0.1, 20.0}, {0.2, 15.0}};
        record.hasPath = record.exact = true;
        record.path = Path{{1.0 / 3.0, 2.0, 0.5}, {{0.2, 3.0}, {0.0, -2.5}, {-0.25, 1.25, 0.1}}};
        record.path.append(PathPiece::turnOnTheSpot(0.7));
        const RunRecord back = throughText(record);
        EXPECT_EQ(back.figures, record.figures);
        EXPECT_EQ(back.toJson(), record.toJson());
        EXPECT_TRUE(back.exact);
        EXPECT_EQ(back.path.pieces.size(), 4U);
        EXPECT_EQ(back.path.pieces[2].sharpness, 0.1);
        EXPECT_EQ(back.path.pieces[3].turn, 0.7);
    }

    TEST(RunRecord, WhatWasNotMeasuredStaysSo)
    {
        const RunRecord back = throughText(smallRecord());
        EXPECT_EQ(back.figures.size(), 2U);
        EXPECT_EQ(back.run(), 3U);
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
        RunRecord record = smallRecord();
        record.hasPath = true;
        record.path = {{}, {{0.0, 1.0}}};
        const std::string whole = record.toJson().dump();
        EXPECT_NO_THROW(RunRecord::fromJson(nlohmann::json::parse(whole)));
        for (const auto &[part, instead] :
             std::vector<std::pair<std::string, std::string>>{{R"("run":3,)", ""},
                                                              {R"("run":3)", R"("run":true)"},
                                                              {R"("run":3)", R"("run":3,"outcome":"x")"},
                                                              {"[0.0,1.0]", "[]"},
                                                              {"[0.0,1.0]", "[1,2,3,4]"},
                                                              {"[0.0,1.0]", "7"},
                                                              {R"("exact":false)", R"("exact":0)"},
                                                              {R"("progress":[])", R"("progress":[[1]])"},
                                                              {R"("planner":"")", R"("planner":[])"}})
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
}  // namespace

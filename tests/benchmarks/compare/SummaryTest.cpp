// The summary's figures: time-outs and invalid solutions count as infinite times, lengths are those of solved runs.

#include "benchmarks/summary/Summary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace
{
    using namespace parking;

    const char *const TIME = "first solution time";

    /** \param length of the path; 0 without one */
    RunRecord runOf(const std::string &planner, std::size_t run, bool exact, bool valid, double time, double length)
    {
        RunRecord record;
        record.experiment = "garage";
        record.planner = planner;
        record.set("run", run);
        record.hasPath = length > 0.0;
        record.exact = exact;
        record.set("success", exact && valid);
        if (exact)
            record.set("first solution time", time);
        if (record.hasPath)
        {
            record.set("path length", length);
            record.set("cusps", 3);
            record.set("densely valid", valid);
            record.set("least clearance", 0.25);
        }
        return record;
    }

    class SummaryTest : public ::testing::Test
    {
    protected:
        SummaryTest()
        {
            config_.planners = {
                {"good", "RRT", {}, {}, {}}, {"poor", "RRT", {}, {}, {}}, {"absent", "RRT", {}, {}, {}}};
            experiments_ = {{"garage", "garage.yaml", {}, {0, 1, 2}, "x", {}}};
            for (std::size_t run = 0; run < 3; ++run)
                records_.push_back(runOf("good", run, true, true, 0.1 * (run + 1.0), 10.0 + run));
            records_.push_back(runOf("poor", 0, true, true, 1.5, 20.0));
            records_.push_back(runOf("poor", 1, true, false, 0.1, 5.0));   // not valid: worth nothing
            records_.push_back(runOf("poor", 2, false, false, 0.0, 7.0));  // approximate
            records_.push_back(runOf("poor", 3, false, false, 0.0, 0.0));  // nothing
        }

        BenchmarkConfig config_;
        std::vector<Experiment> experiments_;
        std::vector<RunRecord> records_;
    };

    TEST_F(SummaryTest, CountsEveryRun)
    {
        const std::vector<SummaryRow> rows = summarize(config_, experiments_, records_);
        ASSERT_EQ(rows.size(), 2U);
        EXPECT_EQ(rows[0].solved, 3U);
        EXPECT_DOUBLE_EQ(rows[0].figure(TIME).median, 0.2);
        EXPECT_DOUBLE_EQ(rows[0].figure(TIME).low, 0.15);
        EXPECT_DOUBLE_EQ(rows[0].figure("path length").median, 11.0);
        EXPECT_EQ(rows[1].runs, 4U);
        EXPECT_EQ(rows[1].solved, 1U);
        EXPECT_EQ(rows[1].invalid, 1U);
        EXPECT_EQ(rows[1].approximate, 1U);
        EXPECT_TRUE(std::isinf(rows[1].figure(TIME).median));
        EXPECT_DOUBLE_EQ(rows[1].figure("path length").median, 20.0);
    }

    TEST_F(SummaryTest, WhatIsYesOrNoIsAShareOfTheSuccessfulRunsThatHaveIt)
    {
        records_[0].set("attains goal", true);
        records_[1].set("attains goal", false);  // and the third one does not say
        records_[4].set("attains goal", true);   // not valid
        const std::vector<SummaryRow> rows = summarize(config_, experiments_, records_);
        EXPECT_EQ(rows[0].figure("attains goal").median, 0.5);
        EXPECT_TRUE(std::isnan(rows[1].figure("attains goal").median));
        EXPECT_NE(summaryCsv(rows).find(",attains_goal_share,"), std::string::npos);
    }

    TEST_F(SummaryTest, TablesSayTheSame)
    {
        const std::vector<SummaryRow> rows = summarize(config_, experiments_, records_);
        const std::string text = summaryText(rows), markdown = summaryMarkdown(rows), csv = summaryCsv(rows);
        for (const std::string &each : {text, markdown})
        {
            EXPECT_NE(each.find("3/3"), std::string::npos) << each;
            EXPECT_NE(each.find("1/4"), std::string::npos) << each;
            EXPECT_NE(each.find("200 ms"), std::string::npos) << each;
            EXPECT_NE(each.find("Times are medians over all runs"), std::string::npos) << each;
        }
        EXPECT_NE(text.find("1 INVALID, 1 near"), std::string::npos) << text;
        EXPECT_NE(markdown.find("NO (1)"), std::string::npos) << markdown;
        EXPECT_EQ(text.find("\033"), std::string::npos);
        EXPECT_NE(summaryText(rows, true).find("\033[31m1 INVALID, 1 near\033[0m"), std::string::npos);
        EXPECT_NE(csv.find("garage,poor,4,1,1,1,,"), std::string::npos) << csv;
        const std::string head = csv.substr(0, csv.find('\n')), row = csv.substr(head.size() + 1);
        EXPECT_EQ(std::count(head.begin(), head.end(), ','),
                  std::count(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(row.find('\n')), ','));
    }

    TEST_F(SummaryTest, ATableHasEightyColumns)
    {
        config_.planners[0].name = "improved_astar_with_a_very_long_name_of_60_characters_in_all";
        for (RunRecord &record : records_)
        {
            if (record.planner == "good")
                record.planner = config_.planners[0].name;
            if (record.isSuccess())
                record.set("first solution time", 12.345678);
        }
        std::istringstream text(summaryText(summarize(config_, experiments_, records_)));
        std::size_t widest = 0;
        for (std::string line; std::getline(text, line);)
            widest = std::max(widest, line.size());
        EXPECT_LE(widest, 80U) << text.str();
        EXPECT_NE(text.str().find("\n  " + config_.planners[0].name + "\n"), std::string::npos) << text.str();
        EXPECT_NE(text.str().find("12346 ms"), std::string::npos) << text.str();
    }

    TEST_F(SummaryTest, ProblemsWithoutASolutionAreToldApart)
    {
        config_.timeLimit = 2.0;
        experiments_.push_back({"wall", "wall.yaml", {}, {0, 1, 2}, "x", {}});
        const auto add = [this](const char *planner, PlanStatus outcome, double time)
        {
            RunRecord record = runOf(planner, records_.size(), outcome == PlanStatus::Exact, false, time, 5.0);
            record.experiment = "wall";
            record.set("outcome", outcome);
            record.set("planning time", time);
            if (!isFailure(outcome))
                record.set("solvable", false);
            records_.push_back(record);
        };
        add("good", PlanStatus::Approximate, 0.010);
        add("good", PlanStatus::InvalidGoal, 0.030);
        add("good", PlanStatus::Approximate, 2.0);  // at the time limit
        add("poor", PlanStatus::Exact, 0.020);
        add("poor", PlanStatus::Timeout, 2.0);
        add("absent", PlanStatus::Crash, 0.010);  // such a run has no figures of the problem
        const std::vector<SummaryRow> rows = summarize(config_, experiments_, records_);
        ASSERT_EQ(rows.size(), 5U);
        EXPECT_TRUE(rows[0].solvable);
        EXPECT_EQ(rows[0].refused, 0U);
        for (const std::size_t row : {2U, 3U, 4U})
            EXPECT_FALSE(rows[row].solvable);
        EXPECT_EQ(rows[2].refused, 2U);
        EXPECT_EQ(rows[2].refusal, 0.030);
        EXPECT_EQ(rows[3].refused, 0U);
        EXPECT_EQ(rows[3].invalid, 1U);
        EXPECT_EQ(rows[4].refused, 0U);
        const std::string text = summaryText(rows), markdown = summaryMarkdown(rows);
        const std::size_t apart = text.find("Problems without a solution");
        ASSERT_NE(apart, std::string::npos) << text;
        EXPECT_GT(text.find("wall"), apart) << text;
        EXPECT_NE(text.find("2/3  30.0 ms"), std::string::npos) << text;
        EXPECT_NE(markdown.find("| wall | good | 2/3 | 30.0 ms | - |"), std::string::npos) << markdown;
        EXPECT_NE(markdown.find("| wall | poor | 0/2 | - | 1 |"), std::string::npos) << markdown;
        EXPECT_NE(summaryCsv(rows).find(",0,2,0.03\n"), std::string::npos);
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);)
            EXPECT_LE(line.size(), 80U) << line;
    }
}  // namespace

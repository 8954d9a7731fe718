// The summary's figures: time-outs and invalid solutions count as infinite times, lengths are those of solved runs.

#include "benchmarks/summary/Summary.h"

#include <gtest/gtest.h>

#include <cmath>

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
            EXPECT_NE(each.find("NO (1)"), std::string::npos) << each;
        }
        EXPECT_NE(csv.find("garage,poor,4,1,1,1,,"), std::string::npos) << csv;
        const std::string head = csv.substr(0, csv.find('\n')), row = csv.substr(head.size() + 1);
        EXPECT_EQ(std::count(head.begin(), head.end(), ','),
                  std::count(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(row.find('\n')), ','));
    }
}  // namespace

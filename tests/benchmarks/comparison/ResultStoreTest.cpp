// The file of results: what is written stays, what was cut short is ignored, what is something else is refused.

#include "benchmarks/comparison/ResultStore.h"
#include "tests/parking_geometry/ExpectError.h"
#include "tests/parking_geometry/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <fstream>

namespace
{
    using namespace parking;
    using parking_test::contentOf;
    using parking_test::expectError;

    RunRecord recordOf(const std::string &planner, std::size_t run)
    {
        RunRecord record;
        record.experiment = "garage";
        record.planner = planner;
        record.run = run;
        record.seed = 4000000000U;
        record.time = 0.25;
        record.success = true;
        record.parameters = {{"range", "3"}};
        record.progress = {{0.1, 20.0}, {0.2, 15.0}};
        return record;
    }

    const nlohmann::json HEADER{{"fingerprint", "abc"}, {"host", "here"}};

    TEST(ResultStore, WhatIsAddedIsReadBack)
    {
        const parking_test::TemporaryFolder folder;
        const std::string file = folder.path("runs.jsonl");
        {
            ResultStore store(file, HEADER, false);
            store.add(recordOf("a", 0));
            store.add(recordOf("b", 1));
            EXPECT_TRUE(store.has("garage", "b", 1));
            EXPECT_FALSE(store.has("garage", "b", 0));
        }
        const auto [header, records] = ResultStore::read(file);
        EXPECT_EQ(header.at("host"), "here");
        ASSERT_EQ(records.size(), 2U);
        EXPECT_EQ(records[1].planner, "b");
        EXPECT_EQ(records[1].run, 1U);
        EXPECT_EQ(records[1].seed, 4000000000U);
        EXPECT_EQ(records[1].time, 0.25);
        EXPECT_TRUE(records[1].isSuccess());
        EXPECT_EQ(records[1].progress.at(1).cost, 15.0);
    }

    TEST(ResultStore, GoesOnAfterALineThatWasCutShort)
    {
        const parking_test::TemporaryFolder folder;
        const std::string file = folder.path("runs.jsonl");
        {
            ResultStore store(file, HEADER, false);
            store.add(recordOf("a", 0));
        }
        const std::string whole = contentOf(file);
        std::ofstream(file, std::ios::app) << R"({"experiment": "gara)";
        {
            ResultStore store(file, {{"fingerprint", "abc"}, {"host", "there"}}, false);
            EXPECT_EQ(store.records().size(), 1U);
            EXPECT_EQ(store.header().at("host"), "here");  // the first one's
            store.add(recordOf("a", 1));
        }
        EXPECT_EQ(contentOf(file).substr(0, whole.size()), whole);
        EXPECT_EQ(ResultStore::read(file).second.size(), 2U);
    }

    TEST(ResultStore, RefusesTheRunsOfAnotherComparison)
    {
        const parking_test::TemporaryFolder folder;
        const std::string file = folder.path("runs.jsonl");
        {
            ResultStore store(file, HEADER, false);
            store.add(recordOf("a", 0));
        }
        const std::string before = contentOf(file);
        expectError([&] { ResultStore(file, {{"fingerprint", "xyz"}}, false); }, {"runs.jsonl", "another comparison"});
        EXPECT_EQ(contentOf(file), before);
        ResultStore fresh(file, {{"fingerprint", "xyz"}}, true);
        EXPECT_TRUE(fresh.records().empty());
    }

    TEST(ResultStore, RefusesWhatItDidNotWrite)
    {
        const parking_test::TemporaryFolder folder;
        for (const std::string text : {"not json\n", "{}\n", "{\"parking_benchmark\": 1}\n", "[1]\n", "\n",
                                       "{\"parking_benchmark\": 2}\n{\"experiment\": 3}\n"})
        {
            const std::string file = folder.write("runs.jsonl", text);
            expectError([&] { ResultStore::read(file); }, {"runs.jsonl"});
            expectError([&] { ResultStore(file, HEADER, false); }, {"runs.jsonl"});
            EXPECT_EQ(contentOf(file), text);
        }
        expectError([&] { ResultStore::read(folder.path("missing")); }, {"missing"});
        expectError([&] { ResultStore(folder.path("no/where"), HEADER, false); }, {"cannot be written"});
    }

    TEST(ResultStore, TwoDoNotWriteTheSameFile)
    {
        const parking_test::TemporaryFolder folder;
        const ResultStore first(folder.path("runs.jsonl"), HEADER, false);
        expectError([&] { ResultStore(folder.path("runs.jsonl"), HEADER, false); }, {"another parking_benchmark"});
    }
}  // namespace

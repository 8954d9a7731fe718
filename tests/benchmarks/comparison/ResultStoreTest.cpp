// The file of results: what is written stays, what was cut short is ignored, what is something else is refused.

#include "benchmarks/comparison/ResultStore.h"
#include "tests/parking_geometry/ExpectError.h"
#include "tests/parking_geometry/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

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

    /** A header that wants runs of the planners a and b with these fingerprints. */
    nlohmann::json headerOf(const std::string &a = "1+x", const std::string &b = "2+x")
    {
        return {{"fingerprint", "abc"}, {"host", "here"}, {"fingerprints", {{"garage", {{"a", a}, {"b", b}}}}}};
    }

    TEST(ResultStore, WhatIsAddedIsReadBack)
    {
        const parking_test::TemporaryFolder folder;
        const std::string file = folder.path("runs.jsonl");
        {
            ResultStore store(file, headerOf(), false);
            store.add(recordOf("a", 0));
            store.add(recordOf("b", 1));
            EXPECT_TRUE(store.has("garage", "b", 1));
            EXPECT_FALSE(store.has("garage", "b", 0));
        }
        const StoredResults stored = ResultStore::read(file);
        EXPECT_EQ(stored.header.at("host"), "here");
        EXPECT_EQ(stored.damage, "");
        const std::vector<RunRecord> &records = stored.records;
        ASSERT_EQ(records.size(), 2U);
        EXPECT_EQ(records[1].planner, "b");
        EXPECT_EQ(records[1].run, 1U);
        EXPECT_EQ(records[1].fingerprint, "2+x");
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
            ResultStore store(file, headerOf(), false);
            store.add(recordOf("a", 0));
        }
        const std::string whole = contentOf(file);
        std::ofstream(file, std::ios::app) << R"({"experiment": "gara)";
        nlohmann::json elsewhere = headerOf();
        elsewhere["host"] = "there";
        {
            ResultStore store(file, elsewhere, false);
            EXPECT_EQ(store.records().size(), 1U);
            EXPECT_EQ(store.header().at("host"), "here");  // the first one's
            EXPECT_EQ(store.damage() + store.setAside(), "");
            store.add(recordOf("a", 1));
        }
        EXPECT_EQ(contentOf(file).substr(0, whole.size()), whole);
        EXPECT_EQ(ResultStore::read(file).records.size(), 2U);
    }

    TEST(ResultStore, DamagedLinesAreNamedAndTheOthersKept)
    {
        const parking_test::TemporaryFolder folder;
        const std::string file = folder.path("runs.jsonl");
        {
            ResultStore store(file, headerOf(), false);
            store.add(recordOf("a", 0));
            store.add(recordOf("a", 1));
        }
        const std::string whole = contentOf(file);
        const std::size_t second = whole.find('\n') + 1;
        for (const std::string garbage : {"{\"experiment\": 3}", "\xff\xfe", "[1]", "null", "", "{\"figures\": []}"})
        {
            const std::string damaged =
                whole.substr(0, second) + garbage + "\n" + whole.substr(second) + garbage + "\n";
            std::ofstream(file) << damaged;
            ResultStore store(file, headerOf(), false);
            EXPECT_EQ(store.records().size(), 2U);
            EXPECT_EQ(store.setAside(), "");
            EXPECT_NE(store.damage().find(file + ":2: is not a line of benchmark results"), std::string::npos);
            EXPECT_NE(store.damage().find("it and 1 more are left out"), std::string::npos);
            EXPECT_EQ(contentOf(file), damaged);
        }
        // Without its first line, too.
        std::ofstream(file) << "#" << whole;
        ResultStore store(file, headerOf(), false);
        EXPECT_EQ(store.records().size(), 2U);
        EXPECT_EQ(ResultStore::read(file).header.at("host"), "here");
    }

    TEST(ResultStore, OneChangedPlannerLeavesTheRunsOfTheOthers)
    {
        const parking_test::TemporaryFolder folder;
        const std::string file = folder.path("runs.jsonl");
        {
            ResultStore store(file, headerOf(), false);
            store.add(recordOf("a", 0));
            store.add(recordOf("b", 0));
        }
        const std::string before = contentOf(file);
        {
            ResultStore store(file, headerOf("1+x", "3+x"), false);
            EXPECT_TRUE(store.has("garage", "a", 0));
            EXPECT_FALSE(store.has("garage", "b", 0));
            store.add(recordOf("b", 0));
        }
        EXPECT_EQ(contentOf(file).substr(0, before.size()), before);
        EXPECT_EQ(ResultStore(file, headerOf("1+x", "3+x"), false).records().size(), 2U);
        // And back again.
        EXPECT_EQ(ResultStore(file, headerOf(), false).records().size(), 2U);
        // A planner that is gone.
        nlohmann::json fewer = headerOf();
        fewer["fingerprints"]["garage"].erase("b");
        EXPECT_EQ(ResultStore(file, fewer, false).records().size(), 1U);
        EXPECT_EQ(ResultStore::read(file).records.size(), 3U);
    }

    TEST(ResultStore, WhatIsOfNoUseIsSetAsideAndNeverOverwritten)
    {
        const parking_test::TemporaryFolder folder;
        const std::string file = folder.path("runs.jsonl");
        std::vector<std::string> contents;
        for (const std::string print : {"1", "2", "3"})
        {
            ResultStore store(file, headerOf(print, print), false);
            EXPECT_TRUE(store.records().empty());
            store.add(recordOf("a", 0));
            contents.push_back(contentOf(file));
        }
        {
            const ResultStore store(file, headerOf("3", "3"), true);  // fresh
            EXPECT_EQ(store.setAside(), folder.path("previous-runs-3.jsonl"));
        }
        EXPECT_EQ(contentOf(folder.path("previous-runs.jsonl")), contents[0]);
        EXPECT_EQ(contentOf(folder.path("previous-runs-2.jsonl")), contents[1]);
        EXPECT_EQ(contentOf(folder.path("previous-runs-3.jsonl")), contents[2]);
        // Nothing but a header, or a part of one, is not worth keeping.
        EXPECT_EQ(ResultStore(file, headerOf(), true).setAside(), "");
        std::ofstream(file) << "{\"parking_ben";
        EXPECT_EQ(ResultStore(file, headerOf(), false).setAside(), "");
    }

    TEST(ResultStore, ReadsNothingElseAndSetsItAside)
    {
        const parking_test::TemporaryFolder folder;
        std::size_t number = 0;
        for (const std::string text : {"not json\n", "{}\n", "{\"parking_benchmark\": 1}\n", "[1]\n", "\n",
                                       "{\"parking_benchmark\": 2, \"host\": 3}\n{\"experiment\": 3}\n"})
        {
            const std::string file = folder.write("runs.jsonl", text);
            expectError([&] { ResultStore::read(file); }, {"runs.jsonl"});
            const ResultStore store(file, headerOf(), false);
            EXPECT_EQ(store.setAside(),
                      folder.path("previous-runs" + (++number > 1 ? "-" + std::to_string(number) : "") + ".jsonl"));
            EXPECT_EQ(contentOf(store.setAside()), text);
        }
        expectError([&] { ResultStore::read(folder.path("missing")); }, {"missing"});
        expectError([&] { ResultStore(folder.path("no/where"), headerOf(), false); }, {"cannot be written"});
    }

    TEST(ResultStore, TwoDoNotWriteTheSameFile)
    {
        const parking_test::TemporaryFolder folder;
        const std::string file = folder.path("runs.jsonl");
        ResultStore first(file, headerOf(), false);
        first.add(recordOf("a", 0));
        const std::string before = contentOf(file);
        for (const bool fresh : {false, true})
            for (const std::string print : {"1+x", "9"})
                expectError([&] { ResultStore(file, headerOf(print, print), fresh); },
                            {"runs.jsonl", "another parking_benchmark"});
        EXPECT_EQ(contentOf(file), before);
        EXPECT_NO_THROW(first.add(recordOf("a", 1)));
        EXPECT_EQ(ResultStore::read(file).records.size(), 2U);
    }
}  // namespace

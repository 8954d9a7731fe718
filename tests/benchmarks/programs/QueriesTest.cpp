// Random queries: free by the oracle, with their margin, the same for the same seed.

#include "benchmarks/queries/Queries.h"

#include "benchmarks/worlds/MadeWorlds.h"
#include "benchmarks/worlds/PolygonOracle.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "tests/parking_geometry/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace
{
    using namespace parking;
    using parking_test::madeWorld;
    using parking_test::PolygonOracle;
    using parking_test::Random;
    using parking_test::worldKinds;

    /** All that queries promise, of what is read from their file. */
    void expectFree(const QueryWorld &world, double margin, int count)
    {
        SCOPED_TRACE(world.name);
        const parking_test::TemporaryFolder folder;
        if (world.scenario.grid)
        {
            folder.write("map.pgm", mapImage(*world.scenario.grid));
            folder.write("map.yaml", mapYaml(*world.scenario.grid, "map.pgm"));
        }
        Random random(3), same(3);
        int atObstacle = 0;
        for (int i = 0; i < count; ++i)
        {
            const auto query = drawQuery(world, random, margin, i % 2 == 1);
            const auto again = drawQuery(world, same, margin, i % 2 == 1);
            ASSERT_TRUE(query);
            const std::string text = queryText(world, *query, "map.yaml");
            EXPECT_EQ(text, queryText(world, *again, "map.yaml"));
            const Scenario scenario = readScenario(folder.write("query.yaml", text));
            const PolygonOracle oracle(scenario);
            const Pose start = scenario.toWorld(scenario.start);
            EXPECT_NEAR(start.x, query->start.x, 1e-9);
            EXPECT_NEAR(start.y, query->start.y, 1e-9);
            ASSERT_TRUE(oracle.isFree(scenario.start, scenario.vehicle, margin)) << text.substr(0, 300);
            const Pose goal = scenario.goals.front();
            ASSERT_TRUE(oracle.isFree(goal, scenario.vehicle, margin)) << text.substr(0, 300);
            if (query->goalAtObstacle)
            {
                ++atObstacle;
                // Not free any more with another step into every direction: one of them was tried.
                EXPECT_FALSE(oracle.isFree(goal, scenario.vehicle, margin + 0.11));
            }
        }
        EXPECT_EQ(atObstacle, count / 2);
    }

    TEST(Queries, StartsAndGoalsAreFreeInMadeWorlds)
    {
        for (const std::string &kind : worldKinds())
            for (const double margin : {0.0, 0.25})
                expectFree(queryWorld(kind, madeWorld(kind, "2"), vehicleByName("vw_golf8")), margin, 10);
    }

    TEST(Queries, StartsAndGoalsAreFreeInWorldsOfAFolder)
    {
        const std::vector<QueryWorld> worlds = worldsOf(PARKING_SOURCE_DIR "/benchmarks/scenarios", "");
        int maps = 0;
        for (const QueryWorld &world : worlds)
        {
            maps += world.scenario.grid ? 1 : 0;
            expectFree(world, 0.1, 6);
        }
        EXPECT_EQ(maps, 2);
        EXPECT_EQ(worlds.size(), 11U);
    }

    TEST(Queries, CompetitionCasesAndMapsAreWorlds)
    {
        const parking_test::TemporaryFolder folder;
        folder.write("Case1.csv", "4e9,5,0,4e9,15,1.5,1,4,4000000006,0,4000000009,0,4000000009,3,4000000006,3\n");
        folder.write("lot.pgm", std::string("P5\n60 50\n255\n") + std::string(60 * 50, static_cast<char>(254)));
        folder.write(
            "lot.yaml",
            "image: lot.pgm\nresolution: 0.5\norigin: [3, 4, 0.5]\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
        const std::vector<QueryWorld> worlds = worldsOf(folder.path(""), "toyota_yaris");
        ASSERT_EQ(worlds.size(), 2U);
        for (const QueryWorld &world : worlds)
        {
            EXPECT_EQ(world.scenario.vehicle.name, "toyota_yaris");
            expectFree(world, 0.0, 6);
        }
    }

    TEST(Queries, WithoutRoomThereIsNone)
    {
        Random random(1);
        const QueryWorld full =
            queryWorld("full", {{{-50, -50}, {50, -50}, {50, 50}, {-50, 50}}}, vehicleByName("vw_golf8"));
        EXPECT_FALSE(drawQuery(full, random, 0.0, false));
        EXPECT_THROW(worldsOf(PARKING_SOURCE_DIR "/examples/python", ""), Error);
        EXPECT_THROW(worldsOf("/nowhere", ""), Error);
    }
}  // namespace

// The bundled scenarios leave the room that their comments promise.

#include "benchmarks/worlds/PolygonOracle.h"
#include "parking_geometry/io/ScenarioReader.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

using namespace parking;
using parking_test::PolygonOracle;

namespace
{
    struct Bundled
    {
        const char *name;
        double goalClearance;  ///< metres, as the file's comment promises where it does
    };

    // What narrow means is exact; the others depend on how their neighbours and walls happen to stand.
    const Bundled BUNDLED[] = {
        {"angled45", 0.85},
        {"dead_end_aisle", 0.3},
        {"multi_storey", 0.145},
        {"narrow_parallel", 0.25},
        {"narrow_perpendicular", 0.15},
        {"parallel", 0.22},
        {"perceived_street", 0.2},
        {"perpendicular", 0.35},
        {"tight_parallel", 0.17},
        {"underground_garage", 0.145},
    };

    Scenario read(const std::string &name)
    {
        return readScenario(std::string(PARKING_SOURCE_DIR) + "/benchmarks/scenarios/" + name + ".yaml");
    }
}  // namespace

TEST(BundledScenarios, StartsAndGoalsAreFreeForARealCar)
{
    for (const Bundled &bundled : BUNDLED)
    {
        SCOPED_TRACE(bundled.name);
        const Scenario scenario = read(bundled.name);
        EXPECT_EQ(scenario.name, bundled.name);
        EXPECT_NE(scenario.vehicle.name, "tpcap");
        EXPECT_LE(scenario.bounds.size().maxCoeff(), 100.0);
        EXPECT_GE(scenario.bounds.size().minCoeff(), 15.0);
        const PolygonOracle oracle(scenario);
        EXPECT_TRUE(oracle.isFree(scenario.start, scenario.vehicle, 0.3));
        const double least = bundled.goalClearance - 0.002;
        for (const Pose &goal : scenario.goals)
            if (scenario.grid)
                EXPECT_TRUE(oracle.isFree(goal, scenario.vehicle, least));
            else
                EXPECT_GT(oracle.clearance(goal, scenario.vehicle), least);
    }
}

TEST(BundledScenarios, NarrowOnesAreAsNarrowAsTheySay)
{
    const Scenario perpendicular = read("narrow_perpendicular");
    EXPECT_NEAR(perpendicular.slot->width, perpendicular.vehicle.width + 0.3, 1e-4);
    for (const auto &[name, room] : {std::pair{"narrow_parallel", 0.25}, {"tight_parallel", 0.17}})
    {
        const Scenario scenario = read(name);
        EXPECT_NEAR(scenario.slot->length, scenario.vehicle.length() + 2.0 * room, 1e-4);
    }
    // Room at both ends, or on both sides: a step further the car touches.
    for (const auto &[name, room, isAlong] : {std::tuple{"narrow_parallel", 0.25, true},
                                              {"tight_parallel", 0.17, true},
                                              {"narrow_perpendicular", 0.15, false}})
    {
        const Scenario scenario = read(name);
        const PolygonOracle oracle(scenario);
        for (const double shift : {room + 0.002, -room - 0.002})
            EXPECT_FALSE(oracle.isFree(
                compose(scenario.goals[0], isAlong ? Pose{shift, 0.0, 0.0} : Pose{0.0, shift, 0.0}), scenario.vehicle))
                << name;
    }
}

TEST(BundledScenarios, TheUnreachableGoalIsInsideAnObstacle)
{
    const Scenario scenario = read("unreachable");
    const PolygonOracle oracle(scenario);
    EXPECT_TRUE(oracle.isFree(scenario.start, scenario.vehicle, 0.3));
    EXPECT_FALSE(oracle.isFree(scenario.goals[0], scenario.vehicle));
}

TEST(BundledScenarios, GridsAreOfTheSizesOfThePaper)
{
    const Scenario garage = read("underground_garage"), street = read("perceived_street");
    ASSERT_TRUE(garage.grid && street.grid);
    EXPECT_EQ(garage.grid->width(), 200u);
    EXPECT_EQ(garage.grid->height(), 200u);
    EXPECT_DOUBLE_EQ(garage.grid->resolution(), 0.2);
    EXPECT_DOUBLE_EQ(street.grid->resolution(), 0.5);
    const std::vector<Cell> &cells = street.grid->cells();
    EXPECT_GT(std::count(cells.begin(), cells.end(), Cell::Unknown), 10000);
    EXPECT_GT(std::count(cells.begin(), cells.end(), Cell::Occupied), 300);
    EXPECT_GT(std::count(cells.begin(), cells.end(), Cell::Free), 1000);
}

TEST(BundledScenarios, AllOfThemAreListedHere)
{
    std::set<std::string> listed = {"unreachable"}, present;
    for (const Bundled &bundled : BUNDLED)
        listed.insert(bundled.name);
    for (const auto &entry :
         std::filesystem::directory_iterator(std::string(PARKING_SOURCE_DIR) + "/benchmarks/scenarios"))
    {
        const std::string stem = entry.path().stem().string();
        if (entry.path().extension() == ".yaml" && stem.find("_map") == std::string::npos)
            present.insert(stem);
    }
    EXPECT_EQ(present, listed);
}

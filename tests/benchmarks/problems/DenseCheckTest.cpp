// The second check of finished paths: against an exact polygon test, at hand-made touches, and on torn paths.

#include "benchmarks/problems/DenseCheck.h"
#include "benchmarks/worlds/PolygonOracle.h"
#include "benchmarks/worlds/Random.h"
#include "parking_geometry/curves/Path.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "tests/parking_geometry/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
    using namespace parking;

    Scenario scenarioOf(const std::string &polygons)
    {
        const parking_test::TemporaryFolder folder;
        return readScenario(
            folder.write("world.yaml", "start: [0, 0, 0]\ngoal: [30, 0, 0]\npolygons: " + polygons + "\n"));
    }

    TEST(DenseCheck, TouchesAreFreeAndOverlapsAreNot)
    {
        const Scenario scenario = scenarioOf("[[[10, -1], [11, -1], [11, 1], [10, 1]]]");
        const DenseCheck check(scenario);
        const double front = scenario.vehicle.wheelbase + scenario.vehicle.frontOverhang;
        EXPECT_TRUE(check.isFree({10.0 - front, 0.0, 0.0}));
        EXPECT_FALSE(check.isFree({10.0 - front + 1e-4, 0.0, 0.0}));
        EXPECT_TRUE(check.isFree({11.0 + scenario.vehicle.rearOverhang, 0.0, 0.0}));
        EXPECT_FALSE(check.isFree({10.5, 0.0, 0.0}));  // round the whole obstacle
        EXPECT_FALSE(check.isFree({10.0, 1e6, 0.0}));  // outside of the world
    }

    TEST(DenseCheck, ACarInsideOfAnObstacleIsNotFree)
    {
        const DenseCheck check(scenarioOf("[[[-30, -30], [30, -30], [30, 30], [-30, 30]]]"));
        EXPECT_FALSE(check.isFree({0.0, 0.0, 0.3}));
        const DenseCheck disc(scenarioOf("[[[-30, -30], [30, -30], [30, 30], [-30, 30]]]"), 0.9);
        EXPECT_FALSE(disc.isFree({0.0, 0.0, 0.3}));
    }

    TEST(DenseCheck, DiscsAreRoundTheRearAxle)
    {
        const DenseCheck check(scenarioOf("[[[10, -1], [11, -1], [11, 1], [10, 1]]]"), 0.9);
        EXPECT_TRUE(check.isFree({9.1, 0.0, 0.0}));
        EXPECT_FALSE(check.isFree({9.11, 0.0, 0.0}));
        EXPECT_TRUE(check.isFree({9.4, 1.7, 2.0}));  // 0.92 m from the corner
        EXPECT_FALSE(check.isFree({9.4, 1.6, 2.0}));
    }

    TEST(DenseCheck, AgreesWithTheOracle)
    {
        const Scenario worlds[] = {readScenario(PARKING_SOURCE_DIR "/benchmarks/scenarios/perpendicular.yaml"),
                                   readScenario(PARKING_SOURCE_DIR "/benchmarks/scenarios/underground_garage.yaml")};
        parking_test::Random random(5);
        for (const Scenario &scenario : worlds)
        {
            SCOPED_TRACE(scenario.name);
            const DenseCheck check(scenario);
            const parking_test::PolygonOracle oracle(scenario);
            const Box &bounds = scenario.bounds;
            int free = 0;
            for (int i = 0; i < 20000; ++i)
            {
                const Pose pose{random.between(bounds.min.x(), bounds.max.x()),
                                random.between(bounds.min.y(), bounds.max.y()), random.between(-PI, PI)};
                const bool found = check.isFree(pose);
                free += found ? 1 : 0;
                // Up to a hundredth of a millimetre both answers are right.
                const bool surelyFree = oracle.isFree(pose, scenario.vehicle, 1e-5);
                if (surelyFree || !oracle.isFree(pose, scenario.vehicle, -1e-5))
                {
                    EXPECT_EQ(found, surelyFree) << pose.x << " " << pose.y << " " << pose.yaw;
                }
            }
            EXPECT_GT(free, 1000);
            EXPECT_LT(free, 19000);
        }
    }

    TEST(DenseCheck, FindsWhatLiesBetweenTheStatesOfAPath)
    {
        // A thin post in the middle of a straight drive of 20 m whose states are 10 m apart.
        const Scenario scenario = scenarioOf("[[[7, 0.9], [7.02, 0.9], [7.02, 1.5], [7, 1.5]]]");
        const DenseCheck check(scenario);
        const SampledPath path = Path{{0.0, 0.0, 0.0}, {{0.0, 20.0}}}.sample(10.0);
        const DenseResult hit = check.check(path, false, 0.2);
        EXPECT_FALSE(hit.valid);
        EXPECT_GT(hit.collisions, 900U);  // 4.69 m of car pass the post, tested every 5 mm
        EXPECT_NE(hit.reason.find("collision"), std::string::npos);
        const SampledPath aside = Path{{0.0, -0.2, 0.0}, {{0.0, 20.0}}}.sample(10.0);
        const DenseResult free = check.check(aside, false, 0.2);
        EXPECT_TRUE(free.valid) << free.reason;
        EXPECT_GE(free.states, 4000U);
    }

    TEST(DenseCheck, TornAndSharpPathsAreNotValid)
    {
        const DenseCheck check(scenarioOf("[]"));
        SampledPath path = Path{{0.0, 0.0, 0.0}, {{0.1, 5.0}, {-0.1, 5.0}}}.sample(0.1);
        EXPECT_TRUE(check.check(path, false, 0.2).valid);
        EXPECT_FALSE(check.check(path, false, 0.09).valid);
        SampledPath torn = path;
        torn[30].pose.y += 0.01;
        EXPECT_NE(check.check(torn, false, 0.2).reason.find("torn"), std::string::npos);
        SampledPath turned = path;
        turned.back().pose.yaw += 0.01;
        EXPECT_FALSE(check.check(turned, false, 0.2).valid);
        EXPECT_FALSE(check.check({}, false, 0.2).valid);
    }
}  // namespace

// The figures that are promised for the whole pipeline, on every problem that can be had: nominal, and with the
// everyday disturbances.
#include "automatic_parking/AutomaticParking.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "tests/automatic_parking/ParkingProblems.h"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

namespace
{
    using namespace parking;

    constexpr double DEGREE = PI / 180.0;
    constexpr std::uint64_t SEEDS = 2;
    constexpr double SAFE = 0.2;  // metres of planned clearance from which on a disturbed car must not hit anything

    void evaluate(const Scenario &scenario)
    {
        SCOPED_TRACE(scenario.name);
        const ParkingResult nominal = AutomaticParking().park(scenario);
        ASSERT_TRUE(nominal.parked()) << nominal.message;
        EXPECT_EQ(nominal.legs.size(), 1u);
        EXPECT_LE(nominal.evaluation.finalPositionError, 0.05);
        EXPECT_LE(nominal.evaluation.finalYawError, 1.0 * DEGREE);
        EXPECT_LE(nominal.evaluation.maxCrossTrack, 0.05);
        EXPECT_EQ(nominal.evaluation.collisions, 0u);
        for (const TrajectoryPoint &point : nominal.trajectory)
        {
            EXPECT_LE(std::abs(point.v), scenario.vehicle.maxSpeed + 1e-9);
            EXPECT_LE(std::abs(point.acceleration), scenario.vehicle.maxAcceleration + 1e-9);
            EXPECT_LE(std::abs(point.steering), scenario.vehicle.maxSteeringAngle + 1e-9);
            EXPECT_LE(std::abs(point.steeringRate), scenario.vehicle.maxSteeringRate + 1e-9);
        }
        if (nominal.legs[0].plan.clearance <= SAFE)
            return;
        for (std::uint64_t seed = 1; seed <= SEEDS; ++seed)
        {
            ParkingParameters parameters;
            parameters.drive.disturbances = Disturbances::everyday(seed);
            const ParkingResult disturbed = AutomaticParking(parameters).park(scenario);
            EXPECT_TRUE(disturbed.parked()) << disturbed.message << ", seed " << seed;
            EXPECT_LE(disturbed.evaluation.finalPositionError, 0.15) << "seed " << seed;
            EXPECT_LE(disturbed.evaluation.finalYawError, 2.0 * DEGREE) << "seed " << seed;
            EXPECT_EQ(disturbed.evaluation.collisions, 0u) << "seed " << seed;
        }
    }

    class EvaluationTest : public ::testing::TestWithParam<std::string>
    {
    };

    TEST_P(EvaluationTest, bundledProblemsKeepTheFigures)
    {
        evaluate(readScenario(parking_test::bundledFile(GetParam())));
    }

    INSTANTIATE_TEST_SUITE_P(Problems, EvaluationTest, ::testing::ValuesIn(parking_test::bundledProblems()),
                             [](const auto &each) { return each.param; });

    class TpcapEvaluationTest : public ::testing::TestWithParam<int>
    {
    };

    TEST_P(TpcapEvaluationTest, casesKeepTheFigures)
    {
        const std::string file = std::string(PARKING_SHARED_DATA) + "/tpcap/Case" + std::to_string(GetParam()) + ".csv";
        if (!std::filesystem::exists(file))
            GTEST_SKIP() << file << " is not there";
        evaluate(readScenario(file));
    }

    INSTANTIATE_TEST_SUITE_P(Cases, TpcapEvaluationTest, ::testing::Range(1, 21),
                             [](const auto &each) { return std::to_string(each.param); });
}  // namespace

// The figures that are promised for the whole pipeline, on every problem that can be had: nominal, and with the
// everyday disturbances.
#include "automatic_parking/AutomaticParking.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "tests/support/ProblemFiles.h"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace
{
    using namespace parking;
    using parking_test::solvableProblems;

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

    TEST_P(EvaluationTest, everyProblemKeepsTheFigures)
    {
        evaluate(readScenario(GetParam()));
    }

    /** Bundled ones, and the cases of TPCAP where they are. */
    std::vector<std::string> problems()
    {
        std::vector<std::string> files = solvableProblems(PARKING_SOURCE_DIR "/benchmarks/scenarios", ".yaml");
        for (std::string &file : solvableProblems(PARKING_SHARED_DATA "/tpcap", ".csv"))
            files.push_back(std::move(file));
        return files;
    }

    INSTANTIATE_TEST_SUITE_P(Problems, EvaluationTest, ::testing::ValuesIn(problems()),
                             [](const auto &each) { return std::filesystem::path(each.param).stem().string(); });
}  // namespace

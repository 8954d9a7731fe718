// Some of the drives that `troubled_drives` makes by the thousand: what can be avoided is, and the car ends standing.

#include "benchmarks/studies/TroubledDrives.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "tests/automatic_parking/ParkingProblems.h"

#include <gtest/gtest.h>

#include <array>

namespace parking
{
    namespace
    {
        class TroubledDrives : public testing::TestWithParam<bool>
        {
        };

        TEST_P(TroubledDrives, WhatCanBeAvoidedIsAndTheCarStops)
        {
            constexpr std::size_t DRIVES = 35;
            ParkingParameters parameters;
            parameters.optimizeTrajectory = GetParam();
            const std::array<std::string, 3> names{"angled45", "parallel", "perpendicular"};
            std::size_t appeared = 0, avoidable = 0, stopped = 0;
            for (std::size_t i = 0; i < DRIVES; ++i)
            {
                const auto trouble = static_cast<Trouble>(i % TROUBLES);
                const std::string &name = names[(i / TROUBLES) % names.size()];
                SCOPED_TRACE(name + ", " + toString(trouble) + ", drive " + std::to_string(i));
                const TroubledDrive drive =
                    driveInTrouble(readScenario(parking_test::bundledFile(name)), trouble, i, parameters);
                EXPECT_TRUE(drive.stands) << drive.message;
                EXPECT_EQ(drive.brokenLimit, "");
                EXPECT_LE(drive.fastest, 1.1);
                EXPECT_FALSE(drive.hitOther && drive.otherAvoidable) << drive.message;
                EXPECT_FALSE(drive.hitAppeared && drive.avoidable) << drive.message;
                appeared += drive.appeared ? 1 : 0;
                avoidable += drive.avoidable ? 1 : 0;
                stopped += drive.status != ParkingStatus::Parked ? 1 : 0;
            }
            // A fair test: there was something to avoid, which often could be, and not every drive ended there.
            EXPECT_GT(appeared, DRIVES / 4);
            EXPECT_GT(avoidable, appeared / 3);
            EXPECT_LT(stopped, DRIVES * 3 / 4);
        }

        INSTANTIATE_TEST_SUITE_P(With, TroubledDrives, testing::Bool(),
                                 [](const testing::TestParamInfo<bool> &of)
                                 { return std::string(of.param ? "optimisedTrajectories" : "standstills"); });
    }  // namespace
}  // namespace parking

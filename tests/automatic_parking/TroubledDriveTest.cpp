// Some of the drives that `troubled_drives` makes by the thousand: what can be avoided is, and the car ends standing.

#include "benchmarks/studies/reliability/TroubledDrives.h"
#include "parking_geometry/io/ScenarioReader.h"
#include "tests/automatic_parking/ParkingProblems.h"

#include <gtest/gtest.h>

#include <array>

namespace parking
{
    namespace
    {
        // Of drives with standstills: docs/reliability.md says what the faster trajectories do not keep.
        TEST(TroubledDrive, WhatCanBeAvoidedIsAndTheCarStops)
        {
            constexpr std::size_t DRIVES = 35;
            const std::array<std::string, 3> names{"angled45", "parallel", "perpendicular"};
            std::size_t appeared = 0, stopped = 0;
            for (std::size_t i = 0; i < DRIVES; ++i)
            {
                const auto trouble = static_cast<Trouble>(i % TROUBLES);
                if (trouble == Trouble::Several)
                    continue;  // more than is promised
                const std::string &name = names[(i / TROUBLES) % names.size()];
                SCOPED_TRACE(name + ", " + toString(trouble) + ", drive " + std::to_string(i));
                const TroubledDrive drive =
                    driveInTrouble(readScenario(parking_test::bundledFile(name)), trouble, i, false);
                EXPECT_TRUE(drive.stands) << drive.message;
                EXPECT_EQ(drive.brokenLimit, "");
                EXPECT_LE(drive.fastest, 1.1);
                // Wheels that stick are noticed too late for what stands beside a slot.
                if (trouble != Trouble::Stuck)
                {
                    EXPECT_FALSE(drive.hitOther) << drive.message;
                }
                if (drive.avoidable)
                {
                    EXPECT_FALSE(drive.hitAppeared) << drive.message;
                }
                appeared += drive.appeared ? 1 : 0;
                stopped += drive.status != ParkingStatus::Parked ? 1 : 0;
            }
            // A fair test: there was something to avoid, and not every drive ended there.
            EXPECT_GT(appeared, DRIVES / 4);
            EXPECT_LT(stopped, DRIVES * 3 / 4);
        }
    }  // namespace
}  // namespace parking

// What a car does whose wheels stick.

#include "automatic_parking/AutomaticParking.h"
#include "tests/automatic_parking/ParkingProblems.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

namespace
{
    using namespace parking;
    using namespace parking_test;

    /** Metres per second at which the car rolls at most in [\e begin, \e end] seconds. */
    double fastestBetween(const ParkingResult &result, double begin, double end)
    {
        double fastest = 0.0;
        for (const TrajectoryPoint &point : result.trajectory)
            if (point.t >= begin && point.t <= end)
                fastest = std::max(fastest, std::abs(point.v));
        return fastest;
    }

    TEST(StickingWheels, wheelsThatStickForAWhileAreTriedAgain)
    {
        // Longer than the controller waits for the wheels of a car that stands.
        ParkingParameters parameters;
        parameters.optimizeTrajectory = false;
        parameters.drive.disturbances.stuck = {{0.0, 5.0}};
        const ParkingResult result = AutomaticParking(parameters).park(rowOfSlots());
        EXPECT_TRUE(result.parked()) << result.message;
        ASSERT_GT(result.legs.size(), 1u);
        EXPECT_EQ(result.legs[1].reason, "the wheels did not follow their command");
        parameters.drive.disturbances.stuck = {{0.0, 1e9}};
        const ParkingResult never = AutomaticParking(parameters).park(rowOfSlots());
        EXPECT_EQ(never.status, ParkingStatus::Stopped);
        EXPECT_NE(never.message.find("the wheels have not followed their command for 10 s"), std::string::npos)
            << never.message;
        EXPECT_EQ(never.legs.size(), 1u) << "no plan mends that";
        EXPECT_EQ(never.evaluation.collisions, 0u);
        EXPECT_EQ(never.trajectory.back().v, 0.0);
    }

    TEST(StickingWheels, keepACarStandingUntilTheyTurn)
    {
        // The quickest motions turn the wheels all the way: those that stick are seen soon. (From second 2 on the car
        // is too fast to stop beside the parked ones.)
        for (const double begin : {0.0, 0.5, 1.0, 1.5})
        {
            SCOPED_TRACE("from second " + std::to_string(begin));
            ParkingParameters parameters;
            parameters.drive.disturbances.stuck = {{begin, begin + 6.0}};
            const ParkingResult result = AutomaticParking(parameters).park(rowOfSlots());
            EXPECT_TRUE(result.parked()) << result.message;
            EXPECT_EQ(result.evaluation.collisions, 0u);
            EXPECT_GE(result.legs.size(), 2u);
            EXPECT_EQ(fastestBetween(result, begin + 4.0, begin + 5.9), 0.0);
        }
    }

    TEST(StickingWheels, areSeenAtOnceByWhoKnowsTheCarFromTheDriveBefore)
    {
        // The car stops since the map changes; on its next drive the wheels stick from the begin.
        const Scenario scenario = rowOfSlots();
        const auto parkWith = [&scenario](const ParkingParameters &parameters)
        {
            AutomaticParking parking(parameters);
            bool told = false;
            parking.setMapUpdate(
                [&, told](double time, const Pose &) mutable -> std::optional<Scenario>
                {
                    if (told || time < 2.5)
                        return std::nullopt;
                    told = true;
                    Scenario moved = scenario;
                    moved.goals.front().y += 0.2;
                    return moved;
                });
            return parking.park(scenario);
        };
        ParkingParameters parameters;
        parameters.reactionTime = 0.0;
        parameters.drive.disturbances.delay = 0.2;
        const ParkingResult calm = parkWith(parameters);
        ASSERT_TRUE(calm.parked()) << calm.message;
        ASSERT_EQ(calm.legs.size(), 2u);
        EXPECT_TRUE(calm.legs[0].drive.response.delayIsSure);
        EXPECT_DOUBLE_EQ(calm.legs[0].drive.response.commandDelay, 0.2);

        const double begin = calm.legs[1].begin;
        parameters.drive.disturbances.stuck = {{begin, begin + 4.0}};
        const ParkingResult result = parkWith(parameters);
        EXPECT_TRUE(result.parked()) << result.message;
        ASSERT_GE(result.legs.size(), 3u);
        // Two periods, and the two that commands take.
        EXPECT_LT(fastestBetween(result, begin, begin + 4.0), 0.4);
    }
}  // namespace

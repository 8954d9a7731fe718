// Motions in time under the controller: as quick as they are planned, and as precise as paths with standstills.
#include "path_tracking/simulation/ClosedLoop.h"
#include "path_tracking/trajectory/StopAndSteer.h"
#include "path_tracking/trajectory/TrajectoryOptimizer.h"
#include "tests/parking_geometry/ExpectError.h"
#include "tests/path_tracking/TestPaths.h"

#include <gtest/gtest.h>

#include <cmath>

namespace parking::test
{
    namespace
    {
        constexpr double DEGREE = PI / 180.0;
        constexpr double PERIOD = 0.1;  // seconds, of the controller

        /** The quickest motion near a path where nothing is in the way. */
        TimedMotion quickest(const Path &path, TrajectoryOptions options = {})
        {
            options.sharpest = false;
            const FootprintChecker checker(ObstacleSet::fromPolygons({}, {{-200.0, -200.0}, {200.0, 200.0}}),
                                           Vehicle());
            const OptimizedTrajectory found = TrajectoryOptimizer(checker, options).optimize(path);
            EXPECT_FALSE(found.fallback) << found.reason;
            return found.motion;
        }

        DriveResult follow(const TimedMotion &motion, const Disturbances &disturbances = {})
        {
            ClosedLoopParameters parameters;
            parameters.disturbances = disturbances;
            return ClosedLoop(Vehicle(), parameters).follow(motion);
        }

        TEST(MotionDrive, NominalDrivesAreAsQuickAsPlannedAndEndWithinAMillimetreOrTwo)
        {
            for (std::uint64_t seed = 0; seed < 16; ++seed)
            {
                SCOPED_TRACE(seed);
                const Path path = seed % 2 == 0 ? randomReedsShepp(seed, 18.0) : randomLattice(seed, 18.0);
                const TimedMotion motion = quickest(path);
                const DriveResult result = follow(motion);
                EXPECT_TRUE(result.arrived) << result.message;
                // The last period is begun, and there may be one for each leg that ends in the middle of one.
                EXPECT_LE(result.evaluation.travelTime,
                          1.03 * motion.duration() +
                              PERIOD * (1.0 + 0.5 * static_cast<double>(result.evaluation.standstills)));
                EXPECT_LE(result.evaluation.finalPositionError, 0.005);
                EXPECT_LE(result.evaluation.finalYawError, 0.2 * DEGREE);
                EXPECT_LE(result.evaluation.maxPositionError, 0.01);
                EXPECT_NEAR(result.trajectory.back().steering, 0.0, 1e-3);
            }
        }

        TEST(MotionDrive, WhatTakesTooLongIsRefused)
        {
            const TimedMotion motion{{}, {{0.0, 0.0, 0.0}, {2.0, 1.0, 0.0}, {1e9, 1.0, 0.0}, {1e9 + 2.0, 0.0, 0.0}}};
            parking_test::expectError([&motion] { follow(motion); }, {"it takes 1000000002 s", "at most 20000 s"});
            Vehicle slow;
            slow.maxSpeed = Vehicle::LEAST_LIMIT;
            parking_test::expectError(
                [&slow] {
                    ClosedLoop(slow).drive({{}, {{0.0, 1e5}}});
                },
                {"the path takes", "at most 20000 s"});
        }

        TEST(MotionDrive, EveryCommandObeysTheLimits)
        {
            const Vehicle car;
            const DriveResult result = follow(quickest(randomReedsShepp(5, 25.0)), Disturbances::everyday(5));
            double steering = 0.0;
            for (const DriveRecord &record : result.log)
            {
                const Command &command = record.control.command;
                EXPECT_LE(std::abs(command.acceleration), car.maxAcceleration + 1e-9);
                EXPECT_LE(std::abs(command.steering), car.maxSteeringAngle + 1e-9);
                EXPECT_LE(std::abs(command.steering - steering), car.maxSteeringRate * PERIOD + 1e-9);
                steering = command.steering;
            }
        }

        TEST(MotionDrive, WhatIsLeftOfTheLimitsIsWhatDisturbedDrivesArePreciseWith)
        {
            TrajectoryOptions reserve;
            reserve.accelerationShare = 0.95;
            reserve.steeringShare = 0.97;
            reserve.steeringRateShare = 0.8;
            for (std::uint64_t seed = 1; seed <= 8; ++seed)
            {
                SCOPED_TRACE(seed);
                const DriveResult result =
                    follow(quickest(randomReedsShepp(seed, 18.0), reserve), Disturbances::everyday(seed));
                EXPECT_TRUE(result.arrived) << result.message;
                EXPECT_LE(result.evaluation.finalPositionError, 0.05);
                EXPECT_LE(result.evaluation.finalYawError, 1.0 * DEGREE);
                EXPECT_LE(result.evaluation.maxCrossTrack, 0.12);
            }
        }

        TEST(MotionDrive, StopsSafelyWhereTheSolverFails)
        {
            const TimedMotion motion = quickest(randomReedsShepp(3, 18.0));
            ClosedLoop loop{Vehicle()};
            int solves = 0;
            loop.setSolve(
                [&](const MpcProblem &problem) -> MpcSolution
                {
                    static Mpc mpc{Vehicle(), MpcParameters()};
                    if (++solves > 25)
                        throw std::runtime_error("no more");
                    return mpc.solve(problem);
                });
            const DriveResult result = loop.follow(motion);
            EXPECT_FALSE(result.arrived);
            EXPECT_NE(result.message.find("safe stop"), std::string::npos) << result.message;
            EXPECT_EQ(result.log.back().car.speed, 0.0);
            EXPECT_LE(result.evaluation.maxCrossTrack, 0.1);
        }

        TEST(MotionDrive, AMotionWithStandstillsIsDrivenLikeOneWithout)
        {
            const Path path = randomReedsShepp(7, 15.0);
            const TimedMotion motion = stopAndSteer(path, Vehicle(), 0.0, 0.3);
            const DriveResult result = follow(motion);
            EXPECT_TRUE(result.arrived) << result.message;
            EXPECT_LE(result.evaluation.travelTime, 1.03 * motion.duration() + 2.0 * PERIOD);
            EXPECT_LE(result.evaluation.finalPositionError, 0.005);
            EXPECT_NEAR(result.trajectory.back().steering, 0.3, 1e-3);
        }
    }  // namespace
}  // namespace parking::test

// Drives of a simulated car, along paths and through motions in time.
#include "path_tracking/simulation/ClosedLoop.h"

#include "path_tracking/trajectory/StopAndSteer.h"
#include "path_tracking/trajectory/TrajectoryOptimizer.h"
#include "tests/path_tracking/TestPaths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace parking::test
{
    namespace
    {
        constexpr double DEGREE = PI / 180.0;
        constexpr double PERIOD = 0.1;  // seconds, of the controller

        ClosedLoop loopWith(const Disturbances &disturbances)
        {
            ClosedLoopParameters parameters;
            parameters.disturbances = disturbances;
            return {Vehicle(), parameters};
        }

        DriveResult drive(const Path &path, const Disturbances &disturbances = {})
        {
            return loopWith(disturbances).drive(path);
        }

        DriveResult follow(const TimedMotion &motion, const Disturbances &disturbances = {})
        {
            return loopWith(disturbances).follow(motion);
        }

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

        void expectWithin(const DriveResult &result, double crossTrack, double position, double degrees)
        {
            EXPECT_TRUE(result.arrived) << result.message;
            EXPECT_LE(result.evaluation.maxCrossTrack, crossTrack);
            EXPECT_LE(result.evaluation.finalPositionError, position);
            EXPECT_LE(result.evaluation.finalYawError, degrees * DEGREE);
            EXPECT_EQ(result.trajectory.back().v, 0.0);
        }

        TEST(ClosedLoop, FollowsEveryKindOfPathToTheMillimetre)
        {
            for (std::uint64_t seed = 0; seed < 12; ++seed)
            {
                SCOPED_TRACE(seed);
                expectWithin(drive(randomReedsShepp(seed, 30.0)), 0.006, 0.005, 0.2);
                expectWithin(drive(randomLattice(seed, 30.0)), 0.006, 0.005, 0.2);
                expectWithin(drive(randomSmooth(seed, 30.0)), 0.003, 0.005, 0.1);
            }
            for (const double step : {0.01, 0.03, 0.1, 0.2})  // clothoids that come as many arcs
                expectWithin(drive(inArcs(randomSmooth(3, 15.0), step)), 0.006, 0.005, 0.2);
            expectWithin(drive(randomSmooth(40, 120.0)), 0.003, 0.005, 0.1);
            expectWithin(drive(randomReedsShepp(40, 120.0)), 0.008, 0.008, 0.3);
        }

        TEST(ClosedLoop, DrivesMotionsAsQuicklyAsTheyArePlanned)
        {
            for (std::uint64_t seed = 0; seed < 16; ++seed)
            {
                SCOPED_TRACE(seed);
                const Path path = seed % 2 == 0 ? randomReedsShepp(seed, 18.0) : randomLattice(seed, 18.0);
                const TimedMotion motion = quickest(path);
                const DriveResult result = follow(motion);
                expectWithin(result, 0.01, 0.005, 0.2);
                EXPECT_LE(result.evaluation.maxPositionError, 0.01);
                // The last period is begun, and there may be one for each leg that ends in the middle of one.
                EXPECT_LE(result.evaluation.travelTime,
                          1.03 * motion.duration() +
                              PERIOD * (1.0 + 0.5 * static_cast<double>(result.evaluation.standstills)));
                EXPECT_NEAR(result.trajectory.back().steering, 0.0, 1e-3);
            }
            const TimedMotion stops = stopAndSteer(randomReedsShepp(7, 15.0), Vehicle(), 0.0, 0.3);
            const DriveResult result = follow(stops);
            expectWithin(result, 0.01, 0.005, 0.2);
            EXPECT_LE(result.evaluation.travelTime, 1.03 * stops.duration() + 2.0 * PERIOD);
            EXPECT_NEAR(result.trajectory.back().steering, 0.3, 1e-3);
        }

        TEST(ClosedLoop, StandsToSteerFromLockToLock)
        {
            const DriveResult result = drive(arcs({}, {{1.0, 3.0}, {-1.0, 3.0}, {1.0, -2.0}}));
            expectWithin(result, 0.005, 0.005, 0.2);
            EXPECT_EQ(result.evaluation.standstills, 2u);
            const double lock = Vehicle().maxSteeringAngle, rate = Vehicle().maxSteeringRate;
            double turning = 0.0;
            for (const DriveRecord &record : result.log)
                if (record.control.mode == TrackingMode::Steering)
                {
                    turning += 0.1;
                    EXPECT_EQ(record.car.speed, 0.0);
                }
            EXPECT_GE(turning, 5.0 * lock / rate);  // to the left, to the right, and to the left again
        }

        TEST(ClosedLoop, StaysOnThePathWithEverydayDisturbances)
        {
            for (const Path &path : {randomReedsShepp(1, 20.0), randomLattice(2, 20.0), randomSmooth(3, 20.0)})
                for (std::uint64_t seed = 1; seed <= 20; ++seed)
                    expectWithin(drive(path, Disturbances::everyday(seed)), 0.10, 0.05, 1.0);
            TrajectoryOptions reserve;  // what is left of the limits is what motions are precise with
            reserve.accelerationShare = 0.95;
            reserve.steeringShare = 0.97;
            reserve.steeringRateShare = 0.8;
            for (std::uint64_t seed = 1; seed <= 8; ++seed)
                expectWithin(follow(quickest(randomReedsShepp(seed, 18.0), reserve), Disturbances::everyday(seed)),
                             0.12, 0.05, 1.0);
        }

        TEST(ClosedLoop, LearnsLagsBiasesAndOffsets)
        {
            Disturbances disturbances;
            disturbances.steeringLag = 0.2;
            disturbances.accelerationLag = 0.2;
            disturbances.speedBias = -0.05;
            for (std::uint64_t seed = 0; seed < 6; ++seed)
            {
                expectWithin(drive(randomReedsShepp(seed, 20.0), disturbances), 0.10, 0.05, 1.0);
                expectWithin(drive(randomSmooth(seed, 20.0), disturbances), 0.05, 0.03, 0.5);
            }
            // Away from full lock, where there is room to correct, an offset of the wheels is learnt and taken back.
            disturbances.steeringOffset = 1.0 * DEGREE;
            const DriveResult result = drive(arcs({}, {{0.0, 40.0}}), disturbances);
            expectWithin(result, 0.05, 0.02, 0.2);
            const DriveRecord &late = result.log[result.log.size() * 2 / 3];
            EXPECT_GT(late.car.speed, 1.0);
            EXPECT_LT(std::abs(late.crossTrack), 0.002);
            EXPECT_NEAR(late.control.command.steering, -1.0 * DEGREE, 0.1 * DEGREE);
        }

        TEST(ClosedLoop, ReturnsToThePathFromBesideIt)
        {
            const Path path = arcs({}, {{0.0, 12.0}});
            const ClosedLoop loop{Vehicle()};
            for (const Pose &start : {Pose{0.0, 0.2, 0.0}, Pose{0.0, -0.2, 0.1}, Pose{-0.3, 0.0, -0.1}})
            {
                const DriveResult result = loop.drive(path, start);
                EXPECT_TRUE(result.arrived);
                EXPECT_LE(result.evaluation.finalPositionError, 0.01);
                EXPECT_LE(result.evaluation.finalYawError, 0.3 * DEGREE);
            }
        }

        TEST(ClosedLoop, CarAndCommandsObeyTheLimits)
        {
            const Vehicle car;
            const std::vector<DriveResult> drives{
                drive(randomReedsShepp(5, 30.0)), drive(randomLattice(5, 30.0)), drive(randomSmooth(5, 30.0)),
                follow(quickest(randomReedsShepp(5, 25.0)), Disturbances::everyday(5))};
            for (const DriveResult &result : drives)
            {
                double steering = 0.0;
                for (const DriveRecord &record : result.log)
                {
                    const Command &command = record.control.command;
                    EXPECT_LE(std::abs(command.acceleration), car.maxAcceleration + 1e-9);
                    EXPECT_LE(std::abs(command.steering), car.maxSteeringAngle + 1e-9);
                    EXPECT_LE(std::abs(command.steering - steering), car.maxSteeringRate * PERIOD + 1e-9);
                    steering = command.steering;
                }
                const double bias = &result == &drives.back() ? 1.05 : 1.0;  // of the speed
                for (std::size_t i = 0; i < result.trajectory.size(); ++i)
                {
                    const TrajectoryPoint &point = result.trajectory[i];
                    EXPECT_LE(std::abs(point.v), bias * car.maxSpeed + 1e-9);
                    EXPECT_LE(std::abs(point.acceleration), bias * car.maxAcceleration + 1e-9);
                    EXPECT_LE(std::abs(point.steering), car.maxSteeringAngle + 1e-9);
                    EXPECT_LE(std::abs(point.steeringRate), car.maxSteeringRate + 1e-9);
                    if (i > 0)
                    {
                        const TrajectoryPoint &before = result.trajectory[i - 1];
                        EXPECT_LE(std::abs(point.v - before.v),
                                  bias * car.maxAcceleration * (point.t - before.t) + 1e-9);
                    }
                }
            }
        }

        TEST(ClosedLoop, DrivesGridPathsWithSharpCorners)
        {
            for (std::uint64_t seed = 0; seed < 6; ++seed)
            {
                const DriveResult result = drive(randomGridPath(seed, {}, 30, 6));
                EXPECT_TRUE(result.arrived) << result.message;
                EXPECT_LE(result.evaluation.maxCrossTrack, 0.02);       // from the stand-in
                EXPECT_LE(result.evaluation.finalPositionError, 0.03);  // from the path itself
                EXPECT_LE(result.evaluation.finalYawError, 2.0 * DEGREE);
                EXPECT_LE(result.evaluation.cornerDeviation, 3.5);
            }
        }

        TEST(ClosedLoop, DoesNotDependOnWhereTheMapLies)
        {
            const Path path = randomReedsShepp(8, 15.0);
            const DriveResult expected = drive(path);
            for (const Pose &frame : {Pose{4.48e9, 0.0, 0.0}, Pose{-5.5e9, 8.7e9, 2.0}, Pose{0.0, 0.0, -3.0}})
            {
                Path moved = path;
                moved.start = compose(frame, path.start);
                const DriveResult result = drive(moved);
                expectWithin(result, 0.006, 0.006, 0.2);
                EXPECT_NEAR(result.evaluation.travelTime, expected.evaluation.travelTime, 0.31);
            }
        }

        TEST(ClosedLoop, IsDeterministicAndPrintsNothing)
        {
            testing::internal::CaptureStderr();
            testing::internal::CaptureStdout();
            const Path path = randomReedsShepp(6, 10.0);
            const DriveResult a = drive(path, Disturbances::everyday(7)), b = drive(path, Disturbances::everyday(7)),
                              c = drive(path, Disturbances::everyday(8));
            ASSERT_EQ(a.trajectory.size(), b.trajectory.size());
            for (std::size_t i = 0; i < a.trajectory.size(); ++i)
            {
                EXPECT_EQ(a.trajectory[i].x, b.trajectory[i].x);
                EXPECT_EQ(a.trajectory[i].steering, b.trajectory[i].steering);
            }
            EXPECT_NE(a.trajectory.back().x, c.trajectory.back().x);
            EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
            EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
        }

        TEST(ClosedLoop, EvaluatesAsDocumented)
        {
            const Path path = arcs({}, {{0.0, 6.0}, {1.0, -4.0}});
            const DriveResult result = drive(path, Disturbances::everyday(3));
            const Evaluation &e = result.evaluation;
            const Trajectory &trajectory = result.trajectory;
            EXPECT_NEAR(e.travelTime, trajectory.back().t, 1e-9);
            EXPECT_NEAR(e.plannedLength, 10.0, 1e-9);
            double steering = 0.0, acceleration = 0.0, length = 0.0;
            for (std::size_t i = 1; i < trajectory.size(); ++i)
            {
                const TrajectoryPoint &p = trajectory[i - 1], &q = trajectory[i];
                steering += 0.5 * (std::abs(p.steering) + std::abs(q.steering)) * (q.t - p.t);
                acceleration += std::abs(q.v - p.v);
                length += 0.5 * std::abs(p.v + q.v) * (q.t - p.t);
            }
            EXPECT_NEAR(e.meanAbsSteering, steering / e.travelTime, 0.005);
            EXPECT_NEAR(e.meanAbsAcceleration, acceleration / e.travelTime, 0.01);
            EXPECT_NEAR(e.drivenLength, length, 0.05);
            EXPECT_NEAR(e.finalPositionError,
                        std::hypot(trajectory.back().x - path.end().x, trajectory.back().y - path.end().y), 1e-12);
            double crossTrack = 0.0;
            std::size_t solves = 0;
            for (const DriveRecord &record : result.log)
            {
                if (record.control.mode == TrackingMode::Driving)
                    crossTrack = std::max(crossTrack, std::abs(record.crossTrack));
                solves += record.control.solved ? 1 : 0;
            }
            EXPECT_NEAR(e.maxCrossTrack, crossTrack, 0.003);
            EXPECT_EQ(e.solves, solves);
            EXPECT_EQ(e.checkedPoses, 0u);
            EXPECT_TRUE(std::isinf(e.minClearance));
        }

        TEST(ClosedLoop, ChecksTheBodyAlongTheWay)
        {
            // A wall beside a straight drive: the clearance is that of the car's left side.
            const Vehicle vehicle;
            const Path path = arcs({}, {{0.0, 8.0}});
            for (const double gap : {0.1, -0.1})
            {
                const double wall = 0.5 * vehicle.width + gap;
                ClosedLoop loop(vehicle);
                const auto clearance = [&](const Pose &pose)
                {
                    double least = 1e9;
                    for (const Eigen::Vector2d &corner : vehicle.footprint(pose))
                        least = std::min(least, wall - corner.y());
                    return least;
                };
                loop.setClearance(clearance);
                const DriveResult result = loop.drive(path);
                EXPECT_NEAR(result.evaluation.minClearance, gap, 0.003);
                EXPECT_GE(result.evaluation.checkedPoses, 400u);  // every 2 cm
                EXPECT_EQ(result.evaluation.collisions > 0, gap < 0.0);
            }
        }

        TEST(ClosedLoop, TheMonitorStopsTheCar)
        {
            const Path path = arcs({}, {{0.0, 20.0}});
            ClosedLoop loop{Vehicle()};
            double at = 0.0;
            loop.setMonitor(
                [&at](const DriveRecord &record)
                {
                    at = std::max(at, record.car.pose.x);
                    return record.car.pose.x < 8.0;
                });
            const DriveResult result = loop.drive(path);
            EXPECT_FALSE(result.arrived);
            EXPECT_EQ(result.message, "safe stop: the monitor requested it");
            ASSERT_EQ(result.events.size(), 1u);
            // From at most 2.5 m/s at 1 m/s^2, one period and a bit of 0.3 m later.
            EXPECT_GT(result.trajectory.back().x, 8.0);
            EXPECT_LT(result.trajectory.back().x, 8.0 + 3.2 + 0.5);
            EXPECT_EQ(result.trajectory.back().v, 0.0);
        }

        /** The drive along a path of which some is driven without a pose. */
        DriveResult driveBlind(const std::vector<TimeSpan> &spans, double poseWaitLimit)
        {
            ClosedLoopParameters parameters;
            parameters.disturbances.blind = spans;
            parameters.tracking.poseWaitLimit = poseWaitLimit;
            return ClosedLoop(Vehicle(), parameters).drive(arcs({1.0, 2.0, 0.5}, {{0.0, 3.0}, {1.0, 4.0}, {0.0, 3.0}}));
        }

        TEST(ClosedLoop, ACarThatHasLostItsPoseStandsUntilItIsBack)
        {
            // A pose that flickers is not back.
            const DriveResult result = driveBlind({{3.0, 9.0}, {9.15, 9.25}, {9.45, 9.55}}, 10.0);
            EXPECT_FALSE(result.arrived);
            EXPECT_TRUE(std::any_of(result.log.begin(), result.log.end(),
                                    [](const DriveRecord &record)
                                    { return record.control.interruption == "the pose was lost"; }));
            EXPECT_EQ(result.message, "the pose is available again");
            EXPECT_GT(result.trajectory.back().t, 9.6);
            EXPECT_LT(result.trajectory.back().t, 10.3);
            // It goes by speed and wheels until it stands, and its estimate is right afterwards.
            EXPECT_LT(result.evaluation.maxPositionError, 0.02);
            EXPECT_LT(positionDistance(result.log.back().control.estimate, result.log.back().car.pose), 0.01);
            double stands = 0.0;
            for (const DriveRecord &record : result.log)
                if (record.control.mode == TrackingMode::Waiting)
                {
                    EXPECT_EQ(record.car.speed, 0.0);
                    stands += PERIOD;
                }
            EXPECT_GT(stands, 3.0);
            const DriveResult never = driveBlind({{3.0, 1e9}}, 5.0);
            EXPECT_FALSE(never.arrived);
            EXPECT_EQ(never.message, "safe stop: the pose was lost and not recovered within 5 s");
            EXPECT_EQ(never.trajectory.back().v, 0.0);
            EXPECT_GT(never.trajectory.back().t, 8.0);
            EXPECT_LT(never.trajectory.back().t, 12.0);
        }
    }  // namespace
}  // namespace parking::test

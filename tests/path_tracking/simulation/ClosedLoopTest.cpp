#include "path_tracking/simulation/ClosedLoop.h"

#include "parking_geometry/Error.h"
#include "tests/path_tracking/TestPaths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace parking::test
{
    namespace
    {
        constexpr double DEGREE = PI / 180.0;

        Disturbances everyday(std::uint64_t seed)
        {
            Disturbances disturbances;
            disturbances.steeringLag = 0.1;
            disturbances.positionNoise = 0.02;
            disturbances.yawNoise = 0.5 * DEGREE;
            disturbances.speedBias = 0.05;
            disturbances.seed = seed;
            return disturbances;
        }

        DriveResult drive(const Path &path, const Disturbances &disturbances = {})
        {
            ClosedLoopParameters parameters;
            parameters.disturbances = disturbances;
            return ClosedLoop(Vehicle(), parameters).drive(path);
        }

        void expectWithin(const DriveResult &result, double crossTrack, double position, double degrees)
        {
            EXPECT_TRUE(result.arrived) << result.message;
            EXPECT_LE(result.evaluation.maxCrossTrack, crossTrack);
            EXPECT_LE(result.evaluation.finalPositionError, position);
            EXPECT_LE(result.evaluation.finalYawError, degrees * DEGREE);
        }

        TEST(ClosedLoop, FollowsReedsSheppPathsToTheMillimetre)
        {
            for (std::uint64_t seed = 0; seed < 12; ++seed)
                expectWithin(drive(randomReedsShepp(seed, 30.0)), 0.006, 0.005, 0.2);
        }

        TEST(ClosedLoop, FollowsLatticePathsToTheMillimetre)
        {
            for (std::uint64_t seed = 0; seed < 12; ++seed)
                expectWithin(drive(randomLattice(seed, 30.0)), 0.006, 0.005, 0.2);
        }

        TEST(ClosedLoop, FollowsSmoothPathsToTheMillimetre)
        {
            for (std::uint64_t seed = 0; seed < 12; ++seed)
                expectWithin(drive(randomSmooth(seed, 30.0)), 0.003, 0.005, 0.1);
        }

        TEST(ClosedLoop, ClothoidsMayComeAsManyArcs)
        {
            for (const double step : {0.01, 0.03, 0.1, 0.2})
                expectWithin(drive(inArcs(randomSmooth(3, 15.0), step)), 0.006, 0.005, 0.2);
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

        TEST(ClosedLoop, FollowsALongDrive)
        {
            expectWithin(drive(randomSmooth(40, 120.0)), 0.003, 0.005, 0.1);
            expectWithin(drive(randomReedsShepp(40, 120.0)), 0.008, 0.008, 0.3);
        }

        TEST(ClosedLoop, StaysOnThePathWithEverydayDisturbances)
        {
            const std::vector<Path> paths{randomReedsShepp(1, 20.0), randomLattice(2, 20.0), randomSmooth(3, 20.0)};
            for (const Path &path : paths)
                for (std::uint64_t seed = 1; seed <= 20; ++seed)
                    expectWithin(drive(path, everyday(seed)), 0.10, 0.05, 1.0);
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

        TEST(ClosedLoop, ObeysTheLimitsOfTheCar)
        {
            const Vehicle vehicle;
            for (const Path &path : {randomReedsShepp(5, 30.0), randomLattice(5, 30.0), randomSmooth(5, 30.0)})
            {
                const DriveResult result = drive(path);
                const Trajectory &trajectory = result.trajectory;
                for (std::size_t i = 0; i < trajectory.size(); ++i)
                {
                    EXPECT_LE(std::abs(trajectory[i].v), vehicle.maxSpeed + 1e-9);
                    EXPECT_LE(std::abs(trajectory[i].acceleration), vehicle.maxAcceleration + 1e-9);
                    EXPECT_LE(std::abs(trajectory[i].steering), vehicle.maxSteeringAngle + 1e-9);
                    EXPECT_LE(std::abs(trajectory[i].steeringRate), vehicle.maxSteeringRate + 1e-9);
                    if (i > 0)
                    {
                        const double dt = trajectory[i].t - trajectory[i - 1].t;
                        EXPECT_LE(std::abs(trajectory[i].v - trajectory[i - 1].v), vehicle.maxAcceleration * dt + 1e-9);
                    }
                }
                EXPECT_EQ(trajectory.back().v, 0.0);
            }
        }

        TEST(ClosedLoop, DrivesGridPathsWithSharpCorners)
        {
            for (std::uint64_t seed = 0; seed < 6; ++seed)
            {
                Random random(seed);
                std::vector<double> lengths, turns;
                for (int i = 0; i < 30; ++i)
                {
                    lengths.push_back(random.below(2) == 0 ? 0.5 : std::sqrt(0.5));
                    turns.push_back(random.below(6) == 0 ? (random.below(2) == 0 ? 1 : -1) * PI / 4 : 0.0);
                }
                turns.pop_back();
                const DriveResult result = drive(chords({}, lengths, turns));
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

        TEST(ClosedLoop, IsDeterministic)
        {
            const Path path = randomReedsShepp(6, 10.0);
            const DriveResult a = drive(path, everyday(7)), b = drive(path, everyday(7)), c = drive(path, everyday(8));
            ASSERT_EQ(a.trajectory.size(), b.trajectory.size());
            for (std::size_t i = 0; i < a.trajectory.size(); ++i)
            {
                EXPECT_EQ(a.trajectory[i].x, b.trajectory[i].x);
                EXPECT_EQ(a.trajectory[i].steering, b.trajectory[i].steering);
            }
            EXPECT_NE(a.trajectory.back().x, c.trajectory.back().x);
        }

        TEST(ClosedLoop, EvaluatesAsDocumented)
        {
            const Path path = arcs({}, {{0.0, 6.0}, {1.0, -4.0}});
            const DriveResult result = drive(path, everyday(3));
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
                ClosedLoop valid(vehicle);
                valid.setValidity([&](const Pose &pose) { return clearance(pose) > 0.0; });
                EXPECT_EQ(valid.drive(path).evaluation.collisions > 0, gap < 0.0);
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
            EXPECT_EQ(result.message, "safe stop: the monitor asked for it");
            ASSERT_EQ(result.events.size(), 1u);
            // From at most 2.5 m/s at 1 m/s^2, one period and a bit of 0.3 m later.
            EXPECT_GT(result.trajectory.back().x, 8.0);
            EXPECT_LT(result.trajectory.back().x, 8.0 + 3.2 + 0.5);
            EXPECT_EQ(result.trajectory.back().v, 0.0);
        }

        TEST(ClosedLoop, AFailingSolverIsCountedAndStopsTheCar)
        {
            ClosedLoop loop{Vehicle()};
            int count = 0;
            loop.setSolve(
                [&count](const MpcProblem &)
                {
                    ++count;
                    MpcSolution solution;
                    solution.message = "no licence";
                    return solution;
                });
            const DriveResult result = loop.drive(arcs({}, {{0.0, 5.0}}));
            EXPECT_FALSE(result.arrived);
            EXPECT_EQ(result.message, "safe stop: no licence");
            EXPECT_EQ(result.evaluation.solverFailures, static_cast<std::size_t>(count));
            EXPECT_EQ(result.evaluation.drivenLength, 0.0);
        }

        TEST(ClosedLoop, ASolverThatThrowsStopsTheCar)
        {
            ClosedLoop loop{Vehicle()};
            int count = 0;
            loop.setSolve(
                [&count](const MpcProblem &problem)
                {
                    if (++count > 30)
                        throw std::runtime_error("out of licences");
                    MpcSolution solution;
                    solution.usable = true;
                    solution.controls.assign(problem.reference.size(), {0.5, 0.0});
                    return solution;
                });
            const DriveResult result = loop.drive(arcs({}, {{0.0, 30.0}}));
            EXPECT_FALSE(result.arrived);
            EXPECT_NE(result.message.find("out of licences"), std::string::npos) << result.message;
            EXPECT_GT(result.evaluation.drivenLength, 1.0);
            EXPECT_EQ(result.trajectory.back().v, 0.0);
        }

        TEST(ClosedLoop, CommandsKeepToTheSpeedLimitWhateverTheSolverSays)
        {
            for (const double direction : {1.0, -1.0})
                for (const bool disturbed : {false, true})
                {
                    ClosedLoopParameters parameters;
                    if (disturbed)
                        parameters.disturbances.accelerationLag = parameters.tracking.response.driveLag = 0.2;
                    ClosedLoop loop(Vehicle(), parameters);
                    loop.setSolve(
                        [direction](const MpcProblem &problem)
                        {
                            MpcSolution solution;
                            solution.usable = true;
                            solution.controls.assign(problem.reference.size(), {direction, 0.0});
                            return solution;
                        });
                    const DriveResult result = loop.drive(arcs({}, {{0.0, direction * 40.0}}));
                    double fastest = 0.0;
                    for (const TrajectoryPoint &point : result.trajectory)
                        fastest = std::max(fastest, std::abs(point.v));
                    EXPECT_GT(fastest, 0.95 * Vehicle().maxSpeed);
                    EXPECT_LE(fastest, 1.002 * Vehicle().maxSpeed);
                    EXPECT_EQ(result.trajectory.back().v, 0.0);
                }
        }

        TEST(ClosedLoop, APathWithoutAMoveIsAnError)
        {
            EXPECT_THROW(ClosedLoop{Vehicle()}.drive({}), Error);
            EXPECT_THROW(ClosedLoop{Vehicle()}.drive({{}, {PathPiece::turnOnTheSpot(1.0)}}), Error);
        }

        TEST(ClosedLoop, PrintsNothing)
        {
            testing::internal::CaptureStderr();
            testing::internal::CaptureStdout();
            drive(randomReedsShepp(2, 10.0), everyday(2));
            const std::string error = testing::internal::GetCapturedStderr();
            const std::string output = testing::internal::GetCapturedStdout();
            EXPECT_EQ(error, "");
            EXPECT_EQ(output, "");
        }

        TEST(ClosedLoop, ThePapersOwnCostDrivesTheSamePaths)
        {
            // W1 pulling the wheels straight, heading only near the goal: as printed in the paper.
            ClosedLoopParameters parameters;
            parameters.tracking.mpc.relativeSteering = false;
            parameters.tracking.mpc.farHeadingWeight = 0.0;
            for (std::uint64_t seed = 0; seed < 5; ++seed)
            {
                const DriveResult result = ClosedLoop(Vehicle(), parameters).drive(randomSmooth(seed, 25.0));
                expectWithin(result, 0.05, 0.05, 1.0);
            }
        }

        TEST(ClosedLoop, RefusesBadParameters)
        {
            const auto refused = [](const auto &change)
            {
                ClosedLoopParameters parameters;
                change(parameters);
                EXPECT_THROW(ClosedLoop(Vehicle(), parameters), Error);
            };
            refused([](ClosedLoopParameters &p) { p.plantStep = 0.0; });
            refused([](ClosedLoopParameters &p) { p.checkDistance = std::nan(""); });
            refused([](ClosedLoopParameters &p) { p.patience = -1.0; });
            refused([](ClosedLoopParameters &p) { p.disturbances.positionNoise = -1.0; });
            refused([](ClosedLoopParameters &p) { p.tracking.mpc.step = 0.0; });
            const ClosedLoop loop{Vehicle()};
            EXPECT_THROW(loop.drive(Path{}), Error);
            EXPECT_THROW(loop.drive(Path{{}, {PathPiece::turnOnTheSpot(1.0)}}), Error);
        }

        TEST(TimeStatistics, AreNearestRanks)
        {
            EXPECT_EQ(timeStatistics({}).median, 0.0);
            std::vector<double> values;
            for (int i = 200; i >= 1; --i)
                values.push_back(i);
            const TimeStatistics statistics = timeStatistics(values);
            EXPECT_EQ(statistics.median, 100.0);
            EXPECT_EQ(statistics.p99, 198.0);
            EXPECT_EQ(statistics.max, 200.0);
        }
    }  // namespace
}  // namespace parking::test

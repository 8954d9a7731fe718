#include "automatic_parking/AutomaticParking.h"

#include "automatic_parking/drawing/DriveAnimation.h"
#include "automatic_parking/perception/ExtendedObstacles.h"
#include "automatic_parking/perception/SimulatedSensor.h"
#include "parking_geometry/Error.h"
#include "state_validity/sweeps/PathSweep.h"
#include "tests/automatic_parking/ParkingProblems.h"
#include "tests/support/ExpectRefused.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace
{
    using namespace parking;
    using namespace parking_test;

    void expectLegal(const ParkingResult &result, const Vehicle &vehicle)
    {
        ASSERT_GT(result.trajectory.size(), 2u);
        for (std::size_t i = 1; i < result.trajectory.size(); ++i)
        {
            const TrajectoryPoint &before = result.trajectory[i - 1], &point = result.trajectory[i];
            ASSERT_GT(point.t, before.t) << "point " << i;
            EXPECT_LE(std::abs(point.v), vehicle.maxSpeed + 1e-9);
            EXPECT_LE(std::abs(point.steering), vehicle.maxSteeringAngle + 1e-9);
            EXPECT_LE(std::abs(point.v - before.v), (vehicle.maxAcceleration + 1e-6) * (point.t - before.t));
            EXPECT_LE(std::abs(point.steering - before.steering),
                      (vehicle.maxSteeringRate + 1e-6) * (point.t - before.t));
            // No jumps, not even from one drive to the next.
            EXPECT_LE(std::hypot(point.x - before.x, point.y - before.y),
                      vehicle.maxSpeed * (point.t - before.t) + 1e-6);
        }
    }

    TEST(AutomaticParkingTest, parksInOneCall)
    {
        const Scenario scenario = rowOfSlots();
        const ParkingResult result = AutomaticParking().park(scenario);
        ASSERT_TRUE(result.parked()) << result.message;
        ASSERT_EQ(result.legs.size(), 1u);
        EXPECT_TRUE(result.legs[0].plan.found);
        EXPECT_TRUE(result.legs[0].drive.arrived);
        EXPECT_GT(result.planningTime, 0.0);
        expectLegal(result, scenario.vehicle);
        EXPECT_LT(result.evaluation.finalPositionError, 0.01);
        EXPECT_EQ(result.evaluation.collisions, 0u);
        EXPECT_GT(result.evaluation.checkedPoses, 100u);
        EXPECT_NEAR(result.trajectory.back().x, scenario.goals[0].x, 0.01);
        EXPECT_NEAR(result.trajectory.back().y, scenario.goals[0].y, 0.01);
        EXPECT_EQ(result.trajectory.back().v, 0.0);
    }

    /** Changes the scenario that is asked for at some time, with the car at some pose; false: all is as before. */
    using Change = std::function<bool(Scenario &changed, double time, const Pose &car)>;

    ParkingResult parkWhileItChanges(const Scenario &scenario, const Change &change)
    {
        AutomaticParking parking;
        parking.setMapUpdate(
            [&](double time, const Pose &car) -> std::optional<Scenario>
            {
                Scenario changed = scenario;
                return change(changed, time, car) ? std::optional<Scenario>(changed) : std::nullopt;
            });
        return parking.park(scenario);
    }

    /** The reactions other than keeping the driven motion. */
    std::vector<ReactionKind> kindsOf(const ParkingResult &result)
    {
        std::vector<ReactionKind> kinds;
        for (const Reaction &reaction : result.reactions)
            if (reaction.kind != ReactionKind::Kept)
                kinds.push_back(reaction.kind);
        return kinds;
    }

    TEST(AutomaticParkingTest, stopsToPlanWithoutTimeToReact)
    {
        ParkingParameters parameters;
        parameters.reactionTime = 0.0;
        AutomaticParking parking(parameters);
        const Scenario scenario = openGround(25.0);
        parking.setMapUpdate(
            [&](double time, const Pose &) -> std::optional<Scenario>
            {
                Scenario changed = scenario;
                changed.polygons = {box(16.0, -1.0, 17.0, 1.0)};
                return time >= 3.0 ? std::optional<Scenario>(changed) : std::nullopt;
            });
        const ParkingResult result = parking.park(scenario);
        ASSERT_TRUE(result.parked()) << result.message;
        ASSERT_EQ(result.legs.size(), 2u);
        EXPECT_EQ(result.legs[1].reason, "the map has changed");
        EXPECT_FALSE(result.legs[0].drive.arrived);
        EXPECT_NEAR(result.legs[1].begin, result.legs[0].drive.trajectory.back().t, 1e-9);
        EXPECT_LT(result.legs[0].drive.trajectory.back().x, 12.0);  // it stopped well before the box
    }

    TEST(AutomaticParkingTest, drivesRoundWhatOnlyItsSensorSees)
    {
        Scenario scenario = openGround(25.0);
        scenario.polygons = {box(12.0, -1.5, 13.0, 1.5)};
        for (const double range : {20.0, 8.0})
        {
            SensorParameters sensor;
            sensor.range = range;
            AutomaticParking parking;
            parking.setPerception(std::make_shared<SimulatedSensor>(scenario, sensor));
            const ParkingResult result = parking.park(scenario);
            EXPECT_TRUE(result.parked()) << result.message;
            EXPECT_EQ(result.evaluation.collisions, 0u);
            EXPECT_GT(result.evaluation.checkedPoses, 100u);
            expectLegal(result, scenario.vehicle);
        }
    }

    TEST(AutomaticParkingTest, plansRoundTheUnseenPartsOfObstacles)
    {
        // The car sees the near side of a thick wall. Behind it, the shortest way to the goal leads through the wall.
        Scenario scenario = openGround(30.0);
        scenario.polygons = {box(8.0, -15.0, 11.0, 1.5)};
        scenario.goals = {{18.0, -9.0, -0.5 * PI}};
        for (const double extension : {0.0, 3.0})
        {
            PerceptionParameters perception;
            perception.obstacleExtension = extension;
            AutomaticParking parking;
            parking.setPerception(std::make_shared<SimulatedSensor>(scenario), perception);
            const ParkingResult result = parking.park(scenario);
            ASSERT_TRUE(result.parked()) << result.message;
            EXPECT_EQ(result.evaluation.collisions, 0u);
            Scenario seen = scenario;
            seen.polygons.clear();
            seen.unknownIsOccupied = false;
            seen.grid = result.history.map;
            ASSERT_FALSE(result.history.frames.empty());
            ASSERT_EQ(result.history.frames.front().time, 0.0);
            seen.grid->apply(result.history.frames.front().changes);
            const Path first = result.history.plans.front().path;
            EXPECT_TRUE(isPathFree(ParkingWorld(seen).footprint(), first));
            seen.grid = ExtendedObstacles(seen, 3.0).map();
            EXPECT_EQ(isPathFree(ParkingWorld(seen).footprint(), first), extension > 0.0);
        }
    }

    TEST(AutomaticParkingTest, remembersWhatWasSeenAndPlanned)
    {
        Scenario scenario = openGround(25.0);
        scenario.polygons = {box(12.0, -1.5, 13.0, 1.5)};
        SensorParameters sensor;
        sensor.range = 8.0;
        AutomaticParking parking;
        parking.setPerception(std::make_shared<SimulatedSensor>(scenario, sensor));
        const ParkingResult result = parking.park(scenario);
        ASSERT_TRUE(result.parked()) << result.message;
        OccupancyGrid map = result.history.map;
        EXPECT_EQ(std::count(map.cells().begin(), map.cells().end(), Cell::Occupied), 0);
        double time = -1.0;
        for (const SeenFrame &frame : result.history.frames)
        {
            EXPECT_GT(frame.time, time);
            time = frame.time;
            map.apply(frame.changes);
        }
        EXPECT_LE(time, result.trajectory.back().t);
        EXPECT_GT(std::count(map.cells().begin(), map.cells().end(), Cell::Occupied), 20);
        const ReactionFigures figures = reactionFigures(result);
        EXPECT_EQ(result.history.plans.size(), result.legs.size() + figures.newMotions);
        EXPECT_GT(figures.newMotions + figures.stops, 0u);
        EXPECT_GT(figures.check.median, 0.0);
        EXPECT_GE(figures.motion.max, figures.motion.median);
        // Each plan begins where the car is when the motion begins, or later on its way.
        for (const TimedPlan &plan : result.history.plans)
        {
            ASSERT_FALSE(plan.path.pieces.empty());
            EXPECT_TRUE(std::any_of(result.trajectory.begin(), result.trajectory.end(),
                                    [&plan](const TrajectoryPoint &point) {
                                        return point.t >= plan.time - 1e-9 &&
                                               std::hypot(point.x - plan.path.start.x, point.y - plan.path.start.y) <
                                                   0.2;
                                    }))
                << plan.time;
        }
    }

    TEST(AutomaticParkingTest, standsOnSeenGroundOnceItsSensorFails)
    {
        /** Sees nothing, or throws, after some time. */
        struct Failing : Perception
        {
            Failing(const Scenario &scenario, bool willThrow) : sensor(scenario), throws(willThrow)
            {
            }
            GridUpdate observe(double time, const Pose &car, const OccupancyGrid &map) override
            {
                if (time > 2.0 && throws)
                    throw std::runtime_error("no frame");
                return time > 2.0 ? GridUpdate() : sensor.observe(time, car, map);
            }
            SimulatedSensor sensor;
            bool throws;
        };
        Scenario scenario = openGround(60.0);
        for (const bool throws : {true, false})
        {
            AutomaticParking parking;
            parking.setPerception(std::make_shared<Failing>(scenario, throws));
            const ParkingResult result = parking.park(scenario);
            EXPECT_EQ(result.status, ParkingStatus::Stopped) << result.message;
            EXPECT_EQ(result.trajectory.back().v, 0.0);
            // Within the range of the last frame.
            EXPECT_LT(result.trajectory.back().x, 2.5 + 20.0);
            EXPECT_EQ(result.message.find("no frame") != std::string::npos, throws) << result.message;
        }
    }

    TEST(AutomaticParkingTest, plansAnewWhenTheMapBlocksThePath)
    {
        const Scenario scenario = openGround(25.0);
        bool isTold = false;
        const ParkingResult result = parkWhileItChanges(scenario,
                                                        [&](Scenario &changed, double time, const Pose &)
                                                        {
                                                            changed.polygons = {box(16.0, -1.0, 17.0, 1.0)};
                                                            return time >= 3.0 && !std::exchange(isTold, true);
                                                        });
        ASSERT_TRUE(result.parked()) << result.message;
        ASSERT_EQ(result.legs.size(), 1u);
        ASSERT_EQ(kindsOf(result), std::vector<ReactionKind>{ReactionKind::Moving});
        for (const TrajectoryPoint &point : result.trajectory)
            EXPECT_TRUE(point.v > 0.3 || point.t < 1.0 || point.t > result.trajectory.back().t - 1.0) << point.t;
        EXPECT_EQ(result.evaluation.collisions, 0u);
        expectLegal(result, scenario.vehicle);
        EXPECT_TRUE(std::any_of(result.trajectory.begin(), result.trajectory.end(),
                                [](const TrajectoryPoint &point) { return std::abs(point.y) > 1.5; }));
        EXPECT_LT(result.evaluation.finalPositionError, 0.01);
    }

    TEST(AutomaticParkingTest, drivesOnWhenTheMapChangesElsewhere)
    {
        int updates = 0;
        const ParkingResult result =
            parkWhileItChanges(openGround(25.0),
                               [&](Scenario &changed, double time, const Pose &)
                               {
                                   // Beside the path, and where the car has been already.
                                   changed.polygons = {box(16.0, 3.0, 17.0, 6.0), box(-0.5, -0.5, 0.5, 0.5)};
                                   return time >= 6.0 && ++updates > 0;
                               });
        EXPECT_TRUE(result.parked()) << result.message;
        EXPECT_EQ(result.legs.size(), 1u);
        EXPECT_GT(updates, 10);
    }

    TEST(AutomaticParkingTest, plansAnewForWhatAppearsTooNearBesideThePath)
    {
        // Free, but nearer than the guard allows: a car with another wheelbase than believed crept into it.
        const Scenario scenario = openGround(25.0);
        const double side = 0.5 * scenario.vehicle.width;
        for (const double gap : {0.01, 0.05})
        {
            const ParkingResult result =
                parkWhileItChanges(scenario,
                                   [&](Scenario &changed, double time, const Pose &)
                                   {
                                       changed.polygons = {box(16.0, side + gap, 17.0, side + 3.0)};
                                       return time >= 3.0;
                                   });
            EXPECT_TRUE(result.parked()) << result.message;
            EXPECT_EQ(result.legs.size(), 1u);
            EXPECT_EQ(kindsOf(result).size(), gap < 0.03 ? 1u : 0u);
            EXPECT_GT(result.legs.back().plan.clearance, 0.03);
        }
    }

    TEST(AutomaticParkingTest, followsAGoalThatMoves)
    {
        const Scenario scenario = openGround(20.0);
        // By the heading, not the time: when the car is in the bend depends on how quickly it drives there.
        bool isTurned = false;
        const ParkingResult result = parkWhileItChanges(scenario,
                                                        [&](Scenario &changed, double time, const Pose &car)
                                                        {
                                                            isTurned = isTurned || (time >= 2.0 && car.yaw > 0.08);
                                                            changed.goals = {{20.0, isTurned ? -3.0 : 3.0, 0.0}};
                                                            return time >= 2.0;
                                                        });
        ASSERT_TRUE(result.parked()) << result.message;
        EXPECT_EQ(result.legs.size(), 1u);
        EXPECT_EQ(kindsOf(result).size(), 2u);
        EXPECT_NEAR(result.trajectory.back().y, -3.0, 0.01);
        expectLegal(result, scenario.vehicle);
    }

    TEST(AutomaticParkingTest, aGoalThatJittersIsNotAnotherOne)
    {
        int updates = 0;
        const ParkingResult result = parkWhileItChanges(openGround(),
                                                        [&](Scenario &changed, double, const Pose &)
                                                        {
                                                            ++updates;
                                                            changed.goals.front().x += updates % 2 == 0 ? 0.01 : -0.01;
                                                            changed.goals.front().yaw +=
                                                                updates % 3 == 0 ? 0.002 : -0.002;
                                                            return true;
                                                        });
        EXPECT_TRUE(result.parked()) << result.message;
        EXPECT_EQ(result.legs.size(), 1u);
        EXPECT_GT(updates, 50);
    }

    TEST(AutomaticParkingTest, aMapThatMakesNoSenseOrLeavesNoWayIsASafeStop)
    {
        const auto stops = [](ParkingStatus status, const char *why, const std::function<void(Scenario &)> &change)
        {
            const ParkingResult result = parkWhileItChanges(openGround(25.0),
                                                            [&](Scenario &changed, double time, const Pose &)
                                                            {
                                                                if (time >= 2.0)
                                                                    change(changed);
                                                                return time >= 2.0;
                                                            });
            EXPECT_EQ(result.status, status);
            EXPECT_NE(result.message.find(why), std::string::npos) << result.message;
            EXPECT_EQ(result.evaluation.collisions, 0u);
            EXPECT_EQ(result.trajectory.back().v, 0.0);
            EXPECT_GT(result.trajectory.back().x, 0.1);
            EXPECT_LT(result.trajectory.back().x, 12.0);
        };
        using Status = ParkingStatus;
        stops(Status::NoPath, "no path", [](Scenario &s) { s.polygons = {box(16.0, -15.0, 17.0, 15.0)}; });
        stops(Status::Stopped, "worldOffset", [](Scenario &s) { s.worldOffset = {1.0, 0.0}; });
        stops(Status::Stopped, "no goal", [](Scenario &s) { s.goals.clear(); });
        stops(Status::Stopped, "bounds", [](Scenario &s) { s.bounds.max = s.bounds.min; });
        stops(Status::Stopped, "the lidar is gone", [](Scenario &) { throw std::runtime_error("the lidar is gone"); });
    }

    TEST(AutomaticParkingTest, plansAnewWhenTheCarIsNotOnThePath)
    {
        const Scenario scenario = openGround(20.0);
        // It stands 40 cm beside where it is believed to stand, which the first measurement tells.
        const ParkingResult result = AutomaticParking().park(scenario, Pose{0.0, 0.4, 0.0});
        ASSERT_TRUE(result.parked()) << result.message;
        ASSERT_EQ(result.legs.size(), 2u);
        EXPECT_NE(result.legs[1].reason.find("40 cm beside the path"), std::string::npos) << result.legs[1].reason;
        EXPECT_NEAR(result.legs[1].plan.path.start.y, 0.4, 0.01);
        EXPECT_LT(result.evaluation.finalPositionError, 0.01);
        // Less than the bound is the controller's business.
        EXPECT_EQ(AutomaticParking().park(scenario, Pose{0.0, 0.2, 0.0}).legs.size(), 1u);
        EXPECT_EQ(AutomaticParking().park(scenario, Pose{0.0, 0.0, 0.4}).legs.size(), 2u);
    }

    TEST(AutomaticParkingTest, givesUpWhenNoReplanningIsLeft)
    {
        ParkingParameters parameters;
        parameters.maxReplans = 0;
        const ParkingResult result = AutomaticParking(parameters).park(openGround(20.0), Pose{0.0, 0.4, 0.0});
        EXPECT_EQ(result.status, ParkingStatus::Stopped);
        EXPECT_NE(result.message.find("no replanning is left"), std::string::npos) << result.message;
        EXPECT_EQ(result.trajectory.back().v, 0.0);
    }

    TEST(AutomaticParkingTest, aGoalThatIsMissedIsTriedAgain)
    {
        ParkingParameters parameters;
        parameters.goalTolerance = 1e-9;  // nobody stands so well
        parameters.maxReplans = 2;
        const ParkingResult result = AutomaticParking(parameters).park(rowOfSlots());
        EXPECT_EQ(result.status, ParkingStatus::MissedGoal);
        EXPECT_EQ(result.legs.size(), 3u);
        EXPECT_NE(result.message.find("from the goal"), std::string::npos) << result.message;
    }

    TEST(AutomaticParkingTest, aCarThatHasLostItsPoseStopsWaitsAndGoesOn)
    {
        for (const bool optimized : {true, false})
        {
            SCOPED_TRACE(optimized);
            const Scenario scenario = rowOfSlots();
            ParkingParameters parameters;
            parameters.optimizeTrajectory = optimized;
            // For longer than a stop takes. Time runs on from drive to drive, so that it does not happen again.
            parameters.drive.disturbances.blind = {{3.0, 7.0}};
            const ParkingResult result = AutomaticParking(parameters).park(scenario);
            ASSERT_TRUE(result.parked()) << result.message;
            ASSERT_EQ(result.legs.size(), 2u);
            EXPECT_EQ(result.legs[1].reason, "the pose was lost");
            EXPECT_GT(result.legs[1].begin, 7.0);
            EXPECT_EQ(result.evaluation.collisions, 0u);
            expectLegal(result, scenario.vehicle);
        }
    }

    TEST(AutomaticParkingTest, aPoseThatStaysAwayIsASafeStop)
    {
        ParkingParameters parameters;
        parameters.drive.disturbances.blind = {{3.0, 1e9}};
        const ParkingResult result = AutomaticParking(parameters).park(rowOfSlots());
        EXPECT_EQ(result.status, ParkingStatus::Stopped);
        EXPECT_NE(result.message.find("the pose was lost and not recovered within 10 s"), std::string::npos)
            << result.message;
        EXPECT_EQ(result.legs.size(), 1u);
        EXPECT_EQ(result.evaluation.collisions, 0u);
        EXPECT_EQ(result.trajectory.back().v, 0.0);
    }

    TEST(AutomaticParkingTest, drivesNoWayThatLeavesHardlyAMillimetre)
    {
        // A gate on the only way: with 4 mm to spare on each side, and with 8.
        for (const double spare : {0.004, 0.008})
        {
            Scenario scenario = openGround();
            scenario.start = {};
            scenario.goals = {{20.0, 0.0, 0.0}};
            scenario.bounds = {{-8.0, -5.0}, {28.0, 5.0}};
            const double half = 0.5 * scenario.vehicle.width + spare;
            scenario.polygons = {box(9.0, half, 10.0, 6.0), box(9.0, -6.0, 10.0, -half)};
            const ParkingResult result = AutomaticParking().park(scenario);
            EXPECT_EQ(result.status, spare < 0.005 ? ParkingStatus::NoPath : ParkingStatus::Parked) << result.message;
            EXPECT_EQ(result.evaluation.collisions, 0u);
            EXPECT_EQ(result.trajectory.empty(), spare < 0.005);
        }
    }

    TEST(AutomaticParkingTest, aParkedCarStaysWhereItIs)
    {
        for (Scenario scenario : {rowOfSlots(), openGround()})
        {
            scenario.start = scenario.goals.front();
            const ParkingResult result = AutomaticParking().park(scenario);
            EXPECT_TRUE(result.parked()) << result.message;
            ASSERT_EQ(result.legs.size(), 1u);
            EXPECT_EQ(result.legs[0].plan.path.length(), 0.0);
            EXPECT_EQ(result.evaluation.drivenLength, 0.0);
            EXPECT_EQ(result.evaluation.finalPositionError, 0.0);
            EXPECT_FALSE(driveAnimation(scenario, result.legs[0].plan.path, result.trajectory, "parked").empty());
            // A tenth of a millimetre ahead is a way to drive, but not one out of the slot and back.
            scenario.start = compose(scenario.start, {-1e-4, 0.0, 0.0});
            const ParkingResult near = AutomaticParking().park(scenario);
            EXPECT_TRUE(near.parked()) << near.message;
            EXPECT_LT(near.evaluation.drivenLength, 0.01);
        }
    }

    TEST(AutomaticParkingTest, drivesGivenPathsAndStopsBeforeWhatIsInTheWay)
    {
        Scenario scenario = openGround();
        const Path path{scenario.start, {{0.0, 15.0}}};
        const ParkingResult good = AutomaticParking().drive(scenario, path);
        EXPECT_TRUE(good.parked()) << good.message;
        EXPECT_NEAR(good.evaluation.drivenLength, 15.0, 0.01);
        scenario.polygons = {box(8.0, -0.1, 8.2, 0.1)};
        const ParkingResult bad = AutomaticParking().drive(scenario, path);
        EXPECT_EQ(bad.legs.at(0).plan.clearance, 0.0);
        // The car drives as far as it may, and stands before what is in the way.
        EXPECT_EQ(bad.status, ParkingStatus::Stopped);
        EXPECT_EQ(bad.message, "the car could not stop in time if it drove on");
        EXPECT_EQ(bad.evaluation.collisions, 0u);
        EXPECT_EQ(bad.trajectory.back().v, 0.0);
        const double bumper = bad.trajectory.back().x + scenario.vehicle.wheelbase + scenario.vehicle.frontOverhang;
        EXPECT_LT(bumper, 8.0);
        EXPECT_GT(bumper, 7.0);
    }

    TEST(AutomaticParkingTest, stopsBeforeWhatAPathLeavesMillimetresTo)
    {
        Scenario scenario = openGround();
        const double side = 0.5 * scenario.vehicle.width;
        for (const double gap : {0.003, 0.008})
        {
            scenario.polygons = {box(8.0, side + gap, 9.0, side + 1.0)};
            const ParkingResult result = AutomaticParking().drive(scenario, {scenario.start, {{0.0, 15.0}}});
            EXPECT_EQ(result.status, gap < 0.005 ? ParkingStatus::Stopped : ParkingStatus::Parked) << result.message;
            EXPECT_EQ(result.evaluation.collisions, 0u);
            EXPECT_EQ(result.trajectory.back().v, 0.0);
        }
    }

    TEST(AutomaticParkingTest, pathsThatNobodyCanDriveAreRefused)
    {
        const Scenario scenario = openGround();
        const double nan = std::nan("");
        const auto refused = [&](const Path &path, const char *why)
        {
            const ParkingResult result = AutomaticParking().drive(scenario, path);
            EXPECT_EQ(result.status, ParkingStatus::NotDrivable);
            EXPECT_NE(result.message.find(why), std::string::npos) << result.message;
            EXPECT_TRUE(result.trajectory.empty());
        };
        refused({}, "length");
        refused({{}, {PathPiece::turnOnTheSpot(1.0)}}, "length");
        refused({{}, {{0.0, nan}}}, "finite");
        refused({{nan, 0.0, 0.0}, {{0.0, 1.0}}}, "finite");
        refused({{}, {{0.0, 1.0}, {5.0, 1.0}}}, "piece 1: curvature");
    }

    TEST(AutomaticParkingTest, gridPathsAreDrivenByTheSameController)
    {
        // Chords of a grid, turns on the spot between them, another heading at the end.
        const Scenario scenario = openGround(30.0);
        Path path{{}, {PathPiece::turnOnTheSpot(0.25 * PI), {0.0, std::hypot(10.0, 10.0)}}};
        path.append(PathPiece::turnOnTheSpot(-0.25 * PI));
        path.append({0.0, 10.0});
        path.append(PathPiece::turnOnTheSpot(-0.5));
        const ParkingResult result = AutomaticParking().drive(scenario, path);
        ASSERT_TRUE(result.parked()) << result.message;
        EXPECT_LT(result.evaluation.finalPositionError, 0.03);
        EXPECT_LT(result.evaluation.finalYawError, 0.04);
        EXPECT_LT(result.evaluation.maxCrossTrack, 0.01);
        EXPECT_GT(result.evaluation.cornerDeviation, 0.1);
        expectLegal(result, scenario.vehicle);
    }

    TEST(AutomaticParkingTest, figuresOfSeveralDrivesAreThoseOfOne)
    {
        Evaluation a, b;
        a.travelTime = 10.0;
        a.drivenLength = 5.0;
        a.meanAbsSteering = 0.2;
        a.meanAbsAcceleration = 1.0;
        a.maxCrossTrack = 0.04;
        a.minClearance = 0.3;
        a.collisions = 1;
        a.finalPositionError = 1.0;
        b.travelTime = 30.0;
        b.drivenLength = 7.0;
        b.meanAbsSteering = 0.4;
        b.meanAbsAcceleration = 0.2;
        b.maxCrossTrack = 0.03;
        b.minClearance = 0.2;
        b.standstills = 2;
        b.finalPositionError = 0.01;
        const Evaluation all = combined({a, b});
        EXPECT_DOUBLE_EQ(all.travelTime, 40.0);
        EXPECT_DOUBLE_EQ(all.drivenLength, 12.0);
        EXPECT_DOUBLE_EQ(all.meanAbsSteering, 0.35);
        EXPECT_DOUBLE_EQ(all.meanAbsAcceleration, 0.4);
        EXPECT_DOUBLE_EQ(all.maxCrossTrack, 0.04);
        EXPECT_DOUBLE_EQ(all.minClearance, 0.2);
        EXPECT_EQ(all.collisions, 1u);
        EXPECT_EQ(all.standstills, 3u);
        EXPECT_DOUBLE_EQ(all.finalPositionError, 0.01);
        EXPECT_EQ(combined({}).travelTime, 0.0);
    }

    TEST(AutomaticParkingTest, refusesBadParameters)
    {
        using P = ParkingParameters;
        const double nan = std::nan("");
        const auto drive = [](auto... members)
        {
            return field(&P::drive, &ClosedLoopParameters::tracking, members...);
        };
        expectRefused<P>({{"keptClearance", field(&P::keptClearance), {-1.0, nan}},
                          {"minClearance", field(&P::minClearance), {-1.0, nan}},
                          {"motionClearance", field(&P::motionClearance), {-1.0, nan}},
                          {"clearanceShare", field(&P::clearanceShare), {0.0, 1.0, nan}},
                          {"stopClearance", field(&P::stopClearance), {-1.0, nan}},
                          {"lookBack", field(&P::lookBack), {-1.0, nan}},
                          {"replanCrossTrack", field(&P::replanCrossTrack), {0.0, nan}},
                          {"replanHeadingError", field(&P::replanHeadingError), {-1.0, nan}},
                          {"goalTolerance", field(&P::goalTolerance), {0.0, nan}},
                          {"goalYawTolerance", field(&P::goalYawTolerance), {0.0, nan}},
                          {"horizon", drive(&TrackingParameters::mpc, &MpcParameters::horizon), {0.0}},
                          {"timeLimit", field(&P::planning, &PlanningParameters::timeLimit), {-1.0}}},
                         [](const P &parameters) { AutomaticParking parking(parameters); });
    }
}  // namespace

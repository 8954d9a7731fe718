#include "path_tracking/control/TrackingController.h"

#include "path_tracking/simulation/Plant.h"
#include "tests/path_tracking/TestPaths.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>

namespace parking::test
{
    namespace
    {
        /** What a drive came to. */
        struct Drive
        {
            TrackingMode mode{TrackingMode::Driving};
            double fastest{0.0};
            double farthest{0.0};  // metres beside the path, of the true car
            Pose end;
            double stoppedAt{0.0};  // metres along the path
            std::string event;      // the last
            int events{0};
            double duration{0.0};  // seconds
        };

        /** Lets a controller drive a car, \e spoil changing what the controller measures at a time. Every command is
            checked against the limits of the car. */
        Drive driveWith(TrackingController &controller, const Path &path,
                        const std::function<void(double, Measurement &)> &spoil = {},
                        const Disturbances &disturbances = {})
        {
            const Vehicle vehicle;
            const double period = controller.parameters().mpc.step;
            Plant plant(vehicle, disturbances, path.start, 0.0, 0.005);
            Drive drive;
            double steering = 0.0;
            int standing = 0;
            for (double t = 0.0; t < 300.0 && standing < 3; t += period)
            {
                Measurement measurement = plant.measure();
                if (spoil)
                    spoil(t, measurement);
                const TrackingStep step = controller.step(measurement);
                EXPECT_TRUE(std::isfinite(step.command.acceleration));
                EXPECT_LE(std::abs(step.command.acceleration), vehicle.maxAcceleration + 1e-9);
                EXPECT_LE(std::abs(step.command.steering), vehicle.maxSteeringAngle + 1e-9);
                EXPECT_LE(std::abs(step.command.steering - steering), vehicle.maxSteeringRate * period + 1e-9);
                steering = step.command.steering;
                if (!step.event.empty())
                {
                    drive.event = step.event;
                    ++drive.events;
                }
                plant.drive(step.command, period, {});
                const Plant::State state = plant.state();
                drive.fastest = std::max(drive.fastest, std::abs(state.speed));
                const PathProjection place =
                    controller.reference().project(step.leg, state.pose, step.s - 2.0, step.s + 2.0);
                drive.farthest = std::max(drive.farthest, place.distance);
                drive.stoppedAt = place.s;
                standing = controller.finished() && state.speed == 0.0 ? standing + 1 : 0;
                drive.duration = t;
            }
            EXPECT_GE(standing, 3) << "still driving after five minutes";
            drive.mode = controller.mode();
            drive.end = plant.state().pose;
            return drive;
        }

        Path examplePath()
        {
            return arcs({1.0, 2.0, 0.5}, {{0.0, 3.0}, {1.0, 4.0}, {-1.0, -3.0}, {0.0, -3.0}});
        }

        TEST(TrackingController, ArrivesAndKeepsStanding)
        {
            const Path path = examplePath();
            TrackingController controller(path, Vehicle());
            const Drive drive = driveWith(controller, path);
            EXPECT_EQ(drive.mode, TrackingMode::Arrived);
            EXPECT_EQ(drive.events, 0);
            const Pose off = relativeTo(path.end(), drive.end);
            EXPECT_LT(std::hypot(off.x, off.y), 0.005);
            EXPECT_LT(std::abs(off.yaw), 0.005);
            for (int i = 0; i < 5; ++i)
            {
                const TrackingStep step = controller.step({drive.end, 0.0, 0.0});
                EXPECT_EQ(step.mode, TrackingMode::Arrived);
                EXPECT_TRUE(step.command.hold);
                EXPECT_EQ(step.command.acceleration, 0.0);
            }
        }

        /** An optimiser that works until \e from seconds of solving and then does \e bad, \e times times. */
        TrackingController::Solve spoiled(int from, int times, const std::function<MpcSolution()> &bad)
        {
            auto mpc = std::make_shared<Mpc>(Vehicle(), MpcParameters());
            auto count = std::make_shared<int>(0);
            return [=](const MpcProblem &problem)
            {
                const int n = (*count)++;
                MpcSolution good = mpc->solve(problem);
                return n >= from && n < from + times ? bad() : good;
            };
        }

        MpcSolution failure()
        {
            MpcSolution solution;
            solution.message = "out of order";
            return solution;
        }

        TEST(TrackingController, SurvivesAShortFailureOfTheSolver)
        {
            const Path path = examplePath();
            const TrackingParameters parameters;
            TrackingController controller(path, Vehicle(), parameters, 0.0,
                                          spoiled(12, parameters.maxFailures, failure));
            const Drive drive = driveWith(controller, path);
            EXPECT_EQ(drive.mode, TrackingMode::Arrived);
            EXPECT_EQ(drive.events, parameters.maxFailures);
            EXPECT_EQ(drive.event, "out of order");
            EXPECT_LT(drive.farthest, 0.02);
        }

        TEST(TrackingController, StopsOnThePathWhenTheSolverKeepsFailing)
        {
            const Path path = examplePath();
            const TrackingParameters parameters;
            const auto wild = []
            {
                MpcSolution solution;
                solution.usable = true;
                solution.controls.assign(20, {std::nan(""), 0.1});
                return solution;
            };
            const auto throwing = []() -> MpcSolution
            {
                throw std::runtime_error("out of licences");
            };
            for (const int from : {0, 5, 20, 35, 60})
                for (const std::function<MpcSolution()> &bad :
                     {std::function(failure), std::function(wild), std::function(throwing)})
                {
                    TrackingController controller(path, Vehicle(), parameters, 0.0, spoiled(from, 1000, bad));
                    const Drive drive = driveWith(controller, path);
                    EXPECT_EQ(drive.mode, TrackingMode::Stopped);
                    EXPECT_EQ(drive.event.rfind("safe stop: ", 0), 0u) << drive.event;
                    EXPECT_LT(drive.farthest, 0.05) << from;
                }
        }

        TEST(TrackingController, AWildOptimiserCannotRunAway)
        {
            const Path path = examplePath();
            for (const double sign : {1.0, -1.0})
            {
                const auto wild = [sign](const MpcProblem &)
                {
                    MpcSolution solution;
                    solution.usable = true;
                    solution.controls.assign(20, {sign * 1e9, sign * 1e9});
                    return solution;
                };
                TrackingController controller(path, Vehicle(), {}, 0.0, wild);
                const Drive drive = driveWith(controller, path);
                EXPECT_NE(drive.mode, TrackingMode::Arrived);
                EXPECT_LT(drive.fastest, 2.8);
                EXPECT_LT(drive.farthest, 4.5);  // the braking distance from full speed included
            }
        }

        TEST(TrackingController, KeepsToTheSpeedLimitWhateverTheSolverSays)
        {
            for (const double direction : {1.0, -1.0})
                for (const double lag : {0.0, 0.2})
                {
                    const auto onwards = [direction](const MpcProblem &problem)
                    {
                        MpcSolution solution;
                        solution.usable = true;
                        solution.controls.assign(problem.reference.size(), {direction, 0.0});
                        return solution;
                    };
                    Disturbances disturbances;
                    disturbances.accelerationLag = lag;
                    TrackingParameters parameters;
                    parameters.response.driveLag = lag;
                    const Path path = arcs({}, {{0.0, direction * 40.0}});
                    TrackingController controller(path, Vehicle(), parameters, 0.0, onwards);
                    const Drive drive = driveWith(controller, path, {}, disturbances);
                    EXPECT_GT(drive.fastest, 0.95 * Vehicle().maxSpeed);
                    EXPECT_LE(drive.fastest, 1.002 * Vehicle().maxSpeed);
                }
        }

        TEST(TrackingController, BridgesLostMeasurementsAndStopsWhenTheyStayAway)
        {
            const Path path = examplePath();
            const TrackingParameters parameters;
            for (const double value : {std::nan(""), std::numeric_limits<double>::infinity()})
            {
                const auto lose = [value](double from, double to)
                {
                    return [=](double t, Measurement &measurement)
                    {
                        if (t > from && t < to)
                            measurement.pose.x = value;
                    };
                };
                TrackingController bridged(path, Vehicle(), parameters);
                const Drive shortly = driveWith(bridged, path, lose(3.05, 3.35));
                EXPECT_EQ(shortly.mode, TrackingMode::Arrived);
                EXPECT_EQ(shortly.events, 3);
                EXPECT_LT(shortly.farthest, 0.02);
                TrackingController lost(path, Vehicle(), parameters);
                const Drive longer = driveWith(lost, path, lose(3.05, 1e9));
                EXPECT_EQ(longer.mode, TrackingMode::Stopped);
                EXPECT_LT(longer.farthest, 0.05);
            }
            // Never a good measurement: it does not even move off.
            TrackingController blind(path, Vehicle(), parameters);
            const Drive drive = driveWith(blind, path, [](double, Measurement &m) { m.speed = std::nan(""); });
            EXPECT_EQ(drive.mode, TrackingMode::Stopped);
            EXPECT_EQ(drive.fastest, 0.0);
        }

        TEST(TrackingController, ASafeStopLeadsBackTowardsThePath)
        {
            const Vehicle vehicle;
            for (const double direction : {1.0, -1.0})
                for (const Pose &error : {Pose{0.0, 0.3, 0.0}, Pose{0.0, 0.0, 0.15}, Pose{0.0, -0.2, -0.1}})
                {
                    const Path path = arcs({}, {{0.0, direction * 30.0}});
                    TrackingController controller(path, vehicle);
                    Plant plant(vehicle, {}, compose(path.start, error), 0.0, 0.005);
                    plant.drive({direction * 1.0, 0.0, false}, 2.0, {});
                    const Pose begin = plant.state().pose;
                    controller.step(plant.measure());
                    controller.requestStop("test");
                    while (!controller.finished())
                        plant.drive(controller.step(plant.measure()).command, 0.1, {});
                    const Pose end = plant.state().pose;
                    EXPECT_GT(direction * (end.x - begin.x), 1.0);
                    // Where it would be with straight wheels.
                    const double rolled = begin.y + std::tan(begin.yaw) * (end.x - begin.x);
                    EXPECT_LT(std::abs(end.y), std::abs(rolled) - 0.02) << direction << " " << error.y;
                    EXPECT_LT(std::abs(end.y) + 0.5 * std::abs(end.yaw),
                              std::abs(begin.y) + 0.5 * std::abs(begin.yaw) + 0.12);
                }
        }

        /** Asks for no more than \e shy metres before the end of a straight path of 3 m. */
        TrackingController::Solve shyOf(double shy)
        {
            auto mpc = std::make_shared<Mpc>(Vehicle(), MpcParameters());
            return [=](const MpcProblem &problem)
            {
                MpcProblem shortened = problem;
                for (MpcReference &point : shortened.reference)
                    point.pose.x = std::min(point.pose.x, 3.0 - shy);
                return mpc->solve(shortened);
            };
        }

        TEST(TrackingController, StandingShortOfTheEndIsAcceptedOrNotAfterAWhile)
        {
            const Path path = arcs({}, {{0.0, 3.0}});
            const TrackingParameters parameters;
            TrackingController near(path, Vehicle(), parameters, 0.0, shyOf(0.05));
            const Drive accepted = driveWith(near, path);
            EXPECT_EQ(accepted.mode, TrackingMode::Arrived);
            EXPECT_NEAR(accepted.end.x, 2.95, 0.01);
            EXPECT_LT(accepted.duration, near.reference().duration() + parameters.settleTime + 1.0);
            TrackingController far(path, Vehicle(), parameters, 0.0, shyOf(0.2));
            const Drive refused = driveWith(far, path);
            EXPECT_EQ(refused.mode, TrackingMode::Stopped);
            EXPECT_NE(refused.event.find(" cm from the end of the path"), std::string::npos) << refused.event;
        }

        TEST(TrackingController, StopsWhenTheCarStandsElsewhere)
        {
            const Path path = examplePath();
            for (const Pose &error : {Pose{0.0, 0.51, 0.0}, Pose{0.0, 0.0, 0.72}})
            {
                TrackingController controller(path, Vehicle());
                const TrackingStep step = controller.step({compose(path.start, error), 0.0, 0.0});
                EXPECT_EQ(step.event.rfind("safe stop: the ", 0), 0u) << step.event;
            }
            for (const Pose &error : {Pose{0.0, 0.49, 0.0}, Pose{0.0, 0.0, 0.68}})
            {
                TrackingController controller(path, Vehicle());
                EXPECT_EQ(controller.step({compose(path.start, error), 0.0, 0.0}).event, "");
            }
        }

        TEST(TrackingController, BrakesAsSoonAsTheEndIsPassed)
        {
            // A car that is ahead of its time by a metre and still fast.
            const Path path = arcs({}, {{0.0, 3.0}});
            for (const double beyond : {-0.01, 0.01})
            {
                TrackingController controller(path, Vehicle());
                controller.step({path.start, 0.0, 0.0});
                TrackingStep step;
                for (int i = 0; i < 40; ++i)
                {
                    const double x = std::min(3.0 + beyond, 0.1 * i);
                    step = controller.step({{x, 0.0, 0.0}, 1.0, 0.0});
                    if (x == 3.0 + beyond)
                        break;
                }
                EXPECT_EQ(step.command.hold, beyond > 0.0);
            }
        }

        TEST(TrackingController, StopsWhenTheWheelsDoNotTurn)
        {
            const Path path = arcs({}, {{1.0, 3.0}});
            TrackingController controller(path, Vehicle());
            const Drive drive = driveWith(controller, path, [](double, Measurement &m) { m.steering = 0.1; });
            EXPECT_EQ(drive.mode, TrackingMode::Stopped);
            EXPECT_EQ(drive.event, "safe stop: the wheels have not followed their command for 10 s");
            EXPECT_EQ(drive.fastest, 0.0);
        }

        TEST(TrackingController, GivesUpOnACarThatDoesNotMove)
        {
            const Path path = arcs({}, {{0.0, 3.0}});
            TrackingController controller(path, Vehicle());
            TrackingMode mode = TrackingMode::Driving;
            std::string event;
            for (int i = 0; i < 200 && mode != TrackingMode::Stopped; ++i)
            {
                const TrackingStep step = controller.step({path.start, 0.0, 0.0});
                mode = step.mode;
                if (!step.event.empty())
                    event = step.event;
            }
            EXPECT_EQ(mode, TrackingMode::Stopped);
            EXPECT_EQ(event, "safe stop: the car does not move");
        }
    }  // namespace
}  // namespace parking::test

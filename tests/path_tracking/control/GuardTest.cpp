// What a guard is told, and what becomes of a car that it refuses a command.

#include "path_tracking/control/TrackingController.h"
#include "path_tracking/simulation/Plant.h"
#include "tests/path_tracking/TestPaths.h"

#include <gtest/gtest.h>

#include <cmath>

namespace parking::test
{
    namespace
    {
        Path winding(double direction)
        {
            return arcs({}, {{0.0, direction * 4.0}, {0.12, direction * 5.0}, {-0.1, direction * 5.0}});
        }

        TEST(Guard, IsToldTheWayThatAStopTakes)
        {
            for (const double direction : {1.0, -1.0})
                for (const double delay : {0.0, 0.3})
                    for (const double stopAt : {2.0, 4.5, 6.0})
                    {
                        SCOPED_TRACE(std::to_string(direction) + " " + std::to_string(delay) + " " +
                                     std::to_string(stopAt));
                        Disturbances odds;
                        odds.delay = delay;
                        odds.brakeLoss = 0.2;  // the reserve that the guard is told of is needed
                        const Path path = winding(direction);
                        TrackingController controller(path, Vehicle());
                        Path way;
                        controller.setGuard(
                            [&way](const TrackingStep &step)
                            {
                                way = step.stoppingPath;
                                return true;
                            });
                        Plant plant(Vehicle(), odds, path.start, 0.0, 0.005);
                        double t = 0.0;
                        Pose from;
                        while (!controller.finished() && t < 60.0)
                        {
                            const bool stops = t >= stopAt - 0.05 && t < stopAt + 0.05;
                            if (t < stopAt - 0.05)
                                from = plant.state().pose;
                            if (stops)
                                controller.requestStop("test");
                            plant.drive(controller.step(plant.measure()).command, 0.1, {});
                            t += 0.1;
                        }
                        const Pose end = plant.state().pose;
                        ASSERT_FALSE(way.pieces.empty());
                        EXPECT_GT(positionDistance(from, end), 0.3);
                        // The last way that was told began where the car was before the stop.
                        EXPECT_LT(positionDistance(way.start, from), 0.01);
                        EXPECT_LT(positionDistance(way.end(), end), 0.06);
                        EXPECT_LT(std::abs(wrapAngle(way.end().yaw - end.yaw)), 0.02);
                    }
        }

        TEST(Guard, WhatItRefusesIsBrakedForUntilItIsASafeStop)
        {
            const Path path = winding(1.0);
            TrackingController controller(path, Vehicle());
            // Nothing beyond 6 m.
            controller.setGuard([](const TrackingStep &step) { return step.stoppingPath.end().x < 6.0; });
            Plant plant(Vehicle(), {}, path.start, 0.0, 0.005);
            bool blocked = false;
            int slowed = 0;
            for (int i = 0; i < 400 && !controller.finished(); ++i)
            {
                const TrackingStep step = controller.step(plant.measure());
                slowed += step.event.rfind("slowing down", 0) == 0 ? 1 : 0;
                blocked = blocked || !step.interruption.empty();
                plant.drive(step.command, 0.1, {});
                ASSERT_LT(plant.state().pose.x, 6.0);
            }
            EXPECT_EQ(controller.mode(), TrackingMode::Stopped);
            EXPECT_TRUE(blocked);
            EXPECT_GT(slowed, 0);
            EXPECT_GT(plant.state().pose.x, 5.0);
        }

        TEST(Guard, GoesOnWhenItIsAllowedTo)
        {
            const Path path = winding(1.0);
            double t = 0.0;
            TrackingParameters withLimit;
            withLimit.guardWaitLimit = 10.0;
            TrackingController waiting(path, Vehicle(), withLimit);
            // Something crosses the way for four seconds.
            waiting.setGuard([&t](const TrackingStep &step)
                             { return t < 2.0 || t > 6.0 || step.stoppingPath.end().x < 5.0; });
            Plant plant(Vehicle(), {}, path.start, 0.0, 0.005);
            for (; t < 60.0 && !waiting.finished(); t += 0.1)
            {
                plant.drive(waiting.step(plant.measure()).command, 0.1, {});
                if (t < 6.0)
                {
                    ASSERT_LT(plant.state().pose.x, 5.0);
                }
            }
            EXPECT_EQ(waiting.mode(), TrackingMode::Arrived);
            EXPECT_LT(positionDistance(plant.state().pose, path.end()), 0.02);
        }
    }  // namespace
}  // namespace parking::test

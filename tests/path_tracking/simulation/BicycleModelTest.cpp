#include "path_tracking/simulation/BicycleModel.h"

#include "tests/path_tracking/TestPaths.h"

#include <gtest/gtest.h>

#include <cmath>

namespace parking::test
{
    namespace
    {
        constexpr double WHEELBASE = 2.8;

        /** The same motion in many small arcs. */
        Pose drive(const Pose &start, double speed, double acceleration, double from, double to, double duration)
        {
            constexpr int N = 20000;
            Pose pose = start;
            const double h = duration / N;
            for (int i = 0; i < N; ++i)
            {
                const double middle = (i + 0.5) / N;
                const double steering = from + middle * (to - from);
                pose = advance(pose, std::tan(steering) / WHEELBASE, (speed + acceleration * middle * duration) * h);
            }
            return pose;
        }

        TEST(BicycleModel, AgreesWithManySmallArcs)
        {
            Random random(1);
            for (int i = 0; i < 100; ++i)
            {
                const Pose start{0.0, 0.0, random.between(-PI, PI)};
                const double speed = random.between(-2.5, 2.5), acceleration = random.between(-1.0, 1.0);
                const double from = random.between(-0.7, 0.7), to = from + random.between(-0.05, 0.05);
                const Pose expected = drive(start, speed, acceleration, from, to, 0.1);
                const auto step = bicycleStep(start.yaw, speed, acceleration, from, to, 0.1, WHEELBASE);
                EXPECT_NEAR(step.dx, expected.x, 1e-7);
                EXPECT_NEAR(step.dy, expected.y, 1e-7);
                EXPECT_NEAR(step.dyaw, expected.yaw - start.yaw, 1e-7);
            }
        }

        TEST(BicycleModel, IsOfFourthOrder)
        {
            const auto error = [](double duration)
            {
                const double to = 0.1 + 0.3 * duration;
                const Pose expected = drive({}, 2.0, 1.0, 0.1, to, duration);
                const auto step = bicycleStep(0.0, 2.0, 1.0, 0.1, to, duration, WHEELBASE);
                return std::hypot(step.dx - expected.x, step.dy - expected.y);
            };
            // One step's error falls with the fifth power of its length.
            EXPECT_LT(error(0.4), error(0.8) / 20.0);
            EXPECT_GT(error(0.4), error(0.8) / 80.0);
        }

        TEST(BicycleModel, DrivesBackTheWayItCame)
        {
            const auto there = bicycleStep(0.3, 1.0, 0.5, 0.1, 0.15, 0.1, WHEELBASE);
            const auto back = bicycleStep(0.3 + there.dyaw, -1.05, 0.5, 0.15, 0.1, 0.1, WHEELBASE);
            EXPECT_NEAR(there.dx + back.dx, 0.0, 1e-8);
            EXPECT_NEAR(there.dy + back.dy, 0.0, 1e-8);
            EXPECT_NEAR(there.dyaw + back.dyaw, 0.0, 1e-12);
        }
    }  // namespace
}  // namespace parking::test

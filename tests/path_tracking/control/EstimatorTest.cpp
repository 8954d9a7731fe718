#include "path_tracking/control/ActuatorLag.h"
#include "path_tracking/control/PoseEstimator.h"
#include "path_tracking/simulation/Plant.h"

#include "tests/path_tracking/TestPaths.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace parking::test
{
    namespace
    {
        constexpr double PERIOD = 0.1;

        TEST(LagStep, SolvesTheLagExactly)
        {
            for (const double lag : {0.02, 0.1, 0.5})
            {
                const LagStep step(lag, PERIOD);
                double value = 0.3;
                constexpr int N = 200000;
                for (int i = 0; i < N; ++i)
                    value += (0.1 + (i + 0.5) / N * 0.4 - value) / lag * PERIOD / N;
                EXPECT_NEAR(step.ofCommand * 0.5 + step.ofBefore * 0.1 + step.ofValue * 0.3, value, 1e-6);
                EXPECT_NEAR(step.ofCommand + step.ofBefore + step.ofValue, 1.0, 1e-12);
            }
            const LagStep none(0.0, PERIOD);
            EXPECT_EQ(none.ofCommand, 1.0);
            EXPECT_EQ(none.ofBefore, 0.0);
            EXPECT_EQ(none.ofValue, 0.0);
        }

        /** Drives a plant with commands by time, calling \e seen once a period with the measurements round it. */
        void drive(const Disturbances &disturbances, int periods, const std::function<Command(double)> &commands,
                   const std::function<void(const Command &, const Command &, const Measurement &, const Measurement &,
                                            const Plant &)> &seen)
        {
            Plant plant(Vehicle(), disturbances, {}, 0.0, 0.001);
            Command before;
            Measurement last = plant.measure();
            for (int i = 0; i < periods; ++i)
            {
                const Command command = commands(i * PERIOD);
                plant.drive(command, PERIOD, {});
                const Measurement now = plant.measure();
                seen(before, command, last, now, plant);
                before = command;
                last = now;
            }
        }

        Command waves(double t)
        {
            return {0.8 * std::sin(0.9 * t + 0.3), 0.5 * std::sin(0.8 * t), false};
        }

        // Frames are arbitrary: estimates turn with the measurements, also across the jump of the heading at pi.
        TEST(PoseEstimator, DoesNotDependOnTheFrame)
        {
            Disturbances disturbances;
            disturbances.speedBias = -0.05;
            disturbances.steeringOffset = 0.02;
            disturbances.positionNoise = 0.02;
            disturbances.yawNoise = 0.01;
            const Vehicle vehicle;
            for (const double angle : {0.7, 2.0, PI})
            {
                const Pose frame{3.0, -2.0, angle};
                PoseEstimator here(vehicle.wheelbase, {}), there(vehicle.wheelbase, {});
                const auto turned = [&frame](Measurement measurement)
                {
                    measurement.pose = compose(frame, measurement.pose);
                    return measurement;
                };
                bool isStarted = false;
                drive(disturbances, 200, waves,
                      [&](const Command & /*before*/, const Command & /*command*/, const Measurement &last,
                          const Measurement &now, const Plant & /*plant*/)
                      {
                          if (!isStarted)
                          {
                              here.start(last);
                              there.start(turned(last));
                          }
                          isStarted = true;
                          here.predict(PERIOD, now.speed, now.steering);
                          there.predict(PERIOD, now.speed, now.steering);
                          here.correct(now.pose);
                          there.correct(turned(now).pose);
                          EXPECT_TRUE(isSamePose(compose(frame, here.pose()), there.pose(), 1e-9)) << angle;
                      });
                EXPECT_NEAR(here.speedScale(), there.speedScale(), 1e-9);
                EXPECT_NEAR(here.steeringOffset(), there.steeringOffset(), 1e-9);
            }
        }

        TEST(ActuatorLag, LearnsBothLags)
        {
            for (const double lag : {0.0, 0.05, 0.1, 0.3})
            {
                Disturbances disturbances;
                disturbances.steeringLag = lag;
                disturbances.accelerationLag = lag;
                disturbances.steeringOffset = 0.02;
                disturbances.speedBias = -0.05;
                LagEstimator steering;
                DriveLagEstimator acceleration;
                double worst = 0.0;
                drive(disturbances, 300, waves,
                      [&](const Command &before, const Command &command, const Measurement &last,
                          const Measurement &now, const Plant &plant)
                      {
                          steering.learn(PERIOD, command.steering - before.steering, before.steering - last.steering,
                                         command.steering - now.steering, LagEstimator::MIN_ANGLE);
                          acceleration.learn(PERIOD, command.acceleration, last.speed, now.speed);
                          worst = std::abs(acceleration.acceleration() - plant.state().acceleration / 0.95);
                      });
                EXPECT_NEAR(steering.lag(), lag, 0.01) << lag;
                EXPECT_NEAR(acceleration.lag(), lag, 0.01) << lag;
                EXPECT_LT(worst, 0.05) << lag;
            }
        }

        /** Lets \e estimator take part in such a drive, and calls \e seen after each period. */
        void estimate(PoseEstimator &estimator, const Disturbances &disturbances, int periods,
                      const std::function<void(const Measurement &, const Plant &)> &seen)
        {
            bool first = true;
            drive(disturbances, periods, waves,
                  [&](const Command &, const Command &, const Measurement &last, const Measurement &now,
                      const Plant &plant)
                  {
                      if (first)
                          estimator.start(last);
                      first = false;
                      estimator.predict(PERIOD, now.speed, now.steering);
                      estimator.correct(now.pose);
                      seen(now, plant);
                  });
        }

        TEST(PoseEstimator, IsExactWithoutDisturbances)
        {
            PoseEstimator estimator(Vehicle().wheelbase, EstimatorParameters());
            estimate(estimator, {}, 200,
                     [&](const Measurement &now, const Plant &)
                     { EXPECT_TRUE(isSamePose(now.pose, estimator.pose(), 1e-5)); });
            EXPECT_NEAR(estimator.speedScale(), 1.0, 1e-3);
            EXPECT_NEAR(estimator.steeringOffset(), 0.0, 1e-3);
        }

        TEST(PoseEstimator, LearnsBiasesAndReducesNoise)
        {
            for (std::uint64_t seed = 1; seed <= 10; ++seed)
            {
                Disturbances disturbances;
                disturbances.positionNoise = 0.02;
                disturbances.yawNoise = 0.5 * PI / 180.0;
                disturbances.speedBias = 0.05;
                disturbances.steeringOffset = 0.01;
                disturbances.seed = seed;
                PoseEstimator estimator(Vehicle().wheelbase, EstimatorParameters());
                double measured = 0.0, estimated = 0.0, measuredYaw = 0.0, estimatedYaw = 0.0;
                int count = 0;
                estimate(estimator, disturbances, 400,
                         [&](const Measurement &now, const Plant &plant)
                         {
                             if (++count < 100)
                                 return;
                             const Pose truth = plant.state().pose;
                             const Pose m = relativeTo(truth, now.pose), e = relativeTo(truth, estimator.pose());
                             measured += m.x * m.x + m.y * m.y;
                             estimated += e.x * e.x + e.y * e.y;
                             measuredYaw += m.yaw * m.yaw;
                             estimatedYaw += e.yaw * e.yaw;
                         });
                EXPECT_LT(std::sqrt(estimated), 0.5 * std::sqrt(measured)) << seed;
                EXPECT_LT(std::sqrt(estimatedYaw), 0.5 * std::sqrt(measuredYaw)) << seed;
                EXPECT_NEAR(estimator.speedScale(), 1.05, 0.02) << seed;
                EXPECT_NEAR(estimator.steeringOffset(), 0.01, 0.005) << seed;
            }
        }

        TEST(Plant, BrakesAndHolds)
        {
            for (const double lag : {0.0, 0.2})
                for (const double sign : {1.0, -1.0})
                    for (const double asked : {0.0, -1.0, 1.0})  // even a brake command with the wrong sign brakes
                    {
                        Disturbances disturbances;
                        disturbances.accelerationLag = lag;
                        Plant plant(Vehicle(), disturbances, {}, 0.0, 0.005);
                        plant.drive({sign * 1.0, 0.0, false}, 2.0, {});
                        ASSERT_GT(sign * plant.state().speed, 1.0);
                        plant.drive({asked, 0.0, true}, 3.0, {});
                        EXPECT_EQ(plant.state().speed, 0.0);
                        const Pose stood = plant.state().pose;
                        plant.drive({asked, 0.0, true}, 1.0, {});
                        EXPECT_EQ(plant.state().pose.x, stood.x);
                    }
        }

        TEST(Plant, KeepsToTheLimitsOfTheCar)
        {
            const Vehicle vehicle;
            Plant plant(vehicle, {}, {}, 0.0, 0.005);
            plant.drive({5.0, 3.0, false}, 1.0, {});
            EXPECT_NEAR(plant.state().speed, vehicle.maxAcceleration, 1e-9);
            EXPECT_NEAR(plant.state().steering, vehicle.maxSteeringRate, 1e-9);
            plant.drive({0.0, 3.0, false}, 2.0, {});
            EXPECT_NEAR(plant.state().steering, vehicle.maxSteeringAngle, 1e-9);
        }
    }  // namespace
}  // namespace parking::test

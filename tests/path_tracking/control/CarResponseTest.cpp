#include "path_tracking/control/CarResponse.h"

#include "path_tracking/simulation/Plant.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace parking::test
{
    namespace
    {
        constexpr double PERIOD = 0.1;

        /** A car that speeds up and slows down, and turns its wheels to and fro; what a CarResponse learns from it. */
        class Swerving
        {
        public:
            explicit Swerving(const Disturbances &disturbances, const ResponseParameters &known = {})
              : plant_(Vehicle(), disturbances, {}, 0.0, 0.005),
                response(Vehicle(), known, PERIOD, 0.0)
            {
                response.start(plant_.measure());
            }

            /** Another period, after which the response knows what there is to know and has been given a command. */
            void go()
            {
                const double t = time_;
                time_ += PERIOD;
                if (t > 0.0)
                    response.take(plant_.measure());
                const double wave = std::fmod(t, 6.0);
                Command command;
                command.acceleration = wave < 2.0 ? 0.8 : wave < 3.0 ? 0.0 : -0.8;
                if (wave >= 3.0 && plant_.state().speed < 0.3)
                    command.acceleration = 0.0;
                command.steering = 0.25 * std::sin(1.3 * t);
                foretold = response.ahead();
                response.give(command);
                ages.push_back(foretold.pose);
                plant_.drive(command, PERIOD, {});
            }

            double time() const
            {
                return time_;
            }
            Plant::State car() const
            {
                return plant_.state();
            }

        private:
            Plant plant_;
            double time_{0.0};

        public:
            CarResponse response;
            CarState foretold;
            std::vector<Pose> ages;
        };

        TEST(CarResponse, LearnsHowLateCommandsAreAndForetellsTheCar)
        {
            for (const double delay : {0.0, 0.1, 0.3, 0.5})
                for (const double lag : {0.0, 0.1})
                {
                    SCOPED_TRACE("delay " + std::to_string(delay) + ", lag " + std::to_string(lag));
                    Disturbances odds;
                    odds.delay = delay;
                    odds.steeringLag = lag;
                    Swerving drive(odds);
                    const auto late = static_cast<std::size_t>(std::lround(delay / PERIOD));
                    while (drive.time() < 20.0)
                    {
                        const Pose before = drive.car().pose;  // of the period that begins
                        drive.go();
                        const std::size_t count = drive.ages.size() - 1;
                        if (drive.time() < 8.0 || count < late)
                            continue;
                        EXPECT_NEAR(drive.response.delay(), delay, 1e-9) << drive.time();
                        // What was foretold so long ago is where the car is.
                        EXPECT_LT(positionDistance(drive.ages[count - late], before), 0.01) << drive.time();
                    }
                }
        }

        TEST(CarResponse, LearnsHowWeakTheBrakeIs)
        {
            for (const double loss : {0.0, 0.2, 0.4})
            {
                Disturbances odds;
                odds.brakeLoss = loss;
                Swerving drive(odds);
                while (drive.time() < 12.0)
                    drive.go();
                EXPECT_NEAR(drive.response.brakeScale(), 1.0 - loss, 0.02);
            }
        }

        TEST(CarResponse, SeesWheelsThatStickAndNoOthers)
        {
            for (const double delay : {0.0, 0.3})
                for (const double lag : {0.0, 0.1, 0.3})
                    for (const bool breaks : {false, true})
                    {
                        SCOPED_TRACE("delay " + std::to_string(delay) + ", lag " + std::to_string(lag));
                        Disturbances odds;
                        odds.delay = delay;
                        odds.steeringLag = lag;
                        if (breaks)
                            odds.stuck = {{10.0, 12.0}};
                        Swerving drive(odds);
                        double seen = -1.0;
                        while (drive.time() < 20.0)
                        {
                            drive.go();
                            if (drive.response.wheelsStick() && seen < 0.0)
                                seen = drive.time();
                        }
                        if (breaks)
                        {
                            EXPECT_GT(seen, 10.0);
                            EXPECT_LT(seen, 10.8);
                        }
                        else
                        {
                            EXPECT_EQ(seen, -1.0);
                        }
                        EXPECT_FALSE(drive.response.wheelsStick()) << "they move again";
                    }
        }

        TEST(CarResponse, SeesWheelsThatStickFromTheBegin)
        {
            // Nothing has been learnt of the delay then, and nothing will be: any that is thought of must be over.
            for (const double delay : {0.0, 0.3, 0.6})
            {
                SCOPED_TRACE("delay " + std::to_string(delay));
                Disturbances odds;
                odds.delay = delay;
                odds.stuck = {{0.0, 2.0}};
                Swerving drive(odds);
                while (drive.time() < 1.2 && !drive.response.wheelsStick())
                    drive.go();
                EXPECT_GT(drive.time(), 0.1 * CommandDelay::MAX_PERIODS);
                EXPECT_LT(drive.time(), 1.2);
            }
        }

        TEST(CarResponse, KnowsACarAgain)
        {
            Disturbances odds;
            odds.delay = 0.6;
            odds.steeringLag = 0.1;
            odds.brakeLoss = 0.2;
            Swerving first(odds);
            while (first.time() < 12.0)
                first.go();
            const ResponseParameters learnt = first.response.learnt();
            EXPECT_NO_THROW(learnt.validate());
            EXPECT_TRUE(learnt.delayIsSure);
            EXPECT_NEAR(learnt.brakeScale, 0.8, 0.02);
            EXPECT_NEAR(learnt.steeringLag, 0.1, 0.03);

            Swerving second(odds, learnt);
            EXPECT_NEAR(second.response.delay(), 0.6, 1e-9);
            EXPECT_EQ(second.response.brakeScale(), learnt.brakeScale);
            while (second.time() < 12.0)
            {
                second.go();
                EXPECT_NEAR(second.response.delay(), 0.6, 1e-9);
            }
        }
    }  // namespace
}  // namespace parking::test

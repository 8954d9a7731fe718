#include "parking_geometry/Error.h"
#include "path_tracking/trajectory/StopAndSteer.h"
#include "path_tracking/trajectory/TimedMotion.h"
#include "tests/path_tracking/TestPaths.h"
#include "tests/path_tracking/trajectory/TrajectoryReferee.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace parking
{
    namespace
    {
        TEST(TimedMotion, AnArcAtConstantSpeedEndsWhereThePathDoes)
        {
            const Vehicle car;
            const TimedMotion motion{{1.0, 2.0, 0.5}, {{0.0, -1.5, 0.4}, {3.0, -1.5, 0.4}}};
            const Pose expected = advance(motion.start, car.curvature(0.4), -4.5);
            EXPECT_TRUE(isSamePose(endOf(motion, car), expected, 1e-8));
        }

        TEST(TimedMotion, TpcapCostIsWhatFineSumsGive)
        {
            const TimedMotion motion{{},
                                     {{0.0, 0.0, 0.0},
                                      {1.0, 0.0, 0.4},
                                      {2.5, 1.5, -0.2},
                                      {4.0, 0.0, 0.1},
                                      {5.0, -1.0, 0.3},
                                      {6.0, 0.0, 0.3}}};
            double effort = 0.0, steering = 0.0;
            constexpr int PARTS = 20000;
            for (std::size_t i = 1; i < motion.knots.size(); ++i)
            {
                const MotionKnot &a = motion.knots[i - 1], &b = motion.knots[i];
                const double h = b.t - a.t, acceleration = (b.v - a.v) / h, rate = (b.steering - a.steering) / h;
                for (int k = 0; k < PARTS; ++k)
                {
                    const double t = (k + 0.5) / PARTS, v = a.v + t * (b.v - a.v);
                    const double angle = a.steering + t * (b.steering - a.steering);
                    effort += h / PARTS * (acceleration * acceleration + v * v * rate * rate);
                    steering += h / PARTS * angle * angle;
                }
            }
            const TpcapCost cost = tpcapCost(motion);
            EXPECT_DOUBLE_EQ(cost.time, 6.0);
            EXPECT_NEAR(cost.controlEffort, effort, 1e-6);
            EXPECT_NEAR(cost.steeringIntegral, steering, 1e-6);
            EXPECT_EQ(cost.gearChanges, 1U);
            EXPECT_NEAR(cost.total(), 600.0 + 10.0 * effort + 10.0 * steering + 5.0, 1e-4);
        }

        TEST(TimedMotion, SamplesHoldEveryKnotAndAreNoFartherApartThanAsked)
        {
            const Vehicle car;
            const TimedMotion motion{{}, {{0.0, 0.0, 0.0}, {0.73, 0.7, 0.3}, {1.9, 0.0, 0.0}}};
            const Trajectory samples = sample(motion, car, 0.1);
            EXPECT_EQ(test::judge(samples, car, {}).fault, "");
            std::size_t found = 0;
            for (std::size_t i = 0; i < samples.size(); ++i)
            {
                for (const MotionKnot &knot : motion.knots)
                    found += std::abs(samples[i].t - knot.t) < 1e-12 ? 1 : 0;
                if (i > 0)
                {
                    EXPECT_LE(samples[i].t - samples[i - 1].t, 0.1 + 1e-12);
                }
            }
            EXPECT_EQ(found, motion.knots.size());
        }

        TEST(Trajectory, CsvReadsBackExactlyAndIsWrittenWholeOrNotAtAll)
        {
            const Trajectory example{{0.0, 1.0 / 3.0, -2e-17, 3.0, 0.0, 0.8, -0.75, 0.5},
                                     {0.1, 4.48e9 + 0.125, 1e300, -3.0, -2.5, -1.0, 0.1, -0.5}};
            const auto folder = std::filesystem::temp_directory_path() / "parking_trajectory_test";
            std::filesystem::create_directories(folder);
            writeCsv(example, (folder / "drive.csv").string());
            std::ifstream stream(folder / "drive.csv");
            std::string line;
            std::getline(stream, line);
            EXPECT_EQ(line, "t,x,y,yaw,v,a,steering,steering_rate");
            for (const TrajectoryPoint &p : example)
            {
                ASSERT_TRUE(std::getline(stream, line));
                std::istringstream cells(line);
                for (const double value : {p.t, p.x, p.y, p.yaw, p.v, p.acceleration, p.steering, p.steeringRate})
                {
                    std::string cell;
                    std::getline(cells, cell, ',');
                    EXPECT_EQ(std::strtod(cell.c_str(), nullptr), value);
                }
            }
            EXPECT_FALSE(std::getline(stream, line));
            EXPECT_THROW(writeCsv(example, (folder / "missing" / "drive.csv").string()), Error);
            EXPECT_FALSE(std::filesystem::exists(folder / "missing"));
            std::filesystem::remove_all(folder);
        }

        TEST(StopAndSteer, AStraightLineTakesWhatFullAccelerationAllows)
        {
            const Vehicle car;
            for (const double length : {0.01, 1.0, 4.0, 6.25, 30.0})
            {
                const double top = std::min(car.maxSpeed, std::sqrt(length * car.maxAcceleration));
                const double expected = length / top + top / car.maxAcceleration;
                for (const double sign : {1.0, -1.0})
                    EXPECT_NEAR(stopAndSteer({{}, {{0.0, sign * length}}}, car, 0.0, 0.0).duration(), expected, 1e-9);
            }
        }

        TEST(StopAndSteer, StandsWhileTheWheelsTurn)
        {
            const Vehicle car;
            const double angle = 0.5;
            const Path path{{}, {{0.0, 4.0}, {car.curvature(angle), 4.0}}};
            EXPECT_NEAR(stopAndSteer(path, car, 0.0, 0.0).duration(), 4.0 + 1.0 + 4.0 + 1.0, 1e-9);
            EXPECT_NEAR(stopAndSteer(path, car, std::nullopt, std::nullopt).duration(), 4.0 + 1.0 + 4.0, 1e-9);
        }

        TEST(StopAndSteer, DrivesEveryKindOfPathToItsEnd)
        {
            const Vehicle car;
            for (std::uint64_t seed = 1; seed <= 30; ++seed)
                for (const Path &path : {test::randomReedsShepp(seed, 15.0), test::randomSmooth(seed, 15.0)})
                {
                    const TimedMotion motion = stopAndSteer(path, car, 0.0, 0.0);
                    const test::Verdict verdict = test::judge(sample(motion, car, 0.05), car, {});
                    EXPECT_EQ(verdict.fault, "") << seed;
                    EXPECT_TRUE(isSamePose(verdict.end, path.end(), 2e-3)) << seed;
                }
        }
    }  // namespace
}  // namespace parking

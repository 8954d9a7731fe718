#include "path_tracking/trajectory/JerkLimit.h"

#include "parking_geometry/Error.h"
#include "path_tracking/trajectory/StopAndSteer.h"
#include "path_tracking/trajectory/TrajectoryOptimizer.h"
#include "tests/path_tracking/TestPaths.h"
#include "tests/path_tracking/trajectory/TrajectoryReferee.h"
#include "tests/path_tracking/trajectory/TrajectoryWorlds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace parking
{
    namespace
    {
        /** The greatest change of the acceleration by time, from the middle of one interval to that of the next, and
            from and to none at the ends of standstills. */
        double greatestJerk(const TimedMotion &motion)
        {
            double greatest = 0.0, before = 0.0, middle = motion.knots.front().t;
            for (std::size_t k = 1; k < motion.knots.size(); ++k)
            {
                const MotionKnot &a = motion.knots[k - 1], &b = motion.knots[k];
                const double now = (b.v - a.v) / (b.t - a.t), at = 0.5 * (a.t + b.t);
                greatest = std::max(greatest, std::abs(now - before) / (at - middle));
                before = now;
                middle = at;
            }
            return std::max(greatest, std::abs(before) / (motion.knots.back().t - middle));
        }

        double greatestAcceleration(const TimedMotion &motion)
        {
            double greatest = 0.0;
            for (std::size_t k = 1; k < motion.knots.size(); ++k)
                greatest = std::max(greatest, std::abs((motion.knots[k].v - motion.knots[k - 1].v) /
                                                       (motion.knots[k].t - motion.knots[k - 1].t)));
            return greatest;
        }

        double greatestSteeringRate(const TimedMotion &motion)
        {
            double greatest = 0.0;
            for (std::size_t k = 1; k < motion.knots.size(); ++k)
                greatest = std::max(greatest, std::abs((motion.knots[k].steering - motion.knots[k - 1].steering) /
                                                       (motion.knots[k].t - motion.knots[k - 1].t)));
            return greatest;
        }

        TEST(JerkLimit, AStraightLineTakesWhatItsSevenPhasesTake)
        {
            // Rest to rest: jerk up, full acceleration, jerk down, full speed, and the same in reverse order.
            Vehicle car;
            car.maxSpeed = 2.0;
            car.maxAcceleration = 1.0;
            for (const double jerk : {0.5, 1.0, 3.0})
            {
                const double length = 20.0;
                const TimedMotion motion = stopAndSteer({{}, {{0.0, length}}}, car, 0.0, 0.0);
                const TimedMotion limited = withJerkLimit(motion, car, jerk);
                // Each ramp takes v / a + a / j, and half of its time at full speed is lost.
                const double ramp = car.maxSpeed / car.maxAcceleration + car.maxAcceleration / jerk;
                EXPECT_NEAR(limited.duration(), length / car.maxSpeed + ramp, 0.02) << jerk;
                EXPECT_NEAR(endOf(limited, car).x, length, 1e-6) << jerk;
            }
            // Where the acceleration is never reached: four phases of jerk, 32 length = jerk time^3.
            const double jerk = 0.5, length = 0.1;
            const TimedMotion shortOne = withJerkLimit(stopAndSteer({{}, {{0.0, length}}}, car, 0.0, 0.0), car, jerk);
            EXPECT_NEAR(shortOne.duration(), std::cbrt(32.0 * length / jerk), 0.03);
        }

        TEST(JerkLimit, HoldsEveryLimitGoesTheSameWayAndIsNeverQuicker)
        {
            for (std::uint64_t seed = 1; seed <= 40; ++seed)
            {
                Vehicle car;
                test::Random random(seed);
                car.maxSpeed = random.between(0.8, 3.0);
                car.maxAcceleration = random.between(0.4, 2.0);
                car.maxSteeringRate = random.between(0.3, 1.0);
                const double jerk = std::pow(10.0, random.between(-1.0, 1.5));
                const Path path = seed % 2 == 0 ? test::randomReedsShepp(seed, 14.0) : test::randomSmooth(seed, 14.0);
                TimedMotion motion = stopAndSteer(path, car, 0.0, 0.0);
                if (seed % 3 == 0)
                    motion = TrajectoryOptimizer(test::checkerOf({}, car)).optimize(path).motion;
                const TimedMotion limited = withJerkLimit(motion, car, jerk);
                EXPECT_LE(greatestJerk(limited), jerk * (1.0 + 1e-6)) << seed;
                EXPECT_LE(greatestAcceleration(limited), car.maxAcceleration * (1.0 + 1e-6)) << seed;
                EXPECT_LE(greatestSteeringRate(limited), car.maxSteeringRate * (1.0 + 1e-6)) << seed;
                EXPECT_GE(limited.duration(), motion.duration()) << seed;
                EXPECT_TRUE(isSamePose(endOf(limited, car), endOf(motion, car), 5e-4)) << seed;
                EXPECT_EQ(limited.knots.back().steering, motion.knots.back().steering) << seed;
                EXPECT_EQ(limited.start.x, motion.start.x) << seed;
                EXPECT_LE(withJerkLimit(motion, car, 2.0 * jerk).duration(), limited.duration() * (1.0 + 1e-3)) << seed;
                // With a jerk that no longer matters it takes as long as before, but for a step at each stop.
                EXPECT_LE(withJerkLimit(motion, car, 1e4).duration(),
                          1.01 * motion.duration() + 0.05 * static_cast<double>(path.pieces.size() + 1))
                    << seed;
            }
        }

        TEST(JerkLimit, IsNoFasterThanTheCarAndNeverDrivesBack)
        {
            // Ways that are short for their steps, where straight lines between knots leave the most.
            for (std::uint64_t seed = 1; seed <= 300; ++seed)
            {
                test::Random random(seed);
                Vehicle car;
                car.maxSpeed = random.between(0.2, 4.0);
                car.maxAcceleration = random.between(0.2, 4.0);
                const double length = std::exp(random.between(-4.0, 3.0));
                const double jerk = std::exp(random.between(-2.0, 5.0)), step = random.between(0.005, 0.1);
                const TimedMotion motion = stopAndSteer({{}, {{0.0, length}}}, car, 0.0, 0.0);
                double top = 0.0;
                for (const MotionKnot &knot : motion.knots)
                    top = std::max(top, knot.v);
                const TimedMotion limited = withJerkLimit(motion, car, jerk, step);
                for (const MotionKnot &knot : limited.knots)
                {
                    EXPECT_GE(knot.v, 0.0) << seed;
                    EXPECT_LE(knot.v, top * (1.0 + 1e-12)) << seed;
                }
                EXPECT_LE(greatestJerk(limited), jerk) << seed;
                EXPECT_LE(greatestAcceleration(limited), car.maxAcceleration) << seed;
                EXPECT_NEAR(endOf(limited, car).x, length, 1e-9) << seed;
            }
        }

        TEST(JerkLimit, WheelsThatTurnWhileTheCarHardlyMovesDoNotSlowItDown)
        {
            // A twentieth of a radian over ten micrometres: as if the car stood.
            const Vehicle car;
            const double fast = car.maxAcceleration;
            TimedMotion motion;
            motion.knots = {{0.0, 0.0, 0.0}, {0.1, 2e-4, 0.05}, {1.1, fast, 0.05}, {2.1, 0.0, 0.05}};
            const TimedMotion limited = withJerkLimit(motion, car, 5.0);
            EXPECT_LE(limited.duration(), 2.1 + 2.0 * car.maxAcceleration / 5.0);
            EXPECT_LE(greatestJerk(limited), 5.0 * (1.0 + 1e-6));
            EXPECT_TRUE(isSamePose(endOf(limited, car), endOf(motion, car), 2e-4));
        }

        TEST(JerkLimit, OfTheOptimiserTouchesNothing)
        {
            for (std::uint64_t seed = 1; seed <= 8; ++seed)
            {
                const Vehicle car;
                const Path path = test::randomReedsShepp(seed, 14.0);
                const std::vector<Polygon> obstacles = test::obstaclesBeside(path, car, seed, 60);
                const FootprintChecker checker = test::checkerOf(obstacles, car);
                TrajectoryOptions options;
                const double before = TrajectoryOptimizer(checker, options).optimize(path).motion.duration();
                options.maxJerk = 1.0;
                const OptimizedTrajectory found = TrajectoryOptimizer(checker, options).optimize(path);
                EXPECT_GE(found.motion.duration(), before) << seed;
                EXPECT_LE(greatestJerk(found.motion), 1.0 + 1e-6) << seed;
                const test::Verdict verdict = test::judge(sample(found.motion, car, 0.05), car, obstacles);
                EXPECT_EQ(verdict.fault, "") << seed;
                EXPECT_TRUE(isSamePose(verdict.end, path.end(), 5e-3)) << seed;
            }
        }

        TEST(JerkLimit, RefusesWhatMakesNoSense)
        {
            const Vehicle car;
            const TimedMotion motion = stopAndSteer({{}, {{0.0, 5.0}}}, car, 0.0, 0.0);
            for (const double jerk : {0.0, -1.0, std::nan(""), 1e-12})
                EXPECT_THROW(withJerkLimit(motion, car, jerk), Error) << jerk;
            EXPECT_THROW(withJerkLimit(motion, car, 1.0, 0.0), Error);
            EXPECT_THROW(withJerkLimit({}, car, 1.0), Error);
            EXPECT_THROW(withJerkLimit(restOf(motion, car, 1.0), car, 1.0), Error);
            const FootprintChecker checker = test::checkerOf({});
            for (const double jerk : {-1.0, 1e-3, 1e5, std::nan("")})
            {
                TrajectoryOptions options;
                options.maxJerk = jerk;
                EXPECT_THROW(TrajectoryOptimizer(checker, options), Error) << jerk;
            }
        }
    }  // namespace
}  // namespace parking

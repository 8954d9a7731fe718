#include "path_tracking/trajectory/Splice.h"
#include "path_tracking/trajectory/TrajectoryOptimizer.h"
#include "tests/path_tracking/TestPaths.h"
#include "tests/path_tracking/trajectory/TrajectoryWorlds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace parking
{
    namespace
    {
        constexpr double DECELERATION = 0.8;  // m/s^2

        TimedMotion randomMotion(std::uint64_t seed)
        {
            const FootprintChecker checker = test::checkerOf({});
            return TrajectoryOptimizer(checker).optimize(test::randomReedsShepp(seed, 12.0)).motion;
        }

        /** Poses by driven length, a centimetre apart. */
        std::vector<Pose> placesOf(const TimedMotion &motion)
        {
            std::vector<Pose> places{motion.start};
            double s = 0.0;
            visitParts(motion, Vehicle(), 0.001, 0.001,
                       [&](const MotionPart &part)
                       {
                           s += std::abs(part.length());
                           while (s >= 0.01 * static_cast<double>(places.size()))
                               places.push_back(part.after);
                           return true;
                       });
            return places;
        }

        TEST(Splice, BeginsAreThoseOfTheMotion)
        {
            const TimedMotion motion = randomMotion(1);
            for (double time = -1.0; time < motion.duration() + 1.0; time += 0.37)
            {
                const TimedMotion begin = beginOf(motion, time);
                EXPECT_NEAR(begin.duration(), std::clamp(time, 0.0, motion.duration()), 1e-9);
                const std::vector<Pose> all = placesOf(motion), some = placesOf(begin);
                ASSERT_LE(some.size(), all.size());
                for (std::size_t i = 0; i < some.size(); ++i)
                    EXPECT_TRUE(isSamePose(some[i], all[i], 2e-3)) << time << " " << i;
            }
        }

        TEST(Splice, StopsAlongThePathOfTheMotionWithinTheLimits)
        {
            for (std::uint64_t seed = 1; seed <= 20; ++seed)
            {
                const TimedMotion motion = randomMotion(seed);
                const std::vector<Pose> places = placesOf(motion);
                for (double share = 0.05; share < 1.0; share += 0.1)
                {
                    const double time = share * motion.duration();
                    const TimedMotion stop = stopAfter(motion, Vehicle(), time, DECELERATION);
                    EXPECT_EQ(stop.knots.back().v, 0.0);
                    const double speed = std::abs(beginOf(motion, time).knots.back().v);
                    EXPECT_LE(stop.duration(), time + speed / DECELERATION + 1e-6);
                    const std::vector<Pose> stopping = placesOf(stop);
                    ASSERT_LE(stopping.size(), places.size());
                    for (std::size_t i = 0; i < stopping.size(); ++i)
                        EXPECT_TRUE(isSamePose(stopping[i], places[i], 4e-3)) << seed << " " << share << " " << i;
                    for (std::size_t i = 1; i < stop.knots.size(); ++i)
                    {
                        const MotionKnot &a = stop.knots[i - 1], &b = stop.knots[i];
                        EXPECT_LE(std::abs(b.v - a.v), 1.0001 * Vehicle().maxAcceleration * (b.t - a.t) + 1e-9);
                        EXPECT_LE(std::abs(b.steering - a.steering),
                                  1.0001 * Vehicle().maxSteeringRate * (b.t - a.t) + 1e-9);
                    }
                }
            }
        }

        TEST(Splice, JoinsInTime)
        {
            const TimedMotion motion = randomMotion(2);
            const TimedMotion begin = beginOf(motion, 0.4 * motion.duration());
            TimedMotion rest{endOf(begin, Vehicle()), {begin.knots.back()}};
            for (const MotionKnot &knot : motion.knots)
                if (knot.t > begin.knots.back().t)
                    rest.knots.push_back(knot);
            for (MotionKnot &knot : rest.knots)
                knot.t += 17.0;  // its clock does not matter
            const TimedMotion whole = joined(begin, rest);
            EXPECT_NEAR(whole.duration(), motion.duration(), 1e-9);
            EXPECT_TRUE(isSamePose(endOf(whole, Vehicle()), endOf(motion, Vehicle()), 1e-6));
        }
    }  // namespace
}  // namespace parking

#include "path_tracking/reference/MotionReference.h"

#include "parking_geometry/Error.h"
#include "path_tracking/trajectory/StopAndSteer.h"
#include "tests/path_tracking/TestPaths.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace parking::test
{
    namespace
    {
        /** Rolls while its wheels turn, stands, comes back, and turns its wheels straight at the end. */
        TimedMotion example()
        {
            return {{1.0, 2.0, 3.0},
                    {{0.0, 0.0, 0.0},
                     {0.5, 0.0, 0.2},
                     {2.0, 1.5, 0.7},
                     {4.0, 1.0, -0.2},
                     {5.0, 0.0, -0.1},
                     {5.5, 0.0, 0.1},
                     {7.0, -1.0, 0.5},
                     {8.5, 0.0, 0.4},
                     {9.3, 0.0, 0.0}}};
        }

        TEST(MotionReference, HasALegBetweenStandstills)
        {
            const MotionReference reference(example(), Vehicle());
            ASSERT_EQ(reference.legs().size(), 2u);
            EXPECT_DOUBLE_EQ(reference.duration(), 9.3);
            EXPECT_DOUBLE_EQ(reference.legs()[0].standstill, 0.5);
            EXPECT_DOUBLE_EQ(reference.legs()[1].standstill, 0.5);
            EXPECT_NEAR(reference.finalStandstill(), 0.8, 1e-12);
            EXPECT_EQ(reference.legs()[0].direction, 1);
            EXPECT_EQ(reference.legs()[1].direction, -1);
            EXPECT_DOUBLE_EQ(reference.legs()[1].steering, 0.1);
            EXPECT_DOUBLE_EQ(reference.finalSteering(), 0.0);
            EXPECT_NEAR(reference.legs()[0].endLength, 1.125 + 2.5 + 0.5, 1e-12);
            EXPECT_NEAR(reference.length(), 4.125 + 1.5, 1e-12);
        }

        TEST(MotionReference, IsAtEveryTimeWhereTheMotionIs)
        {
            const Vehicle car;
            for (std::uint64_t seed = 0; seed < 10; ++seed)
            {
                const TimedMotion motion =
                    seed == 0 ? example() : stopAndSteer(randomSmooth(seed, 20.0), car, 0.0, 0.0);
                const MotionReference reference(motion, car);
                EXPECT_NEAR(reference.duration(), motion.duration(), 1e-9);
                double begin = reference.legs()[0].standstill;
                std::size_t leg = 0;
                visitParts(motion, car, 0.007, 0.05,
                           [&](const MotionPart &part)
                           {
                               if (part.from.v == 0.0 && part.to.v == 0.0)
                                   return true;
                               while (part.begin >= begin + reference.legs()[leg].duration - 1e-9)
                               {
                                   begin += reference.legs()[leg].duration;
                                   begin += reference.legs()[++leg].standstill;
                               }
                               const TimedState at = reference.at(leg, part.begin - begin);
                               EXPECT_TRUE(isSamePose(at.pose, part.before, 2e-4)) << part.begin;
                               EXPECT_NEAR(at.speed, std::abs(part.from.v), 1e-6);
                               EXPECT_NEAR(at.steering, part.from.steering, 1e-6);
                               EXPECT_NEAR(reference.steering(leg, at.s), at.steering, 0.02);
                               const Pose beside = compose(at.pose, {0.0, 0.1, 0.05});
                               const PathProjection place = reference.project(leg, beside, at.s - 0.5, at.s + 0.5);
                               EXPECT_NEAR(place.s, at.s, 0.03);
                               EXPECT_NEAR(place.lateral, 0.1, 2e-3);
                               EXPECT_NEAR(place.distance, 0.1, 2e-3);
                               return true;
                           });
                EXPECT_TRUE(isSamePose(reference.end(), endOf(motion, car), 1e-6));
            }
        }

        TEST(MotionReference, RefusesWhatNoCarCanDo)
        {
            const auto refused = [](const std::function<void(TimedMotion &)> &spoil)
            {
                TimedMotion motion = example();
                spoil(motion);
                EXPECT_THROW(MotionReference(motion, Vehicle()), Error);
            };
            EXPECT_NO_THROW(MotionReference(example(), Vehicle()));
            refused([](TimedMotion &m) { m.knots.clear(); });
            refused([](TimedMotion &m) { m.start.x = std::nan(""); });
            refused([](TimedMotion &m) { m.knots[3].v = std::numeric_limits<double>::infinity(); });
            refused([](TimedMotion &m) { m.knots.pop_back(), m.knots.pop_back(); });    // ends while it rolls
            refused([](TimedMotion &m) { m.knots[2].v = 1.6; });                        // acceleration
            refused([](TimedMotion &m) { m.knots[2].steering = 0.76; });                // angle
            refused([](TimedMotion &m) { m.knots[1].steering = 0.3; });                 // rate
            refused([](TimedMotion &m) { m.knots[4].t = m.knots[3].t; });               // time
            refused([](TimedMotion &m) { m.knots[4].v = -0.1, m.knots[5].v = -0.1; });  // no rest between
            refused(
                [](TimedMotion &m)
                {
                    for (MotionKnot &knot : m.knots)
                        knot.v = 0.0;
                });  // never drives
            Vehicle slow;
            slow.maxSpeed = 1.0;
            EXPECT_THROW(MotionReference(example(), slow), Error);
        }
    }  // namespace
}  // namespace parking::test

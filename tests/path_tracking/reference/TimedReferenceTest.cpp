#include "path_tracking/reference/TimedReference.h"

#include "path_tracking/trajectory/StopAndSteer.h"
#include "tests/path_tracking/TestPaths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace parking::test
{
    namespace
    {
        const double LOCK = Vehicle().maxSteeringAngle, RATE = Vehicle().maxSteeringRate;

        TimedReference referenceOf(const Path &path, const SpeedLimits &limits = {}, double initialSteering = 0.0)
        {
            return {ReferencePath(path, Vehicle()), limits, initialSteering};
        }

        /** Calls \e visit with every \e step seconds of a leg and its end. */
        void visitLeg(const TimedReference &reference, std::size_t leg, double step,
                      const std::function<void(double, const TimedState &)> &visit)
        {
            const double duration = reference.legs()[leg].duration;
            for (double t = 0.0; t < duration; t += step)
                visit(t, reference.at(leg, t));
            visit(duration, reference.at(leg, duration));
        }

        TEST(TimedReference, TakesTheTimeOfAStraightLine)
        {
            // Long enough to cruise: 2.5 s and 3.125 m each to speed up and to brake.
            EXPECT_NEAR(referenceOf(arcs({}, {{0.0, 10.0}})).duration(), 5.0 + (10.0 - 6.25) / 2.5, 1e-9);
            EXPECT_NEAR(referenceOf(arcs({}, {{0.0, 4.0}})).duration(), 4.0, 1e-9);
            EXPECT_NEAR(referenceOf(arcs({}, {{0.0, -4.0}, {0.0, 1.0}})).duration(), 6.0, 1e-9);
        }

        TEST(TimedReference, StandsToSteer)
        {
            const TimedReference reference = referenceOf(arcs({}, {{1.0, 2.0}, {-1.0, 2.0}}));
            ASSERT_EQ(reference.legs().size(), 2u);
            EXPECT_NEAR(reference.legs()[0].standstill, LOCK / RATE, 1e-12);
            EXPECT_NEAR(reference.legs()[1].standstill, 2.0 * LOCK / RATE, 1e-12);
            EXPECT_NEAR(referenceOf(arcs({}, {{1.0, 2.0}}), {}, LOCK).legs()[0].standstill, 0.0, 1e-12);
        }

        /** No number and no difference beyond the limits, at rest at both ends of each leg. */
        void expectWithinLimits(const TimedReference &reference, const SpeedLimits &limits)
        {
            constexpr double EPS = 1e-6;
            for (std::size_t leg = 0; leg < reference.legs().size(); ++leg)
            {
                EXPECT_EQ(reference.at(leg, -1.0).speed, 0.0);
                EXPECT_NEAR(reference.at(leg, 1e9).s, reference.legs()[leg].endLength, 1e-12);
                EXPECT_NEAR(reference.at(leg, 1e9).speed, 0.0, 1e-12);
                double before = 0.0;
                TimedState last = reference.at(leg, 0.0);
                visitLeg(reference, leg, 0.02,
                         [&](double t, const TimedState &state)
                         {
                             const double dt = t - before;
                             EXPECT_LE(state.speed, limits.speed + EPS);
                             EXPECT_LE(std::abs(state.steering), LOCK + EPS);
                             EXPECT_LE(state.speed * state.speed * std::abs(Vehicle().curvature(state.steering)),
                                       limits.lateralAcceleration + EPS);
                             EXPECT_LE(std::abs(state.speed - last.speed), limits.acceleration * dt + EPS);
                             EXPECT_LE(std::abs(state.steering - last.steering), limits.steeringRate * dt + EPS);
                             EXPECT_NEAR(state.s - last.s, 0.5 * (state.speed + last.speed) * dt,
                                         0.5 * limits.acceleration * dt * dt + EPS);
                             EXPECT_LE(positionDistance(state.pose, last.pose), state.s - last.s + EPS);
                             before = t;
                             last = state;
                         });
            }
        }

        TEST(TimedReference, ObeysTheLimitsEverywhere)
        {
            for (std::uint64_t seed = 0; seed < 25; ++seed)
                for (const Path &path :
                     {randomReedsShepp(seed, 30.0), randomLattice(seed, 30.0), randomSmooth(seed, 30.0)})
                {
                    const TimedReference reference = referenceOf(path);
                    expectWithinLimits(reference, SpeedLimits());
                    const SpeedLimits limits{1.3, 0.4, 0.2, 0.3};
                    const TimedReference slow = referenceOf(path, limits, 0.3);
                    expectWithinLimits(slow, limits);
                    EXPECT_GT(slow.duration(), reference.duration());
                }
        }

        TEST(TimedReference, SpeedAndSteeringLeadWhereThePathGoes)
        {
            for (std::uint64_t seed = 0; seed < 10; ++seed)
                for (const Path &path : {randomReedsShepp(seed, 30.0), randomSmooth(seed, 30.0)})
                {
                    const TimedReference reference = referenceOf(path);
                    Pose car = path.start;
                    for (std::size_t leg = 0; leg < reference.legs().size(); ++leg)
                    {
                        TimedState last = reference.at(leg, 0.0);
                        visitLeg(
                            reference, leg, 0.002,
                            [&](double, const TimedState &state)
                            {
                                const double curvature = Vehicle().curvature(0.5 * (last.steering + state.steering));
                                car = advance(car, curvature, reference.legs()[leg].direction * (state.s - last.s));
                                EXPECT_LE(positionDistance(car, state.pose), 0.02);
                                last = state;
                            });
                    }
                }
        }

        TEST(TimedReference, LiesOnThePath)
        {
            for (std::uint64_t seed = 0; seed < 10; ++seed)
            {
                const ReferencePath path(randomSmooth(seed, 20.0), Vehicle());
                const TimedReference reference(path, {});
                for (std::size_t leg = 0; leg < reference.legs().size(); ++leg)
                    visitLeg(reference, leg, 0.03,
                             [&](double, const TimedState &state)
                             {
                                 EXPECT_TRUE(isSamePose(state.pose, path.pose(leg, state.s), 2e-4));
                                 EXPECT_NEAR(state.steering, path.steering(leg, state.s), 0.02);
                                 EXPECT_NEAR(reference.steering(leg, state.s), path.steering(leg, state.s), 1e-9);
                             });
                EXPECT_TRUE(isSamePose(reference.end(), path.end(), 1e-9));
            }
        }

        /** Least duration of a leg, by dynamic programming over the squared speed. */
        double minDuration(const ReferencePath &path, std::size_t leg, const SpeedLimits &limits)
        {
            constexpr double STEP = 0.01;      // metres
            constexpr int CELLS_PER_STEP = 8;  // of squared speed that full acceleration passes in one step
            const double begin = path.legs()[leg].beginLength, length = path.legs()[leg].length();
            const int steps = std::max(2, static_cast<int>(std::lround(length / STEP)));
            const double h = length / steps, cell = 2.0 * limits.acceleration * h / CELLS_PER_STEP;
            const int cells = static_cast<int>(std::floor(limits.speed * limits.speed / cell)) + 1;
            const auto steering = [&](double s)
            {
                return path.steering(leg, begin + std::clamp(s, 0.0, length));
            };
            const auto cap = [&](double s)
            {
                double speed = limits.speed;
                // Slopes on both sides: a place where a ramp ends belongs to the ramp, too.
                for (const double side : {-1e-4, 1e-4})
                    if (const double slope = std::abs(steering(s + side) - steering(s)) / 1e-4; slope > 0.0)
                        speed = std::min(speed, limits.steeringRate / slope);
                const double curvature = std::abs(Vehicle().curvature(steering(s)));
                return std::min(speed * speed, limits.lateralAcceleration / std::max(curvature, 1e-9));
            };
            const double never = std::numeric_limits<double>::infinity();
            std::vector<double> time(static_cast<std::size_t>(cells), never), next = time;
            time[0] = 0.0;
            for (int i = 1; i <= steps; ++i)
            {
                std::fill(next.begin(), next.end(), never);
                const int highest = i == steps ? 0 : std::min(cells - 1, static_cast<int>(cap(i * h) / cell));
                for (int to = 0; to <= highest; ++to)
                    for (int from = std::max(0, to - CELLS_PER_STEP); from <= std::min(cells - 1, to + CELLS_PER_STEP);
                         ++from)
                        if (from + to > 0)
                            next[to] = std::min(next[to],
                                                time[from] + 2.0 * h / (std::sqrt(from * cell) + std::sqrt(to * cell)));
                time.swap(next);
            }
            return time[0];
        }

        TEST(TimedReference, IsNearTheOptimumOfDynamicProgramming)
        {
            const double most = 1.0 / Vehicle().minTurningRadius();
            const std::vector<std::vector<SmoothPart>> paths{
                {straight(1, 30.0)},
                {straight(1, 6.0), clothoidTurn(1, 0.9 * most, 2.0, 3.0), straight(1, 8.0),
                 clothoidTurn(1, -0.5 * most, 1.0, 5.0), straight(1, 5.0)},
                {clothoidTurn(-1, most, 3.0, 2.0), clothoidTurn(-1, -most, 3.0, 0.5), straight(-1, 10.0)},
                {clothoidTurn(1, 0.7 * most, 0.4, 2.0), straight(-1, 7.0), clothoidTurn(-1, -most, 1.5, 6.0),
                 straight(1, 3.0), clothoidTurn(1, 0.3 * most, 0.5, 3.0)},
            };
            for (const std::vector<SmoothPart> &parts : paths)
            {
                const ReferencePath path(smooth({}, parts), Vehicle());
                const TimedReference reference(path, {});
                for (std::size_t leg = 0; leg < reference.legs().size(); ++leg)
                {
                    const double least = minDuration(path, leg, {});
                    EXPECT_LE(reference.legs()[leg].duration, 1.05 * least);
                    EXPECT_GE(reference.legs()[leg].duration, 0.97 * least);
                }
            }
        }

        TEST(TimedReference, ProjectsToTheNearestPlace)
        {
            for (std::uint64_t seed = 0; seed < 20; ++seed)
            {
                const ReferencePath path(randomReedsShepp(seed, 15.0), Vehicle());
                const TimedReference reference(path, {});
                Random random(seed + 100);
                for (int i = 0; i < 50; ++i)
                {
                    const auto leg = static_cast<std::size_t>(random.below(static_cast<int>(path.legs().size())));
                    const TimedLeg &l = reference.legs()[leg];
                    const double s = random.between(l.beginLength, l.endLength);
                    const Pose car =
                        compose(path.pose(leg, s), {0.0, random.between(-0.4, 0.4), random.between(-0.3, 0.3)});
                    const double from = std::max(s - 0.8, l.beginLength), to = std::min(s + 0.8, l.endLength);
                    const PathProjection place = reference.project(leg, car, s - 0.8, s + 0.8);
                    EXPECT_GE(place.s, from);
                    EXPECT_LE(place.s, to);
                    for (double t = from; t <= to; t += 0.001)
                        ASSERT_LE(place.distance, positionDistance(path.pose(leg, t), car) + 1e-3);
                    const Pose offset = relativeTo(path.pose(leg, place.s), car);
                    EXPECT_NEAR(place.lateral, offset.y, 2e-5);
                    EXPECT_NEAR(place.yaw, offset.yaw, 1e-3);
                    EXPECT_NEAR(place.distance, std::hypot(offset.x, offset.y), 2e-5);
                }
            }
        }

        TEST(TimedReference, MeasuresBeyondItsEnds)
        {
            const TimedReference reference = referenceOf(arcs({}, {{0.0, 2.0}, {0.0, -1.0}}));
            EXPECT_NEAR(reference.project(0, {2.3, 0.1, 0.0}, 0.0, 9.0).beyond, 0.3, 1e-9);
            EXPECT_NEAR(reference.project(0, {-0.2, 0.0, 0.0}, 0.0, 9.0).beyond, -0.2, 1e-9);
            EXPECT_NEAR(reference.project(1, {0.8, 0.0, 0.0}, 0.0, 9.0).beyond, 0.2, 1e-9);
            EXPECT_NEAR(reference.project(0, {1.2, 0.3, 0.0}, 0.0, 9.0).beyond, 0.0, 1e-9);
        }

        TEST(TimedReference, HasALegBetweenStandstillsOfAMotion)
        {
            const TimedReference reference(exampleMotion(), Vehicle());
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

        TEST(TimedReference, IsAtEveryTimeWhereTheMotionIs)
        {
            const Vehicle car;
            for (std::uint64_t seed = 0; seed < 10; ++seed)
            {
                const TimedMotion motion =
                    seed == 0 ? exampleMotion() : stopAndSteer(randomSmooth(seed, 20.0), car, 0.0, 0.0);
                const TimedReference reference(motion, car);
                EXPECT_NEAR(reference.duration(), motion.duration(), 1e-9);
                double begin = reference.legs()[0].standstill;
                std::size_t leg = 0;
                visitParts(motion, car, 0.007, 0.05,
                           [&](const MotionPart &part)
                           {
                               if (part.from.v == 0.0 && part.to.v == 0.0)
                                   return true;
                               while (part.from.t >= begin + reference.legs()[leg].duration - 1e-9)
                               {
                                   begin += reference.legs()[leg].duration;
                                   begin += reference.legs()[++leg].standstill;
                               }
                               const TimedState at = reference.at(leg, part.from.t - begin);
                               EXPECT_TRUE(isSamePose(at.pose, part.before, 2e-5)) << part.from.t;
                               EXPECT_NEAR(at.speed, std::abs(part.from.v), 1e-6);
                               EXPECT_NEAR(at.steering, part.from.steering, 1e-6);
                               EXPECT_NEAR(reference.steering(leg, at.s), at.steering, 0.02);
                               const Pose beside = compose(at.pose, {0.0, 0.1, 0.05});
                               const PathProjection place = reference.project(leg, beside, at.s - 0.5, at.s + 0.5);
                               EXPECT_NEAR(place.s, at.s, 1e-3);
                               EXPECT_NEAR(place.lateral, 0.1, 1e-4);
                               EXPECT_NEAR(place.distance, 0.1, 1e-4);
                               return true;
                           });
                EXPECT_TRUE(isSamePose(reference.end(), endOf(motion, car), 1e-6));
            }
        }
    }  // namespace
}  // namespace parking::test

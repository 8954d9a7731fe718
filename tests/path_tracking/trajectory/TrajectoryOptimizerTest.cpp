#include "benchmarks/worlds/OutlinedVehicles.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/referee/Referee.h"
#include "path_tracking/trajectory/MotionCheck.h"
#include "path_tracking/trajectory/StopAndSteer.h"
#include "path_tracking/trajectory/TrajectoryOptimizer.h"
#include "tests/path_tracking/TestPaths.h"
#include "tests/path_tracking/trajectory/TrajectoryReferee.h"
#include "tests/path_tracking/trajectory/TrajectoryWorlds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace parking
{
    namespace
    {
        using test::bangBang;
        using test::box;
        using test::checkerOf;
        using test::obstaclesBeside;
        using test::Random;

        /** Aside, round and back onto the line on which it begins. */
        Path detour(double radius)
        {
            Path path{{}, {}};
            for (const double side : {1.0, -1.0, -1.0, 1.0})
                path.append({side / radius, PI / 3.0 * radius});
            return path;
        }

        TEST(TrajectoryOptimizer, AStraightLineLosesNothingWhereverItsPeakIs)
        {
            const Vehicle car;
            const FootprintChecker checker = checkerOf({});
            for (double length = 0.6; length < 25.0; length *= 1.17)
            {
                const OptimizedTrajectory found = TrajectoryOptimizer(checker).optimize({{}, {{0.0, length}}});
                const double bound = bangBang(length, car);
                EXPECT_GE(found.motion.duration(), bound - 1e-6) << length;
                EXPECT_LE(found.motion.duration(), bound * 1.0005) << length;
            }
        }

        TEST(TrajectoryOptimizer, AMovingCarKeepsSpeedAndSteeringAtTheStart)
        {
            const FootprintChecker checker = checkerOf({box(60.0, 60.0, 1.0, 1.0, 0.0)});
            std::size_t found = 0, count = 0;
            for (std::uint64_t seed = 1; seed <= 40; ++seed)
            {
                const Path path = test::randomReedsShepp(seed, 10.0);
                const Stretch first = path.stretches().front();
                if (path.part(first.first, first.last).length() < 3.0)
                    continue;
                ++count;
                TrajectoryOptions options;
                options.initialSpeed = 1.2;
                options.initialSteering = 0.3 * std::sin(static_cast<double>(seed));
                const OptimizedTrajectory result = TrajectoryOptimizer(checker, options).optimize(path);
                if (result.fallback)
                {
                    EXPECT_TRUE(result.motion.knots.empty());
                    continue;
                }
                ++found;
                EXPECT_EQ(result.motion.knots.front().v, first.direction * options.initialSpeed);
                EXPECT_EQ(result.motion.knots.front().steering, *options.initialSteering);
                EXPECT_EQ(result.motion.knots.back().v, 0.0);
                EXPECT_TRUE(isSamePose(endOf(result.motion, Vehicle()), path.end(), 2e-3)) << seed;
                const std::vector<MotionKnot> &knots = result.motion.knots;
                for (std::size_t i = 1; i < knots.size(); ++i)
                {
                    const double h = knots[i].t - knots[i - 1].t;
                    EXPECT_LE(std::abs(knots[i].v - knots[i - 1].v), 1.000001 * Vehicle().maxAcceleration * h);
                    EXPECT_LE(std::abs(knots[i].steering - knots[i - 1].steering),
                              1.000001 * Vehicle().maxSteeringRate * h);
                }
            }
            EXPECT_GE(count, 20u);
            EXPECT_GE(found, count - 2);
        }

        TEST(TrajectoryOptimizer, AMovingCarBrakesOnAStraightLineIfThatSuffices)
        {
            const FootprintChecker checker = checkerOf({});
            TrajectoryOptions options;
            options.initialSpeed = 2.0;  // brakes within 2 m
            const auto along = [&](double length)
            {
                return TrajectoryOptimizer(checker, options).optimize({{}, {{0.0, length}}});
            };
            EXPECT_TRUE(along(1.95).motion.knots.empty());
            ASSERT_FALSE(along(2.1).fallback);
            // With a peak at p: p^2 = (2 l + v^2) / 2 for an acceleration of 1 m/s^2.
            const double peak = std::sqrt(0.5 * (2.0 * 4.0 + 4.0));
            EXPECT_NEAR(along(4.0).motion.duration(), (peak - 2.0) + peak, 2e-3);
        }

        TEST(TrajectoryOptimizer, CoarseStepsTakeHardlyLongerThanFineOnes)
        {
            const FootprintChecker checker = checkerOf({});
            TrajectoryOptions fine;
            fine.step = 0.1;
            double coarseSum = 0.0, fineSum = 0.0;
            for (std::uint64_t seed = 1; seed <= 20; ++seed)
            {
                const Path path = test::randomReedsShepp(seed, 10.0);
                coarseSum += TrajectoryOptimizer(checker).optimize(path).motion.duration();
                fineSum += TrajectoryOptimizer(checker, fine).optimize(path).motion.duration();
            }
            EXPECT_LT(coarseSum, 1.0005 * fineSum);
        }

        TEST(TrajectoryOptimizer, OfPathsThatAreAlikeOneIsSolvedAndOfOthersEach)
        {
            // Round a box, on two sides.
            const auto swing = [](double side, double aside)
            {
                return Path{{0.0, aside, 0.0}, {{0.2 * side, 3.0}, {-0.2 * side, 6.0}, {0.2 * side, 3.0}}};
            };
            TrajectoryOptions options;
            options.sharpest = false;
            const FootprintChecker checker = checkerOf({box(6.8, 0.0, 0.8, 0.8, 0.0)});
            const TrajectoryOptimizer optimizer(checker, options);
            const std::size_t alone = optimizer.optimize(swing(1.0, 0.0)).rounds;
            EXPECT_EQ(optimizer.optimizeBest({swing(1.0, 0.0), swing(1.0, 1e-3)}).rounds, alone);
            EXPECT_EQ(optimizer.optimizeBest({swing(1.0, 0.0), swing(-1.0, 0.0)}).rounds, alone + 1);
        }

        TEST(TrajectoryOptimizer, PassesObstaclesWithoutWidthAsQuicklyAsThinOnes)
        {
            // Between two places 2.4 m apart, beside the path.
            const Eigen::Vector2d a(2.0, 1.25), b(4.4, 1.25), middle(3.2, 1.25), corner(4.4, 3.0);
            const auto quad = [&](double width) -> Polygon
            {
                const Eigen::Vector2d across(0.0, width);
                return {a, b, b + across, a + across};
            };
            const Path path{{}, {{0.0, 3.0}, {-0.15, 4.0}, {0.15, 4.0}, {0.0, 2.0}}};
            const OptimizedTrajectory thin = TrajectoryOptimizer(checkerOf({quad(1e-3)})).optimize(path);
            ASSERT_FALSE(thin.fallback);
            const std::vector<std::vector<Polygon>> others = {
                {{a, b}},           {{a, b, b}},  {{a, a, b}},  {{a, b, a}},  {{a, middle, b}},
                {quad(1e-9)},       {quad(1e-6)}, {quad(5e-6)}, {quad(2e-5)}, {{a, b, b + Eigen::Vector2d(0.0, 1e-9)}},
                {{a, b, corner, b}}};
            for (std::size_t i = 0; i < others.size(); ++i)
            {
                const FootprintChecker checker = checkerOf(others[i]);
                const OptimizedTrajectory found = TrajectoryOptimizer(checker).optimize(path);
                EXPECT_FALSE(found.fallback) << i;
                EXPECT_NEAR(found.motion.duration(), thin.motion.duration(), 0.01 * thin.motion.duration()) << i;
                EXPECT_TRUE(collisionsOf(found.motion, checker, 1).empty()) << i;
            }
            // A point, and what is one by its corners.
            for (const Polygon &point : {Polygon{b}, Polygon{b, b, b}, Polygon{b, b + Eigen::Vector2d(1e-7, 1e-7)}})
            {
                const OptimizedTrajectory found = TrajectoryOptimizer(checkerOf({point})).optimize(path);
                EXPECT_FALSE(found.fallback) << point.size();
                EXPECT_LE(found.motion.duration(), 1.001 * thin.motion.duration()) << point.size();
            }
        }

        TEST(TrajectoryOptimizer, HoldsEveryLimitTouchesNothingAndIsNeverSlower)
        {
            std::size_t optimised = 0, all = 0;
            double before = 0.0, after = 0.0;
            for (std::uint64_t seed = 1; seed <= 25; ++seed)
            {
                Vehicle car;
                Random random(seed);
                car.maxSpeed = random.between(0.8, 3.0);
                car.maxAcceleration = random.between(0.4, 2.0);
                car.maxSteeringRate = random.between(0.3, 1.0);
                const Path path = seed % 2 == 0 ? test::randomReedsShepp(seed, 14.0) : test::randomLattice(seed, 14.0);
                const std::vector<Polygon> obstacles = obstaclesBeside(path, car, seed, 60);
                const FootprintChecker checker = checkerOf(obstacles, car);
                const OptimizedTrajectory found = TrajectoryOptimizer(checker).optimize(path);
                const test::Verdict verdict = test::judge(sample(found.motion, car, 0.05), car, obstacles);
                EXPECT_EQ(verdict.fault, "") << "seed " << seed << (found.fallback ? ", fallback" : "");
                EXPECT_TRUE(isSamePose(verdict.end, path.end(), 5e-3)) << seed;
                EXPECT_EQ(found.motion.knots.front().steering, 0.0) << seed;
                EXPECT_EQ(found.motion.knots.back().steering, 0.0) << seed;
                const double slow = stopAndSteer(path, car, 0.0, 0.0).duration();
                EXPECT_LE(found.motion.duration(), slow + 1e-9) << seed;
                EXPECT_GE(found.motion.duration(), bangBang(positionDistance(path.start, path.end()), car) - 1e-6);
                EXPECT_GE(found.motion.duration(), test::bound(found.motion, car) - 1e-6) << seed;
                EXPECT_EQ(found.fallback, !found.reason.empty()) << seed << ": " << found.reason;
                before += slow;
                after += found.motion.duration();
                optimised += found.fallback ? 0 : 1;
                ++all;
            }
            EXPECT_GE(optimised + 1, all);
            EXPECT_LT(after, 0.6 * before);
        }

        TEST(TrajectoryOptimizer, BodiesWithOutlinesTouchNothingEither)
        {
            std::size_t optimised = 0, all = 0, obstacles = 0;
            double before = 0.0, after = 0.0;
            for (const Vehicle &car : parking_test::outlinedVehicles())
                for (std::uint64_t seed = 1; seed <= 4; ++seed)
                {
                    const Path path =
                        seed % 2 == 0 ? test::randomReedsShepp(seed, 10.0) : test::randomLattice(seed, 10.0);
                    Random random(seed);
                    const SampledPath states = path.sample(0.1);
                    Scenario scenario;
                    scenario.vehicle = car;
                    scenario.bounds = test::WIDE;
                    for (int i = 0; i < 60; ++i)
                    {
                        const Pose &near = states[random.index(states.size())].pose;
                        Scenario alone = scenario;
                        alone.polygons = {box(near.x + random.between(-3.0, 3.0), near.y + random.between(-3.0, 3.0),
                                              random.between(0.1, 2.0), random.between(0.1, 1.0),
                                              random.between(-PI, PI))};
                        if (Referee(alone).minClearance(path) > 0.02)
                            scenario.polygons.push_back(alone.polygons.front());
                    }
                    obstacles += scenario.polygons.size();
                    const FootprintChecker checker = checkerOf(scenario.polygons, car);
                    const OptimizedTrajectory found = TrajectoryOptimizer(checker).optimize(path);
                    const FreeSpace space(scenario);
                    for (const TrajectoryPoint &point : sample(found.motion, car, 0.01))
                        ASSERT_TRUE(space.isFree({point.x, point.y, point.yaw})) << seed << " at " << point.t;
                    optimised += found.fallback ? 0 : 1;
                    before += stopAndSteer(path, car, 0.0, 0.0).duration();
                    after += found.motion.duration();
                    ++all;
                }
            EXPECT_GT(obstacles, 10 * all);
            EXPECT_GE(optimised + 2, all);
            EXPECT_LT(after, 0.6 * before);
        }

        TEST(TrajectoryOptimizer, KeepsAMapsCellsClear)
        {
            const Vehicle car;
            int optimised = 0;
            for (std::uint64_t seed = 1; seed <= 5; ++seed)
            {
                Path path = test::randomReedsShepp(seed, 10.0);
                path.start = {30.0, 30.0, 0.3};
                const double side = 0.2;
                std::vector<Polygon> cells;
                Random random(seed);
                OccupancyGrid grid(300, 300, side, {});
                const SampledPath states = path.sample(0.02);
                for (int i = 0; i < 300; ++i)
                {
                    const Pose &near = states[random.index(states.size())].pose;
                    const double column = std::floor((near.x + random.between(-6.0, 6.0)) / side);
                    const double row = std::floor((near.y + random.between(-6.0, 6.0)) / side);
                    const Polygon cell = box((column + 0.5) * side, (row + 0.5) * side, side, side, 0.0);
                    const Vehicle larger = test::enlarged(car, 0.02);
                    if (std::any_of(states.begin(), states.end(),
                                    [&](const PathState &state) { return test::touches(state.pose, larger, {cell}); }))
                        continue;
                    cells.push_back(cell);
                    grid.set(static_cast<std::size_t>(column), static_cast<std::size_t>(row), Cell::Occupied);
                }
                const FootprintChecker checker(ObstacleSet::fromGrid(grid), car);
                const OptimizedTrajectory found = TrajectoryOptimizer(checker).optimize(path);
                const test::Verdict verdict = test::judge(sample(found.motion, car, 0.05), car, cells);
                EXPECT_EQ(verdict.fault, "") << seed;
                optimised += found.fallback ? 0 : 1;
            }
            EXPECT_GE(optimised, 4);
        }

        TEST(TrajectoryOptimizer, CutsNoCornerThroughWhatIsFarFromThePath)
        {
            // A wide way round a box that is out of the optimiser's sight at first: straight on would be quicker.
            const Vehicle car;
            const Path path = detour(6.0);
            const std::vector<Polygon> obstacles{box(11.5, 0.5, 1.0, 1.0, 0.0)};
            EXPECT_NE(
                collisionsOf(TrajectoryOptimizer(checkerOf({})).optimize(path).motion, checkerOf(obstacles), 1).size(),
                0U);
            const FootprintChecker checker = checkerOf(obstacles);
            const OptimizedTrajectory found = TrajectoryOptimizer(checker).optimize(path);
            EXPECT_EQ(test::judge(sample(found.motion, car, 0.05), car, obstacles).fault, "");
            EXPECT_FALSE(found.fallback) << found.reason;
        }

        TEST(TrajectoryOptimizer, IsTheSameEveryTime)
        {
            const Vehicle car;
            const Path path = test::randomReedsShepp(4, 14.0);
            const FootprintChecker checker = checkerOf(obstaclesBeside(path, car, 4, 40));
            const TimedMotion first = TrajectoryOptimizer(checker).optimize(path).motion;
            const TimedMotion second = TrajectoryOptimizer(checker).optimize(path).motion;
            ASSERT_EQ(first.knots.size(), second.knots.size());
            for (std::size_t i = 0; i < first.knots.size(); ++i)
            {
                EXPECT_EQ(first.knots[i].t, second.knots[i].t);
                EXPECT_EQ(first.knots[i].v, second.knots[i].v);
                EXPECT_EQ(first.knots[i].steering, second.knots[i].steering);
            }
        }

        TEST(TrajectoryOptimizer, KeepsTheMarginThatItIsAsked)
        {
            // Round a post as closely as it dares.
            const Vehicle car;
            const Path path = detour(4.0);
            const std::vector<Polygon> post{box(7.5, -0.5, 1.0, 1.0, 0.0)};
            const FootprintChecker checker = checkerOf(post);
            double before = 0.0;
            for (const double margin : {0.002, 0.1, 0.3})
            {
                TrajectoryOptions options;
                options.margin = margin;
                options.preferredClearance = 0.0;
                const OptimizedTrajectory found = TrajectoryOptimizer(checker, options).optimize(path);
                EXPECT_FALSE(found.fallback) << margin << ": " << found.reason;
                // Between two checkpoints a curve comes nearer than at them, by some tenths of a millimetre.
                const double kept = margin - std::min(0.5e-3, 0.1 * margin);
                EXPECT_EQ(test::judge(sample(found.motion, car, 0.05), test::enlarged(car, kept), post).fault, "")
                    << margin;
                EXPECT_GT(found.motion.duration(), before) << margin;
                before = found.motion.duration();
            }
        }

        TEST(TrajectoryOptimizer, ParksWithinHundredthsOfAMillimetre)
        {
            const Vehicle car;
            const Path path{{}, {{0.05, 4.0}, {-0.05, 4.0}, {0.0, 2.0}}};
            for (const double gap : {5e-5, 1e-3})
            {
                // Across its way, in front of where it shall stand.
                const Pose end = path.end();
                const double middle = car.wheelbase + car.frontOverhang + gap + 0.25;
                const std::vector<Polygon> wall{
                    box(end.x + middle * std::cos(end.yaw), end.y + middle * std::sin(end.yaw), 0.5, 4.0, end.yaw)};
                const FootprintChecker checker = checkerOf(wall);
                const OptimizedTrajectory found = TrajectoryOptimizer(checker).optimize(path);
                EXPECT_FALSE(found.fallback) << gap << ": " << found.reason;
                EXPECT_EQ(test::judge(sample(found.motion, car, 0.05), car, wall).fault, "") << gap;
            }
        }

        TEST(TrajectoryOptimizer, FreeWheelsAtTheEndsSaveTheTimeToTurnThem)
        {
            const Vehicle car;
            const Path path{{}, {{car.curvature(0.6), 1.0}}};
            const FootprintChecker checker = checkerOf({});
            TrajectoryOptions free;
            free.initialSteering.reset();
            free.finalSteering.reset();
            const double straight = TrajectoryOptimizer(checker).optimize(path).motion.duration();
            const TimedMotion quick = TrajectoryOptimizer(checker, free).optimize(path).motion;
            EXPECT_LT(quick.duration(), straight - 1.0);
            EXPECT_NEAR(quick.duration(), bangBang(1.0, car), 0.05);
            // The pose stays what it was, though.
            const Path bend{{1.0, 2.0, 0.5}, {{car.curvature(0.6), 3.0}, {car.curvature(-0.6), 3.0}}};
            const OptimizedTrajectory found = TrajectoryOptimizer(checker, free).optimize(bend);
            EXPECT_FALSE(found.fallback) << found.reason;
            EXPECT_TRUE(isSamePose(found.motion.start, bend.start, 1e-9));
            EXPECT_TRUE(isSamePose(endOf(found.motion, car), bend.end(), 5e-3));
        }

        TEST(TrajectoryOptimizer, ReachesTheGoalHoweverCoarseItsSteps)
        {
            // Collocation alone misses the goal by centimetres then, and every path would be driven as it is.
            const Vehicle car;
            const FootprintChecker checker = checkerOf({});
            for (const double step : {0.6, 1.0, 2.0})
            {
                TrajectoryOptions coarse;
                coarse.step = step;
                int optimised = 0;
                for (std::uint64_t seed = 1; seed <= 20; ++seed)
                {
                    const Path path = test::randomLattice(seed, 40.0);
                    const OptimizedTrajectory found = TrajectoryOptimizer(checker, coarse).optimize(path);
                    EXPECT_TRUE(isSamePose(endOf(found.motion, car), path.end(), 2.5e-3)) << seed;
                    optimised += found.fallback ? 0 : 1;
                }
                EXPECT_EQ(optimised, 20) << step;
            }
        }

        TEST(TrajectoryOptimizer, DoesWithoutAStretchThatIsOfNoUse)
        {
            const Vehicle car;
            const FootprintChecker checker = checkerOf({});
            for (const double back : {0.02, 0.2, 0.4})
                for (const double first : {6.0, 0.3})
                {
                    const Path path{{}, {{0.0, first}, {0.0, -back}, {0.02, 8.0}}};
                    const OptimizedTrajectory found = TrajectoryOptimizer(checker).optimize(path);
                    EXPECT_EQ(tpcapCost(found.motion).gearChanges, 0U) << back << ", " << first;
                    EXPECT_LE(found.motion.duration(), 1.01 * bangBang(first + 8.0 - back, car));
                }
        }

        TEST(TrajectoryOptimizer, TheWeightsOfACompetitionLowerItsCost)
        {
            const Path path = test::randomReedsShepp(6, 14.0);
            const FootprintChecker checker = checkerOf({});
            TrajectoryOptions tpcap;
            tpcap.weights = TrajectoryOptions::tpcapWeights();
            const TimedMotion quick = TrajectoryOptimizer(checker).optimize(path).motion;
            const TimedMotion cheap = TrajectoryOptimizer(checker, tpcap).optimize(path).motion;
            EXPECT_LT(tpcapCost(cheap).total(), tpcapCost(quick).total());
            EXPECT_LT(quick.duration(), cheap.duration());
        }

        TEST(TrajectoryOptimizer, StopsWhenItIsTold)
        {
            const Vehicle car;
            const Path path = test::randomReedsShepp(3, 14.0);
            const std::vector<Polygon> obstacles = obstaclesBeside(path, car, 3, 40);
            const FootprintChecker checker = checkerOf(obstacles);
            const TrajectoryOptimizer optimizer(checker);
            // While lines are chosen, while programs are solved, and between the two.
            for (const int limit : {0, 1, 2, 5, 20, 50, 100, 150, 200, 300, 500})
            {
                int asked = 0;
                const OptimizedTrajectory found = optimizer.optimize(path, [&] { return ++asked > limit; });
                EXPECT_LE(asked, limit + 1);
                EXPECT_EQ(test::judge(sample(found.motion, car, 0.05), car, obstacles).fault, "");
                if (limit < 5)
                {
                    EXPECT_TRUE(found.fallback);
                    EXPECT_EQ(found.reason, "interrupted");
                }
            }
        }

        TEST(TrajectoryOptimizer, DrivesThePathItselfWhereNothingElseIsFound)
        {
            // Walls with less room between them than the margin asked for, not met before the middle.
            const Vehicle car;
            const Path path{{}, {{0.0, 20.0}, {car.curvature(0.3), 3.0}}};
            const double beside = 0.5 * car.width + 0.001 + 0.5;
            const std::vector<Polygon> walls{box(10.0, beside, 4.0, 1.0, 0.0), box(10.0, -beside, 4.0, 1.0, 0.0)};
            const FootprintChecker checker = checkerOf(walls);
            TrajectoryOptions wide;
            wide.margin = 0.3;
            wide.maxRounds = 2;
            const OptimizedTrajectory found = TrajectoryOptimizer(checker, wide).optimize(path);
            EXPECT_TRUE(found.fallback);
            EXPECT_FALSE(found.reason.empty());
            EXPECT_EQ(test::judge(sample(found.motion, car, 0.05), car, walls).fault, "");
            EXPECT_FALSE(TrajectoryOptimizer(checker).optimize(path).fallback);
        }

        TEST(TrajectoryOptimizer, KeepsToItsSharesOfTheLimitsWhateverItFallsBackTo)
        {
            // A straight line is driven as it is; the other one is quicker without stops.
            const Path straight{{}, {{0.0, 12.0}}}, shunt{{}, {{0.0, 8.0}, {0.1, 4.0}, {0.0, -8.0}}};
            const Vehicle car;
            for (const Path &path : {straight, shunt})
                for (const double share : {1.0, 0.5, 0.2})
                {
                    TrajectoryOptions options;
                    options.speedShare = options.accelerationShare = options.steeringRateShare = share;
                    const OptimizedTrajectory found = TrajectoryOptimizer(checkerOf({}), options).optimize(path);
                    EXPECT_EQ(found.fallback, path.pieces.size() == 1) << share;
                    EXPECT_EQ(found.reason, found.fallback ? "stopping to steer is equally fast" : "") << share;
                    const std::vector<MotionKnot> &knots = found.motion.knots;
                    for (std::size_t k = 1; k < knots.size(); ++k)
                    {
                        const MotionKnot &a = knots[k - 1], &b = knots[k];
                        const double most = share * (b.t - a.t) * (1.0 + 1e-9);
                        EXPECT_LE(std::abs(b.v), share * car.maxSpeed * (1.0 + 1e-9)) << share;
                        EXPECT_LE(std::abs(b.v - a.v), car.maxAcceleration * most) << share;
                        EXPECT_LE(std::abs(b.steering - a.steering), car.maxSteeringRate * most) << share;
                    }
                }
        }

        TEST(MotionCheck, SeesWhatIsTouchedByLessThanAnArcLeaves)
        {
            // Straight on at first, the wheels turning right: the arc of the first 20 ms never comes nearer to the
            // post.
            const Vehicle car;
            const TimedMotion motion{{}, {{0.0, 2.5, 0.005}, {0.3, 2.5, -0.145}, {2.8, 0.0, -0.145}}};
            for (const double gap : {1e-6, 1e-5, 5e-5, 7.5e-5, 5e-4})
            {
                // The true motion comes 0.08 mm nearer.
                const double y = 0.5 * car.width + gap;
                const FootprintChecker checker = checkerOf({{{3.6, y}, {3.62, y + 0.3}, {3.58, y + 0.3}}});
                EXPECT_EQ(collisionsOf(motion, checker, 1).empty(), gap > 8e-5) << gap;
            }
        }

        TEST(MotionCheck, FindsWhatARefereeFinds)
        {
            // Motions that were optimised in a world without obstacles, driven among some.
            const Vehicle car;
            std::size_t touching = 0;
            for (std::uint64_t seed = 1; seed <= 40; ++seed)
            {
                const Path path = test::randomReedsShepp(seed, 8.0);
                const FootprintChecker empty = checkerOf({});
                const TimedMotion motion = TrajectoryOptimizer(empty).optimize(path).motion;
                const std::vector<Polygon> obstacles = obstaclesBeside(path, car, seed, 30);
                const bool referee = !test::judge(sample(motion, car, 0.05), car, obstacles).fault.empty();
                const bool check = !collisionsOf(motion, checkerOf(obstacles), 1).empty();
                EXPECT_TRUE(check || !referee) << seed;
                touching += referee ? 1 : 0;
            }
            EXPECT_GT(touching, 5U);
        }
    }  // namespace
}  // namespace parking

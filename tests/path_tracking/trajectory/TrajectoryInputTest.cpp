// What a TrajectoryOptimizer refuses: one error each, which says what was wrong and with what value.

#include "parking_geometry/Error.h"
#include "path_tracking/trajectory/StopAndSteer.h"
#include "path_tracking/trajectory/TrajectoryOptimizer.h"
#include "tests/path_tracking/trajectory/TrajectoryWorlds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace parking
{
    namespace
    {
        using test::box;
        using test::checkerOf;

        constexpr double INF = std::numeric_limits<double>::infinity();
        const double NO_NUMBER = std::nan("");

        /** The message of the error that \e call throws; empty when it throws none. */
        std::string refusal(const std::function<void()> &call)
        {
            try
            {
                call();
            }
            catch (const Error &error)
            {
                return error.what();
            }
            return "";
        }

        void expectWords(const std::string &message, const std::vector<std::string> &words)
        {
            for (const std::string &word : words)
                EXPECT_NE(message.find(word), std::string::npos) << '"' << message << "\" should say " << word;
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        }

        std::string text(double value)
        {
            return std::isnan(value)   ? "nan"
                   : std::isinf(value) ? (value > 0.0 ? "inf" : "-inf")
                                       : std::to_string(value).substr(0, 1);
        }

        TEST(TrajectoryInput, ALimitOfTheCarThatIsNoneIsNamed)
        {
            const std::vector<std::pair<std::string, double Vehicle::*>> limits{
                {"max_speed", &Vehicle::maxSpeed},
                {"max_acceleration", &Vehicle::maxAcceleration},
                {"max_steering_angle", &Vehicle::maxSteeringAngle},
                {"max_steering_rate", &Vehicle::maxSteeringRate}};
            for (const auto &[name, limit] : limits)
                for (const double wrong : {0.0, -1.0, NO_NUMBER, INF})
                {
                    Vehicle car;
                    car.*limit = wrong;
                    expectWords(refusal([&car = car] { TrajectoryOptimizer optimizer(checkerOf({}, car)); }),
                                {name, text(wrong)});
                    expectWords(refusal(
                                    [&car = car] {
                                        stopAndSteer({{}, {{0.0, 5.0}}}, car, 0.0, 0.0);
                                    }),
                                {name, text(wrong)});
                }
        }

        TEST(TrajectoryInput, AnOptionOutOfItsRangeIsNamed)
        {
            const FootprintChecker checker = checkerOf({});
            const auto expect = [&checker](const std::string &name,
                                           const std::function<void(TrajectoryOptions &, double)> &set,
                                           const std::vector<double> &wrong)
            {
                for (const double value : wrong)
                {
                    TrajectoryOptions options;
                    set(options, value);
                    expectWords(refusal([&] { TrajectoryOptimizer optimizer(checker, options); }), {name, text(value)});
                }
            };
            const std::vector<double> below{-1.0, NO_NUMBER, INF}, notAbove{0.0, -1.0, NO_NUMBER, INF};
            const std::vector<double> shares{0.0, -1.0, 2.0, NO_NUMBER, INF}, noNumber{NO_NUMBER, INF};
            using O = TrajectoryOptions;
            const auto option = [](double O::*field)
            {
                return [field](O &options, double value)
                {
                    options.*field = value;
                };
            };
            const auto weight = [](double MotionWeights::*field)
            {
                return [field](O &options, double value)
                {
                    options.weights.*field = value;
                };
            };
            const auto angle = [](std::optional<double> O::*field)
            {
                return [field](O &options, double value)
                {
                    options.*field = value;
                };
            };
            expect("margin", option(&O::margin), below);
            expect("preferred clearance", option(&O::preferredClearance), below);
            expect("step", option(&O::step), notAbove);
            expect("share of the speed", option(&O::speedShare), shares);
            expect("share of the acceleration", option(&O::accelerationShare), shares);
            expect("share of the steering angle", option(&O::steeringShare), shares);
            expect("share of the steering rate", option(&O::steeringRateShare), shares);
            expect("time weight", weight(&MotionWeights::time), notAbove);
            expect("effort weight", weight(&MotionWeights::effort), below);
            expect("steering weight", weight(&MotionWeights::steering), below);
            expect("nearness weight", weight(&MotionWeights::nearness), below);
            expect("initial steering angle", angle(&O::initialSteering), noNumber);
            expect("final steering angle", angle(&O::finalSteering), noNumber);
            expect("steering angle at an end", angle(&O::initialSteering), {1.0});
            expect("steering angle at an end", angle(&O::finalSteering), {-1.0});
        }

        TEST(TrajectoryInput, APathThatIsNoneOfTheCarIsRefused)
        {
            const Vehicle car;
            const FootprintChecker checker = checkerOf({});
            const auto refused = [&checker](const Path &path)
            {
                return refusal([&] { TrajectoryOptimizer(checker).optimize(path); });
            };
            expectWords(refused({{}, {}}), {"never drives"});
            expectWords(refused({{}, {{0.0, 0.0}}}), {"never drives"});
            expectWords(refused({{}, {{0.0, 2.0}, PathPiece::turnOnTheSpot(1.0), {0.0, 2.0}}}), {"piece 2", "spot"});
            expectWords(refused({{}, {{0.0, 2.0}, {1.05 / car.minTurningRadius(), 1.0}}}), {"piece 2", "curvature"});
            expectWords(refused({{}, {PathPiece{0.0, 3.0, 1.0}}}), {"piece 1", "curvature"});  // a clothoid
            expectWords(refused({{}, {{NO_NUMBER, 1.0}}}), {"piece 1", "finite"});
            expectWords(refused({{}, {{0.0, INF}}}), {"piece 1", "finite"});
            expectWords(refused({{NO_NUMBER, 0.0, 0.0}, {{0.0, 1.0}}}), {"finite pose"});
            expectWords(refusal([&checker] { TrajectoryOptimizer(checker).optimizeBest({}); }), {"no path"});
        }

        TEST(TrajectoryInput, WhatTakesTooLongIsRefusedOrDrivenAsItIs)
        {
            Vehicle slow;
            slow.maxSpeed = slow.maxAcceleration = slow.maxSteeringRate = Vehicle::MIN_LIMIT;
            const auto along = [](double metres)
            {
                return Path{{-200.0, 0.0, 0.0}, {{0.0, metres}}};
            };
            const double longest = slow.maxSpeed * LONGEST_MOTION - 1.0;
            EXPECT_LE(stopAndSteer(along(longest), slow, 0.0, 0.0).duration(), LONGEST_MOTION);
            expectWords(refusal([&] { stopAndSteer(along(longest + 2.0), slow, 0.0, 0.0); }),
                        {"the path takes 20051 s", "at most 20000 s"});
            const FootprintChecker checker(ObstacleSet::fromPolygons({}, {{-300.0, -300.0}, {300.0, 300.0}}), slow);
            expectWords(refusal([&] { TrajectoryOptimizer(checker).optimize(along(longest + 2.0)); }),
                        {"the path takes 20051 s", "at most 20000 s"});
            // Shares of what a car can do may be less than a car must be able to.
            TrajectoryOptions options;
            options.speedShare = 0.5;
            const OptimizedTrajectory half = TrajectoryOptimizer(checker, options).optimize(along(5.0));
            EXPECT_NEAR(half.motion.duration(), 500.5, 1.0);
            options.speedShare = 1e-300;
            expectWords(refusal([&] { TrajectoryOptimizer(checker, options).optimize(along(5.0)); }),
                        {"the path takes", "at most 20000 s"});
            // Nothing is searched for where that would take thousands of intervals.
            const Path bent{{-200.0, 0.0, 0.0}, {{0.0, 40.0}, {0.1, 3.0}, {0.0, 60.0}}};
            const OptimizedTrajectory found = TrajectoryOptimizer(checker).optimize(bent);
            EXPECT_TRUE(found.fallback);
            EXPECT_EQ(found.iterations, 0U);
            expectWords(found.reason, {"too long"});
        }

        TEST(TrajectoryInput, APathThatCollidesIsRefused)
        {
            const FootprintChecker checker = checkerOf({box(8.0, 4.0, 1.0, 1.0, 0.0)});
            const Path through{{0.0, 4.0, 0.0}, {{0.0, 15.0}}}, past{{0.0, 0.0, 0.0}, {{0.0, 12.0}, {-0.2, 3.0}}};
            const TrajectoryOptimizer optimizer(checker);
            expectWords(refusal([&] { optimizer.optimize(through); }), {"collides"});
            expectWords(refusal([&] { optimizer.optimizeBest({past, through}); }), {"collides"});
            // From the first moment, and after it was told to stop.
            expectWords(refusal([&] { optimizer.optimize({{8.0, 4.0, 0.0}, {{0.0, 9.0}}}); }), {"collides"});
            expectWords(refusal([&] { optimizer.optimize(through, [] { return true; }); }), {"collides"});
            EXPECT_FALSE(optimizer.optimize(past).fallback);
        }

        TEST(TrajectoryInput, WithoutTimeThePathIsDrivenAsItIsAndThatIsSaid)
        {
            const Vehicle car;
            const Path path = test::randomReedsShepp(3, 14.0);
            const std::vector<Polygon> obstacles = test::obstaclesBeside(path, car, 3, 40);
            const FootprintChecker checker = checkerOf(obstacles);
            const OptimizedTrajectory found = TrajectoryOptimizer(checker).optimize(path, [] { return true; });
            EXPECT_TRUE(found.fallback);
            EXPECT_EQ(found.reason, "interrupted");
            EXPECT_EQ(found.iterations, 0U);
            EXPECT_NEAR(found.motion.duration(), stopAndSteer(path, car, 0.0, 0.0).duration(), 1e-12);
            EXPECT_EQ(test::judge(sample(found.motion, car, 0.05), car, obstacles).fault, "");
        }
    }  // namespace
}  // namespace parking

// What a TrajectoryOptimizer refuses: one error each, which says what was wrong and with what value.

#include "path_tracking/trajectory/StopAndSteer.h"
#include "path_tracking/trajectory/TrajectoryOptimizer.h"
#include "tests/path_tracking/trajectory/TrajectoryWorlds.h"
#include "tests/support/ExpectRefused.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace parking
{
    namespace
    {
        using namespace parking_test;
        using test::box;
        using test::checkerOf;

        constexpr double INF = std::numeric_limits<double>::infinity();
        const double NO_NUMBER = std::nan("");

        TEST(TrajectoryInput, ALimitOfTheCarThatIsNoneIsNamed)
        {
            const std::vector<double> wrong{0.0, -1.0, NO_NUMBER, INF};
            const std::vector<RefusedField<Vehicle>> limits{
                {"max_speed", field(&Vehicle::maxSpeed), wrong},
                {"max_acceleration", field(&Vehicle::maxAcceleration), wrong},
                {"max_steering_angle", field(&Vehicle::maxSteeringAngle), wrong},
                {"max_steering_rate", field(&Vehicle::maxSteeringRate), wrong}};
            expectRefused<Vehicle>(limits, [](const Vehicle &car) { TrajectoryOptimizer(checkerOf({}, car)); });
            expectRefused<Vehicle>(limits, [](const Vehicle &car) { stopAndSteer({{}, {{0.0, 5.0}}}, car, 0.0, 0.0); });
        }

        TEST(TrajectoryInput, AnOptionOutOfItsRangeIsNamed)
        {
            const FootprintChecker checker = checkerOf({});
            const std::vector<double> below{-1.0, NO_NUMBER, INF}, notAbove{0.0, -1.0, NO_NUMBER, INF};
            const std::vector<double> shares{0.0, -1.0, 2.0, NO_NUMBER, INF}, noNumber{NO_NUMBER, INF};
            using O = TrajectoryOptions;
            const auto weight = [](auto member)
            {
                return field(&O::weights, member);
            };
            expectRefused<O>({{"margin", field(&O::margin), below},
                              {"preferred clearance", field(&O::preferredClearance), below},
                              {"step", field(&O::step), notAbove},
                              {"share of the speed", field(&O::speedShare), shares},
                              {"share of the acceleration", field(&O::accelerationShare), shares},
                              {"share of the steering angle", field(&O::steeringShare), shares},
                              {"share of the steering rate", field(&O::steeringRateShare), shares},
                              {"time weight", weight(&MotionWeights::time), notAbove},
                              {"effort weight", weight(&MotionWeights::effort), below},
                              {"steering weight", weight(&MotionWeights::steering), below},
                              {"nearness weight", weight(&MotionWeights::nearness), below},
                              {"initial steering angle", field(&O::initialSteering), noNumber},
                              {"final steering angle", field(&O::finalSteering), noNumber},
                              {"steering angle at an end", field(&O::initialSteering), {1.0}},
                              {"steering angle at an end", field(&O::finalSteering), {-1.0}}},
                             [&checker](const O &options) { TrajectoryOptimizer(checker, options); });
        }

        TEST(TrajectoryInput, APathThatIsNoneOfTheCarIsRefused)
        {
            const Vehicle car;
            const FootprintChecker checker = checkerOf({});
            const auto refused = [&checker](const Path &path, const std::vector<std::string> &words)
            {
                expectError([&] { TrajectoryOptimizer(checker).optimize(path); }, words);
            };
            refused({{}, {}}, {"never drives"});
            refused({{}, {{0.0, 0.0}}}, {"never drives"});
            refused({{}, {{0.0, 2.0}, PathPiece::turnOnTheSpot(1.0), {0.0, 2.0}}}, {"piece 2", "spot"});
            refused({{}, {{0.0, 2.0}, {1.05 / car.minTurningRadius(), 1.0}}}, {"piece 2", "curvature"});
            refused({{}, {PathPiece{0.0, 3.0, 1.0}}}, {"piece 1", "curvature"});  // a clothoid
            refused({{}, {{NO_NUMBER, 1.0}}}, {"piece 1", "finite"});
            refused({{}, {{0.0, INF}}}, {"piece 1", "finite"});
            refused({{NO_NUMBER, 0.0, 0.0}, {{0.0, 1.0}}}, {"finite pose"});
            expectError([&checker] { TrajectoryOptimizer(checker).optimizeBest({}); }, {"no path"});
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
            expectError([&] { stopAndSteer(along(longest + 2.0), slow, 0.0, 0.0); },
                        {"the path takes 20051 s", "at most 20000 s"});
            const FootprintChecker checker(ObstacleSet::fromPolygons({}, {{-300.0, -300.0}, {300.0, 300.0}}), slow);
            expectError([&] { TrajectoryOptimizer(checker).optimize(along(longest + 2.0)); },
                        {"the path takes 20051 s", "at most 20000 s"});
            // Shares of what a car can do may be less than a car must be able to.
            TrajectoryOptions options;
            options.speedShare = 0.5;
            const OptimizedTrajectory half = TrajectoryOptimizer(checker, options).optimize(along(5.0));
            EXPECT_NEAR(half.motion.duration(), 500.5, 1.0);
            options.speedShare = 1e-300;
            expectError([&] { TrajectoryOptimizer(checker, options).optimize(along(5.0)); },
                        {"the path takes", "at most 20000 s"});
            // Nothing is searched for where that would take thousands of intervals.
            const Path bent{{-200.0, 0.0, 0.0}, {{0.0, 40.0}, {0.1, 3.0}, {0.0, 60.0}}};
            const OptimizedTrajectory found = TrajectoryOptimizer(checker).optimize(bent);
            EXPECT_TRUE(found.fallback);
            EXPECT_EQ(found.iterations, 0U);
            EXPECT_NE(found.reason.find("limit of the optimisation"), std::string::npos) << found.reason;
        }

        TEST(TrajectoryInput, APathThatCollidesIsRefused)
        {
            const FootprintChecker checker = checkerOf({box(8.0, 4.0, 1.0, 1.0, 0.0)});
            const Path through{{0.0, 4.0, 0.0}, {{0.0, 15.0}}}, past{{0.0, 0.0, 0.0}, {{0.0, 12.0}, {-0.2, 3.0}}};
            const TrajectoryOptimizer optimizer(checker);
            expectError([&] { optimizer.optimize(through); }, {"collides"});
            expectError([&] { optimizer.optimizeBest({past, through}); }, {"collides"});
            // From the first moment, and after it was told to stop.
            expectError([&] { optimizer.optimize({{8.0, 4.0, 0.0}, {{0.0, 9.0}}}); }, {"collides"});
            expectError([&] { optimizer.optimize(through, [] { return true; }); }, {"collides"});
            EXPECT_FALSE(optimizer.optimize(past).fallback);
        }
    }  // namespace
}  // namespace parking

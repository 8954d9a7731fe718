// What is refused: a parking::Error in one line, which names what is wrong.
#include "path_tracking/reference/TimedReference.h"
#include "path_tracking/simulation/ClosedLoop.h"
#include "tests/path_tracking/TestPaths.h"
#include "tests/support/ExpectRefused.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace parking::test
{
    namespace
    {
        using parking_test::expectError;
        using parking_test::expectRefused;
        using parking_test::field;

        constexpr double INF = std::numeric_limits<double>::infinity();
        const double NO_NUMBER = std::nan("");

        const std::vector<double> NOT_POSITIVE{0.0, -1.0, NO_NUMBER}, NEGATIVE{-1e-9, NO_NUMBER, INF};

        TEST(Refusals, ParametersOutOfTheirRangeAreNamed)
        {
            using P = ClosedLoopParameters;
            const auto mpc = [](auto member)
            {
                return field(&P::tracking, &TrackingParameters::mpc, member);
            };
            const auto tracking = [](auto member)
            {
                return field(&P::tracking, member);
            };
            const auto reference = [](auto member)
            {
                return field(&P::tracking, &TrackingParameters::reference, member);
            };
            const auto response = [](auto... members)
            {
                return field(&P::tracking, &TrackingParameters::response, members...);
            };
            const auto estimator = [&response](auto member)
            {
                return response(&ResponseParameters::estimator, member);
            };
            const auto disturbance = [](auto member)
            {
                return field(&P::disturbances, member);
            };
            const std::vector<double> shares{0.0, 1.01, NO_NUMBER};
            expectRefused<P>({{"horizon", mpc(&MpcParameters::horizon), {0, 201}},
                              {"maxIterations", mpc(&MpcParameters::maxIterations), {0, -1}},
                              {"step", mpc(&MpcParameters::step), {0.0, -1.0, 1.01, NO_NUMBER}},
                              {"accelerationWeight", mpc(&MpcParameters::accelerationWeight), NEGATIVE},
                              {"steeringWeight", mpc(&MpcParameters::steeringWeight), NEGATIVE},
                              {"accelerationChangeWeight", mpc(&MpcParameters::accelerationChangeWeight), NEGATIVE},
                              {"steeringChangeWeight", mpc(&MpcParameters::steeringChangeWeight), NEGATIVE},
                              {"alongWeight", mpc(&MpcParameters::alongWeight), NEGATIVE},
                              {"acrossWeight", mpc(&MpcParameters::acrossWeight), NEGATIVE},
                              {"headingWeight", mpc(&MpcParameters::headingWeight), NEGATIVE},
                              {"farHeadingWeight", mpc(&MpcParameters::farHeadingWeight), NEGATIVE},
                              {"alignDistance", mpc(&MpcParameters::alignDistance), NEGATIVE},
                              {"speedShare", tracking(&TrackingParameters::speedShare), shares},
                              {"accelerationShare", tracking(&TrackingParameters::accelerationShare), shares},
                              {"steeringRateShare", tracking(&TrackingParameters::steeringRateShare), shares},
                              {"lateralAcceleration", tracking(&TrackingParameters::lateralAcceleration), NOT_POSITIVE},
                              {"brakeReserve", tracking(&TrackingParameters::brakeReserve), {-0.1, 1.0, NO_NUMBER}},
                              {"guardWaitLimit", tracking(&TrackingParameters::guardWaitLimit), NEGATIVE},
                              {"poseWaitLimit", tracking(&TrackingParameters::poseWaitLimit), NEGATIVE},
                              {"wheelWaitLimit", tracking(&TrackingParameters::wheelWaitLimit), NEGATIVE},
                              {"stopTolerance", tracking(&TrackingParameters::stopTolerance), NOT_POSITIVE},
                              {"arrivalTolerance", tracking(&TrackingParameters::arrivalTolerance), NOT_POSITIVE},
                              {"settleTime", tracking(&TrackingParameters::settleTime), NOT_POSITIVE},
                              {"steeringTolerance", tracking(&TrackingParameters::steeringTolerance), NOT_POSITIVE},
                              {"maxCrossTrack", tracking(&TrackingParameters::maxCrossTrack), NOT_POSITIVE},
                              {"maxHeadingError", tracking(&TrackingParameters::maxHeadingError), NOT_POSITIVE},
                              {"maxFailures", tracking(&TrackingParameters::maxFailures), {-1}},
                              {"bodyTolerance", reference(&ReferenceParameters::bodyTolerance), NOT_POSITIVE},
                              {"minBlendSpeed", reference(&ReferenceParameters::minBlendSpeed), NOT_POSITIVE},
                              {"maxBlendLength", reference(&ReferenceParameters::maxBlendLength), NOT_POSITIVE},
                              {"maxCornerCut", reference(&ReferenceParameters::maxCornerCut), NOT_POSITIVE},
                              {"maxCornerRadii", reference(&ReferenceParameters::maxCornerRadii), NOT_POSITIVE},
                              {"cornerSpeed", reference(&ReferenceParameters::cornerSpeed), NOT_POSITIVE},
                              {"steeringLag", response(&ResponseParameters::steeringLag), {-0.1, 0.6, NO_NUMBER}},
                              {"driveLag", response(&ResponseParameters::driveLag), {-0.1, 0.6, NO_NUMBER}},
                              {"commandDelay", response(&ResponseParameters::commandDelay), {-0.1, 1.1, NO_NUMBER}},
                              {"brakeScale", response(&ResponseParameters::brakeScale), shares},
                              {"positionNoise", estimator(&EstimatorParameters::positionNoise), NOT_POSITIVE},
                              {"yawNoise", estimator(&EstimatorParameters::yawNoise), NOT_POSITIVE},
                              {"speedBias", estimator(&EstimatorParameters::speedBias), NOT_POSITIVE},
                              {"steeringOffset", estimator(&EstimatorParameters::steeringOffset), NOT_POSITIVE},
                              {"drift", estimator(&EstimatorParameters::drift), NOT_POSITIVE},
                              {"steeringLag", disturbance(&Disturbances::steeringLag), NEGATIVE},
                              {"accelerationLag", disturbance(&Disturbances::accelerationLag), NEGATIVE},
                              {"positionNoise", disturbance(&Disturbances::positionNoise), NEGATIVE},
                              {"yawNoise", disturbance(&Disturbances::yawNoise), NEGATIVE},
                              {"delay", disturbance(&Disturbances::delay), NEGATIVE},
                              {"speedBias", disturbance(&Disturbances::speedBias), {-1.0, 1.0, NO_NUMBER}},
                              {"steeringOffset", disturbance(&Disturbances::steeringOffset), {-1.0, 1.0, NO_NUMBER}},
                              {"wheelbaseError", disturbance(&Disturbances::wheelbaseError), {-1.0, 1.0, NO_NUMBER}},
                              {"brakeLoss", disturbance(&Disturbances::brakeLoss), {-0.1, 1.0, NO_NUMBER}}},
                             [](const P &parameters) { ClosedLoop(Vehicle(), parameters); });
        }

        TEST(Refusals, LimitsThatLeadNowhereAreNamed)
        {
            const ReferencePath path(arcs({}, {{0.0, 2.0}}), Vehicle());
            const std::vector<double> wrong{0.0, -1.0, 0.0099, NO_NUMBER, INF};
            expectRefused<SpeedLimits>({{"speed", field(&SpeedLimits::speed), wrong},
                                        {"acceleration", field(&SpeedLimits::acceleration), wrong},
                                        {"steeringRate", field(&SpeedLimits::steeringRate), wrong},
                                        {"lateralAcceleration", field(&SpeedLimits::lateralAcceleration), wrong}},
                                       [&path](const SpeedLimits &limits) { TimedReference(path, limits); });
            EXPECT_NO_THROW(TimedReference(path, {0.01, 0.01, 0.01, 0.01}));
            for (const double angle : {0.76, -0.76, NO_NUMBER})
                expectError([&] { TimedReference(path, {}, angle); }, {"initial steering angle"});
        }

        TEST(Refusals, CarsAndPathsThatCannotBeDriven)
        {
            const Path path = arcs({}, {{0.0, 2.0}});
            Vehicle broken, slow;
            broken.wheelbase = -1.0;
            slow.maxSpeed = Vehicle::MIN_LIMIT;
            expectError([&] { ReferencePath(path, broken); }, {"wheelbase"});
            expectError([&] { ClosedLoop{broken}; }, {"wheelbase"});
            expectError([&] { Mpc(broken, {}); }, {"wheelbase"});
            EXPECT_NO_THROW(TrackingController(path, slow));
            TrackingParameters hesitant;
            hesitant.speedShare = 0.4;  // of a valid car: no timed path suits that
            expectError([&] { TrackingController(path, slow, hesitant); }, {"speed"});
            expectError([] { TrackingController(std::shared_ptr<const TimedReference>(), Vehicle()); },
                        {"no reference"});
            for (const Path &nowhere : {Path{}, Path{{}, {PathPiece::turnOnTheSpot(1.0)}}})
                expectError([&] { ClosedLoop{Vehicle()}.drive(nowhere); }, {"path"});
            expectError([] { Plant(Vehicle(), {}, {}, 0.0, 0.0); }, {"step"});
        }

        TEST(Refusals, WhatTakesTooLong)
        {
            const TimedMotion motion{{}, {{0.0, 0.0, 0.0}, {2.0, 1.0, 0.0}, {1e9, 1.0, 0.0}, {1e9 + 2.0, 0.0, 0.0}}};
            expectError([&motion] { ClosedLoop{Vehicle()}.follow(motion); },
                        {"it takes 1000000002 s", "at most 20000 s"});
            Vehicle slow;
            slow.maxSpeed = Vehicle::MIN_LIMIT;
            expectError([&slow] { ClosedLoop(slow).drive({{}, {{0.0, 1e5}}}); }, {"the path takes", "at most 20000 s"});
        }

        TEST(Refusals, MotionsThatNoCarCanDrive)
        {
            const TimedMotion right = exampleMotion();
            EXPECT_NO_THROW(TimedReference(right, Vehicle()));
            const auto refused = [&right](const std::string &words, const std::function<void(TimedMotion &)> &spoil)
            {
                TimedMotion motion = right;
                spoil(motion);
                expectError([&motion] { TimedReference(motion, Vehicle()); }, {words});
            };
            refused("0 knots", [](TimedMotion &m) { m.knots.clear(); });
            refused("start is not finite", [](TimedMotion &m) { m.start.x = NO_NUMBER; });
            refused("not finite", [](TimedMotion &m) { m.knots[3].v = INF; });
            refused("end at rest", [](TimedMotion &m) { m.knots.resize(7); });
            refused("acceleration", [](TimedMotion &m) { m.knots[2].v = 1.6; });
            refused("steering angle", [](TimedMotion &m) { m.knots[2].steering = 0.76; });
            refused("steering rate", [](TimedMotion &m) { m.knots[1].steering = 0.3; });
            refused("the time does not increase", [](TimedMotion &m) { m.knots[4].t = m.knots[3].t; });
            refused("without standstill", [](TimedMotion &m) { m.knots[4].v = -0.1; });
            refused("never drives",
                    [](TimedMotion &m)
                    {
                        for (MotionKnot &knot : m.knots)
                            knot.v = 0.0;
                    });
            Vehicle slow;
            slow.maxSpeed = 1.0;
            expectError([&] { TimedReference(right, slow); }, {"the speed is"});
        }
    }  // namespace
}  // namespace parking::test

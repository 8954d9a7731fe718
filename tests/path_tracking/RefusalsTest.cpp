// What is refused: a parking::Error in one line, which names what is wrong.
#include "path_tracking/reference/TimedReference.h"
#include "path_tracking/simulation/ClosedLoop.h"
#include "tests/parking_geometry/ExpectError.h"
#include "tests/path_tracking/TestPaths.h"

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

        constexpr double INF = std::numeric_limits<double>::infinity();
        const double NO_NUMBER = std::nan("");

        /** Something that takes numbers, by the names of those that it refuses. */
        template <class Parameters>
        struct Field
        {
            const char *name;
            std::function<void(Parameters &, double)> set;
            std::vector<double> wrong;
        };

        template <class Parameters>
        void expectRefused(const std::vector<Field<Parameters>> &fields, const std::function<void(Parameters)> &use)
        {
            EXPECT_NO_THROW(use(Parameters()));
            for (const Field<Parameters> &field : fields)
                for (const double value : field.wrong)
                {
                    Parameters parameters;
                    field.set(parameters, value);
                    SCOPED_TRACE(std::string(field.name) + " " + std::to_string(value));
                    expectError([&] { use(parameters); }, {field.name});
                }
        }

        const std::vector<double> NOT_POSITIVE{0.0, -1.0, NO_NUMBER}, NEGATIVE{-1e-9, NO_NUMBER, INF};

        TEST(Refusals, ParametersOutOfTheirRangeAreNamed)
        {
            using P = ClosedLoopParameters;
            const auto mpc = [](double MpcParameters::*field)
            {
                return [field](P &p, double v)
                {
                    p.tracking.mpc.*field = v;
                };
            };
            const auto tracking = [](double TrackingParameters::*field)
            {
                return [field](P &p, double v)
                {
                    p.tracking.*field = v;
                };
            };
            const auto reference = [](double ReferenceParameters::*field)
            {
                return [field](P &p, double v)
                {
                    p.tracking.reference.*field = v;
                };
            };
            const auto response = [](double ResponseParameters::*field)
            {
                return [field](P &p, double v)
                {
                    p.tracking.response.*field = v;
                };
            };
            const auto estimator = [](double EstimatorParameters::*field)
            {
                return [field](P &p, double v)
                {
                    p.tracking.response.estimator.*field = v;
                };
            };
            const auto disturbance = [](double Disturbances::*field)
            {
                return [field](P &p, double v)
                {
                    p.disturbances.*field = v;
                };
            };
            const std::vector<double> shares{0.0, 1.01, NO_NUMBER};
            expectRefused<P>(
                {{"plantStep", [](P &p, double v) { p.plantStep = v; }, NOT_POSITIVE},
                 {"checkDistance", [](P &p, double v) { p.checkDistance = v; }, NOT_POSITIVE},
                 {"patience", [](P &p, double v) { p.patience = v; }, NOT_POSITIVE},
                 {"horizon", [](P &p, double v) { p.tracking.mpc.horizon = static_cast<std::size_t>(v); }, {0, 201}},
                 {"maxIterations", [](P &p, double v) { p.tracking.mpc.maxIterations = static_cast<int>(v); }, {0, -1}},
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
                 {"guardPatience", tracking(&TrackingParameters::guardPatience), NEGATIVE},
                 {"posePatience", tracking(&TrackingParameters::posePatience), NEGATIVE},
                 {"wheelPatience", tracking(&TrackingParameters::wheelPatience), NEGATIVE},
                 {"stopTolerance", tracking(&TrackingParameters::stopTolerance), NOT_POSITIVE},
                 {"arrivalTolerance", tracking(&TrackingParameters::arrivalTolerance), NOT_POSITIVE},
                 {"settleTime", tracking(&TrackingParameters::settleTime), NOT_POSITIVE},
                 {"steeringTolerance", tracking(&TrackingParameters::steeringTolerance), NOT_POSITIVE},
                 {"maxCrossTrack", tracking(&TrackingParameters::maxCrossTrack), NOT_POSITIVE},
                 {"maxHeadingError", tracking(&TrackingParameters::maxHeadingError), NOT_POSITIVE},
                 {"maxFailures", [](P &p, double v) { p.tracking.maxFailures = static_cast<int>(v); }, {-1}},
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
            const auto limit = [](double SpeedLimits::*field)
            {
                return [field](SpeedLimits &limits, double v)
                {
                    limits.*field = v;
                };
            };
            const std::vector<double> wrong{0.0, -1.0, 0.0099, NO_NUMBER, INF};
            expectRefused<SpeedLimits>({{"speed", limit(&SpeedLimits::speed), wrong},
                                        {"acceleration", limit(&SpeedLimits::acceleration), wrong},
                                        {"steeringRate", limit(&SpeedLimits::steeringRate), wrong},
                                        {"lateralAcceleration", limit(&SpeedLimits::lateralAcceleration), wrong}},
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
            const TimedMotion right{{1.0, 2.0, 3.0},
                                    {{0.0, 0.0, 0.0},
                                     {0.5, 0.0, 0.2},
                                     {2.0, 1.5, 0.7},
                                     {4.0, 1.0, -0.2},
                                     {5.0, 0.0, -0.1},
                                     {5.5, 0.0, 0.1},
                                     {7.0, -1.0, 0.5},
                                     {8.5, 0.0, 0.4}}};
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
            refused("end at rest", [](TimedMotion &m) { m.knots.pop_back(); });
            refused("acceleration", [](TimedMotion &m) { m.knots[2].v = 1.6; });
            refused("steering angle", [](TimedMotion &m) { m.knots[2].steering = 0.76; });
            refused("steering rate", [](TimedMotion &m) { m.knots[1].steering = 0.3; });
            refused("time does not go on", [](TimedMotion &m) { m.knots[4].t = m.knots[3].t; });
            refused("without a rest", [](TimedMotion &m) { m.knots[4].v = -0.1; });
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

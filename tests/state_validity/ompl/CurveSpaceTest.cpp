#include "state_validity/ompl/CurveSpace.h"

#include "benchmarks/worlds/RandomWorlds.h"
#include "state_validity/ompl/OmplPose.h"

#include <memory>

#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/DubinsStateSpace.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#include <ompl/base/spaces/SE3StateSpace.h>
#include <ompl/util/Exception.h>

#include <gtest/gtest.h>

namespace ob = ompl::base;
using namespace parking;
using namespace parking_test;

namespace
{
    using State = ob::ScopedState<>;

    Pose anyPose(Random &random)
    {
        const double range = std::abs(random.magnitude(0.1, 30.0));
        return {random.between(-range, range), random.between(-range, range), random.between(-PI, PI)};
    }

    Pose along(const Pose &from, const ReedsSheppCurve &curve, double driven)
    {
        Pose pose = from;
        for (std::size_t i = 0; i < curve.count && driven > 0.0; ++i)
        {
            const Arc &arc = curve.pieces[i];
            const double part = std::min(driven, std::abs(arc.length));
            pose = advance(pose, arc.curvature, std::copysign(part, arc.length));
            driven -= part;
        }
        return pose;
    }

    void expectSame(const Pose &a, const Pose &b, double tolerance)
    {
        ASSERT_NEAR(a.x, b.x, tolerance);
        ASSERT_NEAR(a.y, b.y, tolerance);
        ASSERT_NEAR(wrapAngle(a.yaw - b.yaw), 0.0, tolerance);
    }

    /** The space's own interpolate() is what planners use; the arcs must be what it follows. */
    void expectInterpolates(const std::shared_ptr<ob::SE2StateSpace> &space, double radius, bool reverses)
    {
        ob::RealVectorBounds bounds(2);
        bounds.setLow(-100.0);
        bounds.setHigh(100.0);
        space->setBounds(bounds);
        const CurveSpace curves(*space);
        EXPECT_NEAR(curves.turningRadius(), radius, 1e-15 * radius);
        Random random(1);
        State from(space), to(space), between(space);
        ReedsSheppCurve curve;
        int reversed = 0;
        for (int i = 0; i < 3000; ++i)
        {
            const Pose a = anyPose(random);
            setPose(from.get(), a);
            setPose(to.get(), i % 50 == 0 ? a : anyPose(random));
            curves.curve(from.get(), to.get(), curve);
            ASSERT_NEAR(curve.length, space->distance(from.get(), to.get()), 1e-9 * radius);
            double length = 0.0;
            for (std::size_t k = 0; k < curve.count; ++k)
            {
                length += std::abs(curve.pieces[k].length);
                reversed += curve.pieces[k].length < 0.0;
                ASSERT_NE(curve.pieces[k].length, 0.0);
            }
            ASSERT_NEAR(length, curve.length, 1e-9 * radius);
            Path path{poseOf(from.get()), {}};
            curves.append(from.get(), to.get(), path);
            ASSERT_NEAR(path.length(), curve.length, 1e-6);
            expectSame(path.end(), poseOf(to.get()), 1e-6 * std::max(1.0, radius));
            for (const PathPiece &piece : path.pieces)
                ASSERT_GE(piece.driven(), 1e-7);
            for (double t = 0.0; t < 1.0; t += 0.0625)
            {
                space->interpolate(from.get(), to.get(), t, between.get());
                expectSame(along(poseOf(from.get()), curve, t * curve.length), poseOf(between.get()), 1e-8 * radius);
                if (testing::Test::HasFatalFailure())
                    return;
            }
        }
        EXPECT_EQ(reversed > 500, reverses);
        EXPECT_EQ(reversed > 0, reverses);
    }
}  // namespace

TEST(CurveSpace, FollowsTheCurvesOfTheSpace)
{
    for (const double radius : {0.7, 1.0, 3.0056, 11.5})
    {
        const auto reedsShepp = std::make_shared<ob::ReedsSheppStateSpace>(radius);
        EXPECT_EQ(CurveSpace(*reedsShepp).kind(), SpaceKind::ReedsShepp);
        expectInterpolates(reedsShepp, radius, true);
        for (const bool symmetric : {false, true})
        {
            const auto dubins = std::make_shared<ob::DubinsStateSpace>(radius, symmetric);
            EXPECT_EQ(CurveSpace(*dubins).kind(), SpaceKind::Dubins);
            expectInterpolates(dubins, radius, symmetric);
        }
    }
}

TEST(CurveSpace, PlainSE2HasNoCurves)
{
    const auto space = std::make_shared<ob::SE2StateSpace>();
    const CurveSpace curves(*space);
    EXPECT_EQ(curves.kind(), SpaceKind::SE2);
    EXPECT_EQ(curves.turningRadius(), 0.0);
    State a(space), b(space);
    setPose(a.get(), {});
    setPose(b.get(), {1.0, 0.0, 0.0});
    ReedsSheppCurve curve;
    EXPECT_THROW(curves.curve(a.get(), b.get(), curve), ompl::Exception);
}

TEST(CurveSpace, RefusesOtherSpaces)
{
    EXPECT_THROW(CurveSpace{ob::SE3StateSpace()}, ompl::Exception);
    EXPECT_THROW(CurveSpace{ob::RealVectorStateSpace(3)}, ompl::Exception);
    EXPECT_THROW(CurveSpace{ob::ReedsSheppStateSpace(0.0)}, ompl::Exception);
}

TEST(OmplPose, WrapsYawIntoTheRangeThatOmplAllows)
{
    const auto space = std::make_shared<ob::SE2StateSpace>();
    ob::RealVectorBounds bounds(2);
    bounds.setLow(-1.0);
    bounds.setHigh(1.0);
    space->setBounds(bounds);
    State state(space);
    for (const double yaw : {-PI, PI, 3.0 * PI, -3.0 * PI, 2.0 * PI, 100.0, std::nextafter(PI, 4.0)})
    {
        setPose(state.get(), {0.5, -0.5, yaw});
        EXPECT_TRUE(space->satisfiesBounds(state.get())) << yaw;
        EXPECT_NEAR(std::remainder(poseOf(state.get()).yaw - yaw, 2.0 * PI), 0.0, 1e-12) << yaw;
        EXPECT_EQ(poseOf(state.get()).x, 0.5);
        EXPECT_EQ(poseOf(state.get()).y, -0.5);
    }
}

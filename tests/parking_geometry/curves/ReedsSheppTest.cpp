#include "benchmarks/worlds/Random.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/curves/ReedsShepp.h"

#include "tests/support/PoseGap.h"

#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/DubinsStateSpace.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace
{
    using namespace parking;
    using parking_test::gap;

    Pose drive(const Pose &from, const ReedsSheppCurve &curve)
    {
        Path path{from, {curve.pieces.begin(), curve.pieces.begin() + static_cast<long>(curve.count)}};
        return path.end();
    }

    template <class Space>
    double omplDistance(Space &space, const Pose &a, const Pose &b)
    {
        ompl::base::ScopedState<ompl::base::SE2StateSpace> from(space), to(space);
        from->setXY(a.x, a.y);
        from->setYaw(a.yaw);
        to->setXY(b.x, b.y);
        to->setYaw(b.yaw);
        return space->distance(from.get(), to.get());
    }
}  // namespace

TEST(ReedsShepp, EveryWordEndsAtTheGoalAndTheShortestIsFirst)
{
    parking_test::Random random(1);
    std::vector<ReedsSheppCurve> curves;
    for (const double extent : {0.5, 3.0, 20.0})
        for (int i = 0; i < 20000; ++i)
        {
            const ReedsShepp solver(1.0 + (i % 7));
            const Pose from = random.poseIn(-extent, extent), to = random.poseIn(-extent, extent);
            solver.candidates(from, to, curves);
            ASSERT_FALSE(curves.empty());
            for (const ReedsSheppCurve &curve : curves)
            {
                ASSERT_LT(gap(drive(from, curve), to), 1e-6) << extent << " " << i;
                ASSERT_GE(curve.length, curves.front().length);
                for (std::size_t k = 0; k < curve.count; ++k)
                    ASSERT_LE(std::abs(curve.pieces[k].curvature) * solver.turningRadius(), 1.0 + 1e-12);
            }
            ASSERT_NEAR(solver.distance(from, to), curves.front().length, 1e-9);
            ASSERT_NEAR(solver.shortest(from, to).length, curves.front().length, 1e-9);
        }
}

TEST(ReedsShepp, LengthAgreesWithOmpl)
{
    parking_test::Random random(1);
    for (const double radius : {1.0, 3.0, 5.3})
    {
        const ReedsShepp solver(radius), dubins(radius, CurveFamily::Dubins);
        auto reedsSheppSpace = std::make_shared<ompl::base::ReedsSheppStateSpace>(radius);
        auto dubinsSpace = std::make_shared<ompl::base::DubinsStateSpace>(radius);
        ompl::base::RealVectorBounds bounds(2);
        bounds.setLow(-100.0);
        bounds.setHigh(100.0);
        reedsSheppSpace->setBounds(bounds);
        dubinsSpace->setBounds(bounds);
        for (int i = 0; i < 20000; ++i)
        {
            const Pose from = random.poseIn(-12.0, 12.0), to = random.poseIn(-12.0, 12.0);
            ASSERT_NEAR(solver.distance(from, to), omplDistance(reedsSheppSpace, from, to), 1e-6);
            ASSERT_NEAR(dubins.distance(from, to), omplDistance(dubinsSpace, from, to), 1e-6);
        }
    }
}

TEST(ReedsShepp, DubinsDrivesForwardsOnly)
{
    parking_test::Random random(1);
    const ReedsShepp solver(2.0, CurveFamily::Dubins);
    std::vector<ReedsSheppCurve> curves;
    for (int i = 0; i < 20000; ++i)
    {
        const Pose from = random.poseIn(-8.0, 8.0), to = random.poseIn(-8.0, 8.0);
        solver.candidates(from, to, curves);
        ASSERT_FALSE(curves.empty());
        for (const ReedsSheppCurve &curve : curves)
        {
            ASSERT_LT(gap(drive(from, curve), to), 1e-6);
            ASSERT_EQ(curve.cusps(), 0u);
            for (std::size_t k = 0; k < curve.count; ++k)
                ASSERT_GT(curve.pieces[k].length, 0.0);
        }
    }
}

TEST(ReedsShepp, LongestIsABoundOnBothSides)
{
    const ReedsShepp solver(1.0);
    const Pose from{}, to{2.0, 1.0, 0.4};
    std::vector<ReedsSheppCurve> curves;
    const double shortest = solver.distance(from, to);
    solver.candidates(from, to, curves, shortest * (1.0 - 1e-9));
    EXPECT_TRUE(curves.empty());
    solver.candidates(from, to, curves, shortest * (1.0 + 1e-9));
    EXPECT_EQ(curves.size(), 1u);
}

TEST(ReedsShepp, NoWordIsLostToALimit)
{
    // What is left out before its angles are known must be longer than the limit, just above the length of each word.
    parking_test::Random random(2);
    std::vector<ReedsSheppCurve> all, limited;
    for (const double extent : {0.3, 1.5, 4.0, 20.0})
        for (int i = 0; i < 5000; ++i)
        {
            const ReedsShepp solver(1.0);
            Pose from = random.poseIn(-extent, extent), to = random.poseIn(-extent, extent);
            if (i % 4 == 0)
                to.yaw = wrapAngle(from.yaw + 0.5 * PI * (i % 16 / 4));
            solver.candidates(from, to, all);
            for (const ReedsSheppCurve &word : all)
            {
                const double limit = word.length + 1e-8;
                solver.candidates(from, to, limited, limit);
                const auto within = [limit](const ReedsSheppCurve &each)
                {
                    return each.length <= limit;
                };
                ASSERT_EQ(static_cast<long>(limited.size()), std::count_if(all.begin(), all.end(), within))
                    << extent << " " << i << " " << limit;
            }
        }
}

TEST(ReedsShepp, RejectsBadRadius)
{
    EXPECT_THROW(ReedsShepp(0.0), Error);
    EXPECT_THROW(ReedsShepp(-1.0), Error);
    EXPECT_THROW(ReedsShepp(std::nan("")), Error);
    EXPECT_THROW(ReedsShepp{std::numeric_limits<double>::infinity()}, Error);
    EXPECT_NO_THROW(ReedsShepp(1e-3));
}

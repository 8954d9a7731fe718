// What driving from pose to pose costs, along lines and along curves, against sums by hand.

#include "ompl_improved_astar/search/planning/DrivingCost.h"
#include "parking_geometry/Error.h"
#include "tests/ompl_improved_astar/search/CarWorlds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    PlannerParameters weights()
    {
        PlannerParameters result;
        result.reversePenalty = 1.5;
        result.gearChangePenalty = 3.0;
        result.steeringChangePenalty = 0.7;
        result.preferredClearance = 0.5;
        result.clearanceCost = 6.0;
        result.turningRadius = 4.0;
        return result;
    }

    void noCurve(std::size_t /*i*/, Path & /*path*/)
    {
        FAIL() << "lines are no curves";
    }
}  // namespace

TEST(DrivingCostParts, linesCountLengthDirectionTurnsAndClearance)
{
    const Box inside{{-20.0, -20.0}, {20.0, 20.0}};
    DiscCarWorld world(inside), narrow(inside, {{{-20.0, 1.2}, {20.0, 2.0}}});
    const DrivingCost cost(weights(), 0.0);
    const auto along = [&](const std::vector<Pose> &poses, MotionEnvironment &environment)
    {
        return cost.along(poses, noCurve, environment);
    };
    EXPECT_EQ(along({}, world), 0.0);
    EXPECT_EQ(along({{1.0, 2.0, 3.0}}, world), 0.0);
    EXPECT_NEAR(along({{0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}, world), 2.0 + 3.0 + 2.0 * 2.5, 1e-12);
    EXPECT_NEAR(along({{0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {4.0, 0.0, 0.25}}, world), 4.0 + 0.5 * 0.7, 1e-12);
    EXPECT_NEAR(along({{0.0, 0.0, 0.0}, {4.0, 0.0, 0.0}}, narrow), 4.0 + 4.0 * 6.0, 1e-12);
}

TEST(DrivingCostParts, curvesAreThoseOfTheSpace)
{
    DiscCarWorld world(Box{{-20.0, -20.0}, {20.0, 20.0}});
    std::vector<std::size_t> motions;
    const auto arc = [&](std::size_t i, Path &path)
    {
        motions.push_back(i);
        path.append(Arc{i == 1 ? 0.0 : 0.2, i == 1 ? 3.0 : -1.0});
    };
    // The radius of the space counts: from straight to full lock.
    EXPECT_NEAR(DrivingCost(weights(), 5.0).along({{}, {3.0, 0.0, 0.0}, {2.0, 0.1, -0.2}}, arc, world),
                3.0 + 3.0 + 2.5 + 0.7, 1e-12);
    EXPECT_EQ(motions, (std::vector<std::size_t>{1, 2}));
}

TEST(DrivingCostParts, whatIsNotFiniteOrTooFarCostsInfinitelyMuchAndWrongWeightsThrow)
{
    DiscCarWorld world(Box{{-20.0, -20.0}, {20.0, 20.0}});
    for (const double radius : {0.0, 5.0})
        for (const Pose &pose :
             {Pose{NAN, 0.0, 0.0}, Pose{0.0, HUGE_VAL, 0.0}, Pose{0.0, 0.0, NAN}, Pose{2e6, 0.0, 0.0}})
            EXPECT_EQ(DrivingCost(weights(), radius).along({{}, pose}, noCurve, world), HUGE_VAL);
    PlannerParameters wrong = weights();
    wrong.reversePenalty = -1.0;
    EXPECT_THROW(DrivingCost(wrong, 5.0), Error);
}

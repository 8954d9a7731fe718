// The motions of the car: where they lead, that they are free, and which poses share a cell.

#include "ompl_improved_astar/search/MotionModel.h"
#include "tests/ompl_improved_astar/search/DiscCarWorld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    /** The car model in a world. */
    struct CarIn
    {
        explicit CarIn(DiscCarWorld &world, bool forwardOnly = false, double preferredClearance = 0.0)
          : model(motionModels().make("car"))
        {
            car.bounds = world.inside;
            car.forwardOnly = forwardOnly;
            cost.fullLockCurvature = 1.0 / car.turningRadius;
            cost.preferredClearance = preferredClearance;
            cost.clearanceCost = 4.0;
            context = std::make_unique<SearchContext>(SearchContext{world, parameters, car, cost});
            model->begin(*context);
        }

        PlannerParameters parameters;
        CarInSpace car;
        CostModel cost;
        std::unique_ptr<SearchContext> context;
        std::unique_ptr<MotionModel> model;
    };

    /** The least gap along a motion from a pose, driven in small steps. */
    double gapAlong(const DiscCarWorld &world, const Pose &from, const Motion &motion)
    {
        return leastGap(world, Path{from, {motion.drive()}});
    }
}  // namespace

TEST(CarModel, motionsAreFreeLeadWhereTheySayAndKeepTheClearanceTheyAreKnownToKeep)
{
    int count = 0, clear = 0;
    for (std::uint64_t seed = 0; seed < 30; ++seed)
    {
        DiscCarWorld world = randomField(seed);
        Random random(seed);
        const bool forwardOnly = seed % 3 == 0;
        const double clearance = seed % 2 == 0 ? 0.2 : 0.0;
        CarIn car(world, forwardOnly, clearance);
        NodeIndex index[2]{0, 0};
        for (int i = 0; i < 20; ++i)
            for (const Side side : {Side::Start, Side::Goal})
            {
                Node node;
                node.pose = world.freePose(random);
                if (i % 2 == 1)
                {
                    node.parent = 0;
                    node.motion = {0.0, random.below(3) / car.car.turningRadius - 1.0 / car.car.turningRadius, 1.0};
                }
                const NodeIndex number = index[static_cast<std::size_t>(side)]++;
                for (std::size_t level = 0; level < car.model->traits().levels; ++level)
                {
                    std::vector<Successor> successors;
                    car.model->expand(side, number, node, level, level == 0, successors);
                    for (const Successor &each : successors)
                    {
                        ++count;
                        const Pose end = advance(node.pose, each.motion.drive());
                        ASSERT_NEAR(positionDistance(end, each.pose), 0.0, 1e-9);
                        ASSERT_NEAR(wrapAngle(end.yaw - each.pose.yaw), 0.0, 1e-9);
                        ASSERT_EQ(each.motion.turn, 0.0);
                        ASSERT_LE(std::abs(each.motion.curvature), (1.0 + 1e-9) / car.car.turningRadius);
                        ASSERT_GT(std::abs(each.motion.length), 0.0);
                        ASSERT_GT(gapAlong(world, node.pose, each.motion), 0.0);
                        ASSERT_TRUE(!forwardOnly || (each.motion.length > 0.0) == (side == Side::Start));
                        if (each.clear <= 0.0)
                            continue;
                        ++clear;
                        const double known = std::min(each.clear, std::abs(each.motion.length));
                        ASSERT_GE(gapAlong(world, node.pose,
                                           {0.0, each.motion.curvature, std::copysign(known, each.motion.length)}),
                                  clearance);
                    }
                }
            }
    }
    EXPECT_GT(count, 5000);
    EXPECT_GT(clear, 1000);
}

TEST(CarModel, movesTowardsAPoseUntilSomethingIsInTheWay)
{
    int arrived = 0, ended = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed)
        for (const double clearance : {0.0, 0.2})
            for (const Side side : {Side::Start, Side::Goal})
            {
                DiscCarWorld world = randomField(seed, 4);
                Random random(seed);
                CarIn car(world, seed % 4 == 0, clearance);
                for (int i = 0; i < 10; ++i)
                {
                    const Pose from = world.freePose(random), to = world.freePose(random);
                    std::vector<Successor> motions{{}};
                    car.model->moveTowards(side, from, to, motions);
                    Pose pose = from;
                    double length = 0.0;
                    for (const Successor &each : motions)
                    {
                        // Where nothing is known beforehand, gaps between the samples may be smaller.
                        ASSERT_GE(gapAlong(world, pose, each.motion), std::max(1e-9, clearance - 0.15));
                        pose = advance(pose, each.motion.drive());
                        ASSERT_NEAR(positionDistance(pose, each.pose), 0.0, 1e-9);
                        length += std::abs(each.motion.length);
                        ASSERT_TRUE(!car.car.forwardOnly || (each.motion.length > 0.0) == (side == Side::Start));
                    }
                    const double whole =
                        side == Side::Start ? car.model->distance(from, to) : car.model->distance(to, from);
                    ASSERT_LE(length, whole + 1e-6);
                    if (length < whole - 1e-3)
                        ++ended;
                    else
                    {
                        ++arrived;
                        ASSERT_NEAR(positionDistance(pose, to), 0.0, 1e-5);
                        ASSERT_NEAR(wrapAngle(pose.yaw - to.yaw), 0.0, 1e-5);
                    }
                }
            }
    EXPECT_GT(arrived, 100);
    EXPECT_GT(ended, 300);
}

TEST(CarModel, cellsHoldPosesThatAreNearEachOtherAndNearerOnFinerLevels)
{
    DiscCarWorld world({{-12.0, -12.0}, {12.0, 12.0}});
    CarIn car(world);
    Random random(1);
    double coarser = HUGE_VAL, coarsest = 0.0;
    for (std::size_t level = 0; level < car.model->traits().levels; ++level)
    {
        double widest = 0.0, turned = 0.0;
        for (int i = 0; i < 40000; ++i)
        {
            const double reach = random.magnitude(1e-4, 2.0);
            const Pose a = random.poseIn(-10.0, 10.0),
                       b{a.x + random.between(-1.0, 1.0) * reach, a.y + random.between(-1.0, 1.0) * reach,
                         a.yaw + random.between(-1.0, 1.0) * reach};
            const std::uint64_t cell = car.model->cell(a, level);
            ASSERT_EQ(cell >> 61, 0u);
            ASSERT_EQ(car.model->cell({a.x, a.y, a.yaw + 2.0 * PI}, level), cell);
            ASSERT_EQ(car.model->cell(a, level), cell);
            if (car.model->cell(b, level) != cell)
                continue;
            widest = std::max(widest, positionDistance(a, b));
            turned = std::max(turned, std::abs(wrapAngle(a.yaw - b.yaw)));
        }
        EXPECT_TRUE(0.0 < widest && widest < coarser);
        EXPECT_LT(turned, 1.0);
        coarser = widest;
        coarsest = std::max(coarsest, widest);
    }
    EXPECT_LT(coarsest, car.car.turningRadius);
    EXPECT_LT(coarser, 0.05 * coarsest);
    EXPECT_EQ(car.model->cell({1.0, 1.0, PI}, 3), car.model->cell({1.0, 1.0, -PI}, 3));
}

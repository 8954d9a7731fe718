// The motions of the car: where they lead, that they are free, and which poses share a cell.

#include "ompl_improved_astar/search/MotionModel.h"
#include "tests/ompl_improved_astar/search/CarWorlds.h"

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

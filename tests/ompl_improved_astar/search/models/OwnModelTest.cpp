// A motion model that the project does not bring: a robot with two driven wheels, which turns on the spot.

#include "ompl_improved_astar/search/MotionModel.h"
#include "ompl_improved_astar/search/planning/Plan.h"
#include "tests/ompl_improved_astar/search/GridWorld.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    constexpr double STEP = 0.5;  // metres

    /** Turns by an eighth of a circle or not at all, then drives a step; joined by a turn, a straight line and a
        turn. */
    class TwoWheels final : public MotionModel
    {
    public:
        void begin(const SearchContext &context) override
        {
            environment_ = &context.environment;
        }

        ModelTraits traits() const override
        {
            ModelTraits traits;
            traits.drivesCurves = true;
            traits.turnsOnTheSpot = true;
            return traits;
        }

        std::string heuristic() const override
        {
            return "straight";
        }

        std::uint64_t cell(const Pose &pose, std::size_t /*level*/) const override
        {
            const auto bits = [](double value)
            {
                return static_cast<std::uint64_t>(std::llround(value)) & 0xffff;
            };
            return bits(pose.x / 0.3) << 32 | bits(pose.y / 0.3) << 16 | bits(4.0 * wrapAngle(pose.yaw) / PI);
        }

        void expand(Side side, NodeIndex /*index*/, const Node &node, std::size_t /*level*/, bool /*isFirst*/,
                    std::vector<Successor> &successors) override
        {
            for (const double turn : {-0.25 * PI, 0.0, 0.25 * PI})
            {
                const double length = side == Side::Start ? STEP : -STEP, yaw = wrapAngle(node.pose.yaw + turn);
                successors.push_back({{turn, 0.0, length}, advance({node.pose.x, node.pose.y, yaw}, 0.0, length)});
            }
        }

        bool isFree(Side side, const Node &from, const Successor &to) override
        {
            return side == Side::Start ? isMotionFree(from.pose, to.pose) : isMotionFree(to.pose, from.pose);
        }

        bool join(const Node &fromStart, const Node &fromGoal, Side /*sweptFrom*/, double bound,
                  const Offer &offer) override
        {
            const Pose &a = fromStart.pose, &b = fromGoal.pose;
            const double length = positionDistance(a, b), cost = fromStart.g + fromGoal.g + length;
            if (cost >= bound || !isMotionFree(a, b))
                return false;
            const double heading = std::atan2(b.y - a.y, b.x - a.x);
            const PathPiece pieces[] = {PathPiece::turnOnTheSpot(wrapAngle(heading - a.yaw)),
                                        {0.0, length},
                                        PathPiece::turnOnTheSpot(wrapAngle(b.yaw - heading))};
            return offer(pieces, 3, cost);
        }

        double distance(const Pose &from, const Pose &to) const override
        {
            return positionDistance(from, to);
        }

    private:
        bool isMotionFree(const Pose &from, const Pose &to)
        {
            return environment_->isFree(to) && environment_->isMotionFree(from, to);
        }

        MotionEnvironment *environment_{nullptr};
    };

    PlanRequest requestIn(const GridWorld &world, const Pose &start, const Pose &goal)
    {
        motionModels().add("two_wheels", newPart<TwoWheels>);
        PlanRequest request;
        request.starts = {start};
        request.goals = {goal};
        request.car = world.car();
        request.parameters.motionModel = "two_wheels";
        return request;
    }
}  // namespace

TEST(OwnModel, isSearchedLikeTheProjectsOwn)
{
    GridWorld world({"..........", "..######..", ".......#..", "..####.#..", ".....#.#..", ".....#...."});
    // Off the middles of cells, so that no step ends on a border, where rounding decides what is free.
    const Pose start{0.53, 0.47, 0.0}, goal{6.53, 1.47, 0.5 * PI};
    const PlanResult result = plan(world, requestIn(world, start, goal));
    ASSERT_EQ(result.outcome, PlanOutcome::Solved) << result.reason;
    EXPECT_EQ(faultOf(posesOf(result.path), world, start, goal), "");
    EXPECT_NEAR(result.cost, result.path.length(), 1e-9);
    EXPECT_GE(result.path.length(), 8.49) << "round the walls";
    EXPECT_GE(result.suboptimalityBound, 1.0);
    EXPECT_TRUE(turnsOnTheSpot("two_wheels"));
}

TEST(OwnModel, findsOutThatThereIsNoPath)
{
    GridWorld world({".....", "#####", ".....", "....."});
    const PlanResult result = plan(world, requestIn(world, {0.5, 0.5, 0.0}, {4.5, 3.5, 0.0}));
    EXPECT_EQ(result.outcome, PlanOutcome::Approximate);
    EXPECT_FALSE(result.reason.empty()) << "not for want of time";
    EXPECT_NEAR(result.path.end().y, 2.0, 0.4) << "up to the wall";
}

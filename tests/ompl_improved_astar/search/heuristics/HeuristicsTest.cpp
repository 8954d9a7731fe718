// The heuristics that know no obstacles, and their weights: never above what has been driven, and exact where the
// shortest path is known.

#include "ompl_improved_astar/search/Heuristic.h"
#include "ompl_improved_astar/search/HeuristicWeights.h"
#include "tests/ompl_improved_astar/search/GridWorld.h"

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
    /** A heuristic of a car in a query. */
    class Query
    {
    public:
        explicit Query(const std::string &name, double turningRadius = 3.0, bool forwardOnly = false)
          : heuristic_(heuristics().make(name))
        {
            car_.turningRadius = turningRadius;
            car_.forwardOnly = forwardOnly;
        }

        void begin(Side side, const std::vector<Pose> &targets)
        {
            heuristic_->begin({world_, parameters_, car_, cost_}, side, targets);
        }

        Heuristic *operator->()
        {
            return heuristic_.get();
        }

    private:
        GridWorld world_{1, 1};
        PlannerParameters parameters_;
        CarInSpace car_;
        CostModel cost_;
        std::unique_ptr<Heuristic> heuristic_;
    };

    Path randomDrive(Random &random, double radius, bool forwardOnly)
    {
        Path path{random.poseIn(-5.0, 5.0), {}};
        for (std::size_t count = 1 + random.index(6); count > 0; --count)
        {
            const double length = random.between(0.1, 2.5) * radius;
            path.append({random.between(-1.0, 1.0) / radius, !forwardOnly && random.chance(0.5) ? -length : length});
        }
        return path;
    }

    /** Of `curves` the estimate is a bound, too. */
    const std::vector<std::string> NAMES{"curves", "straight", "octile", "manhattan"};
}  // namespace

TEST(Heuristics, theLowerBoundIsNeverAboveADriveFromEitherEnd)
{
    for (const std::string &name : NAMES)
        for (const bool forwardOnly : {false, true})
            for (const double radius : {0.2, 3.7, 10.0})
            {
                Query query(name, radius, forwardOnly);
                Random random(6);
                for (int i = 0; i < 3000; ++i)
                {
                    const Path path = randomDrive(random, radius, forwardOnly);
                    const double length = path.length() + 1e-6 * radius;
                    query.begin(Side::Start, {path.end()});
                    ASSERT_LE(query->lowerBound(path.start), length) << name;
                    query.begin(Side::Goal, {path.start});
                    ASSERT_LE(query->lowerBound(path.end()), length) << name;
                }
            }
}

/** No path is shorter than the straight line, or turns faster than at full lock: such drives are shortest. */
TEST(Heuristics, curvesAreExactForLinesAndArcsAtFullLock)
{
    Random random(4);
    for (const bool forwardOnly : {false, true})
        for (const double radius : {0.2, 4.0})
        {
            Query query("curves", radius, forwardOnly);
            for (int i = 0; i < 500; ++i)
            {
                const bool isLine = random.chance(0.5), isReverse = !forwardOnly && random.chance(0.5);
                const double length = (isLine ? random.between(0.0, 50.0) : random.between(0.0, PI)) * radius,
                             curvature = isLine ? 0.0 : (random.chance(0.5) ? 1.0 : -1.0) / radius;
                const Pose from = random.poseIn(-9.0, 9.0), to = advance(from, curvature, isReverse ? -length : length);
                query.begin(Side::Start, {to});
                ASSERT_NEAR(query->lowerBound(from), length, 1e-6 * radius);
                ASSERT_EQ(query->estimate(from), query->lowerBound(from));
                query.begin(Side::Goal, {from});
                ASSERT_NEAR(query->lowerBound(to), length, 1e-6 * radius);
                // Back to where a straight drive began there is no path in reverse, but only round a circle.
                query.begin(Side::Start, {from});
                ASSERT_TRUE(!forwardOnly || !isLine || length < 0.1 * radius ||
                            query->lowerBound(to) > length + radius);
            }
        }
}

TEST(Heuristics, severalTargetsAreAsNearAsTheNearestAndForgottenAtBegin)
{
    Random random(5);
    for (const std::string &name : NAMES)
        for (const Side side : {Side::Start, Side::Goal})
        {
            Query all(name), each(name);
            for (int round = 0; round < 20; ++round)
            {
                std::vector<Pose> targets;
                for (std::size_t count = 1 + random.index(5); count > 0; --count)
                    targets.push_back(random.poseIn(-10.0, 10.0));
                all.begin(side, targets);
                for (int i = 0; i < 20; ++i)
                {
                    const Pose pose = random.poseIn(-15.0, 15.0);
                    double estimate = HUGE_VAL, bound = HUGE_VAL;
                    for (const Pose &target : targets)
                    {
                        each.begin(side, {target});
                        estimate = std::min(estimate, each->estimate(pose));
                        bound = std::min(bound, each->lowerBound(pose));
                    }
                    ASSERT_EQ(all->estimate(pose), estimate) << name;
                    ASSERT_EQ(all->lowerBound(pose), bound) << name;
                }
            }
        }
}

TEST(Heuristics, onAnEmptyGridTheMetricsAreWhatTheirNeighboursNeed)
{
    GridWorld world(15, 15);
    for (const Pose &goal : {Pose{7.5, 7.5, 0.0}, Pose{0.5, 0.5, 0.0}, Pose{14.5, 3.5, 0.0}})
    {
        Query octile("octile"), straight("straight"), manhattan("manhattan");
        for (Query *query : {&octile, &straight, &manhattan})
            query->begin(Side::Start, {goal});
        for (int i = 0; i < 15 * 15; ++i)
        {
            const Pose from{i % 15 + 0.5, i / 15 + 0.5, 0.0};
            ASSERT_NEAR(octile->estimate(from), shortestByDijkstra(world, from, goal, false), 1e-9);
            ASSERT_NEAR(manhattan->estimate(from), std::abs(from.x - goal.x) + std::abs(from.y - goal.y), 1e-9);
            ASSERT_NEAR(straight->estimate(from), positionDistance(from, goal), 1e-9);
        }
    }
}

TEST(Heuristics, anAimMovesTheEstimateButNotTheBound)
{
    Random random(7);
    for (const std::string &name : NAMES)
    {
        Query query(name), atAim(name);
        const bool canAim = name != "curves";
        for (int i = 0; i < 100; ++i)
        {
            const Pose target = random.poseIn(-9.0, 9.0), aim = random.poseIn(-9.0, 9.0),
                       pose = random.poseIn(-9.0, 9.0);
            query.begin(Side::Start, {target});
            atAim.begin(Side::Start, {aim});
            const double estimate = query->estimate(pose), bound = query->lowerBound(pose);
            query->aim(aim);
            ASSERT_EQ(query->estimate(pose), canAim ? atAim->estimate(pose) : estimate) << name;
            ASSERT_EQ(query->lowerBound(pose), bound) << name;
            query.begin(Side::Start, {target});
            ASSERT_EQ(query->estimate(pose), estimate) << "the aim is forgotten";
        }
    }
}

TEST(HeuristicWeights, aLoweredWeightIsNeitherRaisedNorBelowOneUnlessItWas)
{
    Random random(8);
    for (int i = 0; i < 1000; ++i)
    {
        const HeuristicWeights weights{random.between(0.0, 3.0), random.between(0.0, 3.0), random.between(0.0, 9.0),
                                       0.1};
        const double factor = random.between(0.1, 0.99);
        ASSERT_EQ(weights.at(weights.nearDistance), weights.near + 0.1);
        ASSERT_EQ(weights.at(std::nextafter(weights.nearDistance, HUGE_VAL)), weights.far + 0.1);
        ASSERT_EQ(weights.canBeLowered(), std::max(weights.far, weights.near) > 1.0);
        const HeuristicWeights lower = weights.lowered(factor);
        for (const double HeuristicWeights::*each : {&HeuristicWeights::far, &HeuristicWeights::near})
            ASSERT_EQ(lower.*each, weights.*each <= 1.0 ? weights.*each : std::max(1.0, factor * weights.*each));
    }
}

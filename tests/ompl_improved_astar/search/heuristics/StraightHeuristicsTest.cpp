// The paper's three distances: Manhattan, diagonal and Euclidean.

#include "benchmarks/worlds/Random.h"
#include "ompl_improved_astar/search/Heuristic.h"
#include "tests/ompl_improved_astar/search/GridWorld.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

using namespace parking;
using namespace parking::search;
using parking_test::GridWorld;
using parking_test::Random;
using parking_test::randomGrid;

namespace
{
    struct Estimates
    {
        double straight, octile, manhattan;
    };

    Estimates estimates(const Pose &pose, const Pose &target)
    {
        GridWorld world = randomGrid(1, 0.0);
        const SearchParameters parameters = world.parameters();
        const std::vector<Pose> roots{pose}, targets{target};
        const StopFunction stop;
        Estimates result{};
        for (const auto &[name, value] :
             {std::pair{"straight", &result.straight}, {"octile", &result.octile}, {"manhattan", &result.manhattan}})
        {
            const std::unique_ptr<Heuristic> heuristic = heuristics().make(name);
            heuristic->begin({world, parameters, Side::Start, roots, targets, stop});
            *value = heuristic->estimate(pose);
            EXPECT_DOUBLE_EQ(heuristic->lowerBound(pose), std::hypot(target.x - pose.x, target.y - pose.y)) << name;
        }
        return result;
    }
}  // namespace

TEST(StraightHeuristics, areThePapersDistances)
{
    const Estimates of = estimates({1.0, 2.0, 0.0}, {4.0, -2.0, 1.0});
    EXPECT_DOUBLE_EQ(of.straight, 5.0);
    EXPECT_DOUBLE_EQ(of.octile, 4.0 + (std::sqrt(2.0) - 1.0) * 3.0);
    EXPECT_DOUBLE_EQ(of.manhattan, 7.0);
}

TEST(StraightHeuristics, areInOrderAndAgreeAlongTheAxes)
{
    Random random(5);
    for (int i = 0; i < 200; ++i)
    {
        const Pose from{random.between(-9.0, 9.0), random.between(-9.0, 9.0), 0.0};
        const Pose to{random.between(-9.0, 9.0), random.between(-9.0, 9.0), 0.0};
        const Estimates any = estimates(from, to), along = estimates(from, {to.x, from.y, 0.0});
        ASSERT_LE(any.straight, any.octile);
        ASSERT_LE(any.octile, any.manhattan);
        ASSERT_NEAR(along.straight, along.manhattan, 1e-12);
    }
}

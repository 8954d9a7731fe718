#include "state_validity/sweeps/PathSweep.h"

#include "benchmarks/worlds/RandomParking.h"
#include "tests/parking_geometry/PolygonWorld.h"

#include <cmath>

#include <gtest/gtest.h>

using namespace parking;
using parking_test::PolygonWorld;
using parking_test::RandomParking;

namespace
{
    Polygon box(double x, double y, double halfSize)
    {
        return {{x - halfSize, y - halfSize},
                {x + halfSize, y - halfSize},
                {x + halfSize, y + halfSize},
                {x - halfSize, y + halfSize}};
    }

    /** Arcs and clothoids, and here and there a turn on the spot. */
    Path anyPath(RandomParking &random, bool turns)
    {
        Path path{random.pose(5.0), {}};
        for (int i = 0; i < 4; ++i)
        {
            path.append({random.between(-0.3, 0.3), random.between(-2.0, 2.0), random.between(-0.3, 0.3)});
            path.append({random.between(-0.3, 0.3), random.between(-2.0, 2.0)});
            if (turns && random.chance(0.5))
                path.append(PathPiece::turnOnTheSpot(random.between(-0.5, 0.5)));
        }
        return path;
    }

    /** Poses at most 5 mm and 2 mrad apart. */
    std::vector<Pose> densely(const Path &path)
    {
        std::vector<Pose> poses;
        const SampledPath states = path.sample(0.005);
        for (std::size_t i = 0; i < states.size(); ++i)
        {
            const double turn = i > 0 && states[i].arcLength == states[i - 1].arcLength
                                    ? wrapAngle(states[i].pose.yaw - states[i - 1].pose.yaw)
                                    : 0.0;
            for (int k = static_cast<int>(std::abs(turn) / 0.002); k > 0; --k)
                poses.push_back({states[i].pose.x, states[i].pose.y,
                                 states[i].pose.yaw - turn * k / std::ceil(std::abs(turn) / 0.002)});
            poses.push_back(states[i].pose);
        }
        return poses;
    }
}  // namespace

TEST(PathSweep, AgreesWithDenseSampling)
{
    RandomParking random(1);
    int free = 0, blocked = 0;
    for (int i = 0; i < 600; ++i)
    {
        const Vehicle car = random.vehicle();
        const Path path = anyPath(random, i % 3 == 0);
        const std::vector<Pose> poses = densely(path);
        std::vector<Polygon> obstacles;
        for (int k = 0; k < 2; ++k)
        {
            const Pose near = poses[static_cast<std::size_t>(random.below(static_cast<int>(poses.size())))];
            const Pose spot = compose(
                near, {random.between(-2.0, 5.0),
                       (random.chance(0.5) ? 1.0 : -1.0) * (0.5 * car.width + random.between(-0.05, 0.6)), 0.0});
            obstacles.push_back(box(spot.x, spot.y, random.between(0.01, 0.1)));
        }
        const PolygonWorld world(car, obstacles);
        const FootprintChecker checker(ObstacleSet::fromPolygons(obstacles, Box{{-100.0, -100.0}, {100.0, 100.0}}),
                                       car);
        double least = 1e9;
        for (const Pose &pose : poses)
            least = std::min(least, world.isFree(pose) ? world.clearance(pose) : -1.0);
        const bool found = isPathFree(checker, path);
        if (least < 0.0)
        {
            EXPECT_FALSE(found) << i;
        }
        else if (least > 5e-3)
        {
            EXPECT_TRUE(found) << i << " although the distance is never below " << least;
        }
        EXPECT_EQ(queriesOf(checker).isPathFree(path), found);
        ++(found ? free : blocked);
    }
    EXPECT_GT(free, 100);
    EXPECT_GT(blocked, 100);
}

TEST(PathSweep, TheEndOfAPathCountsAndSoDoesItsOnlyPose)
{
    const Vehicle car;
    const double front = car.wheelbase + car.frontOverhang;
    const std::vector<Polygon> wall{box(front + 3.0, 0.0, 1.0)};
    const FootprintChecker checker(ObstacleSet::fromPolygons(wall, Box{{-20.0, -20.0}, {20.0, 20.0}}), car);
    EXPECT_TRUE(isPathFree(checker, {{}, {{0.0, 1.9}}}));
    EXPECT_FALSE(isPathFree(checker, {{}, {{0.0, 2.1}}}));
    EXPECT_FALSE(isPathFree(checker, {{}, {{0.0, 2.1, 0.01}}}));
    EXPECT_TRUE(isPathFree(checker, {{}, {}}));
    EXPECT_FALSE(isPathFree(checker, {{3.0, 0.0, 0.0}, {}}));
    EXPECT_FALSE(isPathFree(checker, {{front + 1.5, -3.0, 0.0}, {PathPiece::turnOnTheSpot(3.0)}}))
        << "the front swings past";
    EXPECT_TRUE(checker.isFree({front + 1.5, -3.0, 0.0}) && checker.isFree({front + 1.5, -3.0, 3.0}));
}

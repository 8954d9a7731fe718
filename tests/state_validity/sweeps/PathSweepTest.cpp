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

    /** The least clearance along a path without turns on the spot, negative when a pose touches: every 5 mm, and every
        0.2 mm where little is left. */
    double leastClearance(const Path &path, const PolygonWorld &world)
    {
        constexpr double STEP = 5e-3, FINE_STEP = 2e-4;
        double least = 1e9;
        Pose begin = path.start;
        for (const PathPiece &piece : path.pieces)
        {
            const auto clearanceAt = [&](double driven)
            {
                const Pose pose = advance(begin, piece, std::min(driven, piece.driven()));
                return world.isFree(pose) ? world.clearance(pose) : -1.0;
            };
            for (double driven = 0.0; driven < piece.driven() + STEP; driven += STEP)
            {
                const double clearance = clearanceAt(driven);
                least = std::min(least, clearance);
                if (clearance < 0.01)
                    for (double fine = driven - STEP; fine < driven + STEP; fine += FINE_STEP)
                        least = std::min(least, clearanceAt(std::max(fine, 0.0)));
            }
            begin = advance(begin, piece);
        }
        return least;
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
            obstacles.push_back(parking_test::square(spot.x, spot.y, random.between(0.01, 0.1)));
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

TEST(PathSweep, APathThatPassesWithinAMillimetreTouchesNothing)
{
    RandomParking random(2);
    int passed = 0, refused = 0, touched = 0;
    for (int i = 0; i < 100; ++i)
    {
        const Vehicle car = random.vehicle();
        const Path path = anyPath(random, false);
        const std::vector<Pose> poses = densely(path);
        const Pose near = poses[static_cast<std::size_t>(random.below(static_cast<int>(poses.size())))];
        const Pose spot = compose(
            near, {random.between(-1.0, 4.0), (random.chance(0.5) ? 1.0 : -1.0) * (0.5 * car.width + 0.3), 0.0});
        const double wanted = random.between(-2e-4, 6e-4);  // metres that the car keeps from the box
        double halfSize = 0.2, least = 0.0;
        for (int grown = 0; grown < 10; ++grown)
        {
            least = leastClearance(path, PolygonWorld(car, {parking_test::square(spot.x, spot.y, halfSize)}));
            if (std::abs(least - wanted) < 1e-4)
                break;
            halfSize = std::max(1e-3, halfSize + (least < 0.0 ? -0.01 : 0.7 * (least - wanted)));
        }
        least = leastClearance(path, PolygonWorld(car, {parking_test::square(spot.x, spot.y, halfSize)}));
        const FootprintChecker checker(ObstacleSet::fromPolygons({parking_test::square(spot.x, spot.y, halfSize)},
                                                                 Box{{-100.0, -100.0}, {100.0, 100.0}}),
                                       car);
        if (least < 0.0)
        {
            ++touched;
            EXPECT_FALSE(touchesNothing(checker, path)) << i;
        }
        else if (least > 5e-5 && least < 9e-4)
        {
            ++passed;
            refused += isPathFree(checker, path) ? 0 : 1;
            EXPECT_TRUE(touchesNothing(checker, path)) << i << " at " << least;
        }
    }
    EXPECT_GT(passed, 20);
    EXPECT_GT(refused, 10) << "of those that passed, by the sweep that keeps a millimetre";
    EXPECT_GT(touched, 20);
}

TEST(PathSweep, AClothoidThatBeginsBesideAPostTouchesNoMoreThanItSays)
{
    // Towards a post at first, and away from it: the arcs that take the place of such a clothoid never come nearer.
    RandomParking random(5);
    const Vehicle car;
    int touching = 0, near = 0;
    for (int i = 0; i < 200; ++i)
    {
        const double sharpness = -random.between(0.05, 0.3), length = random.between(0.5, 2.0);
        const double reach = std::hypot(car.wheelbase + car.frontOverhang, 0.5 * car.width);
        const double parts = 1.0 + std::floor(length * std::sqrt(-sharpness * (reach / 8.0 + length / 12.0) / 1e-4));
        const Path path{{}, {{-0.5 * sharpness * length / parts, length, sharpness}}};
        const double x = random.between(2.5, 3.6), y = 0.5 * car.width + std::pow(10.0, random.between(-6.0, -3.5));
        const std::vector<Polygon> post{{{x, y}, {x + 0.02, y + 0.2}, {x - 0.02, y + 0.2}}};
        const FootprintChecker checker(ObstacleSet::fromPolygons(post, Box{{-12.0, -12.0}, {12.0, 12.0}}), car);
        // How far the tip is from the car's left side.
        double least = 1.0;
        for (double driven = 0.0; driven < length; driven += 1e-3)
            least = std::min(least, relativeTo(advance({}, path.pieces[0], driven), {x, y, 0.0}).y - 0.5 * car.width);
        if (least <= 0.0)
        {
            ++touching;
            EXPECT_FALSE(isPathFree(checker, path)) << i;
            EXPECT_FALSE(touchesNothing(checker, path)) << i;
        }
        else if (least > 2e-5)
        {
            ++near;
            EXPECT_TRUE(touchesNothing(checker, path)) << i << ": " << least;
        }
    }
    EXPECT_GT(touching, 50);
    EXPECT_GT(near, 20);
}

TEST(PathSweep, TheEndOfAPathCountsAndSoDoesItsOnlyPose)
{
    const Vehicle car;
    const double front = car.wheelbase + car.frontOverhang;
    const std::vector<Polygon> wall{parking_test::square(front + 3.0, 0.0, 1.0)};
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

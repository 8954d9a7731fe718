// The referee leaves poses out where there is room: what it says must be what a look at every pose says.

#include "parking_geometry/referee/Referee.h"

#include "benchmarks/worlds/PolygonOracle.h"
#include "benchmarks/worlds/RandomParking.h"
#include "benchmarks/worlds/RandomWorlds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace
{
    using namespace parking;
    using parking_test::RandomParking;

    Scenario openGround(const Vehicle &car, double extent)
    {
        Scenario scenario;
        scenario.vehicle = car;
        scenario.bounds = {{-extent, -extent}, {extent, extent}};
        return scenario;
    }

    /** Obstacles strewn over 120 m x 120 m, so that paths of some 20 m meet some and miss many. */
    Scenario strewn(RandomParking &random)
    {
        Scenario scenario = openGround(random.vehicle(), 60.0);
        for (int i = random.below(120); i >= 0; --i)
            scenario.polygons.push_back(parking_test::star(random, random.between(-60.0, 60.0),
                                                           random.between(-60.0, 60.0), random.between(0.02, 3.0)));
        return scenario;
    }

    Scenario cells(RandomParking &random)
    {
        Scenario scenario = openGround(random.vehicle(), 60.0);
        OccupancyGrid grid(240, 240, 0.5, {-60.0, -60.0, random.between(-0.2, 0.2)});
        for (int i = random.below(400); i >= 0; --i)
            grid.set(random.index(240), random.index(240), random.chance(0.5) ? Cell::Occupied : Cell::Unknown);
        scenario.unknownIsOccupied = random.chance(0.5);
        scenario.grid = grid;
        return scenario;
    }

    /** Clothoids among the pieces, as smooth paths have them, and long straight lines. */
    Path somePath(RandomParking &random, const Vehicle &car)
    {
        Path path = random.plannerPath(car, 1.2);
        if (random.chance(0.5))
            path.append({0.0, random.between(-40.0, 40.0)});
        if (random.chance(0.5))
            path.append({0.0, random.between(-9.0, 9.0), random.between(-0.01, 0.01)});
        return path;
    }

    /** The poses that the referee decides. */
    std::vector<Pose> allPoses(const Path &path, double farthest)
    {
        std::vector<Pose> poses{path.start};
        Pose pose = path.start;
        for (const PathPiece &piece : path.pieces)
        {
            const double curvature = std::max(std::abs(piece.curvature), std::abs(piece.endCurvature()));
            const double way = piece.driven() * (1.0 + farthest * curvature);
            const double steps = std::max(1.0, std::ceil(way / Referee::STEP));
            for (double k = 1.0; k <= steps; ++k)
                poses.push_back(advance(pose, piece, k / steps * piece.driven()));
            pose = advance(pose, piece);
        }
        return poses;
    }

    void expectSameVerdicts(const std::function<Scenario(RandomParking &)> &world, double radius)
    {
        RandomParking random(11);
        int valid = 0, collided = 0;
        for (int i = 0; i < 150; ++i)
        {
            Scenario scenario = world(random);
            const Path path = somePath(random, scenario.vehicle);
            scenario.start = path.start;
            scenario.goals = {path.end()};
            const Referee referee(scenario, radius);
            const Verdict verdict = referee.check(path);
            std::size_t states = 0, collisions = 0;
            for (const Pose &pose : allPoses(path, referee.space().farthestPoint()))
            {
                ++states;
                collisions += referee.space().isFree(pose) ? 0 : 1;
            }
            ASSERT_EQ(verdict.states, states) << i;
            ASSERT_EQ(verdict.collisions, collisions) << i;
            ASSERT_EQ(verdict.valid, collisions == 0) << i << " " << verdict.reason;
            ASSERT_EQ(verdict.fault, collisions == 0 ? Fault::None : Fault::Collision) << i;
            ++(collisions == 0 ? valid : collided);
        }
        EXPECT_GT(valid, 20);
        EXPECT_GT(collided, 20);
    }

    TEST(SecondLook, SaysWhatEveryPoseSaysAmongPolygons)
    {
        expectSameVerdicts(strewn, 0.0);
    }

    TEST(SecondLook, SaysWhatEveryPoseSaysOnAMap)
    {
        expectSameVerdicts(cells, 0.0);
    }

    TEST(SecondLook, SaysWhatEveryPoseSaysOfADisc)
    {
        expectSameVerdicts(strewn, 1.1);
        expectSameVerdicts(cells, 1.1);
    }

    TEST(SecondLook, LinesAreNoLessSeen)
    {
        RandomParking random(12);
        int valid = 0, collided = 0;
        for (int i = 0; i < 100; ++i)
        {
            Scenario scenario = strewn(random);
            std::vector<Pose> poses;
            for (int k = 0; k < 6; ++k)
                poses.push_back(random.pose(random.chance(0.5) ? 20.0 : 4.0));
            scenario.start = poses.front();
            scenario.goals = {poses.back()};
            const Referee referee(scenario);
            const Verdict verdict = referee.checkLines(poses);
            std::size_t collisions = referee.space().isFree(poses.front()) ? 0 : 1;
            for (std::size_t k = 1; k < poses.size(); ++k)
            {
                const Pose &from = poses[k - 1], &to = poses[k];
                const double turn = wrapAngle(to.yaw - from.yaw);
                const double way = positionDistance(from, to) + referee.space().farthestPoint() * std::abs(turn);
                const double steps = std::max(1.0, std::ceil(way / Referee::STEP));
                for (double n = 1.0; n <= steps; ++n)
                    if (!referee.space().isFree({from.x + n / steps * (to.x - from.x),
                                                 from.y + n / steps * (to.y - from.y), from.yaw + n / steps * turn}))
                        ++collisions;
            }
            ASSERT_EQ(verdict.collisions, collisions) << i;
            ++(collisions == 0 ? valid : collided);
        }
        EXPECT_GT(valid, 10);
        EXPECT_GT(collided, 10);
    }

    /** Occupied cells, each a polygon of its own, for the oracle. */
    std::vector<Polygon> squares(const Scenario &scenario)
    {
        std::vector<Polygon> result;
        const OccupancyGrid &grid = *scenario.grid;
        for (std::size_t row = 0; row < grid.height(); ++row)
            for (std::size_t column = 0; column < grid.width(); ++column)
                if (grid.at(column, row) == Cell::Occupied ||
                    (grid.at(column, row) == Cell::Unknown && scenario.unknownIsOccupied))
                {
                    const double half = 0.5 * grid.resolution();
                    const Pose middle = compose(grid.origin(), {half * static_cast<double>(2 * column + 1),
                                                                half * static_cast<double>(2 * row + 1), 0.0});
                    result.push_back(
                        parking_test::rectangle(2.0 * half, 2.0 * half, {middle.x, middle.y, grid.origin().yaw}));
                }
        return result;
    }

    TEST(SecondLook, ClearancesOfPosesAreTheOracles)
    {
        RandomParking random(13);
        int known = 0;
        for (int i = 0; i < 40; ++i)
        {
            const bool isGrid = i % 2 == 1;
            const Scenario scenario = isGrid ? cells(random) : strewn(random);
            const FreeSpace space(scenario);
            const parking_test::PolygonOracle oracle(isGrid ? squares(scenario) : scenario.polygons,
                                                     isGrid ? Box{{-1e4, -1e4}, {1e4, 1e4}} : scenario.bounds);
            for (int k = 0; k < 100; ++k)
            {
                // Of maps not the rim: the oracle does not know a turned one.
                const Pose pose = random.pose(isGrid ? 30.0 : 60.0);
                const double expected = oracle.clearance(pose, scenario.vehicle);
                if (isGrid && expected > 10.0)
                    continue;
                ASSERT_NEAR(space.clearance(pose, INFINITY), expected, 1e-6) << i << " " << k;
                known += expected > 0.0 ? 1 : 0;
            }
        }
        EXPECT_GT(known, 1000);
    }

    TEST(SecondLook, TheLeastClearanceIsThatOfTheNearestPose)
    {
        RandomParking random(14);
        int known = 0;
        for (int i = 0; i < 120; ++i)
        {
            const bool isGrid = i % 2 == 1;
            Scenario scenario = isGrid ? cells(random) : strewn(random);
            const double radius = i % 3 == 0 ? 0.9 : 0.0;
            const Path path = somePath(random, scenario.vehicle);
            const Referee referee(scenario, radius);
            double dense = INFINITY;
            for (const Pose &pose : allPoses(path, referee.space().farthestPoint()))
                dense = std::min(dense, referee.space().clearance(pose, dense));
            const double found = referee.minClearance(path);
            // Between two poses the body comes no nearer than half a step.
            ASSERT_GE(found, dense - 0.5 * Referee::STEP - 1e-9) << i;
            ASSERT_LE(found, dense + std::max(Referee::CLEARANCE, 0.01 * dense) + 1e-9) << i;
            const double lines = referee.minClearance(std::vector<Pose>{path.start, path.end()});
            ASSERT_LE(lines, referee.space().clearance(path.start, INFINITY) + 1e-12);
            known += dense > 0.0 ? 1 : 0;
        }
        EXPECT_GT(known, 30);
    }

    /** A row of posts on both sides of a slalom of 10 km: no step of it may be left out, and it must not take long. */
    TEST(SecondLook, SeesOnePostInTenKilometres)
    {
        Scenario scenario;
        scenario.vehicle = vehicleByName("vw_golf8");
        scenario.bounds = {{-20.0, -20.0}, {10100.0, 20.0}};
        Path path{{0.0, 0.0, 0.0}, {}};
        while (path.end().x < 9990.0)
            for (const double curvature : {0.02, -0.02, -0.02, 0.02})
                path.append({curvature, 5.0});
        for (double x = 0.0; x < 10000.0; x += 7.0)
            for (const double y : {-3.0, 4.0})
                scenario.polygons.push_back({{x, y}, {x + 0.1, y}, {x + 0.1, y + 0.1}, {x, y + 0.1}});
        scenario.start = path.start;
        scenario.goals = {path.end()};
        const Referee free(scenario);
        const Verdict good = free.check(path);
        EXPECT_TRUE(good.valid) << good.reason;
        EXPECT_GT(good.states, 2000000U);
        const double least = free.minClearance(path);
        EXPECT_GT(least, 1.0);
        EXPECT_LT(least, 2.5);
        scenario.polygons.push_back({{7654.0, 0.9}, {7654.01, 0.9}, {7654.01, 0.91}, {7654.0, 0.91}});
        EXPECT_EQ(Referee(scenario).check(path).fault, Fault::Collision);
        EXPECT_EQ(Referee(scenario).minClearance(path), 0.0);
    }
}  // namespace

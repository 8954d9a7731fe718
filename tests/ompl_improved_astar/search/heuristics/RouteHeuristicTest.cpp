// The shortest routes of a disc: compared with Dijkstra's algorithm in any order of questions, and as lower bounds.

#include "ompl_improved_astar/search/heuristics/RouteHeuristic.h"
#include "tests/ompl_improved_astar/search/CarWorlds.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

using namespace parking::search;
using namespace parking_test;
using Eigen::Vector2d;
using parking::Pose;

namespace
{
    constexpr std::uint64_t MAX_CELLS = 1000000;
    const StopFunction never;

    using Cell = std::pair<int, int>;

    /** Cells of a metre that are blocked, costly or free, and the routes of a disc between them. */
    struct CellWorld : DiscCarWorld
    {
        explicit CellWorld(std::uint64_t seed)
          : DiscCarWorld({}),
            random(seed),
            disc{1.0, 2.0, seed % 2 == 0 ? 1.0 : 21.0}
        {
            const double blocked = random.between(0.2, 0.6);
            for (double &clearance : clearances)
                clearance = random.chance(blocked) ? 0.0 : random.chance(0.5) ? 1.0 : 3.0;
            for (std::uint64_t i = 0; i <= seed % 3; ++i)
                targets.push_back(anyCell());
            begin(targets);
        }

        void begin(const std::vector<Cell> &of)
        {
            const Cell toward = anyCell();
            routes.begin(*this, 1.0, disc, Vector2d(toward.first, toward.second), never, MAX_CELLS);
            for (const Cell &cell : of)
                routes.addTarget(cell.first + 0.5, cell.second + 0.5);
        }

        /** The lengths of the shortest routes by Dijkstra's algorithm. */
        std::map<Cell, double> baseline() const
        {
            using Open = std::pair<double, Cell>;
            std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
            for (const Cell &target : targets)
                open.push({0.0, target});
            std::map<Cell, double> lengths;
            while (!open.empty())
            {
                const auto [length, cell] = open.top();
                open.pop();
                if (!lengths.emplace(cell, length).second)
                    continue;
                for (const int dx : {-1, 0, 1})
                    for (const int dy : {-1, 0, 1})
                    {
                        const Cell next{cell.first + dx, cell.second + dy};
                        const double factor = clearanceOf(next) < disc.wideRadius ? disc.costFactor : 1.0;
                        if (clearanceOf(next) >= disc.radius)
                            open.push({length + (dx != 0 && dy != 0 ? 17.0 / 12.0 : 1.0) * factor, next});
                    }
            }
            return lengths;
        }

        Box bounds() const override
        {
            return {{2.75, -100.0}, {100.0, 100.0}};
        }

        double roomAt(double x, double y) override
        {
            ++roomsAsked;
            return clearanceOf({static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y))});
        }

        Cell anyCell()
        {
            return {random.below(SIZE), random.below(SIZE)};
        }

        double clearanceOf(const Cell &cell) const
        {
            const bool isInside = cell.first >= 2 && cell.second >= 0 && cell.first < SIZE && cell.second < SIZE;
            return isInside ? clearances[static_cast<std::size_t>(cell.first * SIZE + cell.second)] : 0.0;
        }

        static constexpr int SIZE = 60;
        Random random;
        Disc disc;
        std::array<double, SIZE * SIZE> clearances;
        std::vector<Cell> targets;
        RouteHeuristic routes;
    };

    /** The routes of a disc to one target. */
    RouteHeuristic routesTo(const Vector2d &target, DiscCarWorld &world, double side, double radius,
                            const Vector2d &toward, const StopFunction &stop = never,
                            std::uint64_t maxCells = MAX_CELLS)
    {
        RouteHeuristic routes;
        routes.begin(world, side, {radius}, toward, stop, maxCells);
        routes.addTarget(target.x(), target.y());
        return routes;
    }
}  // namespace

TEST(RouteHeuristic, isDijkstrasDistanceInAnyOrderOfQuestions)
{
    int known = 0, aimed = 0, closed = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed)
    {
        SCOPED_TRACE(seed);
        CellWorld world(seed);
        const std::map<Cell, double> baseline = world.baseline();
        if (seed % 5 == 0)
            world.routes.load({{0.0, 0.0}, {60.0, 60.0}});
        for (int i = 0; i < 100; ++i)
        {
            const Cell cell = world.anyCell();
            const auto found = baseline.find(cell);
            const double expected = found == baseline.end() ? HUGE_VAL : found->second;
            const double x = cell.first + world.random.between(0.0, 1.0), y = cell.second + 0.5;
            const std::uint64_t cells = world.routes.cells(), queries = world.roomsAsked;
            const std::optional<double> told = world.routes.knownDistance(x, y);
            ASSERT_EQ(world.roomsAsked, queries);
            const double distance = world.routes.distance(x, y);
            ASSERT_NEAR(std::min(distance, 1e6), std::min(expected, 1e6), 1e-6);
            ASSERT_EQ(world.routes.provesUnreachable({x, y, 0.0}), expected == HUGE_VAL);
            ASSERT_TRUE(world.routes.knownDistance(x, y) || world.roomAt(x, y) == 0.0);
            ASSERT_TRUE(!told || (*told == distance && world.routes.cells() == cells));
            known += told ? 1 : 0;
            aimed += distance < HUGE_VAL && world.routes.cells() > cells + 200 ? 1 : 0;
            closed += expected == HUGE_VAL && world.roomAt(x, y) > 0.0 ? 1 : 0;
        }
    }
    EXPECT_GT(known, 1000);
    EXPECT_GT(aimed, 50);
    EXPECT_GT(closed, 50);
}

TEST(RouteHeuristic, placesLieOnAShortestRoute)
{
    int found = 0;
    for (std::uint64_t seed = 0; seed < 600; seed += 2)
    {
        SCOPED_TRACE(seed);
        CellWorld world(seed), back(seed);
        const Cell cell = world.anyCell();
        back.begin({cell});
        const double x = cell.first + 0.5, y = cell.second + 0.5, length = world.routes.distance(x, y);
        const double ahead = world.random.between(0.0, 30.0), around = world.random.between(0.0, ahead);
        const std::optional<Pose> place = world.routes.placeOnRoute(x, y, ahead, around);
        const bool isFarEnough = length < HUGE_VAL && length > ahead + around;
        EXPECT_TRUE(isFarEnough ? place || around < 2.0 : !place);
        if (!place)
            continue;
        ++found;
        const double driven = back.routes.distance(place->x, place->y);
        EXPECT_NEAR(driven + world.routes.distance(place->x, place->y), length, 1e-9);
        EXPECT_GE(driven, ahead - 1e-9);
        EXPECT_LT(driven, ahead + 17.0 / 12.0);
    }
    EXPECT_GT(found, 50);
}

TEST(RouteHeuristic, placesAreHeadedAlongTheRoute)
{
    DiscCarWorld world({{-60.0, -60.0}, {60.0, 60.0}});
    for (const double yaw : {0.0, 0.25 * parking::PI, 0.5 * parking::PI, parking::PI, -0.75 * parking::PI})
    {
        const Vector2d from(0.25, 0.25), target = from + 20.0 * Vector2d(std::cos(yaw), std::sin(yaw));
        RouteHeuristic routes = routesTo(target, world, 0.5, 1.0, {0.0, 0.0});
        EXPECT_NEAR(routes.placeOnRoute(from.x(), from.y(), 5.0, 3.0)->yaw, yaw, 1e-9);
        EXPECT_FALSE(routes.placeOnRoute(from.x(), from.y(), 5.0, 0.0));
    }
}

TEST(RouteHeuristic, nearestReachableIsTheNearestCellWithARoute)
{
    for (std::uint64_t seed = 0; seed < 100; ++seed)
    {
        CellWorld world(seed);
        if (seed % 2 == 1)
            world.routes.distance(30.5, 30.5);
        const Vector2d goal(world.random.between(-20.0, 80.0), world.random.between(-20.0, 80.0));
        double nearest = HUGE_VAL;
        for (const auto &[cell, length] : world.baseline())
            nearest = std::min(nearest, (Vector2d(cell.first + 0.5, cell.second + 0.5) - goal).norm());
        const Vector2d place = world.routes.nearestReachable(goal);
        EXPECT_NEAR((place - goal).norm(), nearest, 1e-9);
        EXPECT_LT(world.routes.distance(place.x(), place.y()), HUGE_VAL);
    }
}

TEST(RouteHeuristic, lowerBoundIsNeverAboveAStraightRoute)
{
    double tightest = 0.0;
    for (std::uint64_t seed = 0; seed < 500; ++seed)
    {
        DiscCarWorld world = randomField(seed);
        Random random(seed);
        const double radius = random.between(0.2, 1.0), side = random.between(0.2, 0.5);
        const Pose a = random.poseIn(-11.0, 11.0), away = random.poseIn(-10.0, 10.0);
        const double near = random.chance(0.5) ? 0.01 : 1.0;
        const Pose b{a.x + near * away.x, a.y + near * away.y, 0.0};
        bool isFree = true;
        for (double share = 0.0; share <= 1.0; share += 1e-3)
            isFree = isFree && world.distanceFrom(a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)) >= radius;
        const double bound = routesTo({a.x, a.y}, world, side, radius, {b.y, b.x}).lowerBound(b);
        const double length = positionDistance(a, b);
        ASSERT_TRUE(!isFree || bound <= length) << seed;
        tightest = isFree ? std::max(tightest, bound / length) : tightest;
    }
    EXPECT_GT(tightest, 0.7);
}

TEST(RouteHeuristic, lowerBoundHoldsInASlalomBetweenCells)
{
    // Thin walls from below and above alternately, two cells apart: the disc weaves by a quarter of a cell to either
    // side, the route of the grid by a whole cell.
    constexpr double RADIUS = 0.8;
    DiscCarWorld world({{-20.0, -10.0}, {100.0, 12.0}});
    for (double x = 1.5; x < 80.0; x += 4.0)
    {
        world.boxes.push_back({{x - 1e-3, -10.0}, {x + 1e-3, 1.25 - RADIUS}});
        world.boxes.push_back({{x + 2.0 - 1e-3, 0.75 + RADIUS}, {x + 2.0 + 1e-3, 12.0}});
    }
    RouteHeuristic routes = routesTo({79.5, 0.7}, world, 1.0, RADIUS, {0.0, 0.0});
    const double length = 39.0 * std::hypot(2.0, 0.6);  // from 5 cm above or below one end to the next
    EXPECT_GT(routes.distance(1.5, 1.3) - 1.0, length) << "without the factor there would be no bound";
    EXPECT_LE(routes.lowerBound({1.5, 1.3, 0.0}), length);
}

TEST(RouteHeuristic, passesALaneAHairWiderThanTheDiscButNoWallThinnerThanACell)
{
    Random random(3);
    for (int i = 0; i < 200; ++i)
        for (const double thickness : {1e-3, 4.0})
            for (const double door : {0.0, 0.96, 1.5})
            {
                DiscCarWorld world({{-9.0, -6.0}, {9.0, 6.0}},
                                   {{{0.0, -6.0}, {thickness, -door}}, {{0.0, door}, {thickness, 6.0}}});
                const Vector2d toward(random.between(-5.0, 5.0), random.between(-0.5, 0.5));
                RouteHeuristic routes = routesTo({6.0, 0.0}, world, random.between(0.5, 0.92), 0.95, toward);
                ASSERT_EQ(routes.provesUnreachable({-4.0, 0.0, 0.0}), door == 0.0);
            }
}

TEST(RouteHeuristic, claimsNothingWhenStoppedAndResumes)
{
    DiscCarWorld world({{-60.0, -60.0}, {60.0, 60.0}}, {{{-50.0, -1.0}, {60.0, 1.0}}});
    bool isOver = true;
    const StopFunction stop = [&isOver]
    {
        return isOver;
    };
    const Pose pose{50.0, 10.0, 0.0};
    RouteHeuristic routes = routesTo({50.0, -10.0}, world, 0.3, 0.5, {50.0, 10.0}, stop);
    routes.load(world.inside);
    EXPECT_EQ(world.roomsAsked, 0u);
    EXPECT_EQ(routes.distance(pose.x, pose.y), HUGE_VAL);
    EXPECT_FALSE(routes.provesUnreachable(pose));
    EXPECT_EQ(routes.lowerBound(pose), 0.0);
    EXPECT_EQ(routes.estimate(pose), 0.0);
    EXPECT_LT(routes.cells(), 2000u);
    isOver = false;
    EXPECT_GT(routes.lowerBound(pose), 140.0) << "round the wall";
    EXPECT_LT(routes.estimate(pose), routes.distance(pose.x, pose.y));
}

TEST(RouteHeuristic, claimsNothingBeyondItsLimits)
{
    // The grid reaches 2048 m along a corridor with a wall across.
    DiscCarWorld corridor({{-1e6, -2.0}, {1e6, 2.0}}, {{{-1.0, -2.0}, {0.0, 2.0}}});
    const Pose behind{-9.5, 0.5, 0.0};
    RouteHeuristic routes = routesTo({9.5, 0.5}, corridor, 1.0, 0.9, {0.0, 0.0});
    routes.load({{-HUGE_VAL, 0.0}, {HUGE_VAL, 0.5}});
    EXPECT_GE(corridor.roomsAsked, 4096u);
    EXPECT_NEAR(routes.distance(5.5, 0.5), 4.0, 1e-9);
    EXPECT_EQ(routes.distance(1e5, 0.5), 0.0) << "beyond the grid";
    EXPECT_EQ(routes.distance(behind.x, behind.y), 0.0) << "perhaps round the wall, beyond the grid";
    EXPECT_FALSE(routes.provesUnreachable(behind));
    routes.begin(corridor, 1.0, {0.9}, {0.0, 0.0}, never, MAX_CELLS);
    EXPECT_TRUE(routes.provesUnreachable({9.5, 0.5, 0.0})) << "without a target";
    routes = routesTo({1e5, 0.5}, corridor, 1.0, 0.9, {0.0, 0.0});
    EXPECT_FALSE(routes.provesUnreachable(behind)) << "the target is beyond the grid";
    routes = routesTo({9.5, 0.5}, corridor, 1.0, 0.9, {0.0, 0.0}, never, 100);
    EXPECT_FALSE(routes.provesUnreachable(behind)) << "at the limit of cells";
    EXPECT_EQ(routes.cells(), 100u);
}

// What the search asks of the world, answered by the footprint checker within the bounds of the state space, and by any
// other checker.

#include "benchmarks/worlds/RandomWorlds.h"
#include "ompl_improved_astar/search/heuristics/RouteHeuristic.h"
#include "ompl_improved_astar/search/models/CurveCheck.h"
#include "ompl_improved_astar/search/planning/FootprintEnvironment.h"
#include "ompl_improved_astar/search/planning/Plan.h"
#include "tests/ompl_improved_astar/search/DiscCarWorld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    constexpr double TOLERANCE = 1e-3;
}  // namespace

/** Turned round the body covers the ground that it covered: every corner lies where the opposite one was. */
TEST(FootprintEnvironment, turnsTheCarRoundOnTheSpotOnWhichItStands)
{
    Vehicle vehicle;
    vehicle.frontOverhang = 1.1;
    vehicle.rearOverhang = 0.6;
    const World world = randomPolygonWorld(1);
    const FootprintChecker checker(world.obstacles, vehicle);
    const FootprintEnvironment environment(checker, {{-50.0, -50.0}, {50.0, 50.0}}, TOLERANCE);
    Random random(7);
    for (int i = 0; i < 100; ++i)
    {
        const Pose pose{random.between(-9.0, 9.0), random.between(-9.0, 9.0), random.between(-PI, PI)};
        const Pose turned = environment.turnedRound(pose);
        EXPECT_NEAR(std::abs(wrapAngle(turned.yaw - pose.yaw)), PI, 1e-12);
        EXPECT_EQ(turned.yaw, wrapAngle(turned.yaw));
        const Pose front = advance(pose, 0.0, vehicle.wheelbase + vehicle.frontOverhang);
        const Pose turnedRear = advance(turned, 0.0, -vehicle.rearOverhang);
        EXPECT_NEAR(positionDistance(front, turnedRear), 0.0, 1e-12);
        EXPECT_EQ(checker.isFree(turned), checker.isFree(pose));
    }
}

TEST(FootprintEnvironment, motionsEndAtTheBoundsOrWhereTheCheckerSays)
{
    const Vehicle vehicle;
    int whole = 0, atBounds = 0, atObstacles = 0;
    for (std::uint64_t seed = 0; seed < 6; ++seed)
    {
        const World world = randomPolygonWorld(seed);
        const FootprintChecker checker(world.obstacles, vehicle);
        const Box bounds{{-9.0, -4.0}, {7.0, 11.0}};
        FootprintEnvironment environment(checker, bounds, TOLERANCE);
        Random random(seed);
        for (int i = 0; i < 800;)
        {
            const Pose from{random.between(-10.0, 8.0), random.between(-5.0, 12.0), random.between(-PI, PI)};
            if (!checker.isFree(from))
                continue;
            ++i;
            ASSERT_EQ(environment.isFree(from), bounds.contains(from.x, from.y));
            const double curvature = random.chance(0.3) ? 0.0 : random.between(-0.25, 0.25);
            const double length = random.magnitude(0.05, 9.0), wanted = std::abs(length);
            const double free = environment.freeLength(from, curvature, length);
            const double byChecker = checker.freeLength(from, curvature, length);
            ASSERT_LE(free, byChecker);
            for (double driven = 0.0; driven < free; driven += 0.01)
            {
                const Pose at = advance(from, curvature, std::copysign(driven, length));
                ASSERT_TRUE(bounds.contains(at.x, at.y));
            }
            if (!bounds.contains(from.x, from.y))
            {
                ASSERT_EQ(free, 0.0);
                continue;
            }
            if (free >= wanted)
            {
                ++whole;
                continue;
            }
            // No shorter than need be: just beyond its end is a wall, of one kind or the other.
            const Pose beyond = advance(from, curvature, std::copysign(free + 2.0 * TOLERANCE, length));
            const bool leaves = !bounds.contains(beyond.x, beyond.y);
            ASSERT_TRUE(leaves || free >= byChecker - 1e-12) << free << " of " << byChecker;
            ++(leaves ? atBounds : atObstacles);
        }
    }
    EXPECT_GT(whole, 300);
    EXPECT_GT(atBounds, 300);
    EXPECT_GT(atObstacles, 300);
}

TEST(FootprintEnvironment, whoStandsOnTheBoundsDrivesAwayFromThem)
{
    // At a slot's end the bounds pass through the goal, to which only a straight way leads.
    const Vehicle vehicle;
    const Box bounds{{-25.0, -25.0}, {10.0, 25.0}};
    for (const double half : {0.98, 1.02})
        for (const double yaw : {0.0, 1e-12, -1e-12})
        {
            SCOPED_TRACE(yaw);
            const std::vector<Polygon> walls = {{{0.0, half}, {15.0, half}, {15.0, half + 3.0}, {0.0, half + 3.0}},
                                                {{0.0, -half - 3.0}, {15.0, -half - 3.0}, {15.0, -half}, {0.0, -half}}};
            const FootprintChecker checker(ObstacleSet::fromPolygons(walls, {{-30.0, -30.0}, {30.0, 30.0}}), vehicle);
            FootprintEnvironment environment(checker, bounds, TOLERANCE);
            const Pose goal{10.0, 0.0, yaw};
            ASSERT_TRUE(environment.isFree(goal));
            EXPECT_EQ(environment.freeLength(goal, 0.0, -3.0), 3.0);
            EXPECT_LT(environment.freeLength(goal, 0.0, 0.1), 0.1);
            for (const double beyond : {1e-8, 5e-10})
                EXPECT_LT(environment.freeLength(advance(goal, 0.0, -3.0), 0.0, 3.0 + beyond), 3.0);
            PlanRequest request;
            request.starts = {{-15.0, 8.0, 0.5}};
            request.goals = {goal};
            request.car = carInSpace(vehicle, 0.0, bounds);
            request.parameters.approximate = false;
            request.maxExpansions = 6000;
            const PlanResult result = plan(environment, request);
            EXPECT_EQ(result.outcome, PlanOutcome::Solved) << result.reason;
        }
}

TEST(FootprintEnvironment, severalMotionsFromOnePoseAreWhatEachIsAlone)
{
    const Vehicle vehicle;
    for (std::uint64_t seed = 0; seed < 4; ++seed)
    {
        const World world = randomPolygonWorld(seed);
        const FootprintChecker checker(world.obstacles, vehicle);
        FootprintEnvironment environment(checker, {{-9.0, -4.0}, {7.0, 11.0}}, TOLERANCE);
        Random random(seed + 50);
        std::vector<Arc> arcs;
        std::vector<double> free;
        for (int i = 0; i < 500; ++i)
        {
            const Pose from = i % 2 == 0 ? world.anywhere(random)
                                         : world.touching(random, vehicle, std::abs(random.magnitude(1e-6, 0.5)));
            arcs.clear();
            for (std::size_t k = 0; k < 1 + random.index(6); ++k)
                arcs.push_back({random.chance(0.3) ? 0.0 : random.between(-0.3, 0.3), random.magnitude(0.01, 8.0)});
            free.assign(arcs.size(), -1.0);
            environment.freeLengths(from, arcs.data(), arcs.size(), free.data());
            for (std::size_t k = 0; k < arcs.size(); ++k)
                ASSERT_EQ(free[k], environment.freeLength(from, arcs[k].curvature, arcs[k].length));
        }
    }
}

/** Past a wall that leaves less than the tolerance, or more: nobody asks once more about what is clear. */
TEST(FootprintEnvironment, whatIsClearToItsEndIsFree)
{
    const Vehicle vehicle;
    int clear = 0, withinTolerance = 0;
    for (const double room : {1e-5, 4e-4, 7e-4, 2e-3, 0.02, 0.2})
    {
        const double side = 0.5 * vehicle.width + room;
        const Polygon wall{{6.0, side}, {25.0, side}, {25.0, side + 1.0}, {6.0, side + 1.0}};
        const FootprintChecker checker(ObstacleSet::fromPolygons({wall}, {{-20.0, -20.0}, {40.0, 20.0}}), vehicle);
        FootprintEnvironment environment(checker, {{-20.0, -20.0}, {40.0, 20.0}}, TOLERANCE);
        for (const double clearance : {1e-12, 1e-4, 5e-4, TOLERANCE, 1.5e-3, 0.01, 0.1, 0.3})
            for (const double curvature : {0.0, -0.1, 0.1})
            {
                const Arc arc{curvature, 8.0};
                double kept = -1.0;
                environment.clearLengths({0.0, 0.0, 0.0}, &arc, 1, clearance, &kept);
                const bool isFree = environment.freeLength({0.0, 0.0, 0.0}, curvature, arc.length) >= arc.length;
                if (kept >= arc.length)
                {
                    EXPECT_TRUE(isFree) << room << " of room, " << clearance << " kept";
                    ++clear;
                }
                withinTolerance += !isFree && clearance < room;
            }
    }
    EXPECT_GT(clear, 10);
    EXPECT_GT(withinTolerance, 3);
}

TEST(FootprintEnvironment, whatIsClearNeedNoLookToBeFreeAndTheRestIsFreeAsFarAsBefore)
{
    const Vehicle vehicle;
    int whole = 0, partly = 0, notAtAll = 0;
    for (std::uint64_t seed = 0; seed < 12; ++seed)
    {
        const World world = seed % 2 == 0 ? randomPolygonWorld(seed) : randomGridWorld(seed);
        const FootprintChecker checker(world.obstacles, vehicle);
        // Bounds that matter cut some motions short, too.
        const Box &all = world.obstacles.bounds();
        const Box bounds =
            seed % 3 == 0 ? Box{all.min + Eigen::Vector2d(4.0, 3.0), all.max - Eigen::Vector2d(2.0, 5.0)} : all;
        FootprintEnvironment environment(checker, bounds, TOLERANCE);
        Random random(seed);
        for (int i = 0; i < 1500; ++i)
        {
            const Pose from = world.anywhere(random);
            if (!environment.isFree(from))
                continue;
            const double clearance = i % 8 == 0 ? TOLERANCE : random.between(0.005, 0.3);
            std::vector<Arc> arcs;
            for (int k = 0; k < 6; ++k)
                arcs.push_back({random.chance(0.3) ? 0.0 : random.between(-0.25, 0.25), random.magnitude(0.05, 8.0)});
            std::vector<double> clear(arcs.size()), free(arcs.size()), expected(arcs.size());
            environment.clearLengths(from, arcs.data(), arcs.size(), clearance, clear.data());
            environment.freeLengths(from, arcs.data(), arcs.size(), expected.data());
            environment.freeLengthsBeyond(from, arcs.data(), arcs.size(), clear.data(), free.data());
            for (std::size_t k = 0; k < arcs.size(); ++k)
            {
                const double wanted = std::abs(arcs[k].length);
                ASSERT_GE(free[k], clear[k]);
                ASSERT_NEAR(free[k], expected[k], 1e-7) << "clear " << clear[k] << " of " << wanted;
                ASSERT_EQ(free[k] == wanted, expected[k] == wanted);
                ++(clear[k] >= wanted ? whole : clear[k] > 0.0 ? partly : notAtAll);
            }
        }
    }
    EXPECT_GT(whole, 1000);
    EXPECT_GT(partly, 1000);
    EXPECT_GT(notAtAll, 1000);
}

namespace
{
    /** Whether a disc gets from one half of a map, as wide as long, to the other, through a gap in the wall between. */
    class GapInMap
    {
    public:
        GapInMap(std::size_t size, double resolution, std::size_t gap)
          : map_(size, size, resolution),
            checker_(ObstacleSet::fromGrid(wall(map_, gap)), Vehicle()),
            side_(static_cast<double>(size) * resolution),
            environment_(checker_, {{0.0, 0.0}, {side_, side_}}, TOLERANCE)
        {
        }

        bool lets(double radius)
        {
            const StopFunction never;
            const Pose root{0.8 * side_, 0.8 * side_, 0.0}, target{0.2 * side_, 0.2 * side_, 0.0};
            RouteHeuristic routes;
            routes.begin(environment_, routeResolution(1.0, 0.0, {root}, {target}), {radius}, {root.x, root.y}, never,
                         1000000);
            routes.addTarget(target.x, target.y);
            return !routes.provesUnreachable(root);
        }

    private:
        static OccupancyGrid &wall(OccupancyGrid &map, std::size_t gap)
        {
            const std::size_t middle = map.height() / 2;
            for (std::size_t row = 0; row < map.height(); ++row)
                if (row < middle || row >= middle + gap)
                    map.set(map.width() / 2, row, Cell::Occupied);
            return map;
        }

        OccupancyGrid map_;
        FootprintChecker checker_;
        double side_;
        FootprintEnvironment environment_;
    };
}  // namespace

/** In maps whose cells are a metre wide: were the room told with the error of a cell, discs would go where they do not
    fit, and lead the search there. */
TEST(FootprintEnvironment, discsPassGapsOfMapsWithWideCellsWhereTheyFitButForAFractionOfACell)
{
    constexpr double GAP = 4.0;
    GapInMap map(80, 1.0, 4);
    for (const double radius : {0.5, 1.0, 1.5, 0.499 * GAP})
        EXPECT_TRUE(map.lets(radius)) << radius;
    // In the corner of a cell the bound is too high by half a diagonal less half a side: 0.21 m. To this comes what a
    // part of a cell of the disc's way is wide.
    for (const double radius : {0.6 * GAP, 0.75 * GAP, GAP})
        EXPECT_FALSE(map.lets(radius)) << radius;
}

/** The same for cells of 10 cm: a gap that is too narrow by a few centimetres must be told from one that is not, or a
    place that is closed to every car is taken for open. */
TEST(FootprintEnvironment, discsPassGapsOfMapsWithSmallCellsWhereTheyFitButForCentimetres)
{
    constexpr double GAP = 1.6;
    GapInMap map(400, 0.1, 16);
    for (const double radius : {0.4, 0.7, 0.499 * GAP})
        EXPECT_TRUE(map.lets(radius)) << radius;
    for (const double radius : {0.5 * GAP + 0.08, 0.5 * GAP + 0.129, GAP})
        EXPECT_FALSE(map.lets(radius)) << radius;
}

/** Looking at the ends of the pieces first changes the cost of the answer, not the answer. */
TEST(CurveCheck, saysWhatSweepingSaysFromEitherEnd)
{
    const ReedsShepp curves(3.0);
    int free = 0, blocked = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed)
    {
        DiscCarWorld world = randomField(seed);
        Random random(seed);
        std::vector<ReedsSheppCurve> candidates;
        for (int i = 0; i < 20; ++i)
        {
            const Pose from = world.freePose(random), to = world.freePose(random);
            curves.candidates(from, to, candidates, 40.0);
            for (const ReedsSheppCurve &curve : candidates)
            {
                bool swept = true;
                Pose pose = from;
                for (std::size_t k = 0; k < curve.count && swept; ++k)
                {
                    const Arc &piece = curve.pieces[k];
                    swept = world.freeLength(pose, piece.curvature, piece.length) >= std::abs(piece.length);
                    pose = advance(pose, piece.curvature, piece.length);
                }
                ASSERT_EQ(isCurveFree(world, from, curve, to, CurveEnd::Start), swept);
                // From the other end the sweep stops elsewhere, but a path that is clear by a hand's breadth is so from
                // both.
                if (isCurveFree(world, from, curve, to, CurveEnd::Goal) != swept)
                {
                    double least = 1.0;
                    Pose at = from;
                    for (std::size_t k = 0; k < curve.count; ++k)
                        for (int m = 0; m <= 200; ++m)
                        {
                            const double part = curve.pieces[k].length * m / 200.0;
                            least = std::min(least, std::abs(world.gap(advance(at, curve.pieces[k].curvature, part))));
                            if (m == 200)
                                at = advance(at, curve.pieces[k].curvature, part);
                        }
                    ASSERT_LT(least, 0.02);
                }
                ++(swept ? free : blocked);
            }
        }
    }
    EXPECT_GT(free, 500);
    EXPECT_GT(blocked, 3000);
}

/** Curves that keep the preferred clearance are not swept as free once more, and most are given up before they are
   priced: what is offered must be what is left when each is swept, priced and compared by itself. */
TEST(CurveCheck, offersTheFreeCurvesThatCostLessThanTheBoundCheapestFirst)
{
    const Vehicle vehicle;
    const ReedsShepp curves(4.0);
    int offers = 0, clear = 0, close = 0, dear = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed)
    {
        const World world = randomPolygonWorld(seed);
        const FootprintChecker checker(world.obstacles, vehicle);
        FootprintEnvironment environment(checker, world.obstacles.bounds(), TOLERANCE);
        Random random(seed + 20);
        std::vector<ReedsSheppCurve> candidates;
        for (int i = 0; i < 1000; ++i)
        {
            CostModel cost;
            cost.preferredClearance = i % 4 == 0 ? 0.0 : random.between(0.02, 0.4);
            cost.clearanceCost = 10.0;
            cost.clearanceWeight = i % 5 == 0 ? 0.3 : 0.0;
            const CurveEnd first = i % 2 == 0 ? CurveEnd::Start : CurveEnd::Goal;
            const Pose from = world.anywhere(random);
            const Pose to = advance(from, random.between(-0.2, 0.2), random.magnitude(1.0, 12.0));
            if (!environment.isFree(from) || !environment.isFree(to))
                continue;
            // Before there is a solution nothing is too dear.
            const double most = curves.distance(from, to) * random.between(1.0, 3.0),
                         bound = i % 3 == 0 ? std::numeric_limits<double>::infinity() : most;
            curves.candidates(from, to, candidates, most);
            std::vector<PricedCurve> order, expected, offered;
            for (const ReedsSheppCurve &curve : candidates)
            {
                order.emplace_back(curve.length, &curve);
                if (!isCurveFree(environment, from, curve, to, first))
                    continue;
                const double closeness = curveCloseness(cost, from, curve, environment);
                if (curve.length + closeness < bound)
                    expected.emplace_back(curve.length + closeness, &curve);
                ++(closeness <= 0.0 ? clear : curve.length + closeness < bound ? close : dear);
            }
            std::stable_sort(expected.begin(), expected.end());
            const bool isTaken = offerFreeCurves(environment, cost, from, to, order, first, bound,
                                                 [&](const ReedsSheppCurve &curve, double whole)
                                                 {
                                                     offered.emplace_back(whole, &curve);
                                                     return false;
                                                 });
            EXPECT_FALSE(isTaken);
            ASSERT_EQ(offered.size(), expected.size());
            for (std::size_t k = 0; k < offered.size(); ++k)
                ASSERT_NEAR(offered[k].first, expected[k].first, 1e-9);
            for (const PricedCurve &each : expected)
                ASSERT_TRUE(std::any_of(offered.begin(), offered.end(),
                                        [&](const PricedCurve &other) { return other.second == each.second; }));
            offers += static_cast<int>(offered.size());
        }
    }
    EXPECT_GT(offers, 1000);
    EXPECT_GT(clear, 300);
    EXPECT_GT(close, 300);
    EXPECT_GT(dear, 100);
}

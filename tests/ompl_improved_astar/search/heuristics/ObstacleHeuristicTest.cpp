// The obstacle-aware heuristic: against plain Dijkstra, asked lazily and at once, and as a lower bound.

#include "ompl_improved_astar/search/heuristics/ObstacleHeuristic.h"
#include "tests/ompl_improved_astar/search/DiscCarWorld.h"
#include "tests/ompl_improved_astar/search/heuristics/SmallWorld.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <queue>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

using parking::Pose;
using namespace parking::search;
using namespace parking_test;

namespace
{
    constexpr double INFINITE = std::numeric_limits<double>::infinity();
    using Place = std::pair<int, int>;

    /** Dijkstra over the same cells as the class documents them: eight neighbours, 12 and 17 parts of a cell away,
        centred on \e toward, open unless the disc surely hits something wherever in the cell it stands. */
    class PlainDijkstra
    {
    public:
        PlainDijkstra(const DiscCarWorld &world, double resolution, const Disc &disc, const Eigen::Vector2d &toward,
                      const std::vector<Eigen::Vector2d> &targets)
          : resolution_(resolution),
            toward_(toward)
        {
            std::priority_queue<std::pair<double, Place>, std::vector<std::pair<double, Place>>, std::greater<>> open;
            for (const Eigen::Vector2d &target : targets)
                open.push({0.0, place(target)});
            while (!open.empty())
            {
                const auto [g, at] = open.top();
                open.pop();
                if (!settled_.emplace(at, g).second)
                    continue;
                for (int dr = -1; dr <= 1; ++dr)
                    for (int dc = -1; dc <= 1; ++dc)
                    {
                        const Place next{at.first + dc, at.second + dr};
                        const double x = toward.x() + (next.first + 0.5) * resolution;
                        const double y = toward.y() + (next.second + 0.5) * resolution;
                        const double step = (dc != 0 && dr != 0 ? 17.0 / 12.0 : 1.0) * resolution;
                        const bool dear = disc.wide > 0.0 && !mayHoldDisc(world, x, y, resolution, disc.wide);
                        if (mayHoldDisc(world, x, y, resolution, disc.radius))
                            open.push({g + step * (dear ? disc.dear : 1.0), next});
                    }
            }
        }

        double distance(double x, double y) const
        {
            const auto found = settled_.find(place({x, y}));
            return found == settled_.end() ? INFINITE : found->second;
        }

    private:
        /** One of the sixty-four parts of the cell may hold the disc's centre. */
        static bool mayHoldDisc(const DiscCarWorld &world, double x, double y, double resolution, double radius)
        {
            constexpr int PARTS = 8;
            const auto middle = [](int part)
            {
                return (part + 0.5) / PARTS - 0.5;
            };
            for (int i = 0; i < PARTS; ++i)
                for (int k = 0; k < PARTS; ++k)
                    if (world.distanceFrom(x + middle(i) * resolution, y + middle(k) * resolution) +
                            std::sqrt(0.5) * resolution / PARTS >=
                        radius)
                        return true;
            return false;
        }

        Place place(const Eigen::Vector2d &point) const
        {
            return {static_cast<int>(std::floor((point.x() - toward_.x()) / resolution_)),
                    static_cast<int>(std::floor((point.y() - toward_.y()) / resolution_))};
        }

        double resolution_;
        Eigen::Vector2d toward_;
        std::map<Place, double> settled_;
    };

    void expectSame(double actual, double expected)
    {
        if (expected == INFINITE)
            EXPECT_EQ(actual, INFINITE);
        else
            EXPECT_NEAR(actual, expected, 1e-4 * (1.0 + expected));
    }

    /** Length of a way of the disc from one point to another, nearly the shortest; infinite when none was found. */
    double wayOfDisc(const DiscCarWorld &world, double radius, const Eigen::Vector2d &from, const Eigen::Vector2d &to)
    {
        constexpr double SIDE = 0.15, KEPT = 0.005;
        const auto isFree = [&](const Eigen::Vector2d &p)
        {
            return world.distanceFrom(p.x(), p.y()) >= radius + KEPT;
        };
        const auto isSegmentFree = [&](const Eigen::Vector2d &a, const Eigen::Vector2d &b)
        {
            const double steps = std::ceil((b - a).norm() / KEPT);
            for (double i = 0.0; i <= steps; i += 1.0)
                if (!isFree(a + (b - a) * (i / std::max(1.0, steps))))
                    return false;
            return true;
        };
        // Breadth-first over cells that contain the point asked about, then the string is pulled tight.
        const auto centre = [&](const Place &p)
        {
            return Eigen::Vector2d(from.x() + p.first * SIDE, from.y() + p.second * SIDE);
        };
        std::map<Place, std::pair<double, Place>> settled;
        using Item = std::tuple<double, Place, Place>;
        std::priority_queue<Item, std::vector<Item>, std::greater<>> open;
        open.push({0.0, {0, 0}, {0, 0}});
        Place last{};
        bool found = false;
        while (!open.empty() && !found)
        {
            const auto [g, at, parent] = open.top();
            open.pop();
            if (!settled.emplace(at, std::pair{g, parent}).second)
                continue;
            if ((centre(at) - to).norm() < SIDE && isSegmentFree(centre(at), to))
            {
                last = at;
                found = true;
            }
            for (int dr = -1; dr <= 1; ++dr)
                for (int dc = -1; dc <= 1; ++dc)
                {
                    const Place next{at.first + dc, at.second + dr};
                    if ((dr != 0 || dc != 0) && isFree(centre(next)))
                        open.push({g + std::hypot(dc, dr) * SIDE, next, at});
                }
        }
        if (!found)
            return INFINITE;
        std::vector<Eigen::Vector2d> points{to};
        for (Place at = last; at != Place{0, 0}; at = settled.at(at).second)
            points.push_back(centre(at));
        points.push_back(from);
        double length = 0.0;
        for (std::size_t i = 0; i + 1 < points.size();)
        {
            std::size_t j = points.size() - 1;
            while (j > i + 1 && !isSegmentFree(points[i], points[j]))
                --j;
            length += (points[j] - points[i]).norm();
            i = j;
        }
        return length;
    }
}  // namespace

TEST(ObstacleHeuristic, isDijkstrasDistance)
{
    for (std::uint64_t seed = 0; seed < 20; ++seed)
    {
        SCOPED_TRACE(seed);
        DiscCarWorld world = smallWorld(seed);
        Random random(seed + 100);
        const double resolution = random.between(0.3, 0.6), radius = 1.6 * resolution;
        const Eigen::Vector2d toward = anywhere(random);
        std::vector<Eigen::Vector2d> targets;
        for (std::uint64_t i = 0; i <= seed % 3; ++i)
            targets.push_back(anywhere(random));
        HeuristicIn heuristic(world, resolution, {radius}, toward);
        for (const Eigen::Vector2d &target : targets)
            heuristic.addTarget(target.x(), target.y());
        const PlainDijkstra oracle(world, resolution, {radius}, toward, targets);
        for (int i = 0; i < 200; ++i)
        {
            const Eigen::Vector2d p = anywhere(random);
            expectSame(heuristic.distance(p.x(), p.y()), oracle.distance(p.x(), p.y()));
        }
    }
}

TEST(ObstacleHeuristic, isDijkstrasDistanceWherePlacesAreDear)
{
    int dearer = 0;
    for (std::uint64_t seed = 0; seed < 30; ++seed)
    {
        SCOPED_TRACE(seed);
        DiscCarWorld world = smallWorld(seed);
        Random random(seed + 200);
        const double resolution = random.between(0.12, 0.4), radius = random.between(0.2, 0.6);
        const Disc disc{radius, random.between(1.1, 3.0) * radius, seed % 3 == 0 ? 2.0 : 21.0};
        const Eigen::Vector2d toward = anywhere(random), target = anywhere(random);
        HeuristicIn heuristic(world, resolution, disc, toward);
        heuristic.addTarget(target.x(), target.y());
        const PlainDijkstra oracle(world, resolution, disc, toward, {target});
        const PlainDijkstra cheap(world, resolution, {radius}, toward, {target});
        for (int i = 0; i < 100; ++i)
        {
            const Eigen::Vector2d p = anywhere(random);
            const double expected = oracle.distance(p.x(), p.y());
            expectSame(heuristic.distance(p.x(), p.y()), expected);
            dearer += expected < INFINITE && expected > 1.01 * cheap.distance(p.x(), p.y());
        }
    }
    EXPECT_GT(dearer, 300);
}

TEST(ObstacleHeuristic, resumedLazilyIsTheSameAsAskedInAnyOtherOrder)
{
    for (std::uint64_t seed = 0; seed < 10; ++seed)
    {
        SCOPED_TRACE(seed);
        DiscCarWorld world = smallWorld(seed);
        Random random(seed);
        const Eigen::Vector2d toward = anywhere(random), target = anywhere(random);
        std::vector<Eigen::Vector2d> points;
        for (int i = 0; i < 60; ++i)
            points.push_back(anywhere(random));
        std::vector<double> forwards, backwards(points.size());
        HeuristicIn lazy(world, 0.3, {0.5}, toward), reverse(world, 0.3, {0.5}, toward);
        lazy.addTarget(target.x(), target.y());
        reverse.addTarget(target.x(), target.y());
        for (const Eigen::Vector2d &p : points)
            forwards.push_back(lazy.distance(p.x(), p.y()));
        for (std::size_t i = points.size(); i-- > 0;)
            backwards[i] = reverse.distance(points[i].x(), points[i].y());
        // But for rounding: of equally long ways another may be taken, whose steps are added up in another order.
        for (std::size_t i = 0; i < points.size(); ++i)
            expectSame(backwards[i], forwards[i]);
        for (std::size_t i = 0; i < points.size(); ++i)
            EXPECT_EQ(lazy.distance(points[i].x(), points[i].y()), forwards[i]);
    }
}

TEST(ObstacleHeuristic, settlesOnlyTheAreaThatIsAskedAbout)
{
    DiscCarWorld world({{-300.0, -300.0}, {300.0, 300.0}});
    HeuristicIn heuristic(world, 0.5, {1.0}, {0.0, 0.0});
    heuristic.addTarget(10.0, 0.0);
    heuristic.distance(0.0, 0.0);
    EXPECT_LT(heuristic.cells(), 1000u) << "of 1.4 million";
    const std::uint64_t before = heuristic.cells();
    heuristic.distance(0.0, 0.0);
    EXPECT_EQ(heuristic.cells(), before);
}

// Into a dead end too narrow for the wide disc all ways are dear: that is no reason to look round elsewhere.
TEST(ObstacleHeuristic, aDearPlaceIsMadeForLikeAnyOther)
{
    std::uint64_t settled[2];
    for (const bool isDear : {false, true})
    {
        DiscCarWorld world({{-60.0, -60.0}, {60.0, 60.0}});
        world.boxes = {{{20.0, 1.2}, {30.0, 2.0}}, {{20.0, -2.0}, {30.0, -1.2}}, {{30.0, -2.0}, {30.8, 2.0}}};
        ObstacleHeuristic heuristic;
        const StopFunction never;
        heuristic.reset(world, 0.5, {0.9, isDear ? 2.2 : 0.0, isDear ? 60.0 : 1.0}, {28.0, 0.0}, never);
        heuristic.addTarget(-30.0, 0.0);
        EXPECT_GT(heuristic.distance(28.0, 0.0), isDear ? 400.0 : 57.0);
        EXPECT_LT(heuristic.distance(28.0, 0.0), isDear ? 700.0 : 60.0);
        settled[isDear ? 1 : 0] = heuristic.cells();
    }
    EXPECT_LT(settled[1], 3 * settled[0]);
}

TEST(ObstacleHeuristic, isDijkstrasDistanceForCellsFarApartAndInPockets)
{
    // Cells so small that most questions take many of them, asked here and there; rooms with and without a door.
    constexpr double RESOLUTION = 0.12, RADIUS = 0.2;
    int closed = 0;
    for (std::uint64_t seed = 0; seed < 6; ++seed)
    {
        SCOPED_TRACE(seed);
        DiscCarWorld world = smallWorld(seed);
        Random random(seed + 40);
        for (int i = 0; i < 5; ++i)
        {
            const Eigen::Vector2d low = anywhere(random), high = low + Eigen::Vector2d(2.0, 2.0);
            const double door = random.index(2) == 0 ? 0.0 : 0.6;
            world.boxes.push_back({low, {high.x(), low.y() + 0.1}});
            world.boxes.push_back({{low.x(), high.y() - 0.1}, high});
            world.boxes.push_back({low, {low.x() + 0.1, high.y()}});
            world.boxes.push_back({{high.x() - 0.1, low.y() + door}, high});
        }
        const Eigen::Vector2d toward = anywhere(random), target = anywhere(random);
        HeuristicIn heuristic(world, RESOLUTION, {RADIUS}, toward);
        heuristic.addTarget(target.x(), target.y());
        const PlainDijkstra oracle(world, RESOLUTION, {RADIUS}, toward, {target});
        for (int i = 0; i < 150; ++i)
        {
            const Eigen::Vector2d p = anywhere(random);
            const double expected = oracle.distance(p.x(), p.y());
            expectSame(heuristic.distance(p.x(), p.y()), expected);
            closed += expected == INFINITE && world.distanceFrom(p.x(), p.y()) > RADIUS;
        }
    }
    EXPECT_GT(closed, 20);
}

TEST(ObstacleHeuristic, findsOutFromWithinThatAPocketIsClosed)
{
    // A room in a plain of 1.4 million cells, with and without a gap in its wall.
    for (const double gap : {0.0, 4.0})
    {
        SCOPED_TRACE(gap);
        DiscCarWorld world({{-300.0, -300.0}, {300.0, 300.0}}, {{{-8.0, -8.0}, {8.0, -7.0}},
                                                                {{-8.0, 7.0}, {8.0, 8.0}},
                                                                {{-8.0, -8.0}, {-7.0, 8.0}},
                                                                {{7.0, -8.0 + gap}, {8.0, 8.0}}});
        HeuristicIn heuristic(world, 0.5, {1.0}, {0.0, 0.0});
        heuristic.addTarget(20.0, 0.0);
        EXPECT_EQ(heuristic.provesUnreachable({0.0, 0.0, 0.0}), gap == 0.0);
        EXPECT_LT(heuristic.cells(), 2000u);
        const std::uint64_t before = heuristic.cells();
        EXPECT_EQ(heuristic.distance(3.0, 3.0) == INFINITE, gap == 0.0);
        EXPECT_EQ(gap == 0.0, heuristic.cells() == before) << "what is known of one cell of a pocket is known of all";
        EXPECT_EQ(heuristic.distance(-7.5, 0.0), INFINITE) << "in the wall";
        EXPECT_LT(heuristic.distance(20.0, 30.0), 40.0) << "outside all is as before";
    }
}

TEST(ObstacleHeuristic, stopsAndGoesOn)
{
    DiscCarWorld world({{-60.0, -60.0}, {60.0, 60.0}}, {{{-50.0, -1.0}, {60.0, 1.0}}});
    HeuristicIn heuristic(world, 0.3, {0.5}, {50.0, 10.0}), other(world, 0.3, {0.5}, {50.0, 10.0});
    heuristic.addTarget(50.0, -10.0);
    other.addTarget(50.0, -10.0);
    heuristic.stop = []
    {
        return true;
    };
    EXPECT_EQ(heuristic.distance(50.0, 10.0), INFINITE);
    EXPECT_FALSE(heuristic.provesUnreachable({50.0, 10.0, 0.0})) << "it has only been stopped";
    heuristic.stop = nullptr;
    EXPECT_LE(heuristic.cells(), 2000u);
    const double distance = heuristic.distance(50.0, 10.0);
    EXPECT_EQ(distance, other.distance(50.0, 10.0));
    EXPECT_GT(distance, 200.0) << "round the wall";
}

TEST(ObstacleHeuristic, resetForgetsTheWorldAndTheTargets)
{
    DiscCarWorld closed = twoRooms(0.0), open = twoRooms(4.0);
    DiscCarWorld world = closed;
    HeuristicIn heuristic(world, 0.3, {0.9}, {-6.0, 0.0});
    heuristic.addTarget(6.0, 0.0);
    EXPECT_EQ(heuristic.distance(-6.0, 0.0), INFINITE);
    world.boxes = open.boxes;
    heuristic.reset(world, 0.3, {0.9}, {-6.0, 0.0}, heuristic.stop);
    EXPECT_EQ(heuristic.distance(-6.0, 0.0), INFINITE) << "without a target";
    heuristic.reset(world, 0.3, {0.9}, {-6.0, 0.0}, heuristic.stop);
    heuristic.addTarget(6.0, 0.0);
    EXPECT_NEAR(heuristic.distance(-6.0, 0.0), 12.0, 0.6);
}

TEST(ObstacleHeuristic, loadedBeforehandIsTheSame)
{
    for (std::uint64_t seed = 0; seed < 5; ++seed)
    {
        DiscCarWorld world = smallWorld(seed);
        HeuristicIn lazy(world, 0.25, {0.5}, {0.0, 0.0}), eager(world, 0.25, {0.5}, {0.0, 0.0});
        eager.load({{-6.0, -6.0}, {6.0, 6.0}});
        lazy.addTarget(5.0, 5.0);
        eager.addTarget(5.0, 5.0);
        Random random(seed);
        for (int i = 0; i < 100; ++i)
        {
            const Eigen::Vector2d p = anywhere(random);
            EXPECT_EQ(lazy.distance(p.x(), p.y()), eager.distance(p.x(), p.y()));
        }
    }
}

TEST(ObstacleHeuristic, loadsNoMoreThanItReachesAndStopsSoon)
{
    constexpr std::uint64_t REACHED = 4096, AT_ONCE = 64;
    DiscCarWorld world({{-1e8, -1e8}, {1e8, 1e8}});
    HeuristicIn heuristic(world, 1.0, {0.9}, {0.0, 0.0});
    std::uint64_t questions = 0, most = std::numeric_limits<std::uint64_t>::max(), last = 0;
    heuristic.stop = [&]
    {
        EXPECT_LE(world.roomsAsked - std::exchange(last, world.roomsAsked), AT_ONCE);
        return ++questions > most;
    };
    for (const double far : {1e8, INFINITE})
    {
        // A column and a row of cells.
        heuristic.load({{0.0, -far}, {1.0, far}});
        heuristic.load({{-far, 0.0}, {far, 1.0}});
        EXPECT_EQ(world.roomsAsked, 2 * REACHED - 1) << "the cell that is in both, and those of before, are known";
        EXPECT_LE(questions, 4 * (REACHED / AT_ONCE + 1));
    }
    most = questions + 3;
    heuristic.load({{-1e8, 1.0}, {1e8, 2.0}});
    EXPECT_EQ(world.roomsAsked, 2 * REACHED - 1 + 3 * AT_ONCE);
    EXPECT_EQ(questions, most + 1);
}

TEST(ObstacleHeuristic, lowerBoundIsNeverAboveTheWayOfTheDisc)
{
    int compared = 0;
    double tightest = 0.0;
    for (std::uint64_t seed = 0; seed < 25; ++seed)
    {
        DiscCarWorld world = smallWorld(seed);
        Random random(seed + 500);
        const double radius = random.between(0.1, 0.7), resolution = random.between(0.15, 0.6);
        const Eigen::Vector2d target = anywhere(random), toward = anywhere(random);
        if (world.distanceFrom(target.x(), target.y()) < radius + 0.01)
            continue;
        HeuristicIn heuristic(world, resolution, {radius}, toward);
        heuristic.addTarget(target.x(), target.y());
        for (int i = 0; i < 8; ++i)
        {
            const Eigen::Vector2d p = anywhere(random);
            const double way = wayOfDisc(world, radius, p, target);
            if (way == INFINITE)
                continue;
            const double bound = heuristic.lowerBound({p.x(), p.y(), 0.0});
            ASSERT_LE(bound, way + 1e-6) << "seed " << seed << ", point " << i;
            tightest = std::max(tightest, bound / way);
            ++compared;
        }
    }
    EXPECT_GT(compared, 40);
    EXPECT_GT(tightest, 0.6) << "a bound of nothing holds, too, but helps nobody";
}

TEST(ObstacleHeuristic, lowerBoundHoldsInASlalomBetweenCellsToo)
{
    // Thin walls from below and above in turn, two cells apart, whose ends the disc's centre has to weave between by a
    // quarter of a cell: the way is hardly longer than straight, while the cells' centres go up and down.
    constexpr double RADIUS = 0.8;
    constexpr int WALLS = 40;
    DiscCarWorld world({{-20.0, -10.0}, {2.0 * WALLS + 20.0, 12.0}});
    for (int i = 0; i < WALLS; ++i)
    {
        const double x = 2.0 * i + 1.5;
        world.boxes.push_back(i % 2 == 0 ? Box{{x - 1e-3, -10.0}, {x + 1e-3, 1.25 - RADIUS}}
                                         : Box{{x - 1e-3, 0.75 + RADIUS}, {x + 1e-3, 12.0}});
    }
    const Eigen::Vector2d from(-2.0, 1.0), to(2.0 * WALLS + 2.0, 1.0);
    HeuristicIn heuristic(world, 1.0, {RADIUS}, {0.0, 0.0});
    heuristic.addTarget(to.x(), to.y());
    const double way = wayOfDisc(world, RADIUS, from, to);
    ASSERT_LT(way, 1.1 * (to - from).norm());
    EXPECT_LE(heuristic.lowerBound({from.x(), from.y(), 0.0}), way);
}

TEST(ObstacleHeuristic, targetsBeyondTheGridsReachProveNothing)
{
    DiscCarWorld world({{-1e6, -1e6}, {1e6, 1e6}});
    HeuristicIn heuristic(world, 0.03, {0.1}, {0.0, 0.0});
    heuristic.addTarget(500.0, 0.0);
    EXPECT_LT(heuristic.lowerBound({0.0, 0.0, 0.0}), 500.0) << "infinite would say that there is no way";
}

TEST(ObstacleHeuristic, knowsWaysOfManyHundredMetresOfSmallCarsToo)
{
    constexpr double LENGTH = 900.0, WALL = 440.0, GAP = 8.0;
    const Pose from{10.0, 10.0, 0.0}, to{LENGTH - 10.0, 10.0, 0.0};
    const std::vector<Pose> roots{from}, targets{to};
    const StopFunction never;
    for (const double turningRadius : {0.1, 0.4, 1.0, 3.0, 10.0})
        for (const double body : {0.0, 0.4})
        {
            SCOPED_TRACE(turningRadius);
            SCOPED_TRACE(body);
            DiscCarWorld world({{0.0, 0.0}, {LENGTH, 80.0}}, {{{WALL, 0.0}, {WALL + 1.0, 80.0 - GAP}}});
            SearchParameters parameters;
            parameters.turningRadius = turningRadius;
            parameters.inscribedRadius = 0.2;
            parameters.bodyRadius = body;
            parameters.bounds = world.inside;
            ObstacleHeuristic heuristic;
            heuristic.begin({world, parameters, Side::Start, roots, targets, never});
            const double through = 80.0 - GAP - from.y;
            const double shortest = std::hypot(WALL - from.x, through) + std::hypot(to.x - WALL, through);
            const double way = heuristic.distance(from.x, from.y);
            EXPECT_GT(way, 0.98 * shortest);
            EXPECT_LT(way, 1.09 * shortest) << "the eight directions add 8.3 % at most";
            EXPECT_LT(heuristic.cells(), parameters.tuning.mostCells / 10);
        }
}

// The paper's search on a grid: against plain Dijkstra, and every switch by itself.

#include "ompl_improved_astar/search/Search.h"
#include "tests/ompl_improved_astar/search/GridWorld.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;
using Outcome = SearchOutcome;

namespace
{
    constexpr double INFINITE = std::numeric_limits<double>::infinity();

    struct Result
    {
        Outcome outcome;
        std::vector<Pose> path;
        SearchStatistics statistics;
    };

    Result solve(GridWorld &world, const SearchParameters &parameters, const Pose &start, const Pose &goal)
    {
        Search grid;
        grid.begin(world, parameters);
        grid.addStart(start);
        grid.addGoal(goal);
        const Outcome outcome = grid.run(afterAsking());
        return {outcome, posesOf(grid.bestPath()), grid.statistics()};
    }

    /** The poses of the path that ends nearest to a target; none when there is no start. */
    std::vector<Pose> nearest(const Search &search, const Pose &target)
    {
        Path path;
        return search.nearestPath(target, path) ? posesOf(path) : std::vector<Pose>();
    }

    /** No weighting, no tie-breaking, one direction: plain A*. */
    SearchParameters plain(const GridWorld &world)
    {
        SearchParameters parameters = world.parameters();
        parameters.weights = {1.0, 1.0, 0.0, 0.0};
        parameters.bidirectional = false;
        return parameters;
    }

    void expectSamePath(const std::vector<Pose> &a, const std::vector<Pose> &b)
    {
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t i = 0; i < a.size(); ++i)
            ASSERT_TRUE(a[i].x == b[i].x && a[i].y == b[i].y && a[i].yaw == b[i].yaw) << "pose " << i;
    }
}  // namespace

TEST(GridModel, plainSearchFindsTheOptimum)
{
    int reachable = 0, unreachable = 0;
    for (const bool sixteen : {false, true})
        for (std::uint64_t seed = 0; seed < 120; ++seed)
        {
            SCOPED_TRACE(seed);
            GridWorld world = randomGrid(seed, 0.1 + 0.3 * static_cast<double>(seed % 4) / 3.0);
            Random random(seed);
            const Pose start = world.freePose(random), goal = world.freePose(random);
            SearchParameters parameters = plain(world);
            parameters.motionModel = sixteen ? "grid16" : "grid8";
            const Result result = solve(world, parameters, start, goal);
            const double best = shortestByDijkstra(world, start, goal, sixteen);
            ASSERT_EQ(result.outcome, best == INFINITE ? Outcome::Exhausted : Outcome::Improved);
            if (best == INFINITE)
            {
                ++unreachable;
                continue;
            }
            ++reachable;
            ASSERT_EQ(faultOf(result.path, world, start, goal), "");
            ASSERT_NEAR(lengthOf(result.path), best, 1e-9);
        }
    EXPECT_GT(reachable, 100);
    EXPECT_GT(unreachable, 10);
}

TEST(GridModel, weightBoundsTheLength)
{
    double longest = 1.0;
    for (std::uint64_t seed = 0; seed < 100; ++seed)
    {
        GridWorld world = randomGrid(seed, 0.3);
        Random random(seed);
        const Pose start = world.freePose(random), goal = world.freePose(random);
        SearchParameters parameters = plain(world);
        parameters.weights = {2.0, 2.0, 5.0, 1e-3};
        const Result result = solve(world, parameters, start, goal);
        const double best = shortestByDijkstra(world, start, goal, false);
        ASSERT_EQ(result.outcome == Outcome::Improved, best < INFINITE);
        if (best == INFINITE || best == 0.0)
            continue;
        ASSERT_LE(lengthOf(result.path), (2.0 + 1e-3) * best + 1e-9);
        longest = std::max(longest, lengthOf(result.path) / best);
    }
    EXPECT_GT(longest, 1.001) << "the weight does nothing";
}

TEST(GridModel, weightsLessenTheExpansions)
{
    std::uint64_t plainly = 0, weighted = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed)
    {
        GridWorld world = randomGrid(seed, 0.15, 40);
        Random random(seed);
        const Pose start = world.freePose(random), goal = world.freePose(random);
        SearchParameters parameters = plain(world);
        plainly += solve(world, parameters, start, goal).statistics.expanded;
        parameters.weights = {1.5, 0.9, 5.0, 1e-3};
        weighted += solve(world, parameters, start, goal).statistics.expanded;
    }
    EXPECT_LT(2 * weighted, plainly);
}

TEST(GridModel, bothWaysReachTheSame)
{
    int reachable = 0, unreachable = 0;
    for (const bool sixteen : {false, true})
        for (std::uint64_t seed = 0; seed < 300; ++seed)
        {
            SCOPED_TRACE(seed);
            GridWorld world = randomGrid(seed, 0.25 + 0.15 * static_cast<double>(seed % 2), 14);
            Random random(seed);
            const Pose start = world.freePose(random), goal = world.freePose(random);
            SearchParameters parameters = world.parameters();
            parameters.motionModel = sixteen ? "grid16" : "grid8";
            const Result both = solve(world, parameters, start, goal);
            parameters.bidirectional = false;
            const Result one = solve(world, parameters, start, goal);
            ASSERT_EQ(both.outcome, one.outcome);
            ASSERT_EQ(one.outcome == Outcome::Improved, shortestByDijkstra(world, start, goal, sixteen) < INFINITE);
            ++(both.outcome == Outcome::Improved ? reachable : unreachable);
            if (both.outcome == Outcome::Improved)
            {
                ASSERT_EQ(faultOf(both.path, world, start, goal), "");
                ASSERT_EQ(faultOf(one.path, world, start, goal), "");
            }
        }
    EXPECT_GT(reachable, 100);
    EXPECT_GT(unreachable, 50);
}

TEST(GridModel, searchFromBothEndsLooksAtLess)
{
    std::uint64_t both = 0, one = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed)
    {
        GridWorld world = randomGrid(seed, 0.2, 40);
        SearchParameters parameters = plain(world);
        const Pose start{1.5, 1.5, 0.0}, goal{38.5, 38.5, 0.0};
        world.at(1, 1) = world.at(38, 38) = 0;
        one += solve(world, parameters, start, goal).statistics.expanded;
        parameters.bidirectional = true;
        both += solve(world, parameters, start, goal).statistics.expanded;
    }
    EXPECT_LT(both, one);
    EXPECT_GT(both, 0u);
}

TEST(GridModel, heapAndLinearListGiveTheSamePath)
{
    for (const bool both : {false, true})
        for (std::uint64_t seed = 0; seed < 60; ++seed)
        {
            GridWorld world = randomGrid(seed, 0.25, 24);
            Random random(seed);
            const Pose start = world.freePose(random), goal = world.freePose(random);
            SearchParameters parameters = world.parameters();
            parameters.bidirectional = both;
            const Result heap = solve(world, parameters, start, goal);
            parameters.openList = "linear";
            const Result linear = solve(world, parameters, start, goal);
            ASSERT_EQ(heap.outcome, linear.outcome);
            ASSERT_EQ(heap.statistics.expanded, linear.statistics.expanded);
            expectSamePath(heap.path, linear.path);
        }
}

TEST(GridModel, eagerLoadingGivesTheSamePathAndAsksForEveryCell)
{
    for (const double nose : {0.0, 0.7})
        for (const bool both : {false, true})
            for (std::uint64_t seed = 0; seed < 100; ++seed)
            {
                SCOPED_TRACE(seed);
                GridWorld world = randomGrid(seed, 0.2);
                world.nose = nose;
                Random random(seed);
                const Pose start = world.freePose(random), goal = world.freePose(random);
                SearchParameters parameters = world.parameters();
                parameters.bidirectional = both;
                world.states = 0;
                const Result lazy = solve(world, parameters, start, goal);
                const std::uint64_t asked = world.states;
                world.states = 0;
                parameters.eagerObstacles = true;
                const Result eager = solve(world, parameters, start, goal);
                ASSERT_EQ(lazy.outcome, eager.outcome);
                expectSamePath(lazy.path, eager.path);
                ASSERT_GE(world.states, world.blocked.size() * (nose == 0.0 ? 1 : 8));
                ASSERT_LT(asked, world.states);
            }
}

TEST(GridModel, rootsInCellsWithABlockedCentreAreReachedLazilyAndEagerly)
{
    // A post stands on the centre of the goal's cell; start and goal stand beside such posts.
    class Posts : public GridWorld
    {
    public:
        using GridWorld::GridWorld;
        bool isFree(const Pose &pose) override
        {
            return isPoseFree(pose) && std::hypot(pose.x - 8.5, pose.y - 1.5) > 0.1 &&
                   std::hypot(pose.x - 1.5, pose.y - 1.5) > 0.1;
        }
    } world(10, 3);
    const Pose start{1.8, 1.5, 0.0}, goal{8.2, 1.5, 0.0};
    for (const bool eager : {false, true})
        for (const bool both : {false, true})
        {
            SearchParameters parameters = world.parameters();
            parameters.eagerObstacles = eager;
            parameters.bidirectional = both;
            EXPECT_EQ(solve(world, parameters, start, goal).outcome, Outcome::Improved) << eager << both;
        }
}

TEST(GridModel, sixteenNeighboursDoNotJumpOverAWallOfOneCell)
{
    const std::vector<std::vector<std::string>> walls{
        {".....#.....", ".....#.....", ".....#.....", ".....#.....", ".....#....."},
        {"...........", "...........", "###########", "...........", "..........."},
        // In steps: diagonal neighbours of the wall touch at their corners only.
        {"....##.....", ".....##....", "......##...", ".......##..", "........##."},
        {"......##...", ".....##....", "....##.....", "...##......", "..##......."}};
    for (const auto &picture : walls)
        for (const bool both : {false, true})
            for (const double nose : {0.0, 0.3})
            {
                GridWorld world(picture);
                world.nose = nose;
                SearchParameters parameters = world.parameters();
                parameters.motionModel = "grid16";
                parameters.bidirectional = both;
                const Pose start{0.5, 4.5, 0.0}, goal{10.5, 0.5, 0.0};
                ASSERT_TRUE(world.isPoseFree(start));
                EXPECT_EQ(solve(world, parameters, start, goal).outcome, Outcome::Exhausted);
                // They do use the steps that the eight lack.
                world.blocked.assign(world.blocked.size(), 0);
                parameters.weights = {1.0, 1.0, 0.0, 0.0};
                parameters.bidirectional = false;
                const double sixteen = lengthOf(solve(world, parameters, start, goal).path);
                parameters.motionModel = "grid8";
                EXPECT_LT(sixteen, lengthOf(solve(world, parameters, start, goal).path) - 0.5);
            }
}

TEST(GridModel, pathsAreFreeWhereTheHeadingMatters)
{
    int found = 0;
    for (const bool sixteen : {false, true})
        for (const bool both : {false, true})
            for (std::uint64_t seed = 0; seed < 250; ++seed)
            {
                SCOPED_TRACE(seed);
                GridWorld world = randomGrid(seed, 0.15);
                Random random(seed);
                world.nose = random.between(0.3, 1.5);
                const Pose start = world.freePose(random), goal = world.freePose(random);
                SearchParameters parameters = world.parameters();
                parameters.motionModel = sixteen ? "grid16" : "grid8";
                parameters.bidirectional = both;
                const Result result = solve(world, parameters, start, goal);
                if (result.outcome != Outcome::Improved)
                    continue;
                ++found;
                ASSERT_EQ(faultOf(result.path, world, start, goal), "");
            }
    EXPECT_GT(found, 300);
}

TEST(GridModel, stopsAndGoesOnToTheSamePath)
{
    for (const bool both : {false, true})
        for (const bool eager : {false, true})
            for (std::uint64_t seed = 0; seed < 20; ++seed)
            {
                GridWorld world = randomGrid(seed, 0.25, 40);
                Random random(seed);
                const Pose start = world.freePose(random), goal = world.freePose(random);
                SearchParameters parameters = world.parameters();
                parameters.bidirectional = both;
                parameters.eagerObstacles = eager;
                const Result whole = solve(world, parameters, start, goal);
                Search grid;
                grid.begin(world, parameters);
                grid.addStart(start);
                grid.addGoal(goal);
                Outcome outcome;
                int pieces = 0;
                do
                {
                    int asked = 0;
                    outcome = grid.run([&asked] { return ++asked > 1; });
                    ASSERT_LT(++pieces, 20000);
                } while (outcome == Outcome::Stopped);
                ASSERT_EQ(outcome, whole.outcome);
                ASSERT_EQ(grid.statistics().expanded, whole.statistics.expanded);
                ASSERT_EQ(grid.statistics().generated, whole.statistics.generated);
                expectSamePath(posesOf(grid.bestPath()), whole.path);
                // In the midst of expansions, too.
                EXPECT_TRUE(eager || whole.statistics.expanded < 3 ||
                            pieces > 4 * static_cast<int>(whole.statistics.expanded));
            }
}

TEST(GridModel, aStopIsHeededSoon)
{
    GridWorld world(200, 200);
    world.at(199, 199) = 0;
    for (int i = 1; i < 200; ++i)
        world.at(198, i) = 1;
    world.at(198, 0) = 1;
    Search grid;
    grid.begin(world, world.parameters());
    grid.addStart({0.5, 0.5, 0.0});
    grid.addGoal({199.5, 199.5, 0.0});
    EXPECT_EQ(grid.run([] { return true; }), Outcome::Stopped);
    EXPECT_LE(grid.statistics().expanded, 64u);
}

TEST(GridModel, endsAsNearAsTheMapAllows)
{
    // The goal's room is closed, and small or large; the start's side must be searched to its end all the same.
    const std::vector<std::vector<std::string>> rooms{
        {"..............", "..........###.", "..........#.#.", "..........###.", ".............."},
        {"..............", ".......#######", ".......#......", ".......#......", ".......#......"},
        {"..##############", "..#............#", "..#............#", "..#............#", "..##############"}};
    const std::vector<Pose> goals{{11.5, 2.5, 0.0}, {13.5, 0.5, 0.0}, {14.5, 2.5, 0.0}};
    for (std::size_t i = 0; i < rooms.size(); ++i)
        for (const bool both : {false, true})
        {
            SCOPED_TRACE(i);
            GridWorld world(rooms[i]);
            SearchParameters parameters = world.parameters();
            parameters.bidirectional = both;
            const Pose start{0.5, 4.5, 0.0}, &goal = goals[i];
            Search grid;
            grid.begin(world, parameters);
            grid.addStart(start);
            grid.addGoal(goal);
            ASSERT_EQ(grid.run(afterAsking()), Outcome::Exhausted);
            const std::vector<Pose> path = nearest(grid, goal);
            ASSERT_FALSE(path.empty());
            EXPECT_EQ(faultOf(path, world, start, path.back()), "");
            double nearest = INFINITE;
            for (int cell = 0; cell < world.columns * world.rows; ++cell)
            {
                const Pose centre{cell % world.columns + 0.5, cell / world.columns + 0.5, 0.0};
                if (world.isPoseFree(centre) && shortestByDijkstra(world, start, centre, false) < INFINITE)
                    nearest = std::min(nearest, positionDistance(centre, goal));
            }
            EXPECT_NEAR(positionDistance(path.back(), goal), nearest, 1e-9) << "both " << both;
        }
}

TEST(GridModel, withoutAGoalItGoesNearTheTarget)
{
    GridWorld world({"..........", "....####..", "....#..#..", "....####..", ".........."});
    Search grid;
    grid.begin(world, world.parameters());
    grid.addStart({0.5, 0.5, 0.0});
    grid.setTarget({5.5, 2.5, 0.0});
    EXPECT_EQ(grid.run(afterAsking()), Outcome::Exhausted);
    const std::vector<Pose> path = nearest(grid, {5.5, 2.5, 0.0});
    ASSERT_FALSE(path.empty());
    EXPECT_NEAR(std::hypot(path.back().x - 5.5, path.back().y - 2.5), 2.0, 1e-9);
    Search empty;
    empty.begin(world, world.parameters());
    EXPECT_EQ(empty.run(afterAsking()), Outcome::Exhausted);
    EXPECT_TRUE(nearest(empty, {}).empty());
}

TEST(GridModel, severalStartsAndGoalsAreJoinedAsCheaplyAsAnyPair)
{
    for (std::uint64_t seed = 0; seed < 60; ++seed)
    {
        SCOPED_TRACE(seed);
        GridWorld world = randomGrid(seed, 0.25);
        Random random(seed);
        std::vector<Pose> starts, goals;
        Search grid;
        grid.begin(world, plain(world));
        for (int i = 0; i < 3; ++i)
        {
            starts.push_back(world.freePose(random));
            goals.push_back(world.freePose(random));
            // Two roots in one cell would be one node of the lattice.
            starts.back().x = std::floor(starts.back().x) + 0.5;
            starts.back().y = std::floor(starts.back().y) + 0.5;
            goals.back().x = std::floor(goals.back().x) + 0.5;
            goals.back().y = std::floor(goals.back().y) + 0.5;
            grid.addStart(starts.back());
            grid.addGoal(goals.back());
        }
        double best = INFINITE;
        for (const Pose &start : starts)
            for (const Pose &goal : goals)
                best = std::min(best, shortestByDijkstra(world, start, goal, false));
        ASSERT_EQ(grid.run(afterAsking()) == Outcome::Improved, best < INFINITE);
        if (best < INFINITE)
        {
            ASSERT_NEAR(lengthOf(posesOf(grid.bestPath())), best, 1e-9);
        }
    }
}

TEST(GridModel, oneObjectServesManyQueries)
{
    Search reused;
    for (std::uint64_t seed = 0; seed < 30; ++seed)
    {
        GridWorld world = randomGrid(seed, 0.2, 8 + static_cast<int>(seed));
        Random random(seed);
        const Pose start = world.freePose(random), goal = world.freePose(random);
        const Result fresh = solve(world, world.parameters(), start, goal);
        reused.begin(world, world.parameters());
        reused.addStart(start);
        reused.addGoal(goal);
        ASSERT_EQ(reused.run(afterAsking()), fresh.outcome);
        expectSamePath(posesOf(reused.bestPath()), fresh.path);
        ASSERT_EQ(reused.statistics().expanded, fresh.statistics.expanded);
    }
}

TEST(GridModel, nodesFormTreesOfFreeEdges)
{
    for (std::uint64_t seed = 0; seed < 20; ++seed)
    {
        GridWorld world = randomGrid(seed, 0.2, 24);
        Random random(seed);
        const Pose start = world.freePose(random), goal = world.freePose(random);
        Search grid;
        grid.begin(world, world.parameters());
        grid.addStart(start);
        grid.addGoal(goal);
        grid.run(afterAsking());
        std::vector<std::pair<Pose, NodeIndex>> nodes;
        std::vector<char> sides;
        for (const Side side : {Side::Start, Side::Goal})
        {
            const auto first = static_cast<NodeIndex>(nodes.size());
            for (const Node &node : std::as_const(grid).frontier(side).nodes())
            {
                nodes.emplace_back(node.pose, node.parent == NO_NODE ? NO_NODE : node.parent + first);
                sides.push_back(side == Side::Start);
            }
        }
        ASSERT_GE(nodes.size(), 2u);
        for (std::size_t i = 0; i < nodes.size(); ++i)
        {
            NodeIndex at = static_cast<NodeIndex>(i);
            for (std::size_t steps = 0; nodes[at].second != NO_NODE; ++steps)
            {
                ASSERT_LT(steps, nodes.size()) << "a circle";
                ASSERT_LT(nodes[at].second, nodes.size());
                ASSERT_EQ(sides[at], sides[nodes[at].second]);
                ASSERT_TRUE(
                    world.isBetweenFree({nodes[at].first.x, nodes[at].first.y, 0.0},
                                        {nodes[nodes[at].second].first.x, nodes[nodes[at].second].first.y, 0.0}));
                at = nodes[at].second;
            }
            const Pose &root = sides[i] ? start : goal;
            ASSERT_EQ(nodes[at].first.x, root.x);
            ASSERT_EQ(nodes[at].first.y, root.y);
        }
    }
}

// The paper's search on a grid: against plain Dijkstra, and every switch by itself.

#include "ompl_improved_astar/search/Search.h"
#include "ompl_improved_astar/search/models/GridModel.h"
#include "parking_geometry/Error.h"
#include "tests/ompl_improved_astar/search/GridWorld.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <tuple>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;
using Outcome = SearchOutcome;

namespace
{
    constexpr double INFINITE = std::numeric_limits<double>::infinity();
    const std::string BOTH[]{"grid8", "grid16"};

    struct Result
    {
        Outcome outcome;
        std::vector<Pose> path;
    };

    Result solve(Search &search, GridWorld &world, const PlannerParameters &parameters, const Pose &start,
                 const Pose &goal)
    {
        search.begin(world, parameters, world.car());
        search.addStart(start);
        search.addGoal(goal);
        const Outcome outcome = search.run(afterAsking());
        return {outcome, posesOf(search.bestPath())};
    }

    Result solve(GridWorld &world, const PlannerParameters &parameters, const Pose &start, const Pose &goal)
    {
        Search search;
        return solve(search, world, parameters, start, goal);
    }

    /** A search from one end with this weight and without tie-breaking: plain A* for 1. */
    PlannerParameters weighted(const GridWorld &world, double weight)
    {
        PlannerParameters parameters = world.parameters();
        parameters.heuristicWeightFar = parameters.heuristicWeightNear = weight;
        parameters.nearGoalDistance = parameters.tieBreak = 0.0;
        parameters.bidirectional = false;
        return parameters;
    }

    bool isSame(const std::vector<Pose> &a, const std::vector<Pose> &b)
    {
        bool same = a.size() == b.size();
        for (std::size_t i = 0; same && i < a.size(); ++i)
            same = a[i].x == b[i].x && a[i].y == b[i].y && a[i].yaw == b[i].yaw;
        return same;
    }

    /** Remembers which centres of cells it has been asked about, by heading where that matters. */
    class CountingGrid : public GridWorld
    {
    public:
        explicit CountingGrid(const GridWorld &world) : GridWorld(world)
        {
        }

        bool isFree(const Pose &pose) override
        {
            // Steps from and to roots have headings of their own.
            const double column = std::floor(pose.x), row = std::floor(pose.y), eighths = 4.0 * pose.yaw / PI;
            const bool isStep = !headingMatters() || std::abs(eighths - std::round(eighths)) < 1e-9;
            if (isStep && pose.x == column + 0.5 && pose.y == row + 0.5)
                ++asked[{column, row, headingMatters() ? (std::lround(eighths) + 8) % 8 : 0}];
            return GridWorld::isFree(pose);
        }

        int mostOften() const
        {
            int most = 0;
            for (const auto &[cell, times] : asked)
                most = std::max(most, times);
            return most;
        }

        std::map<std::tuple<double, double, long>, int> asked;
    };
}  // namespace

TEST(GridModel, findsAPathWhereAFloodDoesAndTheShortestAtWeightOne)
{
    int reachable = 0, unreachable = 0;
    for (const std::string &model : BOTH)
        for (std::uint64_t seed = 0; seed < 200; ++seed)
        {
            SCOPED_TRACE(model + ", seed " + std::to_string(seed));
            GridWorld world = randomGrid(seed, 0.1 + 0.3 * static_cast<double>(seed % 4) / 3.0);
            Random random(seed);
            const Pose start = world.freePose(random), goal = world.freePose(random);
            const double best = shortestByDijkstra(world, start, goal, model == "grid16");
            ++(best < INFINITE ? reachable : unreachable);
            for (const double weight : {1.0, 1.7, 2.5})
                for (const bool both : {false, true})
                    for (const char *from : {"start", "goal"})
                    {
                        PlannerParameters parameters = weighted(world, weight);
                        parameters.motionModel = model;
                        parameters.bidirectional = both;
                        parameters.searchFrom = from;
                        const Result result = solve(world, parameters, start, goal);
                        ASSERT_EQ(result.outcome, best == INFINITE ? Outcome::Exhausted : Outcome::Improved);
                        if (best == INFINITE)
                            continue;
                        ASSERT_EQ(faultOf(result.path, world, start, goal), "");
                        ASSERT_GE(lengthOf(result.path), best - 1e-9);
                        if (!both)
                        {
                            ASSERT_LE(lengthOf(result.path), weight * best + 1e-9) << "the weight bounds the length";
                        }
                    }
        }
    EXPECT_GT(reachable, 200);
    EXPECT_GT(unreachable, 30);
}

TEST(GridModel, pathsAreFreeWhereTheHeadingMatters)
{
    int found = 0;
    for (const std::string model : {"grid8", "grid16", "grid32"})
        for (const bool both : {false, true})
            for (std::uint64_t seed = 0; seed < 200; ++seed)
            {
                SCOPED_TRACE(model + ", seed " + std::to_string(seed));
                GridWorld world = randomGrid(seed, 0.15);
                Random random(seed);
                world.nose = random.between(0.3, 1.5);
                const Pose start = world.freePose(random), goal = world.freePose(random);
                PlannerParameters parameters = world.parameters();
                parameters.motionModel = model;
                parameters.bidirectional = both;
                const Result result = solve(world, parameters, start, goal);
                if (result.outcome != Outcome::Improved)
                    continue;
                ++found;
                ASSERT_EQ(faultOf(result.path, world, start, goal), "");
            }
    EXPECT_GT(found, 300);
}

/** How cells are looked up, how entries are sorted, and what was searched before change the time only. */
TEST(GridModel, loadingListsAndReuseLeaveThePathAndAskAboutEachCellOnce)
{
    Search reused;
    for (const double nose : {0.0, 0.7})
        for (const bool both : {false, true})
            for (std::uint64_t seed = 0; seed < 80; ++seed)
            {
                SCOPED_TRACE(seed);
                GridWorld world = randomGrid(seed, 0.2, 8 + static_cast<int>(seed % 20));
                world.nose = nose;
                Random random(seed);
                const Pose start = world.freePose(random), goal = world.freePose(random);
                PlannerParameters parameters = world.parameters();
                parameters.bidirectional = both;
                CountingGrid lazy(world), eager(world), linear(world), again(world);
                const Result expected = solve(lazy, parameters, start, goal);
                const Result afterOthers = solve(reused, again, parameters, start, goal);
                PlannerParameters other = parameters;
                other.openList = "linear";
                const Result byList = solve(linear, other, start, goal);
                other = parameters;
                other.obstacleLoading = "eager";
                const Result loaded = solve(eager, other, start, goal);
                for (const Result *result : {&loaded, &byList, &afterOthers})
                {
                    ASSERT_EQ(result->outcome, expected.outcome);
                    ASSERT_TRUE(isSame(result->path, expected.path));
                }
                for (const CountingGrid *grid : {&lazy, &eager, &linear, &again})
                    ASSERT_LE(grid->mostOften(), 1);
                ASSERT_EQ(eager.asked.size(), world.blocked.size() * (nose == 0.0 ? 1 : 8)) << "all of them";
                ASSERT_LT(lazy.asked.size(), eager.asked.size());
                ASSERT_TRUE(again.asked == lazy.asked);
            }
}

TEST(GridModel, aStopIsHeededWithinAFewQuestionsAndTheSearchGoesOnToAPathAsGood)
{
    int stops = 0;
    for (const std::string &model : BOTH)
        for (const bool both : {false, true})
            for (const bool eager : {false, true})
                for (std::uint64_t seed = 0; seed < 12; ++seed)
                {
                    SCOPED_TRACE(seed);
                    GridWorld world = randomGrid(seed, 0.25, 30);
                    Random random(seed);
                    const Pose start = world.freePose(random), goal = world.freePose(random);
                    PlannerParameters parameters = weighted(world, 1.5);
                    parameters.motionModel = model;
                    parameters.bidirectional = both;
                    parameters.obstacleLoading = eager ? "eager" : "lazy";
                    const double best = shortestByDijkstra(world, start, goal, model == "grid16");
                    Search search;
                    search.begin(world, parameters, world.car());
                    search.addStart(start);
                    search.addGoal(goal);
                    const auto questions = [&]
                    {
                        return world.states + world.motions;
                    };
                    for (Outcome outcome = Outcome::Stopped; outcome == Outcome::Stopped;)
                    {
                        // It may not ask much between two polls either, or it would not hear of the time.
                        std::uint64_t last = questions();
                        const std::size_t polls = 20 + random.index(30);
                        std::size_t polled = 0;
                        outcome = search.run(
                            [&]
                            {
                                EXPECT_LE(questions() - last, 64u);
                                last = questions();
                                return ++polled > polls;
                            });
                        ASSERT_LE(questions() - last, 64u);
                        ASSERT_LT(++stops, 1000000);
                        if (outcome != Outcome::Stopped)
                        {
                            ASSERT_EQ(outcome == Outcome::Exhausted, best == INFINITE);
                        }
                    }
                    const std::vector<Pose> path = posesOf(search.bestPath());
                    if (best == INFINITE)
                        continue;
                    ASSERT_EQ(faultOf(path, world, start, goal), "");
                    if (!both)
                    {
                        ASSERT_LE(lengthOf(path), 1.5 * best + 1e-9);
                    }
                }
    EXPECT_GT(stops, 300);
}

TEST(GridModel, rootsInCellsWithABlockedCentreAreReachedLazilyAndEagerly)
{
    // Start and goal stand beside posts on the centres of their cells.
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
    for (const char *loading : {"lazy", "eager"})
        for (const bool both : {false, true})
        {
            PlannerParameters parameters = world.parameters();
            parameters.obstacleLoading = loading;
            parameters.bidirectional = both;
            EXPECT_EQ(solve(world, parameters, start, goal).outcome, Outcome::Improved) << loading << both;
        }
}

TEST(GridModel, longStepsDoNotJumpOverAWallOfOneCellAndShortenPathsInTheOpen)
{
    const std::vector<std::vector<std::string>> walls{
        {".....#.....", ".....#.....", ".....#.....", ".....#.....", ".....#....."},
        {"...........", "...........", "###########", "...........", "..........."},
        // In steps: diagonal neighbours of the wall touch at their corners only.
        {"....##.....", ".....##....", "......##...", ".......##..", "........##."},
        {"......##...", ".....##....", "....##.....", "...##......", "..##......."}};
    for (const auto &picture : walls)
        for (const double nose : {0.0, 0.3})
        {
            GridWorld world(picture), open(world.columns, world.rows);
            world.nose = open.nose = nose;
            const Pose start{0.5, 4.5, 0.0}, goal{10.5, 0.5, 0.0};
            double shorter = INFINITE;
            for (const char *model : {"grid8", "grid16", "grid32"})
            {
                PlannerParameters parameters = weighted(world, 1.0);
                parameters.motionModel = model;
                for (const bool both : {false, true})
                {
                    parameters.bidirectional = both;
                    EXPECT_EQ(solve(world, parameters, start, goal).outcome, Outcome::Exhausted) << model;
                }
                parameters.bidirectional = false;
                const double length = lengthOf(solve(open, parameters, start, goal).path);
                EXPECT_LT(length, shorter - 0.01) << model;
                shorter = length;
            }
        }
}

TEST(GridModel, endsAsNearToAnUnreachableTargetAsAFloodGets)
{
    // The goal's room is closed, and small or large; the start's side must be searched to its end all the same.
    const std::vector<std::pair<std::vector<std::string>, Pose>> rooms{
        {{"..............", "..........###.", "..........#.#.", "..........###.", ".............."}, {11.5, 2.5, 0.0}},
        {{"..............", ".......#######", ".......#......", ".......#......", ".......#......"}, {13.5, 0.5, 0.0}},
        {{"..##############", "..#............#", "..#............#", "..#............#", "..##############"},
         {14.5, 2.5, 0.0}}};
    for (const auto &[picture, goal] : rooms)
        for (const bool both : {false, true})
            for (const bool isTarget : {false, true})
            {
                SCOPED_TRACE(goal.x);
                GridWorld world(picture);
                PlannerParameters parameters = world.parameters();
                parameters.bidirectional = both;
                const Pose start{0.5, 4.5, 0.0};
                Search search;
                search.begin(world, parameters, world.car());
                search.addStart(start);
                if (isTarget)
                    search.setTarget(goal);
                else
                    search.addGoal(goal);
                ASSERT_EQ(search.run(afterAsking()), Outcome::Exhausted);
                Path path;
                ASSERT_TRUE(search.nearestPath(goal, path));
                const std::vector<Pose> poses = posesOf(path);
                if (poses.size() > 1)
                {
                    EXPECT_EQ(faultOf(poses, world, start, poses.back()), "");
                }
                double nearest = INFINITE;
                for (int cell = 0; cell < world.columns * world.rows; ++cell)
                {
                    const Pose centre{cell % world.columns + 0.5, cell / world.columns + 0.5, 0.0};
                    if (world.isPoseFree(centre) && shortestByDijkstra(world, start, centre, false) < INFINITE)
                        nearest = std::min(nearest, positionDistance(centre, goal));
                }
                EXPECT_NEAR(positionDistance(poses.back(), goal), nearest, 1e-9) << "both " << both;
            }
    Search empty;
    GridWorld world(3, 3);
    empty.begin(world, world.parameters(), world.car());
    EXPECT_EQ(empty.run(afterAsking()), Outcome::Exhausted);
    Path path;
    EXPECT_FALSE(empty.nearestPath({}, path));
}

TEST(GridModel, severalStartsAndGoalsAreJoinedAsCheaplyAsAnyPair)
{
    for (std::uint64_t seed = 0; seed < 60; ++seed)
    {
        SCOPED_TRACE(seed);
        GridWorld world = randomGrid(seed, 0.25);
        Random random(seed);
        std::vector<Pose> starts, goals;
        Search search;
        search.begin(world, weighted(world, 1.0), world.car());
        for (int i = 0; i < 3; ++i)
            for (std::vector<Pose> *roots : {&starts, &goals})
            {
                // Two roots in one cell would be one node of the lattice.
                const Pose pose = world.freePose(random);
                roots->push_back({std::floor(pose.x) + 0.5, std::floor(pose.y) + 0.5, pose.yaw});
                roots == &starts ? search.addStart(roots->back()) : search.addGoal(roots->back());
            }
        double best = INFINITE;
        for (const Pose &start : starts)
            for (const Pose &goal : goals)
                best = std::min(best, shortestByDijkstra(world, start, goal, false));
        ASSERT_EQ(search.run(afterAsking()) == Outcome::Improved, best < INFINITE);
        if (best < INFINITE)
        {
            ASSERT_NEAR(lengthOf(posesOf(search.bestPath())), best, 1e-9);
        }
    }
}

TEST(GridModel, refusesStepsWithoutAnOppositeAndGridsBeyondItsReach)
{
    std::vector<GridStep> steps;
    for (int i = 1; i <= 16; ++i)
        for (const int sign : {1, -1})
            steps.push_back({sign * i, 0});
    EXPECT_NO_THROW(GridModel{steps});
    EXPECT_THROW(GridModel(std::vector<GridStep>(steps.begin(), steps.end() - 1)), Error);
    steps.push_back({0, 1});
    steps.push_back({0, -1});
    EXPECT_THROW(GridModel{steps}, Error);
    GridWorld world(3, 3);
    for (const double side : {1e3, 1e12, INFINITE, std::numeric_limits<double>::quiet_NaN()})
    {
        CarInSpace car = world.car();
        car.bounds.max.x() = side;
        Search search;
        if (side == 1e3)
        {
            EXPECT_NO_THROW(search.begin(world, world.parameters(), car));
        }
        else
        {
            EXPECT_THROW(search.begin(world, world.parameters(), car), Error) << side;
        }
    }
}

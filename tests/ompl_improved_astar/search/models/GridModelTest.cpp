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
            ++(best < HUGE_VAL ? reachable : unreachable);
            for (const double weight : {1.0, 1.7, 2.5})
                for (const bool both : {false, true})
                    for (const char *from : {"start", "goal"})
                    {
                        PlannerParameters parameters = weighted(world, weight);
                        parameters.motionModel = model;
                        parameters.bidirectional = both;
                        parameters.searchFrom = from;
                        const Result result = solve(world, parameters, start, goal);
                        ASSERT_EQ(result.outcome, best == HUGE_VAL ? Outcome::Exhausted : Outcome::Improved);
                        if (best == HUGE_VAL)
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
    for (std::uint64_t seed = 0; seed < 100; ++seed)
    {
        SCOPED_TRACE(seed);
        GridWorld world = randomGrid(seed, 0.25, 30);
        Random random(seed);
        const Pose start = world.freePose(random), goal = world.freePose(random);
        PlannerParameters parameters = weighted(world, 1.5);
        parameters.motionModel = BOTH[seed % 2];
        parameters.bidirectional = seed / 2 % 2 == 0;
        parameters.obstacleLoading = seed / 4 % 2 == 0 ? "eager" : "lazy";
        const double best = shortestByDijkstra(world, start, goal, seed % 2 == 1);
        Search search;
        search.begin(world, parameters, world.car());
        search.addStart(start);
        search.addGoal(goal);
        Outcome outcome = Outcome::Stopped;
        for (; outcome == Outcome::Stopped; ++stops)
        {
            // It may not ask much between two polls either, or it would not hear of the time.
            std::uint64_t last = world.states + world.motions;
            const std::size_t polls = 20 + random.index(30);
            std::size_t polled = 0;
            const auto stop = [&]
            {
                EXPECT_LE(world.states + world.motions - last, 64u);
                last = world.states + world.motions;
                return ++polled > polls;
            };
            outcome = search.run(stop);
            ASSERT_LE(world.states + world.motions - last, 64u);
            ASSERT_LT(stops, 1000000);
        }
        ASSERT_EQ(outcome == Outcome::Improved, best < HUGE_VAL);
        const std::vector<Pose> path = posesOf(search.bestPath());
        ASSERT_EQ(best < HUGE_VAL ? faultOf(path, world, start, goal) : "", "");
        ASSERT_TRUE(parameters.bidirectional || best == HUGE_VAL || lengthOf(path) <= 1.5 * best + 1e-9);
    }
    EXPECT_GT(stops, 300);
}

TEST(GridModel, longStepsDoNotJumpOverAWallOfOneCellAndShortenPathsInTheOpen)
{
    const std::vector<std::vector<std::string>> walls{
        {".....#.....", ".....#.....", ".....#.....", ".....#.....", ".....#....."},
        {"...........", "...........", "###########", "...........", "..........."},
        // In steps: diagonal neighbours of the wall touch at their corners only.
        {"....##.....", ".....##....", "......##...", ".......##..", "........##."},
        {"......##...", ".....##....", "....##.....", "...##......", "..##......."}};
    const Pose start{0.5, 4.5, 0.0}, goal{10.5, 0.5, 0.0};
    for (const auto &picture : walls)
    {
        GridWorld world(picture), open(world.columns, world.rows);
        double shorter = HUGE_VAL;
        for (const char *model : {"grid8", "grid16", "grid32"})
        {
            PlannerParameters parameters = weighted(world, 1.0);
            parameters.motionModel = model;
            for (const double nose : {0.0, 0.3})
            {
                world.nose = nose;
                EXPECT_EQ(solve(world, parameters, start, goal).outcome, Outcome::Exhausted) << model;
            }
            const double length = lengthOf(solve(open, parameters, start, goal).path);
            EXPECT_LT(length, shorter - 0.01) << model;
            shorter = length;
        }
    }
}

TEST(GridModel, endsAsNearToAnUnreachableTargetAsAFloodGets)
{
    int unreachable = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed)
        for (const bool isTarget : {false, true})
        {
            SCOPED_TRACE(seed);
            GridWorld world = randomGrid(seed, 0.45, 12);
            Random random(seed);
            const Pose start = world.freePose(random), goal = world.freePose(random);
            if (shortestByDijkstra(world, start, goal, false) < HUGE_VAL)
                continue;
            ++unreachable;
            PlannerParameters parameters = world.parameters();
            parameters.bidirectional = seed % 2 == 0;
            Search search;
            search.begin(world, parameters, world.car());
            search.addStart(start);
            isTarget ? search.setTarget(goal) : search.addGoal(goal);
            ASSERT_EQ(search.run(afterAsking()), Outcome::Exhausted);
            Path path;
            ASSERT_TRUE(search.nearestPath(goal, path));
            const std::vector<Pose> poses = posesOf(path);
            ASSERT_EQ(poses.size() > 1 ? faultOf(poses, world, start, poses.back()) : "", "");
            // The cells of roots stand for these: no path leads through that of a goal that it does not reach.
            GridWorld others = world;
            others.at(static_cast<int>(goal.x), static_cast<int>(goal.y)) = isTarget ? 0 : 1;
            double nearest = positionDistance(start, goal);
            for (int cell = 0; cell < world.columns * world.rows; ++cell)
            {
                const int column = cell % world.columns, row = cell / world.columns;
                const Pose centre{column + 0.5, row + 0.5, 0.0};
                const bool isStart = std::floor(start.x) == column && std::floor(start.y) == row;
                if (others.isPoseFree(centre) && positionDistance(centre, goal) < nearest && !isStart &&
                    shortestByDijkstra(others, start, centre, false) < HUGE_VAL)
                    nearest = positionDistance(centre, goal);
            }
            ASSERT_NEAR(positionDistance(poses.back(), goal), nearest, 1e-9);
        }
    EXPECT_GT(unreachable, 30);
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
        double best = HUGE_VAL;
        for (const Pose &start : starts)
            for (const Pose &goal : goals)
                best = std::min(best, shortestByDijkstra(world, start, goal, false));
        ASSERT_EQ(search.run(afterAsking()) == Outcome::Improved, best < HUGE_VAL);
        if (best < HUGE_VAL)
        {
            ASSERT_NEAR(lengthOf(posesOf(search.bestPath())), best, 1e-9);
        }
    }
}

TEST(GridModel, refusesStepsWithoutAnOppositeAndGridsBeyondItsReach)
{
    EXPECT_NO_THROW(GridModel({{1, 0}, {-1, 0}}));
    EXPECT_THROW(GridModel({{1, 0}, {-1, 0}, {0, 1}}), Error);
    EXPECT_THROW(GridModel(std::vector<GridStep>(33, {0, 0})), Error);
    GridWorld world(3, 3);
    CarInSpace car = world.car();
    EXPECT_NO_THROW(Search().begin(world, world.parameters(), car));
    for (const double side : {1e12, HUGE_VAL, std::numeric_limits<double>::quiet_NaN()})
    {
        car.bounds.max.x() = side;
        EXPECT_THROW(Search().begin(world, world.parameters(), car), Error) << side;
    }
}

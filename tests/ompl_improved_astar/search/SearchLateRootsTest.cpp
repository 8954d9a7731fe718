// Starts and goals that are added while searching.

#include "ompl_improved_astar/search/Search.h"
#include "tests/ompl_improved_astar/search/CarProblems.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <utility>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

TEST(SearchLateRoots, goalsAddedLaterAreReached)
{
    for (const bool bidirectional : {true, false})
        for (const double nearWeight : {3.0, 0.5})
        {
            SCOPED_TRACE(nearWeight);
            CarProblem problem{twoRooms(0.0), {{-9.0, -2.0, 0.5 * PI}}, {{6.0, 0.0, 0.0}}};
            // The new goal stands behind a wall in the start's own room.
            problem.world.boxes.push_back({{-6.0, -6.0}, {-5.6, 2.2}});
            SearchParameters parameters = carParameters();
            parameters.bidirectional = bidirectional;
            parameters.searchFromGoal = false;
            parameters.weights = {3.0, nearWeight, 30.0, 1e-3};
            Search search;
            problem.begin(search, parameters);
            EXPECT_EQ(search.run([&] { return search.statistics().expanded >= 30; }), SearchOutcome::Stopped);
            const Pose goal{-3.5, -4.0, 0.5 * PI};
            ASSERT_GT(problem.world.gap(goal), 0.0);
            search.addGoal(goal);
            ASSERT_EQ(search.run(afterAsking()), SearchOutcome::Improved);
            EXPECT_EQ(faultOf(search.bestPath(), problem.world, problem.starts, {goal}, TURNING_RADIUS), "");
        }
}

TEST(SearchLateRoots, goalsAddedWhenThereIsNothingLeftAreReached)
{
    // The first goal is in a cage, the second in the field with the start: the nodes that are expanded by then have to
    // be joined with it, or no one else will.
    int solved = 0;
    for (std::uint64_t seed = 0; seed < 4; ++seed)
        for (const bool bidirectional : {true, false})
            for (const bool searchFromGoal : {true, false})
            {
                SCOPED_TRACE(seed);
                CarProblem problem = randomProblem(seed, 14);
                const Pose later = problem.goals.front();
                problem.world.inside.max.x() = 40.0;
                problem.world.boxes.insert(problem.world.boxes.end(), {{{12.0, -12.0}, {12.5, 12.0}},
                                                                       {{24.0, -3.0}, {31.0, -2.5}},
                                                                       {{24.0, 2.5}, {31.0, 3.0}},
                                                                       {{24.0, -2.5}, {24.5, 2.5}},
                                                                       {{30.5, -2.5}, {31.0, 2.5}}});
                problem.goals = {{26.0, 0.0, 0.0}};
                ASSERT_GT(problem.world.gap(problem.goals.front()), 0.0);
                SearchParameters parameters = carParameters();
                parameters.bidirectional = bidirectional;
                parameters.searchFromGoal = searchFromGoal;
                parameters.adaptiveResolution = parameters.obstacleHeuristic = false;
                Search search;
                problem.begin(search, parameters);
                ASSERT_EQ(search.run(afterAsking()), SearchOutcome::Exhausted);
                CarProblem alone{problem.world, problem.starts, {later}};
                Search fresh;
                alone.begin(fresh, parameters);
                if (fresh.run(afterAsking()) != SearchOutcome::Improved)
                    continue;
                ++solved;
                search.addGoal(later);
                ASSERT_EQ(search.run(afterAsking()), SearchOutcome::Improved);
                EXPECT_EQ(faultOf(search.bestPath(), problem.world, problem.starts, {later}, TURNING_RADIUS), "");
            }
    EXPECT_GT(solved, 8);
}

// What was reached by looking ahead is expanded by then, too, and has to be joined like the rest.
TEST(SearchLateRoots, goalsBesideWhatWasReachedByLookingAheadAreReached)
{
    // The first goal is in a cage at the end of a corridor.
    CarProblem problem{DiscCarWorld({{0.0, 0.0}, {80.0, 12.0}}), {{6.0, 6.0, 0.0}}, {{70.0, 6.0, 0.0}}};
    problem.world.boxes = {
        {{66.0, 3.0}, {66.5, 9.0}}, {{75.5, 3.0}, {76.0, 9.0}}, {{66.0, 3.0}, {76.0, 3.5}}, {{66.0, 8.5}, {76.0, 9.0}}};
    problem.world.tellsRoom = false;
    SearchParameters parameters = carParameters();
    parameters.bidirectional = parameters.searchFromGoal = parameters.adaptiveResolution = parameters.detours = false;
    parameters.bounds = problem.world.inside;
    Search search;
    problem.begin(search, parameters);
    ASSERT_EQ(search.run(afterAsking()), SearchOutcome::Exhausted);
    const auto &nodes = std::as_const(search).frontier(Side::Start).nodes();
    ASSERT_TRUE(std::any_of(nodes.begin(), nodes.end(), [](const Node &node) { return node.fixed; }));
    const Pose later{40.0, 2.0, 0.0};
    search.addGoal(later);
    ASSERT_EQ(search.run(afterAsking()), SearchOutcome::Improved);
    EXPECT_EQ(faultOf(search.bestPath(), problem.world, problem.starts, {later}, TURNING_RADIUS), "");
}

namespace
{
    /** A world in which the time is up now and then. */
    class HurriedWorld : public DiscCarWorld
    {
    public:
        using DiscCarWorld::DiscCarWorld;

        double freeLength(const Pose &from, double curvature, double length) override
        {
            isUp_ = isUp_ || ++asked_ % 17 == 0;
            return isUp_ ? 0.0 : DiscCarWorld::freeLength(from, curvature, length);
        }

        bool wasInterrupted() const override
        {
            return isUp_;
        }

        void goOn()
        {
            isUp_ = false;
        }

    private:
        bool isUp_{false};
        int asked_{0};
    };
}  // namespace

namespace
{
    /** Counts the nodes that are where their motions lead to from their parents, as all should be. */
    std::uint64_t hangingOnTheirParents(const Search &search)
    {
        std::uint64_t seen = 0;
        for (const Side side : {Side::Start, Side::Goal})
            for (const Node &node : search.frontier(side).nodes())
            {
                if (node.parent == NO_NODE)
                    continue;
                const Node &parent = search.frontier(side).node(node.parent);
                EXPECT_TRUE(
                    isSamePose(node.pose, advance(parent.pose, node.motion.curvature, node.motion.length), 1e-9));
                ++seen;
            }
        return seen;
    }
}  // namespace

// A node whose expansion was interrupted has children already: it must not give its place to a cheaper one.
TEST(SearchLateRoots, interruptedNodesKeepTheirChildren)
{
    std::uint64_t seen = 0;
    for (std::uint64_t seed = 0; seed < 150; ++seed)
    {
        SCOPED_TRACE(seed);
        const CarProblem problem = randomProblem(seed, 14);
        HurriedWorld world(problem.world.inside, problem.world.boxes);
        Search search;
        search.begin(world, carParameters());
        search.addStart(problem.starts.front());
        search.addGoal(problem.goals.front());
        while (search.run([&] { return world.wasInterrupted(); }) == SearchOutcome::Stopped && search.expanded() < 400)
            world.goOn();
        seen += hangingOnTheirParents(search);
        ASSERT_FALSE(HasFailure());
    }
    EXPECT_GT(seen, 5000u);
}

// So have nodes that are expanded again since there is another root.
TEST(SearchLateRoots, nodesExpandedAgainKeepTheirChildren)
{
    std::uint64_t seen = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed)
    {
        SCOPED_TRACE(seed);
        CarProblem problem = randomProblem(seed, 14);
        Random random(seed);
        Search search;
        problem.begin(search, carParameters());
        for (const std::uint64_t expanded : {100u, 250u, 400u})
        {
            while (search.run({}, expanded) == SearchOutcome::Improved)
                continue;
            const Pose late = problem.world.freePose(random);
            seed % 2 == 0 ? search.addGoal(late) : search.addStart(late);
        }
        seen += hangingOnTheirParents(search);
        ASSERT_FALSE(HasFailure());
    }
    EXPECT_GT(seen, 5000u);
}

// Exploration expands what the first queue still has entries of, so that these may be the last ones in it.
TEST(SearchLateRoots, theEndOfAFrontierIsNoticedWhateverIsLeftInItsQueue)
{
    int ended = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed)
    {
        SCOPED_TRACE(seed);
        CarProblem problem = randomProblem(seed, 24);
        problem.world.tellsRoom = false;
        Search search;
        const Search &searched = search;
        SearchParameters parameters = carParameters();
        parameters.tuning.explorationPeriod = 2;
        parameters.adaptiveResolution = false;
        problem.begin(search, parameters);
        search.run({}, 6000);
        if (search.hasSolution())
            continue;
        for (const Side side : {Side::Start, Side::Goal})
            if (const Frontier &each = searched.frontier(side); each.isExhausted())
            {
                ++ended;
                EXPECT_GT(each.expansionsWhenExhausted, 0u);
                EXPECT_LE(each.expansionsWhenExhausted, search.expanded());
            }
    }
    EXPECT_GT(ended, 3);
}

TEST(SearchLateRoots, changedHeuristicsDoNotLoseOpenNodes)
{
    // With a weight that falls near the goal, a goal added close by lowers what the open nodes are worth.
    CarProblem problem{twoRooms(0.0), {{-9.0, -2.0, 0.5 * PI}}, {{6.0, 0.0, 0.0}}};
    problem.world.boxes.push_back({{-6.0, -6.0}, {-5.6, 2.2}});
    SearchParameters parameters = carParameters();
    parameters.bidirectional = false;
    parameters.searchFromGoal = false;
    parameters.adaptiveResolution = false;
    parameters.weights = {3.0, 0.1, 9.0, 0.0};
    Search search;
    problem.begin(search, parameters);
    EXPECT_EQ(search.run([&] { return search.statistics().expanded >= 1; }), SearchOutcome::Stopped);
    search.addGoal({-3.5, -4.0, 0.5 * PI});
    EXPECT_EQ(search.run(afterAsking()), SearchOutcome::Improved);
}

TEST(SearchLateRoots, startsAddedLaterAreUsed)
{
    CarProblem problem{twoRooms(0.0), {{-9.0, 0.0, 0.0}}, {{9.0, -2.0, 0.5 * PI}}};
    problem.world.boxes.push_back({{5.6, -6.0}, {6.0, 2.2}});
    SearchParameters parameters = carParameters();
    parameters.inscribedRadius = problem.world.radius;
    Search search;
    problem.begin(search, parameters);
    EXPECT_EQ(search.run(afterAsking()), SearchOutcome::Exhausted);
    const Pose start{3.5, -4.0, 0.5 * PI};
    search.addStart(start);
    ASSERT_EQ(search.run(afterAsking()), SearchOutcome::Improved);
    EXPECT_EQ(faultOf(search.bestPath(), problem.world, {start}, problem.goals, TURNING_RADIUS), "");
}

TEST(SearchLateRoots, aGoalAfterATargetIsReached)
{
    CarProblem problem{twoRooms(3.0), {{-9.0, 0.0, 0.0}}, {}};
    Search search;
    problem.begin(search, carParameters());
    search.setTarget({-11.9, -5.9, 0.0});
    EXPECT_EQ(search.run([&] { return search.statistics().expanded >= 200; }), SearchOutcome::Stopped);
    const Pose goal{9.0, 2.0, 0.5 * PI};
    search.addGoal(goal);
    ASSERT_EQ(search.run([&] { return search.statistics().expanded >= 5000; }), SearchOutcome::Improved);
    EXPECT_EQ(faultOf(search.bestPath(), problem.world, problem.starts, {goal}, TURNING_RADIUS), "");
}

TEST(SearchLateRoots, anotherTargetIsSearchedForAfterTheFirst)
{
    // The second is farther behind the same closed door: the disc comes no nearer to it than 10 m. Judged by the 7 m to
    // which the search has come to the first, it would end at once.
    CarProblem problem{twoRooms(0.0), {{-9.0, 0.0, 0.0}}, {}};
    SearchParameters parameters = carParameters();
    parameters.inscribedRadius = problem.world.radius;
    Search search;
    problem.begin(search, parameters);
    for (const Pose &target : {Pose{6.0, 0.0, 0.0}, Pose{9.0, 4.0, 0.0}})
    {
        const std::uint64_t before = search.expanded();
        search.setTarget(target);
        EXPECT_EQ(search.run(afterAsking()), SearchOutcome::Exhausted);
        EXPECT_GT(search.expanded(), before);
        Path path;
        ASSERT_TRUE(search.nearestPath(target, path));
        EXPECT_LE(positionDistance(path.end(), target),
                  nearestByFlooding(problem.world, problem.starts.front(), target) + 0.1);
    }
}

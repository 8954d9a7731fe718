// What is done with all nodes of a large search at once is done in parts, and the search is the same as in one go.

#include "ompl_improved_astar/search/Search.h"
#include "tests/ompl_improved_astar/search/CarProblems.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    constexpr std::uint64_t MANY = 1200;        // expansions
    constexpr std::uint64_t MOST_AT_ONCE = 64;  // nodes that something is done with between two questions
    const Pose LATER{-3.5, -4.0, 0.5 * PI}, EVEN_LATER{-10.0, 4.0, PI};

    /** The curves' estimates, which are counted. */
    class Counting final : public Heuristic
    {
    public:
        void begin(const HeuristicQuery &query) override
        {
            curves_->begin(query);
        }

        double estimate(const Pose &pose) override
        {
            ++asked;
            return curves_->estimate(pose);
        }

        double lowerBound(const Pose &pose) override
        {
            ++asked;
            return curves_->lowerBound(pose);
        }

        static std::uint64_t asked;

    private:
        std::unique_ptr<Heuristic> curves_{heuristics().make("curves")};
    };
    std::uint64_t Counting::asked = 0;

    /** Entries are looked at one by one; counts those that are put in order again. */
    class CountingList final : public OpenList
    {
    public:
        static std::uint64_t arranged;

    protected:
        void pushed() override
        {
        }

        void moveBestToEnd() override
        {
            std::iter_swap(std::max_element(entries_.begin(), entries_.end(), isAfter), entries_.end() - 1);
        }

        void arrange(std::size_t /*place*/) override
        {
            ++arranged;
        }
    };
    std::uint64_t CountingList::arranged = 0;

    /** The goal is in the room without a door. In the other one, with the start, a wall stands in the way. */
    CarProblem vainProblem()
    {
        CarProblem problem{twoRooms(0.0), {{-9.0, -2.0, 0.5 * PI}}, {{6.0, 0.0, 0.0}}};
        problem.world.boxes.push_back({{-6.0, -6.0}, {-5.6, 2.2}});
        problem.world.tellsRoom = false;  // else it would be proven that there is no way
        return problem;
    }

    SearchParameters vainParameters()
    {
        heuristics().add("counting", newPart<Counting>);
        SearchParameters parameters = carParameters();
        parameters.heuristic = "counting";
        parameters.detours = parameters.obstacleHeuristic = false;
        return parameters;
    }

    std::uint64_t nodesOf(const Search &search)
    {
        return search.frontier(Side::Start).nodes().size() + search.frontier(Side::Goal).nodes().size();
    }

    /** A search that has grown in vain. */
    void grow(Search &search, CarProblem &problem, const SearchParameters &parameters)
    {
        problem.begin(search, parameters);
        ASSERT_EQ(search.run({}, MANY), SearchOutcome::Stopped);
        ASSERT_GT(nodesOf(search), 50 * MOST_AT_ONCE);
    }

    std::size_t queuesOf(const Search &search)
    {
        return search.frontier(Side::Start).queues() + search.frontier(Side::Goal).queues();
    }

    /** What lies ahead of each node. */
    std::vector<float> estimatesOf(const Search &search)
    {
        std::vector<float> estimates;
        for (const Side side : {Side::Start, Side::Goal})
            for (const Node &node : search.frontier(side).nodes())
                estimates.push_back(node.h);
        return estimates;
    }

    struct Found
    {
        double cost;
        std::uint64_t expanded, generated;

        bool operator==(const Found &other) const
        {
            return cost == other.cost && expanded == other.expanded && generated == other.generated;
        }
    };

    Found foundBy(const Search &search)
    {
        return {search.bestCost(), search.expanded(), search.statistics().generated};
    }

    /** Searches on until something is found, stopped each time at the so-many-th question. Says how often. */
    int solveInParts(Search &search, int questions)
    {
        int parts = 0;
        SearchOutcome outcome;
        do
        {
            int asked = 0;
            outcome = search.run([&] { return ++asked >= questions; });
            EXPECT_LE(asked, questions) << "it went on asking";
        } while (outcome == SearchOutcome::Stopped && ++parts < 100000);
        EXPECT_EQ(outcome, SearchOutcome::Improved);
        return parts;
    }

    /** Stops a search, whatever it is at, at the so-many-th question. */
    void runFor(Search &search, int questions, std::uint64_t mostExpansions = std::numeric_limits<std::uint64_t>::max())
    {
        search.run([&questions] { return --questions <= 0; }, mostExpansions);
    }
}  // namespace

TEST(SearchStopping, nodesAreEstimatedAnewInPartsWhenAGoalIsAdded)
{
    CarProblem problem = vainProblem();
    Search whole;
    grow(whole, problem, vainParameters());
    whole.addGoal(LATER);
    std::uint64_t before = Counting::asked, longest = 0, last = before;
    ASSERT_EQ(whole.run(
                  [&]
                  {
                      longest = std::max(longest, Counting::asked - std::exchange(last, Counting::asked));
                      return false;
                  }),
              SearchOutcome::Improved);
    EXPECT_GT(Counting::asked - before, nodesOf(whole)) << "all were estimated anew";
    EXPECT_LE(longest, MOST_AT_ONCE);
    for (const int questions : {2, 3, 7, 40, 1000})
    {
        SCOPED_TRACE(questions);
        Search parts;
        grow(parts, problem, vainParameters());
        parts.addGoal(LATER);
        before = Counting::asked;
        runFor(parts, 4);
        EXPECT_LE(Counting::asked - before, 4 * MOST_AT_ONCE);
        EXPECT_GT(Counting::asked, before);
        EXPECT_GE(solveInParts(parts, questions), questions < 100 ? 4 : 0);
        EXPECT_TRUE(foundBy(parts) == foundBy(whole));
        // What has been estimated is not estimated again.
        EXPECT_LT(Counting::asked - before, 2 * nodesOf(whole));
    }
}

TEST(SearchStopping, listsAreSortedInPartsWhenAGoalIsAdded)
{
    openLists().add("counting", newPart<CountingList>);
    CarProblem problem = vainProblem();
    SearchParameters parameters = vainParameters();
    parameters.openList = "counting";
    Search search;
    grow(search, problem, parameters);
    search.addGoal(LATER);
    std::uint64_t last = CountingList::arranged = 0, longest = 0;
    ASSERT_EQ(search.run(
                  [&]
                  {
                      longest = std::max(longest, CountingList::arranged - std::exchange(last, CountingList::arranged));
                      return false;
                  }),
              SearchOutcome::Improved);
    EXPECT_GT(CountingList::arranged, 4000u);
    EXPECT_LT(longest, 2000u) << "some parts, each of a list";
}

TEST(SearchStopping, whatIsAddedMeanwhileIsTakenIn)
{
    CarProblem problem = vainProblem();
    const std::function<void(Search &)> additions[]{[](Search &search) { search.addGoal(EVEN_LATER); },
                                                    [](Search &search)
                                                    {
                                                        search.addStart({-8.0, -4.5, 0.5 * PI});
                                                    }};
    Search alone;
    grow(alone, problem, vainParameters());
    alone.addGoal(LATER);
    ASSERT_EQ(alone.run({}), SearchOutcome::Improved);
    for (const std::function<void(Search &)> &add : additions)
    {
        Search whole;
        grow(whole, problem, vainParameters());
        whole.addGoal(LATER);
        add(whole);
        EXPECT_EQ(whole.run({}, MANY + 1), SearchOutcome::Stopped);
        const std::vector<float> estimates = estimatesOf(whole);
        ASSERT_EQ(whole.run({}), SearchOutcome::Improved);
        // In the middle of the estimates, of sorting, of what is queued again, and at the end of it all.
        for (int questions = 2; questions < 1000; questions += 1 + questions / 4)
        {
            SCOPED_TRACE(questions);
            Search parts;
            grow(parts, problem, vainParameters());
            parts.addGoal(LATER);
            runFor(parts, questions);
            if (parts.expanded() > MANY)
                break;
            EXPECT_LE(parts.lowerBound(), alone.bestCost());
            add(parts);
            while (parts.expanded() == MANY)
                runFor(parts, 5, MANY + 1);
            EXPECT_EQ(estimatesOf(parts), estimates);
            solveInParts(parts, 5);
            EXPECT_NEAR(parts.bestCost(), whole.bestCost(), 1e-9);
            EXPECT_EQ(faultOf(parts.bestPath(), problem.world, {problem.starts.front(), parts.bestPath().start},
                              {LATER, EVEN_LATER}, TURNING_RADIUS),
                      "");
        }
    }
}

TEST(SearchStopping, manyGoalsAreQueuedInParts)
{
    CarProblem problem = vainProblem();
    for (int i = 0; i < 200; ++i)
        problem.goals.push_back({3.0 + 0.01 * i, 0.0, 0.0});
    SearchParameters parameters = vainParameters();
    parameters.weights = {1.0, 1.0, 0.0, 0.0};
    Search whole, parts;
    problem.begin(whole, parameters);
    std::uint64_t last = Counting::asked, longest = 0;
    whole.run(
        [&]
        {
            longest = std::max(longest, Counting::asked - std::exchange(last, Counting::asked));
            return false;
        },
        MOST_AT_ONCE);
    EXPECT_LE(longest, MOST_AT_ONCE);
    problem.begin(parts, parameters);
    runFor(parts, 2);
    EXPECT_EQ(parts.expanded(), 0u);
    EXPECT_LE(parts.lowerBound(), whole.lowerBound()) << "what is not open yet is no bound";
    while (parts.expanded() < MOST_AT_ONCE)
        runFor(parts, 2, MOST_AT_ONCE);
    EXPECT_TRUE(foundBy(parts) == foundBy(whole));
    EXPECT_EQ(parts.lowerBound(), whole.lowerBound());
    const Frontier &goals = std::as_const(parts).frontier(Side::Goal);
    for (const NodeIndex root : goals.roots())
        EXPECT_TRUE(goals.node(root).queued) << root;
}

TEST(SearchStopping, aNewQueryKnowsNothingOfWhatWasLeftInTheMiddle)
{
    CarProblem problem = vainProblem(), other{problem.world, problem.starts, {LATER}};
    Search fresh;
    other.begin(fresh, vainParameters());
    ASSERT_EQ(fresh.run({}), SearchOutcome::Improved);
    for (const int questions : {2, 30, 90, 150, 200})
    {
        SCOPED_TRACE(questions);
        Search search;
        grow(search, problem, vainParameters());
        search.addGoal(LATER);
        runFor(search, questions);
        search.setWeights({1.5, 1.5, 0.0, 0.0}, [] { return true; });
        other.begin(search, vainParameters());
        ASSERT_EQ(search.run({}), SearchOutcome::Improved);
        EXPECT_TRUE(foundBy(search) == foundBy(fresh));
    }
}

TEST(SearchStopping, listsAreSortedByOtherWeightsInParts)
{
    const HeuristicWeights weights{1.2, 1.2, 0.0, 0.0};
    CarProblem problem = vainProblem();
    // Of the same search with and without another goal.
    for (const bool isAdded : {false, true})
    {
        SCOPED_TRACE(isAdded);
        Search whole;
        grow(whole, problem, vainParameters());
        whole.setWeights(weights);
        if (isAdded)
            whole.addGoal(LATER);
        whole.run({}, 2 * MANY);
        for (const int questions : {2, 3, 5})
        {
            SCOPED_TRACE(questions);
            Search parts;
            grow(parts, problem, vainParameters());
            int asked = 0;
            parts.setWeights(weights, [&asked] { return ++asked > 0; });
            EXPECT_EQ(asked, 1) << "there is more than a part";
            // And by yet others in the middle of it.
            if (questions == 3)
            {
                parts.setWeights({7.0, 0.1, 5.0, 0.0}, [] { return true; });
                parts.setWeights(weights);
            }
            if (isAdded)
                parts.addGoal(LATER);
            do
                runFor(parts, questions, 2 * MANY);
            while (!parts.hasSolution() && parts.expanded() < 2 * MANY);
            EXPECT_EQ(parts.hasSolution(), isAdded);
            EXPECT_TRUE(foundBy(parts) == foundBy(whole));
        }
    }
}

TEST(SearchStopping, detoursAreFilledInParts)
{
    CarProblem problem = vainProblem();
    SearchParameters parameters = vainParameters();
    parameters.detours = parameters.obstacleHeuristic = true;
    parameters.tuning.leastExpansions = MANY;
    Search whole;
    grow(whole, problem, parameters);
    std::uint64_t expanded = 0, atOnce = 0, most = 0;
    whole.run(
        [&]
        {
            atOnce = std::exchange(expanded, whole.expanded()) == whole.expanded() ? atOnce + 1 : 0;
            most = std::max(most, atOnce);
            return false;
        },
        MANY + 300);
    EXPECT_EQ(queuesOf(whole), 3u) << "one detour";
    EXPECT_GE(most, nodesOf(whole) / MOST_AT_ONCE / 2) << "asked while the detour began";
    for (const int questions : {2, 3, 10})
    {
        SCOPED_TRACE(questions);
        Search parts;
        grow(parts, problem, parameters);
        while (parts.expanded() < MANY + 300)
            runFor(parts, questions, MANY + 300);
        EXPECT_TRUE(foundBy(parts) == foundBy(whole));
    }
    // Another goal ends the detour, even if that has hardly begun.
    Search early;
    grow(early, problem, parameters);
    runFor(early, 2);
    EXPECT_EQ(early.expanded(), MANY);
    EXPECT_EQ(queuesOf(early), 3u);
    early.addGoal(LATER);
    solveInParts(early, 5);
    EXPECT_EQ(faultOf(early.bestPath(), problem.world, problem.starts, {LATER}, TURNING_RADIUS), "");
}

namespace
{
    /** A world in which the time is up now and then: nothing is free then, and no clearance known. */
    class HurriedWorld : public DiscCarWorld
    {
    public:
        HurriedWorld(const DiscCarWorld &world, int period) : DiscCarWorld(world), period_(period)
        {
        }

        double freeLength(const Pose &from, double curvature, double length) override
        {
            return isUp() ? 0.0 : DiscCarWorld::freeLength(from, curvature, length);
        }

        double clearance(const Pose &pose) override
        {
            return isUp() ? 0.0 : DiscCarWorld::clearance(pose);
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
        bool isUp()
        {
            isUp_ = isUp_ || ++asked_ % period_ == 0;
            return isUp_;
        }

        int period_, asked_{0};
        bool isUp_{false};
    };

    /** How far the car can drive from a node at most, by the motions that are tried from it. */
    double mobilityOf(const Node &node, DiscCarWorld &world, const SearchParameters &parameters)
    {
        const double reach = parameters.tuning.reach * TURNING_RADIUS;
        double farthest = 0.0;
        for (const double curvature : {-1.0 / TURNING_RADIUS, 0.0, 1.0 / TURNING_RADIUS})
            for (const double length : {-reach, reach})
                if (node.parent == NO_NODE || curvature != node.motion.curvature ||
                    (length * node.motion.length > 0.0 && node.farthest))
                    farthest = std::max(farthest, world.freeLength(node.pose, curvature, length));
        return farthest;
    }
}  // namespace

TEST(SearchStopping, whatIsSaidInAHurryIsNotKept)
{
    std::uint64_t priced = 0, dear = 0, expanded = 0, ahead = 0;
    std::vector<CarProblem> problems;
    for (std::uint64_t seed = 0; seed < 12; ++seed)
        problems.push_back(randomProblem(seed, 14));
    // Long ways through the open, where the search looks ahead.
    for (const double y : {-30.0, -10.0, 10.0})
        problems.push_back({DiscCarWorld({{-70.0, -40.0}, {70.0, 40.0}}, {{{-1.0, -40.0}, {1.0, 30.0}}}),
                            {{-60.0, y, 0.0}},
                            {{60.0, y, PI}}});
    for (const CarProblem &problem : problems)
        for (const int period : {97, 301, 1009})
        {
            SCOPED_TRACE(testing::Message() << problem.starts.front().x << ", " << period);
            HurriedWorld world(problem.world, period);
            DiscCarWorld calm = problem.world;
            SearchParameters parameters = carParameters();
            parameters.cost.preferredClearance = 0.5;
            parameters.cost.clearanceCost = 10.0;
            Search search;
            search.begin(world, parameters);
            search.addStart(problem.starts.front());
            search.addGoal(problem.goals.front());
            while (search.run([&world] { return world.wasInterrupted(); }, 150) == SearchOutcome::Stopped &&
                   search.expanded() < 150)
                world.goOn();
            for (const Side side : {Side::Start, Side::Goal})
                for (const Node &node : std::as_const(search).frontier(side).nodes())
                {
                    if (node.isExpanded())
                    {
                        EXPECT_NEAR(node.mobility, mobilityOf(node, calm, parameters), 1e-6);
                        ++expanded;
                    }
                    if (node.parent == NO_NODE)
                        continue;
                    const Node &parent = std::as_const(search).frontier(side).node(node.parent);
                    const PathPiece drive = node.motion.drive();
                    const CostModel &model = search.cost();
                    const double closeness = model.closeness(parent.pose, drive, calm, 0.0);
                    const double joined = parent.parent != NO_NODE ? model.join(parent.motion.drive(), drive) : 0.0;
                    EXPECT_NEAR(node.g - parent.g, drive.driven() + joined + closeness, 1e-9);
                    ++priced;
                    dear += closeness > 0.0 ? 1 : 0;
                    ahead += node.fixed && node.farthest && closeness == 0.0 ? 1 : 0;
                }
            ASSERT_FALSE(HasFailure());
        }
    EXPECT_GT(priced, 5000u);
    EXPECT_GT(dear, 1000u);
    EXPECT_GT(expanded, 1000u);
    EXPECT_GT(ahead, 100u);
}

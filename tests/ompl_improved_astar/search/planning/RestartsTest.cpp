// Searches that begin anew: right and cheap enough paths, no more expansions than they may, the same in pieces.

#include "ompl_improved_astar/search/planning/PathPlanner.h"
#include "ompl_improved_astar/search/planning/Restarts.h"
#include "tests/ompl_improved_astar/search/CarProblems.h"
#include "tests/ompl_improved_astar/search/ClearanceWorld.h"
#include "tests/ompl_improved_astar/search/RowOfCars.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    constexpr double INFINITE = std::numeric_limits<double>::infinity();

    struct Found
    {
        double cost, length;
        std::uint64_t expanded;
    };

    bool operator==(const Found &a, const Found &b)
    {
        return a.cost == b.cost && a.length == b.length && a.expanded == b.expanded;
    }

    constexpr std::uint64_t SEARCHES = 100;  // more than there are in these tests

    /** Everything found with so many expansions, asked for in steps of so many; each must be right. */
    std::vector<Found> findAll(CarProblem &problem, const SearchParameters &parameters, std::uint64_t most,
                               std::uint64_t step, double mostCost = INFINITE)
    {
        Restarts restarts;
        problem.begin(restarts, parameters);
        std::vector<Found> found;
        for (std::uint64_t end = step; end <= most; end += step)
            while (restarts.run(afterAsking(), end, SEARCHES, mostCost))
            {
                EXPECT_EQ(faultOf(restarts.path(), problem.world, problem.starts, problem.goals, TURNING_RADIUS), "");
                EXPECT_NEAR(restarts.cost(), pathCost(parameters.cost, restarts.path(), problem.world), 1e-6);
                EXPECT_LT(restarts.cost(), mostCost);
                found.push_back({restarts.cost(), restarts.path().length(), restarts.expanded()});
            }
        EXPECT_LE(restarts.expanded(), most);
        EXPECT_EQ(restarts.statistics().expanded, restarts.expanded());
        return found;
    }
}  // namespace

TEST(Restarts, findRightPathsOneAfterTheOtherTheSameInPieces)
{
    std::size_t several = 0, limited = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed)
    {
        SCOPED_TRACE(seed);
        CarProblem problem = randomProblem(seed);
        const SearchParameters parameters = parametersIn(problem);
        const std::vector<Found> whole = findAll(problem, parameters, 1200, 1200);
        ASSERT_TRUE(findAll(problem, parameters, 1200, 1200) == whole);
        ASSERT_TRUE(findAll(problem, parameters, 1200, 100) == whole);
        if (whole.empty())
            continue;
        // Other motions lead to other paths, except where there is a single curve.
        double least = INFINITE, most = 0.0;
        for (const Found &each : whole)
        {
            least = std::min(least, each.cost);
            most = std::max(most, each.cost);
        }
        several += least < most - 0.1 ? 1 : 0;
        for (const Found &each : findAll(problem, parameters, 1200, 1200, 1.05 * least))
            limited += each.cost < 1.05 * least ? 1 : 0;
    }
    EXPECT_GT(several, 20U);
    EXPECT_GT(limited, 20U);
}

namespace
{
    /** Counts who wants to prove that there is no way. */
    class ProvableWorld : public DiscCarWorld
    {
    public:
        explicit ProvableWorld(const DiscCarWorld &world) : DiscCarWorld(world)
        {
        }

        std::unique_ptr<BodyCells> bodyCells(double /*side*/, int /*headings*/) override
        {
            ++proofs;
            return nullptr;
        }

        std::uint64_t proofs{0};
    };

    /** What there is to be seen of a search. */
    struct Seen
    {
        std::vector<Found> found;
        std::uint64_t expanded, generated, roomsAsked, proofs;

        bool operator==(const Seen &other) const
        {
            return found == other.found && expanded == other.expanded && generated == other.generated &&
                   roomsAsked == other.roomsAsked && proofs == other.proofs;
        }
    };

    /** Runs a Search, or Restarts that begin so many, for so many expansions each. */
    template <class Searcher, class Run>
    Seen seenOf(const CarProblem &problem, const SearchParameters &parameters, const Run &run)
    {
        ProvableWorld world(problem.world);
        Searcher searcher;
        searcher.begin(world, parameters);
        for (const Pose &start : problem.starts)
            searcher.addStart(start);
        for (const Pose &goal : problem.goals)
            searcher.addGoal(goal);
        std::vector<Found> found = run(searcher);
        const SearchStatistics statistics = searcher.statistics();
        return {std::move(found), statistics.expanded, statistics.generated, world.roomsAsked, world.proofs};
    }

    Seen searchedOnce(const CarProblem &problem, const SearchParameters &parameters, std::uint64_t expansions)
    {
        return seenOf<Search>(
            problem, parameters,
            [expansions](Search &search)
            {
                std::vector<Found> found;
                while (search.run(afterAsking(), expansions) == SearchOutcome::Improved)
                    found.push_back({search.bestCost(), search.bestPath().length(), search.expanded()});
                return found;
            });
    }

    Seen searchedAnew(const CarProblem &problem, const SearchParameters &parameters, std::uint64_t expansions,
                      std::uint64_t searches)
    {
        return seenOf<Restarts>(
            problem, parameters,
            [expansions, searches](Restarts &restarts)
            {
                std::vector<Found> found;
                while (restarts.run(afterAsking(), expansions, searches, INFINITE))
                    found.push_back({restarts.cost(), restarts.path().length(), restarts.expanded()});
                return found;
            });
    }
}  // namespace

// Another way is wanted, not one at any cost, and that there is one is known: what is done for the sake of these in the
// first search is left out, whatever the parameters say. Each of it makes a difference to that.
TEST(Restarts, areNotGreedyInDetoursLoadNoMapAndLookForNoProof)
{
    constexpr std::uint64_t EXPANSIONS = 900;
    const Row row;
    const CarProblem trap = rowOfCars(row);
    SearchParameters usual = parametersIn(trap);
    usual.spreadOut = false;
    usual.tuning.firstRestart = EXPANSIONS;
    const Seen first = searchedOnce(trap, usual, EXPANSIONS), anew = searchedAnew(trap, usual, EXPANSIONS, 1);
    ASSERT_FALSE(anew.found.empty());
    EXPECT_GT(anew.found.front().expanded, usual.tuning.leastExpansions) << "there were detours";
    SearchParameters counting = usual;
    counting.tuning.greedyDetours = false;
    EXPECT_FALSE(searchedOnce(trap, counting, EXPANSIONS) == first);
    EXPECT_TRUE(searchedAnew(trap, counting, EXPANSIONS, 1) == anew);
    SearchParameters loading = usual;
    loading.eagerObstacles = true;
    EXPECT_FALSE(searchedOnce(trap, loading, EXPANSIONS) == first);
    EXPECT_TRUE(searchedAnew(trap, loading, EXPANSIONS, 1) == anew);
    SearchParameters proving = usual;
    proving.bodyRadius = usual.inscribedRadius;
    proving.tuning.enclosureAfter = 1;
    EXPECT_GT(searchedOnce(trap, proving, EXPANSIONS).proofs, 0u);
    EXPECT_EQ(searchedAnew(trap, proving, EXPANSIONS, 1).proofs, 0u);
}

TEST(Restarts, spreadOutEveryOtherTime)
{
    SearchParameters usual = carParameters();
    usual.detours = false;
    SearchParameters straight = usual;
    straight.spreadOut = false;
    std::uint64_t before = 0, beforeStraight = 0;
    for (std::uint64_t searches = 1; searches <= 6; ++searches)
    {
        SCOPED_TRACE(searches);
        // One that is never solved spreads out until its end. Of all but the last the difference is known.
        CarProblem problem{twoRooms(0.0), {{-9.0, -2.0, 0.5 * PI}}, {{6.0, 0.0, 0.0}}};
        problem.world.tellsRoom = false;
        const std::uint64_t spread = searchedAnew(problem, usual, 100000, searches).generated,
                            kept = searchedAnew(problem, straight, 100000, searches).generated;
        EXPECT_EQ(spread - before == kept - beforeStraight, searches % 2 == 0);
        before = spread;
        beforeStraight = kept;
    }
}

TEST(Restarts, searchTowardsRootsThatWereAdded)
{
    CarProblem problem{DiscCarWorld({{-20.0, -12.0}, {20.0, 12.0}}), {{-15.0, 0.0, 0.0}}, {{15.0, 0.0, 1.0}}};
    Restarts restarts;
    problem.begin(restarts, parametersIn(problem));
    ASSERT_TRUE(restarts.run(afterAsking(), 500, SEARCHES, INFINITE));
    const double cost = restarts.cost();
    restarts.addGoal({-8.0, 0.0, 0.0});
    ASSERT_TRUE(restarts.run(afterAsking(), 1000, SEARCHES, INFINITE));
    EXPECT_NEAR(restarts.path().end().x, -8.0, 1e-6);
    restarts.addStart({-9.0, 0.0, 0.0});
    ASSERT_TRUE(restarts.run(afterAsking(), 1500, SEARCHES, INFINITE));
    EXPECT_EQ(restarts.path().start.x, -9.0);
    EXPECT_LT(restarts.cost(), 0.1 * cost);
}

TEST(Restarts, endWhenTheyAreStoppedOrHaveNoMemory)
{
    CarProblem problem = tightSlot();
    Restarts restarts;
    problem.begin(restarts, parametersIn(problem));
    EXPECT_FALSE(restarts.run([] { return true; }, 100000, SEARCHES, INFINITE));
    EXPECT_LE(restarts.expanded(), 1U);
    EXPECT_EQ(restarts.searches(), 0U) << "none has begun while the time was up";
    EXPECT_TRUE(restarts.run(afterAsking(), 100000, SEARCHES, INFINITE));
    problem.begin(restarts, parametersIn(problem));
    EXPECT_FALSE(restarts.run(afterAsking(), 100000, 7, 0.0)) << "nothing is cheap enough";
    EXPECT_EQ(restarts.searches(), 7U);
    EXPECT_LE(restarts.expanded(), 70U);
    CarProblem closed{twoRooms(0.0), {{-9.0, 0.0, 0.0}}, {{6.0, 0.0, 0.0}}};
    closed.world.tellsRoom = false;
    SearchParameters parameters = parametersIn(closed);
    parameters.maxMemory = std::size_t{1} << 20;
    closed.begin(restarts, parameters);
    EXPECT_FALSE(restarts.run(afterAsking(), 1000000, 5, INFINITE));
    EXPECT_EQ(restarts.searches(), 5U);
    EXPECT_GT(restarts.expanded(), 1000U);
    EXPECT_LT(restarts.expanded(), 1000000U);
}

TEST(Restarts, letAnytimeFindCheaperPathsWithAsManyExpansions)
{
    double with = 0.0, without = 0.0;
    std::size_t solved = 0;
    for (std::uint64_t seed = 0; seed < 80; ++seed)
    {
        SCOPED_TRACE(seed);
        CarProblem problem = randomProblem(seed, 16);
        const auto cost = [&](std::size_t restartsPerRound)
        {
            PathPlannerParameters parameters;
            parameters.search = parametersIn(problem);
            parameters.search.tuning.restartsPerRound = restartsPerRound;
            parameters.anytime = true;
            PathPlanner planner;
            problem.begin(planner, parameters);
            planner.solve(afterExpanding(planner, 3000), {});
            if (planner.hasSolution())
            {
                EXPECT_EQ(faultOf(planner.bestPath(), problem.world, problem.starts, problem.goals, TURNING_RADIUS),
                          "");
                EXPECT_EQ(planner.statistics().expanded, planner.expanded());
            }
            return planner.bestCost();
        };
        const double costWith = cost(SearchTuning().restartsPerRound);
        if (costWith == INFINITE)
            continue;
        ++solved;
        with += costWith;
        without += cost(0);
    }
    EXPECT_GT(solved, 20U);
    EXPECT_LT(with, without);
}

/** The ends are joined as soon as they are there, so that a search may find a path and nothing to expand: ever new ones
    must not begin then. */
TEST(Restarts, endWhereTheCurveBetweenTheEndsIsAllThereIs)
{
    // Its end is nearer to the wall than preferred. It costs less than the table of lengths, which are rounded,
    // promises: the other search does not expand anything.
    CarProblem problem{DiscCarWorld({{-40.0, -20.0}, {40.0, 20.0}}), {{-5.0, 0.0, 0.0}}, {{5.0, 0.0, 0.0}}};
    problem.world.boxes.push_back({{5.0 + 2.6 + 0.95 + 0.3, -1.0}, {39.0, 1.0}});
    ClearanceWorld world(problem.world);
    PathPlannerParameters parameters;
    parameters.search = parametersIn(problem);
    parameters.search.cost.preferredClearance = 0.5;
    parameters.search.cost.clearanceCost = 0.2;
    parameters.anytime = true;
    PathPlanner planner;
    planner.begin(world, parameters);
    planner.addStart(problem.starts.front());
    planner.addGoal(problem.goals.front());
    std::uint64_t asked = 0;
    const auto outcome = planner.solve([&] { return planner.expanded() > 100000 || ++asked > 300000; }, {});
    EXPECT_EQ(outcome, PathPlanner::Outcome::Solved);
    EXPECT_GT(planner.bestCost(), planner.bestPath().length());
    EXPECT_LT(asked, 30000U);
}

TEST(HeuristicWeights, areLoweredToOneAndNeverRaised)
{
    const HeuristicWeights given{3.0, 1.2, 7.0, 0.01};
    const HeuristicWeights lower = given.lowered(0.5);
    EXPECT_EQ(lower.far, 1.5);
    EXPECT_EQ(lower.near, 1.0);
    EXPECT_EQ(lower.nearDistance, 7.0);
    EXPECT_EQ(lower.tieBreak, 0.01);
    const HeuristicWeights low = HeuristicWeights{0.5, 1.0}.lowered(0.5);
    EXPECT_EQ(low.far, 0.5);
    EXPECT_EQ(low.near, 1.0);
}

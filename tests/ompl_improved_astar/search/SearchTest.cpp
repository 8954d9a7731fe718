// The search with the car's motions: the laws that every result obeys, in named problems and in random worlds.

#include "ompl_improved_astar/search/Search.h"
#include "tests/ompl_improved_astar/search/CarWorlds.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <iterator>
#include <limits>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    // Without a path the search becomes ever finer, for longer than a test should take.
    constexpr std::uint64_t MAX_EXPANSIONS = 20000;

    /** Every switch at random; what makes solutions rare is off more often than not. */
    PlannerParameters randomParameters(Random &random)
    {
        PlannerParameters parameters = carParameters();
        parameters.steeringAngles = 3 + 2 * static_cast<unsigned int>(random.index(3));
        parameters.bidirectional = random.chance(0.6);
        parameters.searchFrom = random.chance(0.5) ? "goal" : "start";
        parameters.adaptiveResolution = random.chance(0.7);
        parameters.obstacleHeuristic = random.chance(0.7);
        parameters.detours = random.chance(0.7);
        parameters.obstacleLoading = random.chance(0.7) ? "lazy" : "eager";
        parameters.openList = random.chance(0.7) ? "binary_heap" : "linear";
        parameters.heuristicWeightFar = random.between(1.0, 3.0);
        parameters.heuristicWeightNear = random.chance(0.5) ? parameters.heuristicWeightFar : 1.0;
        parameters.reversePenalty = random.chance(0.5) ? random.between(0.0, 1.0) : 0.0;
        parameters.gearChangePenalty = random.between(0.0, 2.0);
        parameters.steeringChangePenalty = random.between(0.0, 0.3);
        parameters.preferredClearance = random.chance(0.5) ? random.between(0.05, 0.5) : 0.0;
        return parameters;
    }

    /** Expects the best path to obey every law that holds whatever the parameters are. */
    void expectLawful(Search &search, CarProblem &problem)
    {
        const Path &path = search.bestPath();
        ASSERT_EQ(problem.faultOf(path), "");
        ASSERT_LE(search.lowerBound(), search.bestCost() + 1e-6);
        ASSERT_GE(search.bestCost(), path.length() - 1e-6);
        const PricedPath priced = price(search.cost(), path, problem.world);
        // Where the clearance is sampled depends on how a path is cut into pieces.
        const CostModel &cost = search.cost();
        const double sampling = 2.0 * cost.clearanceCost * cost.sampleSpacing * static_cast<double>(path.pieces.size());
        ASSERT_NEAR(search.bestCost(), priced.cost, cost.prefersClearance() ? sampling : 1e-6);
    }
}  // namespace

TEST(Search, everyPathIsFreeDrivableAndPricedRightWhateverTheSwitches)
{
    std::size_t solved = 0, improved = 0;
    for (std::uint64_t seed = 0; seed < 150; ++seed)
    {
        SCOPED_TRACE(seed);
        Random random(seed);
        CarProblem problem = randomProblem(seed, 4 + 3 * static_cast<std::uint32_t>(seed % 4));
        const PlannerParameters parameters = randomParameters(random);
        problem.world.acceptsPaths = seed % 10 != 0;
        problem.forwardOnly = random.chance(0.2);
        problem.maxCusps = random.chance(0.3) ? static_cast<std::uint8_t>(random.index(4)) : ANY_CUSPS;
        Search search;
        problem.begin(search, parameters);
        double last = UNREACHED;
        while (search.run({}, 600) == SearchOutcome::Improved)
        {
            ASSERT_TRUE(problem.world.acceptsPaths);
            ASSERT_LE(search.bestCost(), last + 1e-9);
            solved += last == UNREACHED;
            improved += last < UNREACHED;
            last = search.bestCost();
            expectLawful(search, problem);
            if (HasFatalFailure())
                return;
            search.lowerWeights(0.7);
        }
        ASSERT_EQ(search.bestCost(), last) << "kept";
    }
    EXPECT_GT(solved, 75u);
    EXPECT_GT(improved, 50u);
}

TEST(Search, equalInputGivesEqualPathsAlsoInUsedMemoryAndAfterPauses)
{
    Search reused;
    for (std::uint64_t seed = 0; seed < 60; ++seed)
    {
        SCOPED_TRACE(seed);
        Random random(seed);
        CarProblem problem = randomProblem(seed, 14);
        const PlannerParameters parameters = randomParameters(random);
        Search fresh;
        problem.begin(fresh, parameters);
        const SearchOutcome outcome = fresh.run({}, 1000);
        const auto expectSame = [&, path = fresh.bestPath(), cost = fresh.bestCost(),
                                 generated = fresh.statistics().generated](const Search &other, SearchOutcome found)
        {
            ASSERT_EQ(found, outcome);
            ASSERT_EQ(other.bestCost(), cost);
            ASSERT_TRUE(isSamePath(other.bestPath(), path));
            ASSERT_EQ(other.statistics().generated, generated);
        };
        problem.begin(fresh, parameters);
        expectSame(fresh, fresh.run({}, 1000));
        problem.begin(reused, parameters);
        SearchOutcome found = SearchOutcome::Stopped;
        for (std::uint64_t limit = 0; limit <= 1000 && found == SearchOutcome::Stopped; ++limit)
        {
            found = reused.run({}, limit);
            ASSERT_TRUE(found != SearchOutcome::Stopped || reused.expanded() == limit);
        }
        expectSame(reused, found);
        ASSERT_FALSE(HasFatalFailure());
    }
}

TEST(Search, askedToStopItDoesAndThenSolvesTheSameInEveryDirection)
{
    // What one expansion and its curves to the other side may ask, generously.
    constexpr std::uint64_t MAX_QUESTIONS = 2000;
    constexpr int POLLS[]{0, 1, 2, 5, 20, 100, 3, 50};
    for (const NamedProblem &each : namedProblems())
        for (std::size_t i = 0; i < std::size(POLLS); ++i)
        {
            SCOPED_TRACE(testing::Message() << each.name << ", " << POLLS[i] << " polls");
            CarProblem problem = each.problem;
            problem.world.tellsRoom = i < 4;
            PlannerParameters parameters = carParameters();
            parameters.bidirectional = i % 2 == 0;
            parameters.searchFrom = i % 4 < 2 ? "goal" : "start";
            Search search;
            problem.begin(search, parameters);
            SearchOutcome outcome = SearchOutcome::Stopped;
            for (int round = 0; round < 40 && outcome == SearchOutcome::Stopped; ++round)
            {
                std::uint64_t expanded = 0;
                MeasuredStop stop{problem.world, afterPolls(POLLS[i])};
                outcome = search.run(
                    [&]
                    {
                        expanded = stop.isStopped ? expanded : search.expanded();
                        return stop();
                    },
                    search.expanded() + MAX_EXPANSIONS);
                ASSERT_LE(stop.maxQuestions(), MAX_QUESTIONS);
                if (outcome != SearchOutcome::Stopped)
                    break;
                ASSERT_LE(search.expanded(), expanded + 1);
            }
            // Estimates made in haste are poor, but nothing is lost.
            if (outcome == SearchOutcome::Stopped)
                outcome = search.run({}, search.expanded() + MAX_EXPANSIONS);
            ASSERT_EQ(outcome == SearchOutcome::Improved, each.isSolvable);
            if (each.isSolvable)
                expectLawful(search, problem);
        }
}

TEST(Search, anInterruptedWorldProvesNothing)
{
    for (const NamedProblem &each : namedProblems())
        for (const std::uint64_t atOnce : {5u, 30u, 1000u})
        {
            SCOPED_TRACE(testing::Message() << each.name << ", " << atOnce << " questions at once at most");
            CarProblem problem = each.problem;
            problem.world.tellsBlocked = true;
            problem.world.tellsRoom = atOnce > 30u;  // else the route takes all of them
            PlannerParameters parameters = carParameters();
            parameters.preferredClearance = atOnce == 1000u ? 0.2 : 0.0;
            Search search;
            problem.begin(search, parameters);
            SearchOutcome outcome = SearchOutcome::Stopped;
            const auto interrupted = [&problem]
            {
                return problem.world.wasInterrupted();
            };
            for (int round = 0; round < 100 && outcome == SearchOutcome::Stopped; ++round)
            {
                problem.world.lastQuestion = problem.world.questions + static_cast<std::uint64_t>(round) * 7 % atOnce;
                outcome = search.run(interrupted, MAX_EXPANSIONS);
            }
            problem.world.lastQuestion = std::numeric_limits<std::uint64_t>::max();
            if (outcome == SearchOutcome::Stopped)
                outcome = search.run({}, 2 * MAX_EXPANSIONS);
            ASSERT_EQ(outcome == SearchOutcome::Improved, each.isSolvable);
            if (each.isSolvable)
                expectLawful(search, problem);
        }
}

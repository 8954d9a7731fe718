// Looking ahead along the disc's way.

#include "ompl_improved_astar/search/Search.h"
#include "tests/ompl_improved_astar/search/CarProblems.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    constexpr std::uint64_t MOST_EXPANSIONS = 4000;

    /** Lanes beside each other, joined at alternate ends: a long way with room. */
    struct Lanes
    {
        int count{5};
        double length{80.0};
        double width{9.0};

        Box bounds() const
        {
            return {{0.0, 0.0}, {length, count * width}};
        }

        double middleOf(int lane) const
        {
            return (lane + 0.5) * width;
        }
    };

    CarProblem lanesToDrive(const Lanes &lanes, const Pose &start, const Pose &goal)
    {
        CarProblem problem{DiscCarWorld(lanes.bounds()), {start}, {goal}};
        for (int i = 1; i < lanes.count; ++i)
        {
            const double y = i * lanes.width, open = 1.2 * lanes.width;
            problem.world.boxes.push_back(i % 2 == 1 ? Box{{0.0, y - 0.1}, {lanes.length - open, y + 0.1}}
                                                     : Box{{open, y - 0.1}, {lanes.length, y + 0.1}});
        }
        return problem;
    }

    CarProblem lanesToDrive(const Lanes &lanes, double startYaw = 0.0)
    {
        return lanesToDrive(lanes, {6.0, lanes.middleOf(0), startYaw}, {70.0, lanes.middleOf(lanes.count - 1), 0.0});
    }

    /** Expansions up to the first solution. */
    std::uint64_t expansions(CarProblem problem, const SearchParameters &parameters)
    {
        Search search;
        EXPECT_TRUE(isSolved(search, problem, parameters, MOST_EXPANSIONS));
        return search.expanded();
    }

    /** Calls visit(parent, node) for what was reached by looking ahead: nothing else makes nodes that stay as they are
        while the search is not stuck. */
    template <class Visit>
    int forEachAhead(const Search &search, const Visit &visit)
    {
        int count = 0;
        for (const Side side : {Side::Start, Side::Goal})
            for (const Node &node : search.frontier(side).nodes())
                if (node.fixed && node.parent != NO_NODE)
                {
                    visit(search.frontier(side).node(node.parent), node);
                    ++count;
                }
        return count;
    }
}  // namespace

TEST(SearchLookahead, crossesOpenWaysInAFewExpansions)
{
    for (const int count : {1, 3, 5, 9})
    {
        SCOPED_TRACE(count);
        const Lanes lanes{count};
        const CarProblem problem = lanesToDrive(lanes);
        SearchParameters with = parametersIn(problem), without = with;
        without.lookAhead = false;
        const std::uint64_t ahead = expansions(problem, with);
        EXPECT_LT(ahead, 30u + 25u * static_cast<unsigned int>(count));
        if (count > 1)
        {
            EXPECT_GT(expansions(problem, without), 2 * ahead);
        }
    }
}

TEST(SearchLookahead, crossesLongOpenWaysWithCarsThatNearlyTurnOnTheSpot)
{
    // A thousand of their turning radii: cells in proportion to these alone would be too many to find the way at all.
    for (const double turningRadius : {0.3, 0.4})
    {
        SCOPED_TRACE(turningRadius);
        CarProblem problem = lanesToDrive({3, 450.0, 30.0}, {6.0, 15.0, 0.0}, {440.0, 75.0, 0.0});
        problem.world.radius = 0.4;
        problem.world.offsets = {-0.6, 0.0, 0.2};
        SearchParameters parameters = parametersIn(problem);
        parameters.turningRadius = turningRadius;
        parameters.bodyRadius = problem.world.radius;
        Search search;
        problem.begin(search, parameters);
        search.run({}, 1000);
        ASSERT_TRUE(search.hasSolution());
        EXPECT_EQ(faultOf(search.bestPath(), problem.world, problem.starts, problem.goals, turningRadius, false), "");
    }
}

TEST(SearchLookahead, drivesInReverseWhereTheCarFacesAway)
{
    const CarProblem problem = lanesToDrive({3}, PI);
    SearchParameters parameters = parametersIn(problem);
    parameters.detours = false;  // exploring makes nodes like those that are counted
    EXPECT_LT(expansions(problem, parameters), 80u);
    Search search;
    CarProblem reversing = problem;
    reversing.goals.front().yaw = PI;  // along the whole way
    ASSERT_TRUE(isSolved(search, reversing, parameters, MOST_EXPANSIONS));
    int backwards = 0;
    forEachAhead(search, [&](const Node &parent, const Node &node)
                 { backwards += parent.fixed && node.motion.length * parent.motion.length > 0.0; });
    EXPECT_GT(backwards, 10);
}

TEST(SearchLookahead, drivesForwardsOnlyWhereTheCarDoes)
{
    // The goal's side is driven the other way.
    for (const bool fromGoal : {false, true})
    {
        CarProblem problem = lanesToDrive({3});
        SearchParameters parameters = parametersIn(problem);
        parameters.forwardOnly = true;
        parameters.detours = false;
        parameters.bidirectional = false;
        parameters.searchFromGoal = fromGoal;
        Search search;
        ASSERT_TRUE(isSolved(search, problem, parameters, MOST_EXPANSIONS));
        const int ahead = forEachAhead(
            search, [&](const Node &, const Node &node) { EXPECT_EQ(node.motion.length > 0.0, !fromGoal); });
        EXPECT_GT(ahead, 10);
        EXPECT_LT(search.expanded(), 120u);
    }
}

namespace
{
    /** A world that tells how far motions are clear, instead of being asked pose by pose. */
    class TellingWorld : public DiscCarWorld
    {
    public:
        using DiscCarWorld::DiscCarWorld;

        void clearLengths(const Pose &from, const Arc *arcs, std::size_t count, double preferred,
                          double *clear) override
        {
            DiscCarWorld larger = *this;
            larger.radius += preferred;
            for (std::size_t i = 0; i < count; ++i)
                clear[i] = larger.gap(from) > 0.0 ? larger.freeLength(from, arcs[i].curvature, arcs[i].length) : 0.0;
        }
    };

    /** The least gap along what was reached by looking ahead. */
    double leastGapAhead(DiscCarWorld &world, const CarProblem &problem, const SearchParameters &parameters)
    {
        Search search;
        search.begin(world, parameters);
        search.addStart(problem.starts.front());
        search.addGoal(problem.goals.front());
        search.run({}, MOST_EXPANSIONS);
        EXPECT_TRUE(search.hasSolution());
        double least = std::numeric_limits<double>::infinity();
        const auto drive = [&](const Node &parent, const Node &node)
        {
            for (double part = 0.0; part <= 1.0; part += 0.01)
                least =
                    std::min(least, world.gap(advance(parent.pose, node.motion.curvature, part * node.motion.length)));
        };
        EXPECT_GT(forEachAhead(search, drive), 0);
        return least;
    }
}  // namespace

TEST(SearchLookahead, keepsThePreferredClearance)
{
    constexpr double BETWEEN_SAMPLES = 0.26;  // the front of the car comes nearer by so much at most, turning
    const CarProblem problem = lanesToDrive({3});
    for (const double preferred : {0.0, 0.3, 2.5})
    {
        SCOPED_TRACE(preferred);
        SearchParameters parameters = parametersIn(problem);
        parameters.detours = false;  // exploring does not keep it
        parameters.cost.preferredClearance = preferred;
        parameters.cost.clearanceCost = 10.0;
        TellingWorld telling(problem.world.inside, problem.world.boxes);
        EXPECT_GT(leastGapAhead(telling, problem, parameters), preferred - 1e-9);
        DiscCarWorld asked = problem.world;
        EXPECT_GT(leastGapAhead(asked, problem, parameters), std::max(0.0, preferred - BETWEEN_SAMPLES));
    }
}

TEST(SearchLookahead, leavesPlacesNarrowerThanPreferredToTheSearch)
{
    CarProblem problem = lanesToDrive({3});
    SearchParameters parameters = parametersIn(problem);
    parameters.detours = false;
    parameters.cost.clearanceCost = 10.0;
    for (const double preferred : {1.0, 5.0})
    {
        SCOPED_TRACE(preferred);
        parameters.cost.preferredClearance = preferred;
        Search search;
        isSolved(search, problem, parameters, MOST_EXPANSIONS);
        EXPECT_EQ(forEachAhead(search, [](const Node &, const Node &) {}) > 0, preferred < 4.0);
    }
}

// The weight of closeness is a price, and no preference.
TEST(SearchLookahead, comesAsNearAsIsPreferred)
{
    CarProblem problem = lanesToDrive({3, 80.0, 4.0});  // at most 1.05 m of room beside the car
    SearchParameters parameters = parametersIn(problem);
    parameters.detours = false;
    parameters.cost.preferredClearance = 0.3;
    parameters.cost.clearanceCost = 10.0;
    parameters.cost.clearanceWeight = 1.0;
    parameters.cost.clearanceRange = 5.0;
    Search search;
    isSolved(search, problem, parameters, MOST_EXPANSIONS);
    EXPECT_GT(forEachAhead(search, [](const Node &, const Node &) {}), 0);
}

TEST(SearchLookahead, endsWhereNoMoreCuspsAreAllowed)
{
    // Out of a slot nose first, and then where it would be easier in reverse.
    for (const std::uint8_t most : {0, 1})
        for (double y = 1.0; y < 12.0; y += 0.5)
            for (const double width : {2.6, 4.0, 8.0})
            {
                CarProblem problem{DiscCarWorld({{0.0, 0.0}, {80.0, 16.0}}), {{20.0, y, 0.5 * PI}}, {{70.0, 8.0, PI}}};
                problem.world.boxes = {{{0.0, 0.0}, {20.0 - 0.5 * width, 6.0}},
                                       {{20.0 + 0.5 * width, 0.0}, {80.0, 6.0}}};
                SearchParameters parameters = parametersIn(problem);
                parameters.mostCusps = most;
                parameters.bidirectional = parameters.searchFromGoal = false;
                Search search;
                problem.begin(search, parameters);
                std::uint64_t asked = 0;
                search.run([&] { return ++asked > 50000 || search.expanded() >= 500; });
                EXPECT_LE(asked, 50000u) << "it goes round in circles";
            }
}

// However often it is stopped on its way.
// But for stops while the map is flooded, after which an estimate is lower than it would have been.
TEST(SearchLookahead, goesOnWhereItWasStopped)
{
    const CarProblem lanes = lanesToDrive({3});
    const SearchParameters parameters = parametersIn(lanes);
    Search whole, inPieces;
    CarProblem problem = lanes;
    ASSERT_TRUE(isSolved(whole, problem, parameters, MOST_EXPANSIONS));
    for (const int questions : {8, 9, 12})
    {
        problem.begin(inPieces, parameters);
        int runs = 0;
        SearchOutcome outcome = SearchOutcome::Stopped;
        for (; outcome == SearchOutcome::Stopped && runs < 10000; ++runs)
            outcome = inPieces.run(afterAsking(questions - 1));
        EXPECT_EQ(outcome, SearchOutcome::Improved);
        EXPECT_GT(runs, 2);
        EXPECT_EQ(inPieces.expanded(), whole.expanded());
        EXPECT_EQ(inPieces.bestCost(), whole.bestCost());
    }
}

// What is expanded for its cost is all that the bound knows of.
TEST(SearchLookahead, isNotDoneWhereTheBoundCounts)
{
    CarProblem problem = lanesToDrive({3});
    SearchParameters parameters = parametersIn(problem);
    parameters.detours = false;
    Search usual;
    EXPECT_TRUE(isSolved(usual, problem, parameters, MOST_EXPANSIONS));
    EXPECT_GT(forEachAhead(usual, [](const Node &, const Node &) {}), 10);
    parameters.weights = {1.0, 1.0};
    Search bounded;
    isSolved(bounded, problem, parameters, MOST_EXPANSIONS);
    EXPECT_EQ(forEachAhead(bounded, [](const Node &, const Node &) {}), 0);
}

// What the search does when it is stuck.

#include "ompl_improved_astar/search/Search.h"
#include "tests/ompl_improved_astar/search/CarProblems.h"
#include "tests/ompl_improved_astar/search/RowOfCars.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    constexpr std::uint64_t MOST_EXPANSIONS = 6000;
    const Eigen::Vector2d HALF_YARD(30.0, 25.0);  // metres

    /** Spreading out and exploration are off: they would lead out of some of the traps, too, in time. */
    SearchParameters trapParameters()
    {
        SearchParameters parameters = carParameters();
        parameters.spreadOut = false;
        parameters.tuning.explorationPeriod = std::numeric_limits<std::uint64_t>::max();
        return parameters;
    }

    constexpr double PLACES[] = {-25.0, -16.0, -10.0, -4.0, 5.0, 17.0};

    struct Counts
    {
        bool solved;
        std::uint64_t expanded;
        double length;
        std::size_t memory;  // that the search says it has at the end
        std::uint64_t roomsAsked;
    };

    /** Searches, with an object that may have searched before. */
    Counts searched(Search &search, CarProblem &problem, bool detours, const Eigen::Vector2d &half,
                    SearchParameters parameters)
    {
        if (parameters.inscribedRadius == 0.0)
            parameters.inscribedRadius = problem.world.radius;
        parameters.detours = detours;
        parameters.bounds = {-half, half};
        problem.begin(search, parameters);
        std::uint64_t operations = 0;
        const SearchOutcome outcome = search.run(
            [&]
            {
                const SearchStatistics statistics = search.statistics();
                EXPECT_GE(statistics.openListOperations, operations);
                operations = statistics.openListOperations;
                return statistics.expanded >= MOST_EXPANSIONS;
            });
        EXPECT_EQ(search.hasSolution(), outcome == SearchOutcome::Improved);
        EXPECT_GE(search.statistics().openListOperations, operations) << "those of the detours count after their end";
        if (search.hasSolution())
        {
            const Path path = search.bestPath();
            EXPECT_TRUE(isSamePose(path.start, problem.starts.front(), 1e-9));
            EXPECT_TRUE(isSamePose(path.end(), problem.goals.front(), 1e-6));
            EXPECT_NEAR(search.bestCost(), pathCost(parameters.cost, path, problem.world), 1e-6);
            Pose pose = path.start;
            for (const PathPiece &piece : path.pieces)
            {
                EXPECT_LE(std::abs(piece.curvature), 1.0 / TURNING_RADIUS + 1e-9);
                for (double part = 0.0; part <= 1.0; part += 0.01)
                    EXPECT_GT(problem.world.gap(advance(pose, piece.curvature, part * piece.length)), -1e-9);
                pose = advance(pose, piece.curvature, piece.length);
            }
        }
        return {search.hasSolution(), search.statistics().expanded,
                search.hasSolution() ? search.bestPath().length() : std::numeric_limits<double>::infinity(),
                search.memory(), problem.world.roomsAsked};
    }

    Counts searched(CarProblem problem, bool detours, const Eigen::Vector2d &half,
                    SearchParameters parameters = trapParameters())
    {
        Search search;
        return searched(search, problem, detours, half, parameters);
    }

    /** Rows of shelves with passages between them, in a yard. Aisles are narrow for the first disc of a detour, the way
        round the shelves is not. */
    DiscCarWorld shelves(std::uint64_t seed)
    {
        Random random(seed);
        DiscCarWorld world({-HALF_YARD, HALF_YARD});
        const double aisle = random.between(4.0, 6.5);
        for (double y = -19.0; y < 19.0; y += aisle)
            for (double x = -24.0; x < 22.0;)
            {
                const double length = random.between(8.0, 16.0);
                world.boxes.push_back({{x, y}, {x + length, y + 1.2}});
                x += length + random.between(3.0, 5.5);
            }
        return world;
    }

    /** The row is solved soon, but takes several times as many expansions with these parameters. */
    void expectFarMoreExpansions(const Row &row, const SearchParameters &parameters)
    {
        std::uint64_t usual = 0, more = 0;
        for (const double startX : PLACES)
        {
            SCOPED_TRACE(startX);
            const Counts counts = searched(rowOfCars(row, startX), true, row.halfWorld());
            EXPECT_TRUE(counts.solved);
            EXPECT_LT(counts.expanded, 1000u);
            usual += counts.expanded;
            more += searched(rowOfCars(row, startX), true, row.halfWorld(), parameters).expanded;
        }
        EXPECT_GT(more, 5 * usual);
    }
}  // namespace

TEST(SearchDetours, leadOutOfATrap)
{
    const Row row;
    for (const double startX : PLACES)
    {
        SCOPED_TRACE(startX);
        const Counts with = searched(rowOfCars(row, startX), true, row.halfWorld());
        EXPECT_TRUE(with.solved);
        EXPECT_LT(with.expanded, 300u);
        EXPECT_GT(searched(rowOfCars(row, startX), false, row.halfWorld()).expanded, 10 * with.expanded);
    }
}

TEST(SearchDetours, leadOutOfATrapWhileSpreadingOutToo)
{
    const Row row;
    for (const double startX : PLACES)
    {
        SCOPED_TRACE(startX);
        const Counts with = searched(rowOfCars(row, startX), true, row.halfWorld(), carParameters());
        EXPECT_TRUE(with.solved);
        EXPECT_LT(with.expanded, 300u);
    }
}

// Of a wide world the disc of the detour asks about the rooms on its way: of these 37,200, with the ways of all that
// was open before 47,700. By its way, too, the car drives on without an expansion for each step.
TEST(SearchDetours, lookAboutOnTheirWayAndAheadAlongIt)
{
    const Row row{40.0, 4.0, 60.0}, longRow{300.0};
    SearchParameters parameters = trapParameters();
    // With 10, as by default, these are hardly apart: 39,400 and less than 43,000.
    parameters.tuning.detours[0].dear = 60.0;
    const Counts with = searched(rowOfCars(row, 5.0), true, row.halfWorld(), parameters);
    EXPECT_TRUE(with.solved);
    EXPECT_GT(with.expanded, parameters.tuning.leastExpansions);
    EXPECT_LT(with.roomsAsked, 38000u);
    parameters = trapParameters();
    parameters.lookAhead = false;
    EXPECT_GT(4 * searched(rowOfCars(longRow), true, longRow.halfWorld(), parameters).expanded,
              5 * searched(rowOfCars(longRow), true, longRow.halfWorld()).expanded);
}

// What is dear to the first is far less than the way round the end of a long row.
TEST(SearchDetours, aSecondOneKeepsOutOfWhatTheFirstDoesNot)
{
    SearchParameters onlyOne = trapParameters();
    onlyOne.tuning.nextDetour = 2 * MOST_EXPANSIONS;
    const Row row{350.0}, longRow{500.0};
    EXPECT_TRUE(searched(rowOfCars(row), true, row.halfWorld(), onlyOne).solved);
    expectFarMoreExpansions(longRow, onlyOne);
}

// Where a disc with room to turn does not fit into the aisle either, it knows nothing better than the gaps: the way
// through them is as dear and shorter.
TEST(SearchDetours, narrowerOnesFindAislesThatAreNarrowToo)
{
    SearchParameters allWide = trapParameters();
    allWide.tuning.detours[2] = allWide.tuning.detours[1] = allWide.tuning.detours[0];
    expectFarMoreExpansions({80.0, 4.0, 4.2, 2.1}, allWide);
}

// The aisles leave less room than preferred. Queues that count the cost so far look at what is cheaper first: none of
// these is solved then.
TEST(SearchDetours, goOnWhereItIsDear)
{
    SearchParameters parameters = trapParameters();
    parameters.cost.preferredClearance = 1.6;
    parameters.cost.clearanceCost = 10.0;
    const Row row{60.0, 4.0, 4.6, 2.3};
    for (const double startX : PLACES)
    {
        SCOPED_TRACE(startX);
        const Counts counts = searched(rowOfCars(row, startX), true, row.halfWorld(), parameters);
        EXPECT_TRUE(counts.solved);
        EXPECT_LT(counts.expanded, 500u);
        SearchParameters counting = parameters;
        counting.tuning.greedyDetours = false;
        EXPECT_FALSE(searched(rowOfCars(row, startX), true, row.halfWorld(), counting).solved);
    }
}

// They go by what lies ahead alone, whatever that counts at the place where a node is: with weights that are lower near
// the goal, which is beyond the gaps, all that is near the gaps would be looked at first.
TEST(SearchDetours, areGreedyWithUnequalWeightsToo)
{
    SearchParameters parameters = trapParameters();
    parameters.weights = {10.0, 1.1, 20.0, 0.0};
    const Row row{60.0};
    for (const double startX : PLACES)
    {
        SCOPED_TRACE(startX);
        const Counts counts = searched(rowOfCars(row, startX), true, row.halfWorld(), parameters);
        EXPECT_TRUE(counts.solved);
        EXPECT_LT(counts.expanded, 1000u);
    }
}

// A short car with hardly anything behind its rear axle: a disc round that is far narrower than the car.
TEST(SearchDetours, areAsWideAsTheCarAndNotAsWhatLiesRoundItsRearAxle)
{
    const Row row{60.0, 4.0, 3.7, 1.85, 2.8};
    SearchParameters all = trapParameters();
    all.inscribedRadius = 0.58;
    all.bodyRadius = 1.13;
    // Without the one between them, which is nearly wide enough even if it goes by the axle.
    SearchParameters car = all;
    car.tuning.detours[1] = car.tuning.detours[2];
    SearchParameters axle = car;
    axle.bodyRadius = 0.0;
    std::uint64_t byCar = 0, byAxle = 0;
    for (const double startX : PLACES)
    {
        SCOPED_TRACE(startX);
        CarProblem problem = rowOfCars(row, startX);
        problem.world.radius = all.bodyRadius;
        problem.world.offsets = {0.55, 1.25, 1.95};
        const Counts counts = searched(problem, true, row.halfWorld(), all);
        EXPECT_TRUE(counts.solved);
        EXPECT_LT(counts.expanded, 1500u);
        byCar += searched(problem, true, row.halfWorld(), car).expanded;
        byAxle += searched(problem, true, row.halfWorld(), axle).expanded;
    }
    EXPECT_GT(byAxle, 3 * byCar);
    RecordProperty("byCar", static_cast<int>(byCar));
    RecordProperty("byAxle", static_cast<int>(byAxle));
}

// Nothing of them is to be noticed before the search is stuck.
TEST(SearchDetours, leaveOtherSearchesAsTheyAre)
{
    int compared = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed)
    {
        SCOPED_TRACE(seed);
        const Counts without = searched(randomProblem(seed), false, {12.0, 12.0});
        if (!without.solved || without.expanded >= trapParameters().tuning.leastExpansions)
            continue;
        const Counts with = searched(randomProblem(seed), true, {12.0, 12.0});
        EXPECT_EQ(with.expanded, without.expanded);
        EXPECT_EQ(with.length, without.length);
        ++compared;
    }
    EXPECT_GT(compared, 20);
}

// Whatever the same object has searched before.
TEST(SearchDetours, areTheSameEachTime)
{
    const Row row, longRow{500.0};
    CarProblem trap = rowOfCars(row), longTrap = rowOfCars(longRow);
    Search search;
    const Counts once = searched(search, trap, true, row.halfWorld(), trapParameters());
    const Counts both = searched(search, longTrap, true, longRow.halfWorld(), trapParameters());
    EXPECT_GT(both.expanded, once.expanded + trapParameters().tuning.nextDetour) << "two detours";
    const Counts again = searched(search, trap, true, row.halfWorld(), trapParameters());
    EXPECT_EQ(once.expanded, again.expanded);
    EXPECT_EQ(once.length, again.length);
    EXPECT_EQ(once.memory, again.memory);
}

namespace
{
    /** A world whose cells are closed where their middle is in an obstacle, at all headings. */
    class CellWorld : public DiscCarWorld
    {
    public:
        using DiscCarWorld::DiscCarWorld;

        std::unique_ptr<BodyCells> bodyCells(double, int) override
        {
            ++begun;
            return std::make_unique<Cells>(*this);
        }

        int begun{0};
        std::uint64_t asked{0};         ///< about equal cells
        std::uint64_t askedClosely{0};  ///< about cells of any size

    private:
        class Cells final : public BodyCells
        {
        public:
            explicit Cells(CellWorld &world) : world_(world)
            {
            }
            Pose middle(const Pose &rearAxle) const override
            {
                return rearAxle;
            }
            Headings blocked(double x, double y) const override
            {
                ++world_.asked;
                const std::uint64_t all = world_.distanceFrom(x, y) > 0.0 ? 0 : ~std::uint64_t{0};
                return {all, all};
            }
            Contact contact(const PoseCell &cell) const override
            {
                ++world_.askedClosely;
                const double distance = world_.distanceFrom(cell.middle.x, cell.middle.y);
                if (distance > cell.side)
                    return Contact::None;
                return distance > 0.0 ? Contact::Unknown : Contact::Everywhere;
            }

        private:
            CellWorld &world_;
        };
    };

    /** The goal is in a room whose door, beside the rear axle, is for a disc only. */
    CellWorld roomForADisc()
    {
        CellWorld world({{0.0, 0.0}, {80.0, 40.0}}, {{{0.0, 19.0}, {74.0, 20.0}},
                                                     {{2.0, 32.0}, {3.4, 33.0}},
                                                     {{5.4, 32.0}, {9.0, 33.0}},
                                                     {{2.0, 27.0}, {9.0, 28.0}},
                                                     {{2.0, 28.0}, {3.0, 32.0}},
                                                     {{8.0, 28.0}, {9.0, 32.0}}});
        world.radius = 0.9;
        return world;
    }

    /** Searches in vain, with so much of the memory for proofs. */
    void searchInVain(CellWorld &world, double memoryOfEnclosures)
    {
        SearchParameters parameters = carParameters();
        parameters.inscribedRadius = world.radius;
        parameters.bounds = world.inside;
        parameters.tuning.memoryOfEnclosures = memoryOfEnclosures;
        Search search;
        search.begin(world, parameters);
        search.addStart({6.0, 10.0, 0.0});
        search.addGoal({4.4, 30.0, 0.0});
        search.run({}, MOST_EXPANSIONS);
        EXPECT_FALSE(search.hasSolution());
        EXPECT_EQ(search.expanded(), MOST_EXPANSIONS);
        EXPECT_EQ(world.begun, 2) << "equal cells, then some that are cut";
    }
}  // namespace

// A proof that will not succeed costs little: the cells are followed along the disc's way, here once round the end of a
// wall.
TEST(SearchDetours, theProofFollowsTheDiscsWay)
{
    CellWorld world = roomForADisc();
    searchInVain(world, SearchTuning().memoryOfEnclosures);
    EXPECT_LT(world.asked + world.askedClosely, 20000u);
    EXPECT_GT(world.asked + world.askedClosely, 1000u);
}

TEST(SearchDetours, theProofIsGivenUpBeforeItFillsTheMemory)
{
    CellWorld world = roomForADisc();
    searchInVain(world, 0.0);
    EXPECT_LT(world.asked, 10u);
    EXPECT_LT(world.askedClosely, 200u) << "down to the roots, and round them";
}

TEST(SearchDetours, leadAlongAnAisleRatherThanRoundThemAll)
{
    // Where a metre that is dear for the first disc counts as often as for the second, too, the car goes far for the
    // sake of an aisle. Of the first 60 of these worlds the paths differ in seven, and in six by more than a metre:
    // five are shorter, one is longer.
    double length = 0.0, lengthOfWide = 0.0;
    for (const std::uint64_t seed : {12, 23, 42, 43, 52, 58})
    {
        SCOPED_TRACE(seed);
        const DiscCarWorld world = shelves(seed);
        SearchParameters parameters = carParameters();
        const Counts usual = searched(randomProblemIn(world, seed), true, HALF_YARD, parameters);
        parameters.tuning.detours[0].dear = parameters.tuning.detours[1].dear;
        const Counts wide = searched(randomProblemIn(world, seed), true, HALF_YARD, parameters);
        ASSERT_TRUE(usual.solved && wide.solved);
        length += usual.length;
        lengthOfWide += wide.length;
    }
    EXPECT_LT(length, 0.95 * lengthOfWide);
}

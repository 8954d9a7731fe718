// Proofs that there is no way: the flood itself against another, and what the planner makes of it.

#include "benchmarks/worlds/RandomWorlds.h"
#include "ompl_improved_astar/search/planning/FootprintEnvironment.h"
#include "ompl_improved_astar/search/planning/Plan.h"
#include "ompl_improved_astar/search/proofs/Enclosure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <set>
#include <tuple>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    constexpr int SIZE = 7;  // columns and rows beyond which all is blocked
    constexpr double SIDE = 0.5;

    /** A room of random cells round the first root's. */
    class RandomCells final : public BodyCells
    {
    public:
        RandomCells(std::uint64_t seed, int headings, double share) : headings_(headings)
        {
            Random random(seed);
            for (int i = 0; i < SIZE * SIZE * headings; ++i)
                open_.push_back(random.chance(share));
        }

        bool isOpen(int column, int row, int heading) const
        {
            return column >= 0 && row >= 0 && column < SIZE && row < SIZE &&
                   open_[static_cast<std::size_t>((row * SIZE + column) * headings_ + heading)];
        }

        void open(int column, int row, int heading)
        {
            open_[static_cast<std::size_t>((row * SIZE + column) * headings_ + heading)] = true;
        }

        Pose middle(const Pose &rearAxle) const override
        {
            return rearAxle;
        }

        Headings blocked(double x, double y) const override
        {
            Headings bits{};
            const int column = static_cast<int>(std::floor(x / SIDE)), row = static_cast<int>(std::floor(y / SIDE));
            for (int i = 0; i < headings_; ++i)
                if (!isOpen(column, row, i))
                    bits[static_cast<std::size_t>(i / 64)] |= std::uint64_t{1} << (i % 64);
            return bits;
        }

        Contact contact(const PoseCell & /*cell*/) const override
        {
            return Contact::Unknown;
        }

        Pose poseIn(int column, int row, int heading) const
        {
            return {SIDE * column, SIDE * row, 2.0 * PI * (heading + 0.5) / headings_ - PI};
        }

    private:
        int headings_;
        std::vector<bool> open_;
    };

    using CellIndex = std::tuple<int, int, int>;

    /** All cells that can be reached, one after the other. */
    std::set<CellIndex> reached(const RandomCells &cells, int headings, const CellIndex &from)
    {
        std::set<CellIndex> seen{from};
        std::vector<CellIndex> waiting{from};
        while (!waiting.empty())
        {
            const auto [x, y, k] = waiting.back();
            waiting.pop_back();
            for (const CellIndex &next :
                 {CellIndex{x + 1, y, k}, CellIndex{x - 1, y, k}, CellIndex{x, y + 1, k}, CellIndex{x, y - 1, k},
                  CellIndex{x, y, (k + 1) % headings}, CellIndex{x, y, (k + headings - 1) % headings}})
                if (cells.isOpen(std::get<0>(next), std::get<1>(next), std::get<2>(next)) && seen.insert(next).second)
                    waiting.push_back(next);
        }
        return seen;
    }

    /** The usual car on axles that stand as much farther back as leaves so much behind the rear one. */
    Vehicle shiftedForward(double rearOverhang)
    {
        Vehicle car;
        car.frontOverhang += car.rearOverhang - rearOverhang;
        car.rearOverhang = rearOverhang;
        return car;
    }

    /** The goal's yard opens to the start's field by a corridor of this width with a right-angled bend in it. Yard and
        field reach \e farther beyond the corridor's walls than 10 m. */
    PlanResult throughBentCorridor(double width, const Vehicle &car = {}, double farther = 0.0)
    {
        const double left = -farther, right = 40.0 + farther, bottom = -farther, top = 30.0 + farther;
        const Box bounds{{left, bottom}, {right, top}};
        // The corridor goes up from the yard at the bottom and then right, to the field.
        const std::vector<Polygon> walls = {
            {{left, 12.0}, {10.0, 12.0}, {10.0, top}, {left, top}},
            {{10.0 + width, 12.0}, {right, 12.0}, {right, 18.0}, {10.0 + width, 18.0}},
            {{10.0, 18.0 + width}, {22.0, 18.0 + width}, {22.0, top}, {10.0, top}},
        };
        constexpr double FIELD_RESOLUTION = 0.1;  // a large world would choose coarser cells
        const FootprintChecker checker(ObstacleSet::fromPolygons(walls, bounds), car, 0.0, {}, FIELD_RESOLUTION);
        FootprintEnvironment environment(checker, bounds, 1e-3);
        PlanRequest request;
        request.starts = {{30.0, 24.0, PI}};
        request.goals = {{20.0, 6.0, 0.0}};
        request.car = carInSpace(car, 0.0, bounds);
        request.parameters.approximate = false;
        request.maxExpansions = 30000;
        return plan(environment, request);
    }

    void expectEnclosed(const PlanResult &result)
    {
        EXPECT_EQ(result.outcome, PlanOutcome::Infeasible);
        EXPECT_NE(result.reason.find("sideways"), std::string::npos) << result.reason;
    }
}  // namespace

TEST(Enclosure, agreesWithAFloodOfSingleCells)
{
    int closed = 0, connected = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed)
    {
        Random random(seed + 1000);
        const int counts[] = {8, 63, 64, 65, 72, 120, 127, 128};
        const int headings = counts[random.index(std::size(counts))];
        RandomCells cells(seed, headings, random.between(0.2, 0.6));
        const auto any = [&]
        {
            return CellIndex{random.below(SIZE), random.below(SIZE), random.below(headings)};
        };
        const CellIndex from = any(), to = any();
        for (const auto &[x, y, k] : {from, to})
            cells.open(x, y, k);
        const std::set<CellIndex> all = reached(cells, headings, from);
        Enclosure enclosure;
        const auto pose = [&](const CellIndex &cell)
        {
            return cells.poseIn(std::get<0>(cell), std::get<1>(cell), std::get<2>(cell));
        };
        // Whatever is seen first.
        Enclosure::Ahead ahead;
        if (random.chance(0.7))
            ahead = [&random](double, double)
            {
                return random.between(0.0, 3.0);
            };
        // Two roots must not see less than one; the second one is the first again.
        enclosure.begin(cells, {pose(from), pose(from)}, {pose(to)}, SIDE, headings, 100000, ahead);
        Enclosure::Verdict verdict = Enclosure::Verdict::Unknown;
        while (verdict == Enclosure::Verdict::Unknown)
            verdict = enclosure.widen(1 + random.index(5));
        const bool isConnected = all.count(to) > 0;
        ASSERT_EQ(verdict, isConnected ? Enclosure::Verdict::Connected : Enclosure::Verdict::Closed)
            << "seed " << seed << ", " << headings << " headings";
        ASSERT_EQ(enclosure.widen(10), verdict) << "and stays so";
        ++(isConnected ? connected : closed);
    }
    EXPECT_GT(closed, 100);
    EXPECT_GT(connected, 100);
}

TEST(Enclosure, reachesATargetSoonWhereTheWayIsKnown)
{
    /** Nothing is blocked. */
    class OpenCells final : public BodyCells
    {
    public:
        Pose middle(const Pose &rearAxle) const override
        {
            return rearAxle;
        }
        Headings blocked(double, double) const override
        {
            return {};
        }
        Contact contact(const PoseCell & /*cell*/) const override
        {
            return Contact::None;
        }
    };
    const OpenCells cells;
    const Pose root{0.0, 0.0, 0.0}, target{60.0 * SIDE, 10.0 * SIDE, 0.0};
    Enclosure enclosure;
    enclosure.begin(cells, {root}, {target}, SIDE, 72, 100000);
    EXPECT_EQ(enclosure.widen(100000), Enclosure::Verdict::Connected);
    EXPECT_GT(enclosure.columns(), 4000u);
    enclosure.begin(cells, {root}, {target}, SIDE, 72, 100000,
                    [&](double x, double y) { return std::hypot(target.x - x, target.y - y); });
    EXPECT_EQ(enclosure.widen(100000), Enclosure::Verdict::Connected);
    EXPECT_LT(enclosure.columns(), 200u);
}

TEST(Enclosure, givesUpWhereThereIsNoEnd)
{
    const RandomCells cells(1, 8, 1.1);
    Enclosure enclosure;
    enclosure.begin(cells, {cells.poseIn(3, 3, 0)}, {{1e9, 0.0, 0.0}}, SIDE, 8, 20);
    EXPECT_EQ(enclosure.widen(10), Enclosure::Verdict::Unknown);
    EXPECT_EQ(enclosure.widen(100), Enclosure::Verdict::TooLarge);
    EXPECT_EQ(enclosure.columns(), 20u);
    enclosure.begin(cells, {cells.poseIn(3, 3, 0)}, {{1e9, 0.0, 0.0}}, SIDE, 8, 100);
    EXPECT_EQ(enclosure.widen(1000), Enclosure::Verdict::Closed) << "the room has an end";
}

/** No motion leaves the goal, between walls a centimetre from the car's body; behind it a disc gets out. The goal's
   side has nothing to expand, so that it cannot be told by its expansions that it is stuck. */
TEST(Enclosure, endsASearchOneSideOfWhichRunsDry)
{
    Vehicle car;
    car.rearOverhang = 0.5;
    const double side = 0.5 * car.width + 0.01, rear = -car.rearOverhang - 0.01,
                 front = car.length() - car.rearOverhang + 0.01;
    const Box bounds{{-20.0, -20.0}, {20.0, 20.0}};
    const std::vector<Polygon> walls = {
        {{rear - 1.0, side}, {front + 1.0, side}, {front + 1.0, side + 1.0}, {rear - 1.0, side + 1.0}},
        {{rear - 1.0, -side - 1.0}, {front + 1.0, -side - 1.0}, {front + 1.0, -side}, {rear - 1.0, -side}},
        {{front, -side}, {front + 1.0, -side}, {front + 1.0, side}, {front, side}},
        {{rear - 1.0, 0.6}, {rear, 0.6}, {rear, side}, {rear - 1.0, side}},
        {{rear - 1.0, -side}, {rear, -side}, {rear, -0.6}, {rear - 1.0, -0.6}}};
    const FootprintChecker checker(ObstacleSet::fromPolygons(walls, bounds), car);
    FootprintEnvironment environment(checker, bounds, 1e-3);
    PlanRequest request;
    request.starts = {{-12.0, 5.0, 0.0}};
    request.goals = {{0.0, 0.0, 0.0}};
    request.car = carInSpace(car, 0.0, bounds);
    request.parameters.approximate = false;
    request.maxExpansions = 30000;
    const PlanResult result = plan(environment, request);
    expectEnclosed(result);
    EXPECT_LT(result.statistics.expanded, 2000u);
}

/** The disc at the rear axle gets round the bend, the car does not; where it is wide enough for the car, it does. */
TEST(Enclosure, endsASearchThatTheDiscCannotEnd)
{
    const PlanResult narrow = throughBentCorridor(2.1);
    expectEnclosed(narrow);
    const PlanResult wide = throughBentCorridor(4.6);
    EXPECT_EQ(wide.outcome, PlanOutcome::Solved) << wide.reason;
}

/** The size of the cells goes by the whole car, not by what little lies behind its rear axle. */
TEST(Enclosure, endsItForCarsWithHardlyAnythingBehindTheRearAxle)
{
    const PlanResult narrow = throughBentCorridor(2.1, shiftedForward(0.05));
    expectEnclosed(narrow);
    EXPECT_LT(narrow.statistics.expanded, 1500u);
    const PlanResult wide = throughBentCorridor(4.6, shiftedForward(0.05));
    EXPECT_EQ(wide.outcome, PlanOutcome::Solved) << wide.reason;
}

/** A yard of 5.5 hectares and a field of 2.7: only coarse cells get to their end. They suffice where only a disc far
    smaller than the car gets through. */
TEST(Enclosure, seesLargeYardsToTheirEnd)
{
    constexpr double FARTHER = 150.0;
    const PlanResult narrow = throughBentCorridor(1.1, shiftedForward(0.5), FARTHER);
    expectEnclosed(narrow);
    const PlanResult wide = throughBentCorridor(4.6, shiftedForward(0.5), FARTHER);
    EXPECT_EQ(wide.outcome, PlanOutcome::Solved) << wide.reason;
}

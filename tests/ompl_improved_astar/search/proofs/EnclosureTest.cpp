// Proofs that there is no path: the flood itself against another, and against drives.

#include "benchmarks/worlds/RandomWorlds.h"
#include "ompl_improved_astar/search/planning/FootprintEnvironment.h"
#include "ompl_improved_astar/search/planning/Plan.h"
#include "ompl_improved_astar/search/proofs/Enclosure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <tuple>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;
using Verdict = Enclosure::Verdict;

namespace
{
    constexpr double SIDE = 0.5;  // metres, of cells

    using CellIndex = std::tuple<int, int, int>;  // column, row, part of the circle

    /** All open cells that are reached from one, one after the other. */
    std::set<CellIndex> flood(const CellIndex &from, int headings, const std::set<CellIndex> &open)
    {
        std::set<CellIndex> seen{from};
        std::vector<CellIndex> waiting{from};
        while (!waiting.empty())
        {
            const CellIndex cell = waiting.back();
            const auto [x, y, k] = cell;
            waiting.pop_back();
            for (const CellIndex &next :
                 {CellIndex{x + 1, y, k}, CellIndex{x - 1, y, k}, CellIndex{x, y + 1, k}, CellIndex{x, y - 1, k},
                  CellIndex{x, y, (k + 1) % headings}, CellIndex{x, y, (k + headings - 1) % headings}})
                if (seen.count(next) == 0 && open.count(next) > 0)
                {
                    seen.insert(next);
                    waiting.push_back(next);
                }
        }
        return seen;
    }

    Verdict verdictOf(Enclosure &enclosure, std::size_t pace)
    {
        Verdict verdict = Verdict::Unknown;
        while (verdict == Verdict::Unknown)
            verdict = enclosure.widen(pace);
        return verdict;
    }
}  // namespace

TEST(EnclosureProof, findsTheEndThatIsShutIn)
{
    // A ring of blocked cells round the origin in a plane without end, where the other flood never comes to one.
    const auto ring = [](double gap)
    {
        return [gap](double x, double y)
        {
            HeadingSet bits{};
            const double ahead = std::atan2(y, x), distance = std::hypot(x, y);
            if (distance > 4.0 && distance < 8.0 && std::abs(ahead) >= gap)
                bits.fill(~std::uint64_t{0});
            return bits;
        };
    };
    const Pose inside{0.1, 0.1, 0.0}, outside{30.1, 0.1, 0.0};
    const Enclosure::Cells cells{SIDE, 64, 0.0, 20000};
    const auto isProven = [&](double gap, const Pose &start, const Pose &goal)
    {
        EnclosureProof proof;
        proof.begin(ring(gap), {start}, {goal}, cells);
        bool result = false;
        for (int i = 0; i < 1000 && !result; ++i)
            result = proof.widen(10);
        return result;
    };
    EXPECT_TRUE(isProven(0.0, inside, outside));
    EXPECT_TRUE(isProven(0.0, outside, inside));
    EXPECT_FALSE(isProven(0.6, inside, outside));
    EXPECT_FALSE(isProven(0.6, outside, inside));
}

TEST(Enclosure, agreesWithAFloodOfSingleCells)
{
    constexpr int SIZE = 4;  // columns and rows to each side of the root's, beyond which all is blocked
    int closed = 0, connected = 0;
    Enclosure enclosure;
    for (std::uint64_t seed = 0; seed < 400; ++seed)
    {
        Random random(seed);
        const int counts[] = {8, 63, 64, 65, 72, 120, 127, 128}, headings = counts[random.index(std::size(counts))];
        const auto any = [&]
        {
            return CellIndex{random.below(2 * SIZE + 1) - SIZE, random.below(2 * SIZE + 1) - SIZE,
                             random.below(headings)};
        };
        const std::vector<CellIndex> ends{{0, 0, random.below(headings)}, any(), any()};
        const double share = random.between(0.2, 0.6), offset = random.between(-1.0, 2.0);
        std::set<CellIndex> open(ends.begin(), ends.end());
        for (int column = -SIZE; column <= SIZE; ++column)
            for (int row = -SIZE; row <= SIZE; ++row)
                for (int heading = 0; heading < headings; ++heading)
                    if (random.chance(share))
                        open.insert({column, row, heading});
        // The middle of the root's body is a corner of its cell; the others are anywhere in theirs.
        const Eigen::Vector2d origin(random.between(-9.0, 9.0), random.between(-9.0, 9.0));
        std::vector<Pose> poses;
        for (const auto &[column, row, heading] : ends)
        {
            const double in = poses.empty() ? 0.0 : random.between(0.01, 0.99);
            const Pose body{origin.x() + SIDE * (column + in), origin.y() + SIDE * (row + in),
                            2.0 * PI * (heading + random.between(0.01, 0.99)) / headings - PI};
            poses.push_back(advance(body, 0.0, -offset));
        }
        const BlockedHeadings blocked = [&](double x, double y)
        {
            HeadingSet bits{};
            for (int i = 0; i < headings; ++i)
                if (open.count({std::floor((x - origin.x()) / SIDE), std::floor((y - origin.y()) / SIDE), i}) == 0)
                    bits[static_cast<std::size_t>(i / 64)] |= std::uint64_t{1} << (i % 64);
            return bits;
        };
        // Two roots must not see less than one; the second one is the first again. One of two targets suffices.
        enclosure.begin(blocked, {poses[0], poses[0]}, {poses[1], poses[2]}, {SIDE, headings, offset, 100000});
        const Verdict verdict = verdictOf(enclosure, 1 + random.index(5));
        const std::set<CellIndex> reached = flood(ends[0], headings, open);
        const bool isConnected = reached.count(ends[1]) + reached.count(ends[2]) > 0;
        ASSERT_EQ(verdict, isConnected ? Verdict::Connected : Verdict::Closed) << "seed " << seed;
        ASSERT_EQ(enclosure.widen(10), verdict) << "and stays so";
        ++(isConnected ? connected : closed);
    }
    EXPECT_GT(closed, 100);
    EXPECT_GT(connected, 100);
}

TEST(Enclosure, givesUpWhereThereIsNoEnd)
{
    const BlockedHeadings nothing = [](double, double)
    {
        return HeadingSet{};
    };
    for (const std::size_t maxColumns : {20u, 1000u})
    {
        Enclosure enclosure;
        enclosure.begin(nothing, {{}}, {{1e9, 0.0, 0.0}}, {SIDE, 8, 0.0, maxColumns});
        EXPECT_EQ(enclosure.widen(maxColumns), Verdict::Unknown);
        EXPECT_GT(enclosure.bytes(), 0u);
        EXPECT_EQ(enclosure.widen(1), Verdict::TooLarge);
    }
}

/** Wherever a drive leads, free in every part, no proof may say that it cannot. */
TEST(Enclosure, isNeverClosedBetweenTheEndsOfADrive)
{
    int drives = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed)
    {
        Random random(seed);
        const World world = seed % 2 == 0 ? randomPolygonWorld(seed) : randomGridWorld(seed);
        Vehicle car;
        car.rearOverhang = random.between(0.05, 1.2);
        const FootprintChecker checker(world.obstacles, car);
        FootprintEnvironment environment(checker, world.bounds, 1e-3);
        Enclosure enclosure;
        for (int i = 0; i < 10; ++i)
        {
            const Pose from = world.anywhere(random);
            if (!environment.isFree(from))
                continue;
            Pose to = from;
            for (int piece = 0; piece < 12; ++piece)
            {
                const Arc arc{random.between(-0.3, 0.3), random.magnitude(0.2, 8.0)};
                to = advance(to, arc.curvature, std::copysign(environment.freeLength(to, arc), arc.length));
            }
            to.yaw = wrapAngle(to.yaw);
            const double side = random.between(0.2, 1.2);
            const int headings = 8 + random.below(121);
            const BlockedHeadings blocked = environment.blockedHeadings(side, headings);
            enclosure.begin(blocked, {from}, {to}, {side, headings, car.centreOffset(), 4000});
            ASSERT_NE(verdictOf(enclosure, 50), Verdict::Closed) << "seed " << seed << ", drive " << i;
            ++drives;
        }
    }
    EXPECT_GT(drives, 200);
}

/** A corridor with a right-angled bend between two yards: the disc at the rear axle gets round it, the car does not;
    where it is wide enough for the car, it does. The size of the cells goes by the whole car, not by what little lies
    behind its rear axle; yards of hectares are seen to their end with coarse cells. */
TEST(Enclosure, endsPlanningThatTheDiscCannotEnd)
{
    struct Corridor
    {
        double width, rearOverhang, farther;
        bool isPassable;
    };
    for (const auto &[width, rearOverhang, farther, isPassable] :
         {Corridor{1.9, 0.929, 0.0, false}, Corridor{1.9, 0.05, 0.0, false}, Corridor{4.6, 0.05, 0.0, true},
          Corridor{1.1, 0.5, 150.0, false}})
    {
        SCOPED_TRACE(testing::Message() << width << " m, " << rearOverhang << " m behind the axle");
        Vehicle car;
        car.frontOverhang += car.rearOverhang - rearOverhang;
        car.rearOverhang = rearOverhang;
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
        const PlanResult result = plan(environment, request);
        EXPECT_EQ(result.outcome, isPassable ? PlanOutcome::Solved : PlanOutcome::Infeasible) << result.reason;
        EXPECT_EQ(result.reason.find("sideways") != std::string::npos, !isPassable) << result.reason;
    }
}

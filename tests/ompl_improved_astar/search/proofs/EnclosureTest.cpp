// Proofs that there is no path: the flood itself against another, and against drives and floods of small worlds.

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
using Verdict = Enclosure::Verdict;

namespace
{
    constexpr int SIZE = 7;  // columns and rows beyond which all is blocked
    constexpr double SIDE = 0.5;

    using CellIndex = std::tuple<int, int, int>;

    /** A room of random cells of position and heading round the first root's. */
    class RandomCells
    {
    public:
        RandomCells(std::uint64_t seed, int headings, double share) : headings_(headings)
        {
            Random random(seed);
            for (int i = 0; i < SIZE * SIZE * headings; ++i)
                open_.push_back(random.chance(share));
        }

        bool isOpen(const CellIndex &cell) const
        {
            const auto [column, row, heading] = cell;
            return column >= 0 && row >= 0 && column < SIZE && row < SIZE && open_[indexOf(cell)];
        }

        void open(const CellIndex &cell)
        {
            open_[indexOf(cell)] = true;
        }

        BlockedHeadings blocked() const
        {
            return [this](double x, double y)
            {
                HeadingSet bits{};
                const int column = static_cast<int>(std::floor(x / SIDE)), row = static_cast<int>(std::floor(y / SIDE));
                for (int i = 0; i < headings_; ++i)
                    if (!isOpen({column, row, i}))
                        bits[static_cast<std::size_t>(i / 64)] |= std::uint64_t{1} << (i % 64);
                return bits;
            };
        }

        /** A pose whose body's middle, that far ahead, lies on the corner of the cell from which cells are counted. */
        Pose poseIn(const CellIndex &cell, double centreOffset) const
        {
            const auto [column, row, heading] = cell;
            return advance({SIDE * column, SIDE * row, 2.0 * PI * (heading + 0.5) / headings_ - PI}, 0.0,
                           -centreOffset);
        }

        /** All cells that can be reached, one after the other. */
        std::set<CellIndex> reachedFrom(const CellIndex &from) const
        {
            std::set<CellIndex> seen{from};
            std::vector<CellIndex> waiting{from};
            while (!waiting.empty())
            {
                const auto [x, y, k] = waiting.back();
                waiting.pop_back();
                for (const CellIndex &next :
                     {CellIndex{x + 1, y, k}, CellIndex{x - 1, y, k}, CellIndex{x, y + 1, k}, CellIndex{x, y - 1, k},
                      CellIndex{x, y, (k + 1) % headings_}, CellIndex{x, y, (k + headings_ - 1) % headings_}})
                    if (isOpen(next) && seen.insert(next).second)
                        waiting.push_back(next);
            }
            return seen;
        }

    private:
        std::size_t indexOf(const CellIndex &cell) const
        {
            const auto [column, row, heading] = cell;
            return static_cast<std::size_t>((row * SIZE + column) * headings_ + heading);
        }

        int headings_;
        std::vector<bool> open_;
    };

    Verdict verdictOf(Enclosure &enclosure, std::size_t pace = 50)
    {
        Verdict verdict = Verdict::Unknown;
        while (verdict == Verdict::Unknown)
            verdict = enclosure.widen(pace);
        return verdict;
    }

    /** Whether a car that moves as it likes gets from one place to another, in steps of a lattice: a yes is proven, and
        a no right up to the lattice. */
    bool isFloodConnected(FootprintEnvironment &environment, const Box &world, const Pose &from, const Pose &to)
    {
        constexpr double STEP = 0.1;
        constexpr int HEADINGS = 48;
        const auto poseAt = [&](const CellIndex &cell)
        {
            const auto [x, y, k] = cell;
            return Pose{from.x + STEP * x, from.y + STEP * y, wrapAngle(from.yaw + 2.0 * PI * k / HEADINGS)};
        };
        std::set<CellIndex> seen{{0, 0, 0}};
        std::vector<CellIndex> waiting{{0, 0, 0}};
        while (!waiting.empty())
        {
            const auto [x, y, k] = waiting.back();
            waiting.pop_back();
            const Pose pose = poseAt({x, y, k});
            if (positionDistance(pose, to) < 1.5 * STEP && std::abs(wrapAngle(pose.yaw - to.yaw)) < 0.2)
                return true;
            for (const CellIndex &next :
                 {CellIndex{x + 1, y, k}, CellIndex{x - 1, y, k}, CellIndex{x, y + 1, k}, CellIndex{x, y - 1, k},
                  CellIndex{x, y, (k + 1) % HEADINGS}, CellIndex{x, y, (k + HEADINGS - 1) % HEADINGS}})
            {
                const Pose at = poseAt(next);
                if (world.contains(at.x, at.y) && seen.count(next) == 0 && environment.isMotionFree(pose, at))
                {
                    seen.insert(next);
                    waiting.push_back(next);
                }
            }
        }
        return false;
    }
}  // namespace

TEST(Enclosure, agreesWithAFloodOfSingleCells)
{
    int closed = 0, connected = 0;
    Enclosure enclosure;
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
        const std::vector<CellIndex> indices{any(), any(), any()};
        const double offset = random.chance(0.5) ? 0.0 : random.between(-1.0, 2.0);
        std::vector<Pose> poses;
        for (const CellIndex &cell : indices)
        {
            cells.open(cell);
            poses.push_back(cells.poseIn(cell, offset));
        }
        // The grid of the proof begins at its first root; the cells' corners are a hair from it.
        const std::set<CellIndex> all = cells.reachedFrom(indices[0]);
        const Pose middle = advance(poses[0], 0.0, offset);
        const BlockedHeadings inRoom = cells.blocked(), blocked = [&](double x, double y)
        {
            return inRoom(x - middle.x + SIDE * std::get<0>(indices[0]), y - middle.y + SIDE * std::get<1>(indices[0]));
        };
        for (std::size_t i = 1; i < poses.size(); ++i)
        {
            poses[i].x += 0.25 * SIDE;
            poses[i].y += 0.25 * SIDE;
        }
        // Two roots must not see less than one; the second one is the first again. One of two targets suffices.
        enclosure.begin(blocked, {poses[0], poses[0]}, {poses[1], poses[2]}, {SIDE, headings, offset, 100000});
        const Verdict verdict = verdictOf(enclosure, 1 + random.index(5));
        const bool isConnected = all.count(indices[1]) + all.count(indices[2]) > 0;
        ASSERT_EQ(verdict, isConnected ? Verdict::Connected : Verdict::Closed)
            << "seed " << seed << ", " << headings << " headings";
        ASSERT_EQ(enclosure.widen(10), verdict) << "and stays so";
        ++(isConnected ? connected : closed);
    }
    EXPECT_GT(closed, 100);
    EXPECT_GT(connected, 100);
}

TEST(Enclosure, givesUpWhereThereIsNoEndAndMemoryIsLimited)
{
    const RandomCells cells(1, 8, 1.1);
    const Pose root = cells.poseIn({3, 3, 0}, 0.0), beyond{1e9, 0.0, 0.0};
    const BlockedHeadings nothing = [](double, double)
    {
        return HeadingSet{};
    };
    const BlockedHeadings room = [inRoom = cells.blocked()](double x, double y)
    {
        return inRoom(x, y);
    };
    Enclosure enclosure;
    for (const std::size_t maxColumns : {20u, 1000u})
    {
        enclosure.begin(nothing, {root}, {beyond}, {SIDE, 8, 0.0, maxColumns});
        EXPECT_EQ(enclosure.widen(maxColumns), Verdict::Unknown);
        EXPECT_GT(enclosure.bytes(), 0u);
        EXPECT_EQ(enclosure.widen(1), Verdict::TooLarge);
        EXPECT_EQ(enclosure.widen(100), Verdict::TooLarge);
    }
    // A room of as many columns, which has an end, and one of one more.
    enclosure.begin(room, {root}, {beyond}, {SIDE, 8, 0.0, 1000});
    EXPECT_EQ(verdictOf(enclosure), Verdict::Closed);
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
            ASSERT_NE(verdictOf(enclosure), Verdict::Closed) << "seed " << seed << ", drive " << i;
            ++drives;
        }
    }
    EXPECT_GT(drives, 200);
}

/** Two small rooms with a gap between them, from far too narrow to wide. */
TEST(Enclosure, closesASmallWorldOnlyWhereAnExhaustiveFloodAgrees)
{
    Vehicle car;
    car.wheelbase = 1.0;
    car.frontOverhang = car.rearOverhang = 0.2;
    car.width = 0.8;
    const Box box{{0.0, 0.0}, {7.0, 3.5}};
    const Pose from{1.0, 1.6, 0.0}, to{5.5, 1.6, 0.0};
    int closed = 0, connected = 0;
    for (const double gap : {0.0, 0.3, 0.5, 0.7, 0.78, 0.82, 0.9, 1.2, 1.6})
        for (const double slant : {0.0, 0.6})
        {
            SCOPED_TRACE(gap);
            const double low = 1.6 - 0.5 * gap, high = 1.6 + 0.5 * gap;
            const std::vector<Polygon> walls{{{3.4 - slant, 0.0}, {3.7 - slant, 0.0}, {3.7, low}, {3.4, low}},
                                             {{3.4, high}, {3.7, high}, {3.7 + slant, 3.5}, {3.4 + slant, 3.5}}};
            const FootprintChecker checker(ObstacleSet::fromPolygons(walls, box), car, 0.0, {}, 0.02);
            FootprintEnvironment environment(checker, box, 1e-3);
            const bool isConnected = isFloodConnected(environment, box, from, to);
            ++(isConnected ? connected : closed);
            for (const double side : {0.05, 0.1, 0.3})
                for (const int headings : {16, 72, 128})
                {
                    const BlockedHeadings blocked = environment.blockedHeadings(side, headings);
                    Enclosure enclosure;
                    enclosure.begin(blocked, {from}, {to}, {side, headings, car.centreOffset(), 100000});
                    const Verdict verdict = verdictOf(enclosure, 1000);
                    if (isConnected)
                    {
                        EXPECT_EQ(verdict, Verdict::Connected);
                    }
                    else if (gap < 0.6 && side < 0.2 && headings > 16)
                    {
                        EXPECT_EQ(verdict, Verdict::Closed) << side << " " << headings;
                    }
                }
        }
    EXPECT_GT(closed, 4);
    EXPECT_GT(connected, 4);
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
         {Corridor{1.9, 0.929, 0.0, false}, Corridor{4.6, 0.929, 0.0, true}, Corridor{1.9, 0.05, 0.0, false},
          Corridor{4.6, 0.05, 0.0, true}, Corridor{1.1, 0.5, 150.0, false}, Corridor{4.6, 0.5, 150.0, true}})
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

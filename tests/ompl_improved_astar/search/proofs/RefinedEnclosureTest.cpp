// Proofs with cells that are cut where it matters: against a flood of the finest cells, and in a planner.

#include "benchmarks/worlds/RandomWorlds.h"
#include "ompl_improved_astar/search/planning/FootprintEnvironment.h"
#include "ompl_improved_astar/search/planning/Plan.h"
#include "ompl_improved_astar/search/proofs/RefinedEnclosure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

using namespace parking;
using namespace parking::search;
using namespace parking_test;

namespace
{
    constexpr int SIZE = 32;  // the finest columns and rows, beyond which all is blocked
    constexpr int HEADINGS = 32;
    constexpr int FINE = 3;
    constexpr double SIDE = 0.25;  // of the finest cells

    using Verdict = RefinedEnclosure::Verdict;

    RefinedEnclosure::Levels levels(int coarse)
    {
        RefinedEnclosure::Levels result;
        result.side = SIDE * (1 << FINE);
        result.headings = HEADINGS >> FINE;
        result.coarse = coarse;
        result.fine = FINE;
        return result;
    }

    struct FineCell
    {
        int column, row, heading;
    };

    /** A room of fine cells, walls of which have holes. Larger cells tell what is so in all fine ones of them. */
    class Room final : public BodyCells
    {
    public:
        /** All of it is closed. */
        Room() : open_(static_cast<std::size_t>(SIZE) * SIZE * HEADINGS, false)
        {
        }

        explicit Room(std::uint64_t seed) : open_(static_cast<std::size_t>(SIZE) * SIZE * HEADINGS, true)
        {
            Random random(seed);
            // Boxes of any size, walls among them, of what is open and closed; then single cells.
            const int boxes = random.below(200);
            const double closed = random.between(0.4, 1.0), wall = random.between(0.0, 0.2);
            for (int box = 0; box < boxes; ++box)
            {
                const bool isClosed = random.chance(closed);
                const auto interval = [&](int size)
                {
                    const int from = random.below(size);
                    return random.chance(wall) ? std::pair{0, size}
                                               : std::pair{from, std::min(size, from + 1 + random.below(10))};
                };
                const auto [c0, c1] = interval(SIZE);
                const auto [r0, r1] = interval(SIZE);
                const auto [h0, h1] = interval(HEADINGS);
                for (int c = c0; c < c1; ++c)
                    for (int r = r0; r < r1; ++r)
                        for (int h = h0; h < h1; ++h)
                            open({c, r, h}, !isClosed);
            }
            const double share = random.chance(0.5) ? 0.0 : random.between(0.0, 0.7);
            for (std::size_t i = 0; i < open_.size(); ++i)
                if (random.chance(share))
                    open_[i] = false;
        }

        bool isOpen(const FineCell &cell) const
        {
            return cell.column >= 0 && cell.row >= 0 && cell.column < SIZE && cell.row < SIZE && open_[indexOf(cell)];
        }

        void open(const FineCell &cell, bool isOpen = true)
        {
            open_[indexOf(cell)] = isOpen;
        }

        /** In the middle of the fine cell. */
        static Pose poseIn(const FineCell &cell)
        {
            return {SIDE * (cell.column + 0.5), SIDE * (cell.row + 0.5),
                    2.0 * PI * (cell.heading + 0.5) / HEADINGS - PI};
        }

        /** So that the cells of the proof, whose borders go through the first root, are these. */
        Pose middle(const Pose &rearAxle) const override
        {
            return {rearAxle.x - 0.5 * SIDE, rearAxle.y - 0.5 * SIDE, rearAxle.yaw};
        }

        Headings blocked(double /*x*/, double /*y*/) const override
        {
            ADD_FAILURE() << "not of these cells";
            return {};
        }

        Contact contact(const PoseCell &cell) const override
        {
            ++asked;
            const int across = static_cast<int>(std::lround(cell.side / SIDE));
            const auto first = [&](double middle)
            {
                return static_cast<int>(std::lround(middle / SIDE - 0.5 * across));
            };
            const int turns = static_cast<int>(std::lround(cell.halfTurn / PI * HEADINGS));
            const int heading =
                static_cast<int>(std::lround((cell.middle.yaw + PI - cell.halfTurn) / (2.0 * PI) * HEADINGS));
            bool some = false, all = true;
            for (int c = 0; c < across; ++c)
                for (int r = 0; r < across; ++r)
                    for (int h = 0; h < turns; ++h)
                    {
                        const bool isOneOpen =
                            isOpen({first(cell.middle.x) + c, first(cell.middle.y) + r, heading + h});
                        some = some || isOneOpen;
                        all = all && isOneOpen;
                    }
            // What is open at the finest level need not be known to be free.
            return !some ? Contact::Everywhere : all && (across > 1 || doubts == 0) ? Contact::None : Contact::Unknown;
        }

        mutable std::size_t asked{0};
        int doubts{0};

    private:
        static std::size_t indexOf(const FineCell &cell)
        {
            return static_cast<std::size_t>((cell.column * SIZE + cell.row) * HEADINGS + cell.heading);
        }

        std::vector<bool> open_;
    };

    bool areConnected(const Room &room, const FineCell &from, const FineCell &to)
    {
        std::vector<bool> seen(static_cast<std::size_t>(SIZE) * SIZE * HEADINGS, false);
        std::vector<FineCell> waiting{from};
        while (!waiting.empty())
        {
            const FineCell at = waiting.back();
            waiting.pop_back();
            if (at.column == to.column && at.row == to.row && at.heading == to.heading)
                return true;
            const auto &[c, r, h] = at;
            for (const FineCell &next :
                 {FineCell{c + 1, r, h}, FineCell{c - 1, r, h}, FineCell{c, r + 1, h}, FineCell{c, r - 1, h},
                  FineCell{c, r, (h + 1) % HEADINGS}, FineCell{c, r, (h + HEADINGS - 1) % HEADINGS}})
            {
                const auto index = static_cast<std::size_t>((next.column * SIZE + next.row) * HEADINGS + next.heading);
                if (!room.isOpen(next) || seen[index])
                    continue;
                seen[index] = true;
                waiting.push_back(next);
            }
        }
        return false;
    }

    Verdict prove(RefinedEnclosure &proof, Random &random)
    {
        while (proof.verdict() == Verdict::Unknown)
            proof.widen(1 + random.index(50));
        return proof.verdict();
    }

    /** A wall with a door of this width between the start and the goal, each of which faces it. */
    PlanResult throughDoor(double width)
    {
        const Vehicle car;
        const Box bounds{{0.0, 0.0}, {30.0, 20.0}};
        const double low = 10.0 - 0.5 * width, high = 10.0 + 0.5 * width;
        const std::vector<Polygon> walls = {{{14.9, 0.0}, {15.1, 0.0}, {15.1, low}, {14.9, low}},
                                            {{14.9, high}, {15.1, high}, {15.1, 20.0}, {14.9, 20.0}}};
        const FootprintChecker checker(ObstacleSet::fromPolygons(walls, bounds), car);
        FootprintEnvironment environment(checker, bounds, 1e-3);
        PlanRequest request;
        request.starts = {{7.0, 6.0, 0.0}};
        request.goals = {{23.0, 12.0, 0.0}};
        request.car = carInSpace(car, 0.0, bounds);
        request.parameters.approximate = false;
        request.maxExpansions = 30000;
        return plan(environment, request);
    }
}  // namespace

TEST(RefinedEnclosure, agreesWithAFloodOfTheFinestCells)
{
    int closed = 0, connected = 0;
    // Of the first 5,000 rooms 4358 alone needs what has spread before to spread again (at the end of attach()).
    for (std::uint64_t seed = 4200; seed < 4500; ++seed)
    {
        SCOPED_TRACE(seed);
        Random random(seed + 5000);
        Room room(seed);
        room.doubts = random.below(2);
        const auto any = [&]
        {
            return FineCell{random.below(SIZE), random.below(SIZE), random.below(HEADINGS)};
        };
        // Several of each: the proof is about all of them.
        std::vector<FineCell> from(1 + random.index(2)), to(1 + random.index(3));
        std::vector<Pose> starts, goals;
        // The first start has its cell's corner where that of the room is, so that the cells are the same.
        from.front() = {0, 0, random.below(HEADINGS)};
        for (std::size_t i = 0; i < from.size(); ++i)
        {
            from[i] = i == 0 ? from[i] : any();
            room.open(from[i]);
            starts.push_back(Room::poseIn(from[i]));
        }
        for (FineCell &each : to)
        {
            each = any();
            room.open(each);
            goals.push_back(Room::poseIn(each));
        }
        bool isConnected = false;
        for (const FineCell &start : from)
            for (const FineCell &goal : to)
                isConnected = isConnected || areConnected(room, start, goal);
        RefinedEnclosure::Ahead ahead;
        if (random.chance(0.7))  // whatever is seen first
            ahead = [&random](double, double)
            {
                return random.between(0.0, 3.0);
            };
        RefinedEnclosure proof;
        proof.begin(room, starts, goals, levels(random.below(FINE)), ahead, ahead);
        ASSERT_EQ(prove(proof, random), isConnected ? Verdict::Connected : Verdict::Closed);
        ASSERT_EQ(proof.widen(10), proof.verdict()) << "and stays so";
        ++(isConnected ? connected : closed);
    }
    EXPECT_GT(closed, 80);
    EXPECT_GT(connected, 80);
}

/** Whatever is round a start and a goal in one cell, and where the others are: one flood must not end before the other
   has seen that it is where it was to come to. */
TEST(RefinedEnclosure, connectsWhatIsInOneCell)
{
    for (std::uint64_t seed = 0; seed < 5000; ++seed)
    {
        SCOPED_TRACE(seed);
        Random random(seed);
        const auto any = [&]
        {
            return FineCell{random.below(6), random.below(6), random.below(HEADINGS)};
        };
        Room room;
        room.doubts = random.below(2);
        const FineCell origin{0, 0, random.below(HEADINGS)}, shared = random.chance(0.5) ? origin : any(),
                                                             other = any();
        const int open = random.below(200);
        for (int i = 0; i < open; ++i)
            room.open(any());
        for (const FineCell &each : {origin, shared, other})
            room.open(each);
        RefinedEnclosure::Levels large = levels(0);
        large.fine = 1;
        large.side = 2.0 * SIDE;
        large.headings = HEADINGS / 2;
        RefinedEnclosure proof;
        proof.begin(room, {Room::poseIn(origin), Room::poseIn(shared)}, {Room::poseIn(shared), Room::poseIn(other)},
                    large, {}, {});
        ASSERT_EQ(prove(proof, random), Verdict::Connected);
    }
}

/** A proof begun anew knows nothing of the one before, and memory does not grow by it. */
TEST(RefinedEnclosure, beginsAnew)
{
    RefinedEnclosure proof;
    std::vector<Verdict> verdicts[2];
    std::vector<std::size_t> cells[2];
    for (auto times : {0, 1})
        for (std::uint64_t seed = 0; seed < 12; ++seed)
        {
            Random random(seed);
            Room room(seed);
            const FineCell from{0, 0, random.below(HEADINGS)}, to{SIZE - 1, SIZE - 1, random.below(HEADINGS)};
            room.open(from);
            room.open(to);
            RefinedEnclosure fresh;
            for (RefinedEnclosure *each : {&proof, &fresh})
            {
                each->begin(room, {Room::poseIn(from)}, {Room::poseIn(to)}, levels(1), {}, {});
                while (each->widen(7) == Verdict::Unknown)
                    continue;
            }
            EXPECT_EQ(proof.verdict(), fresh.verdict());
            EXPECT_EQ(proof.cells(), fresh.cells());
            EXPECT_GE(proof.bytes(), fresh.bytes() / 2);
            verdicts[times].push_back(proof.verdict());
            cells[times].push_back(proof.cells());
        }
    EXPECT_EQ(verdicts[0], verdicts[1]);
    EXPECT_EQ(cells[0], cells[1]);
}

/** In a room with a wall only the wall is looked at closely, and nothing when it has a wide hole. */
TEST(RefinedEnclosure, looksCloselyOnlyWhereItMatters)
{
    Room room(1);
    constexpr int WALL = 19;  // the large cells do not end there
    for (int c = 0; c < SIZE; ++c)
        for (int r = 0; r < SIZE; ++r)
            for (int h = 0; h < HEADINGS; ++h)
                room.open({c, r, h}, c != WALL);
    const auto verdictOn = [&](const Pose &goal)
    {
        RefinedEnclosure proof;
        room.asked = 0;
        proof.begin(room, {Room::poseIn({0, 0, 5})}, {goal}, levels(0), {}, {});
        while (proof.widen(7) == Verdict::Unknown)
            continue;
        return proof.verdict();
    };
    const Pose goal = Room::poseIn({SIZE - 1, SIZE - 1, 20});
    EXPECT_EQ(verdictOn(goal), Verdict::Closed);
    EXPECT_GT(room.asked, 1000U) << "its faces have 1,024 of the finest cells";
    EXPECT_LT(room.asked, 6000U) << "of 32,768";
    room.open({WALL, 3, 3});
    EXPECT_EQ(verdictOn(goal), Verdict::Connected) << "one cell";
    for (int r = 8; r < 16; ++r)
        for (int h = 0; h < 8; ++h)
            room.open({WALL, r, h});
    EXPECT_EQ(verdictOn(goal), Verdict::Connected);
    EXPECT_LT(room.asked, 1000U);
    EXPECT_EQ(verdictOn({1e9, 0.0, 0.0}), Verdict::TooLarge) << "there is no cell so far away";
}

/** The body is wider than the door by 2 cm, or fits; a disc gets through both. */
TEST(RefinedEnclosure, closesADoorThatIsALittleTooNarrow)
{
    const double width = Vehicle().width;
    const PlanResult narrow = throughDoor(width - 0.02);
    EXPECT_EQ(narrow.outcome, PlanOutcome::Infeasible);
    EXPECT_NE(narrow.reason.find("sideways"), std::string::npos) << narrow.reason;
    const PlanResult wide = throughDoor(width + 0.06);
    EXPECT_EQ(wide.outcome, PlanOutcome::Solved) << wide.reason;
}

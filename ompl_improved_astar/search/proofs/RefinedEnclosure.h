#pragma once

#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/containers/TiledGrid.h"
#include "ompl_improved_astar/search/proofs/Enclosure.h"
#include "parking_geometry/Pose.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <queue>
#include <tuple>
#include <vector>

namespace parking::search
{
    /** \brief The proof of Enclosure with cells of many sizes: fine ones in the gaps that decide, coarse ones
       elsewhere.

        A cell of which it is not known whether the body is free in all of it is doubtful. Two floods, of the starts and
        of the goals, pass through doubtful cells, too, but last: where one comes out of them into a free cell or to a
        target, the doubtful cells of its way are cut into eight, and those beside them, and what was reached through
        them is detached from the flood, to be reached some other way or not at all. A flood that ends has reached all
        that a body could get to (after L. Zhang, Y. J. Kim and D. Manocha, "Efficient cell labelling and path
        non-existence computation using C-obstacle query", 2008, who search the graph of all cells anew after each
        cut). */
    class RefinedEnclosure
    {
    public:
        using Ahead = Enclosure::Ahead;      ///< as there
        using Verdict = Enclosure::Verdict;  ///< as there

        /** \brief The sizes of cells. Cut in two along both axes and in heading, a cell has eight of the next level. */
        struct Levels
        {
            double side{1.0};  ///< of a cell of level 0, metres
            int headings{4};   ///< of level 0 round the circle, 2 or more
            int coarse{3};     ///< doubtful cells of lower levels than this one are always cut,
            int fine{8};       ///< those of this one never; at most 12, with at most 32,768 headings
        };

        /** \brief Begins a proof. What was seen for another is forgotten.

            \param body must outlive the proof
            \param starts, goals poses of the rear axle, free
            \param aheadOfStarts, aheadOfGoals metres from a place to the goals and to the starts: what is nearer is
            seen first. What is proven does not depend on them */
        void begin(const BodyCells &body, const std::vector<Pose> &starts, const std::vector<Pose> &goals,
                   const Levels &levels, Ahead aheadOfStarts, Ahead aheadOfGoals);

        /** \brief Goes on by so many steps of either flood: a look at the neighbours of a cell, or cutting those of a
            way. */
        Verdict widen(std::size_t steps);

        /** \brief What the last widen() said. */
        Verdict verdict() const
        {
            return verdict_;
        }

        /** \brief Cells that have been made since begin(). */
        std::size_t cells() const
        {
            return made_;
        }

        /** \brief Bytes of the cells and of what waits, growing included. */
        std::size_t bytes() const;

    private:
        using CellIndex = std::uint32_t;

        static constexpr CellIndex NONE = ~CellIndex{0};
        static constexpr std::size_t CHUNK = 8192;  // cells: arrays that grow would move them all at once

        struct Waiting
        {
            std::uint16_t doubts;  // as of the cell
            CellIndex index;
            double ahead;
            std::size_t order;  // in which they came

            bool operator>(const Waiting &other) const
            {
                return std::tie(doubts, ahead, order) > std::tie(other.doubts, other.ahead, other.order);
            }
        };

        enum class Content : std::uint8_t
        {
            Unasked,
            Blocked,   // the body collides in all of it
            Free,      // in none of it
            Doubtful,  // that is not known
            Cut        // into its children
        };

        struct Cell
        {
            std::int32_t column{0}, row{0};
            CellIndex parent{NONE}, children{NONE};
            std::array<CellIndex, 2> from{NONE, NONE};  // by flood: what it was reached from, itself for a root
            std::array<std::uint16_t, 2> doubts{0, 0};  // doubtful cells on the way there
            std::int16_t heading{0};
            std::uint8_t level{0};
            Content content{Content::Unasked};
            std::array<bool, 2> isRoot{false, false};
            std::array<bool, 2> isCrossed{false, false};  // nothing on the way there is left to be cut
        };

        struct Flood
        {
            std::vector<Pose> roots;  // of the body's middle
            Ahead ahead;
            std::priority_queue<Waiting, std::vector<Waiting>, std::greater<Waiting>> waiting;
            std::vector<CellIndex> detached;  // what was reached from these is to be detached, too
            std::vector<CellIndex> loose;     // may be reached some other way
            std::vector<CellIndex> arrivals;  // reached cells with roots of the other flood, and some that were
        };

        Cell &cell(CellIndex index)
        {
            return (*chunks_[index / CHUNK])[index % CHUNK];
        }

        CellIndex makeCells(std::size_t count);
        CellIndex top(std::int32_t column, std::int32_t row);
        Eigen::Vector2d middleOf(const Cell &of) const;
        Content contentOf(CellIndex index)
        {
            const Content content = cell(index).content;
            return content == Content::Unasked ? ask(index) : content;
        }
        Content ask(CellIndex index);
        CellIndex leafOf(const Pose &middle);
        CellIndex childOf(const Cell &parent, std::int32_t column, std::int32_t row, int heading) const;
        CellIndex beside(CellIndex index, int axis, int way);
        template <class Visitor>
        void visitFace(CellIndex index, int axis, std::size_t half, const Visitor &visitor);
        template <class Visitor>
        void visitNeighbours(CellIndex index, const Visitor &visitor);

        // Between two steps each open leaf that has not been reached is loose, or those of its neighbours that have
        // been reached wait or hang on something detached; and each root of the other flood that has been reached is
        // among the arrivals. So a flood that has nothing to do has come as far as it can, and not to the other's
        // roots.
        void step(std::size_t flood);
        void plantRoots(std::size_t flood);
        void reach(std::size_t flood, CellIndex index, CellIndex from);
        void wait(std::size_t flood, CellIndex index);
        void spread(std::size_t flood, CellIndex index);
        void detachFollowers(std::size_t flood);
        void attach(std::size_t flood);
        bool mayEnter(std::size_t flood, CellIndex index, CellIndex from);
        CellIndex takeArrival(std::size_t flood);
        CellIndex takeWaiting(std::size_t flood);
        bool refineWay(std::size_t flood, CellIndex end);
        void makeChildren(CellIndex index);
        void cut(CellIndex index);

        const BodyCells *body_{nullptr};
        Levels levels_;
        Eigen::Vector2d origin_{0.0, 0.0};
        Verdict verdict_{Verdict::TooLarge};
        std::array<Flood, 2> floods_;
        std::vector<std::unique_ptr<std::array<Cell, CHUNK>>> chunks_;
        std::size_t made_{0}, order_{0};
        TiledGrid<CellIndex> tops_;              // one more than the first cell of level 0 there
        std::vector<CellIndex> toCut_, beside_;  // of the cell under way
    };
}  // namespace parking::search

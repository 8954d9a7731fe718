#pragma once

#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/containers/TiledGrid.h"
#include "parking_geometry/Pose.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace parking::search
{
    /** \brief Proves that the car cannot get out of a place, however it moves: also sideways and on the spot.

        Position of the body's middle and heading are cut into cells. Cells in which the body collides wherever it
        stands are closed; those that can be reached from the roots through faces of cells that are not closed are
        looked for. When all of them have been seen and no target lies in any of them, then no motion of any kind leads
        from a root to a target (L. Zhang, Y. J. Kim and D. Manocha, "Efficient cell labelling and path non-existence
        computation using C-obstacle query", 2008). The converse does not hold: finer cells may prove what coarse ones
        do not.

        Headings of a column of cells are handled together, as bits, so open areas cost little. */
    class Enclosure
    {
    public:
        /** \brief The cells of a proof. */
        struct Cells
        {
            double side;             ///< metres
            int headings;            ///< round the circle, 8 to 128
            double centreOffset;     ///< metres from the rear axle ahead to the body's middle, which stands in the cell
            std::size_t maxColumns;  ///< places after which the proof is given up
        };

        /** \brief How far the proof is. */
        enum class Verdict
        {
            Unknown,    ///< there is more to see
            Closed,     ///< proven: no target can be reached
            Connected,  ///< nothing is proven with these cells: a target may be reached
            TooLarge    ///< nothing is proven: there are too many cells
        };

        /** \brief Begins a proof; memory of the last one is kept.

            \param blocked of such cells; must outlive the proof
            \param roots, targets poses of the rear axle, free. Places near a target are seen first, so that a flood
            which can reach one does so soon */
        void begin(const BlockedHeadings &blocked, const std::vector<Pose> &roots, const std::vector<Pose> &targets,
                   const Cells &cells);

        /** \brief Goes on by that many columns. */
        Verdict widen(std::size_t columns);

        /** \brief Bytes of the cells and of the queue, growing included. */
        std::size_t bytes() const
        {
            constexpr std::size_t GROWING = 3;  // an array that grows is there twice, once of double the size
            return columns_.bytes() + GROWING * waiting_.size() * sizeof(Waiting);
        }

    private:
        using Place = std::pair<std::int32_t, std::int32_t>;
        using Waiting = std::tuple<std::int32_t, std::size_t, Place>;  // cells to a target, when it came, which

        struct Column
        {
            HeadingSet reached{}, blocked{}, entered{};
            bool asked{false};
        };

        struct Cell
        {
            Place place;
            int heading;
        };

        Cell cellOf(const Pose &pose) const;
        std::int32_t cellsToTarget(const Place &place) const;
        void enter(const Place &place, const HeadingSet &headings);
        HeadingSet spread(HeadingSet from, const HeadingSet &open) const;
        void see(const Place &place);

        const BlockedHeadings *blocked_{nullptr};
        Eigen::Vector2d origin_{0.0, 0.0};
        Cells cells_{1.0, 8, 0.0, 0};
        std::size_t seen_{0};
        Verdict verdict_{Verdict::TooLarge};
        std::vector<Cell> targets_;
        TiledGrid<Column> columns_;
        std::priority_queue<Waiting, std::vector<Waiting>, std::greater<Waiting>> waiting_;
        std::size_t entered_{0};  // places that were put into it
    };

    /** \brief Seeks the proof from both ends at once: out of either is as good as the other. */
    class EnclosureProof
    {
    public:
        /** \brief Forgets it; memory is kept. */
        void reset()
        {
            state_ = State::NotBegun;
            blocked_ = {};
        }

        /** \brief Begins; gives up at once when \e blocked is empty: the world cannot tell. */
        void begin(BlockedHeadings blocked, const std::vector<Pose> &starts, const std::vector<Pose> &goals,
                   const Enclosure::Cells &cells);

        /** \brief Has it begun since it was reset? */
        bool hasBegun() const
        {
            return state_ != State::NotBegun;
        }

        /** \brief Goes on by that many columns at each end, until there is nothing more to find out.

            \return whether it has been proven now that no path leads from a start to a goal */
        bool widen(std::size_t columns);

        /** \brief Bytes of both while it is under way. */
        std::size_t bytes() const;

    private:
        enum class State
        {
            NotBegun,
            UnderWay,
            Over
        };

        State state_{State::NotBegun};
        BlockedHeadings blocked_;
        std::vector<Enclosure> ends_;  // made when first needed: most searches need none
    };
}  // namespace parking::search

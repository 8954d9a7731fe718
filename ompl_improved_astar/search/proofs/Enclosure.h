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
    /** \brief Proves that the car cannot leave a region, even if it moves sideways and turns on the spot.

        Positions of the body's centre and headings are divided into cells. A cell in which the body collides at every
        pose is closed. A flood visits all cells that are connected with the roots by faces of cells that are not
        closed. If it ends without meeting the cell of a target, no motion leads from a root to a
        target (L. Zhang, Y. J. Kim and D. Manocha, "Efficient cell labelling and path non-existence
        computation using C-obstacle query", 2008). The converse does not hold: finer cells may yield proofs that coarse
        ones do not.

        All headings of a position are processed together as bits, so open areas cost little. */
    class Enclosure
    {
    public:
        /** \brief The cells of a proof. */
        struct Cells
        {
            double side;             ///< metres
            int headings;            ///< round the circle, 8 to 128
            double centreOffset;     ///< metres from the rear axle ahead to the body's centre, whose cell counts
            std::size_t maxColumns;  ///< limit of the positions visited
        };

        /** \brief State of a proof. */
        enum class Verdict
        {
            Unknown,    ///< the flood has not ended
            Closed,     ///< proven: no target is reachable
            Connected,  ///< no proof: the flood met a target
            TooLarge    ///< no proof: too many cells
        };

        /** \brief Begins a proof; the memory of the previous one is kept.

            \param blocked of such cells; must outlive the proof
            \param roots, targets free poses of the rear axle. Positions near a target are visited first, so that a
            connected flood ends soon */
        void begin(const BlockedHeadings &blocked, const std::vector<Pose> &roots, const std::vector<Pose> &targets,
                   const Cells &cells);

        /** \brief Visits up to \e columns further positions. */
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

    /** \brief Seeks a proof from both ends alternately; a proof from either end suffices. */
    class EnclosureProof
    {
    public:
        /** \brief Discards the proof; memory is kept. */
        void reset()
        {
            state_ = State::NotBegun;
            blocked_ = {};
        }

        /** \brief Begins a proof. Ends at once if \e blocked is empty. */
        void begin(BlockedHeadings blocked, const std::vector<Pose> &starts, const std::vector<Pose> &goals,
                   const Enclosure::Cells &cells);

        /** \brief Whether it has begun since reset(). */
        bool hasBegun() const
        {
            return state_ != State::NotBegun;
        }

        /** \brief Visits up to \e columns further positions at each end.

            \return whether this call proved that no path leads from a start to a goal */
        bool widen(std::size_t columns);

        /** \brief Bytes of both floods while the proof is under way. */
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

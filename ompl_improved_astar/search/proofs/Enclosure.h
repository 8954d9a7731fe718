#pragma once

#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/containers/TiledGrid.h"
#include "parking_geometry/Pose.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
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
        /** \brief Metres that are thought to lie between the body's middle at (x, y) and the targets. */
        using Ahead = std::function<double(double x, double y)>;

        /** \brief How far the proof is. */
        enum class Verdict
        {
            Unknown,    ///< there is more to see
            Closed,     ///< proven: no target can be reached
            Connected,  ///< nothing is proven with these cells: a target may be reached
            TooLarge    ///< nothing is proven: there are too many cells
        };

        /** \brief Begins a proof; memory of the last one is kept.

            \param body of cells with that side and so many headings; must outlive the proof
            \param roots, targets poses of the rear axle, free
            \param side of a cell in metres
            \param headings cells round the circle, from 8 to 128
            \param mostColumns places after which it is given up
            \param ahead places where it is least are seen first, so that a flood which can reach a target does so soon;
            without it all that are equally near to the roots are. What is proven does not depend on it, unless there
           are too many columns */
        void begin(const BodyCells &body, const std::vector<Pose> &roots, const std::vector<Pose> &targets, double side,
                   int headings, std::size_t mostColumns, Ahead ahead = {});

        /** \brief Goes on by so many columns. */
        Verdict widen(std::size_t columns);

        /** \brief What the last widen() said. */
        Verdict verdict() const
        {
            return verdict_;
        }

        /** \brief Columns seen since begin(), those that were seen again counted again. */
        std::size_t columns() const
        {
            return seen_;
        }

        /** \brief Bytes of the cells and of the queue, growing included. */
        std::size_t bytes() const
        {
            constexpr std::size_t GROWING = 3;  // an array that grows is there twice, once of double the size
            return columns_.bytes() + GROWING * waiting_.size() * sizeof(Waiting);
        }

    private:
        using Headings = BodyCells::Headings;
        using Place = std::pair<std::int32_t, std::int32_t>;
        using Waiting = std::tuple<double, std::size_t, Place>;  // what lies ahead, when it came, which

        struct Column
        {
            Headings reached{}, blocked{}, entered{};
            bool asked{false};
        };

        struct Cell
        {
            Place place;
            int heading;
        };

        Cell cellOf(const Pose &pose) const;
        Eigen::Vector2d middleOf(const Place &place) const;
        void enter(const Place &place, const Headings &headings);
        Headings spread(Headings from, const Headings &open) const;
        void see(const Place &place);

        const BodyCells *body_{nullptr};
        Eigen::Vector2d origin_{0.0, 0.0};
        double side_{1.0};
        int headings_{1};
        std::size_t mostColumns_{0}, seen_{0};
        Ahead ahead_;
        Verdict verdict_{Verdict::TooLarge};
        std::vector<Cell> targets_;
        TiledGrid<Column> columns_;
        std::priority_queue<Waiting, std::vector<Waiting>, std::greater<Waiting>> waiting_;
        std::size_t entered_{0};  // places that were put into it
    };
}  // namespace parking::search

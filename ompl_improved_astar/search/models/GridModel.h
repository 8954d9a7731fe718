#pragma once

#include "ompl_improved_astar/search/MotionModel.h"
#include "ompl_improved_astar/search/containers/Occupancy.h"
#include "ompl_improved_astar/search/containers/TiledGrid.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace parking::search
{
    /** \brief A step to a neighbour, in cells. */
    struct GridStep
    {
        std::int32_t columns,  ///< along x
            rows;              ///< along y
    };

    /** \brief The paper's moves on a grid of positions ("Summary of Optimizations for Improved A* Algorithm").

        The car moves from cell centre to cell centre with the heading of the step, and turns on the spot in between. A
        matrix stores whether each cell is unknown, free or blocked; it is filled on demand or before the search.
        Motions between cells are checked along their whole length. The cells of starts and goals hold their exact
        poses. The sides meet where their nodes share a cell. */
    class GridModel final : public MotionModel
    {
    public:
        /** \brief \param steps to the neighbours, at most 32, each with its opposite */
        explicit GridModel(std::vector<GridStep> steps);

        void begin(const SearchContext &context) override;
        ModelTraits traits() const override;
        std::string heuristic() const override
        {
            return "straight";
        }
        void addRoot(Side side, const Pose &pose) override;
        std::uint64_t cell(const Pose &pose, std::size_t level) const override;
        void expand(Side side, NodeIndex index, const Node &node, std::size_t level, bool isFirst,
                    std::vector<Successor> &successors) override;
        bool isFree(Side side, const Node &from, const Successor &successor) override;
        bool join(const Node &fromStart, const Node &fromGoal, Side sweptFrom, double bound,
                  const Offer &offer) override;
        double distance(const Pose &from, const Pose &to) const override
        {
            return positionDistance(from, to);
        }
        bool load(const StopFunction &stop) override;
        std::size_t bytes() const override
        {
            return cells_.bytes();
        }

    private:
        static constexpr std::size_t MAX_STEPS = 32;

        struct Cell
        {
            Occupancy occupancy{Occupancy::Unknown};       // for any heading
            std::array<Occupancy, MAX_STEPS> byHeading{};  // by the step that arrives with it
        };

        struct Place
        {
            std::int32_t column, row;
        };

        Place placeOf(const Pose &pose) const;
        Pose centre(const Place &place) const;
        Cell &cellAt(const Place &place);
        bool isInside(const Place &place) const
        {
            return place.column >= 0 && place.row >= 0 && place.column < columns_ && place.row < rows_;
        }
        bool isCellFree(Cell &cell, const Pose &pose, std::size_t step);
        bool isTurnFree(const Pose &from, double turn);
        const Pose *rootIn(Side side, std::uint64_t cell) const;

        std::vector<GridStep> steps_;
        std::vector<std::size_t> opposite_;  // of each step
        MotionEnvironment *environment_{nullptr};
        Box bounds_;
        bool isBidirectional_{true};
        double resolution_{0.5};
        std::int32_t columns_{0}, rows_{0};
        TiledGrid<Cell> cells_;
        std::array<std::vector<std::pair<std::uint64_t, Pose>>, 2> roots_;  // with their cells
        std::int64_t loaded_{0};
    };
}  // namespace parking::search

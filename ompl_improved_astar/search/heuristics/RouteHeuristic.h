#pragma once

#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/StopFunction.h"
#include "ompl_improved_astar/search/containers/MonotoneQueue.h"
#include "ompl_improved_astar/search/containers/Occupancy.h"
#include "ompl_improved_astar/search/containers/TiledGrid.h"
#include "parking_geometry/Box.h"
#include "parking_geometry/Pose.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace parking::search
{
    /** \brief A disc that stands for the car. */
    struct Disc
    {
        double radius{0.0};      ///< metres: places where the disc does not fit are blocked
        double wideRadius{0.0};  ///< metres: places where a disc of this radius does not fit are costly; 0: none
        double costFactor{1.0};  ///< a metre at costly places counts as that many, at least 1
    };

    /** \brief Side in metres of the cells of a RouteHeuristic between these poses.

        \param bodyRadius metres: radius of the largest disc within the car */
    double routeResolution(double turningRadius, double bodyRadius, const std::vector<Pose> &roots,
                           const std::vector<Pose> &targets);

    /** \brief The length of a disc's shortest route round the obstacles to the nearest of some targets.

        A resumable A* from the targets (D. Silver, "Cooperative pathfinding", 2005): a question resumes the search
        until the cell of the place is settled, so that the cost grows with the area queried, not with the map.

        Routes lead through the cells of a grid, each with eight neighbours. A cell is passable unless the disc surely
        hits an obstacle, or its centre leaves the bounds, at every place of the cell. A straight step counts as 12
        parts of a side, a diagonal one as 17, which is 0.2 % too long. */
    class RouteHeuristic
    {
    public:
        /** \brief Restarts without targets; memory is kept. \e environment and \e stop must outlive the questions.

            \param resolution side of a cell in metres
            \param toward centre of the grid and first aim of the search: most questions should be near it
            \param stop polled during long questions; may be empty
            \param maxCells limit of the cells settled */
        void begin(MotionEnvironment &environment, double resolution, const Disc &disc, const Eigen::Vector2d &toward,
                   const StopFunction &stop, std::uint64_t maxCells);

        /** \brief Adds a target; only before the first question. */
        void addTarget(double x, double y);

        /** \brief Classifies the cells of a box in advance, until the stop function returns true. */
        void load(const Box &box);

        /** \brief Metres from (x, y) to the nearest target. Infinite when there is no route, or when the stop function
            returned true. 0 when the limit of cells or the reach of the grid leaves the distance unknown. */
        double distance(double x, double y);

        /** \brief distance(), if it needs no further search. */
        std::optional<double> knownDistance(double x, double y) const;

        /** \brief distance() less a cell, for what the grid adds to it; 0 when it is infinite. */
        double estimate(const Pose &pose);

        /** \brief Never more than the length of any route of the disc's centre to a target, along the grid or not;
            infinite when there is none. */
        double lowerBound(const Pose &pose);

        /** \brief Is there certainly no route? False when the stop function ended the search. */
        bool provesUnreachable(const Pose &pose);

        /** \brief The centre of the cell nearest to \e goal among those with a route; \e goal when there is none.
            Settles all cells with a route, unless \e goal lies in one of them. */
        Eigen::Vector2d nearestReachable(const Eigen::Vector2d &goal);

        /** \brief The place \e ahead metres along a shortest route from (x, y), with the heading of the route from
            \e around metres before it to \e around metres behind it; none where the route is shorter or unknown. */
        std::optional<Pose> placeOnRoute(double x, double y, double ahead, double around);

        /** \brief Number of cells settled. */
        std::uint64_t cells() const
        {
            return settled_;
        }

        /** \brief Upper limit of the bytes of cells and open list. */
        std::size_t bytes() const
        {
            return states_.bytes() + open_.bytes();
        }

    private:
        static constexpr std::uint32_t UNREACHED = 0xffffffffu;
        static constexpr std::uint8_t NO_STEP = 8;

        struct CellState
        {
            std::uint32_t g{UNREACHED};
            Occupancy passage{Occupancy::Unknown};
            bool isCostly{false};
            std::uint8_t step{NO_STEP};  // direction from the parent
            bool settled{false};
        };

        using Cell = Eigen::Vector2i;  // column and row

        std::optional<Cell> cellAt(double x, double y) const;
        Eigen::Vector2d centreOf(const Cell &cell) const;
        bool isPassable(CellState &state, const Cell &cell);
        bool mayHoldDisc(double radius, const Eigen::Vector2d &middle, double halfSide, int refinements);
        std::uint32_t stepLength(std::uint8_t step, bool isCostly) const;
        std::uint32_t lengthToAim(const Cell &cell) const;
        void aimAt(const Cell &cell);
        bool settleNext();

        MotionEnvironment *environment_{nullptr};
        const StopFunction *stop_{nullptr};
        Box bounds_;
        Disc disc_;
        double resolution_{1.0};
        Eigen::Vector2d origin_{0.0, 0.0};
        std::uint64_t maxCells_{0}, settled_{0};
        Cell aim_{0, 0};
        TiledGrid<CellState> states_;
        MonotoneQueue<Cell> open_;
        bool stopped_{false};   // the last question, by the stop function
        bool leftGrid_{false};  // a target or a route lies beyond the reach of the grid
    };
}  // namespace parking::search

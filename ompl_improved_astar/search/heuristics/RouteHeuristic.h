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
    /** \brief A disc that approximates the car. */
    struct Disc
    {
        double radius{0.0};      ///< metres: cells where the disc does not fit are blocked
        double wideRadius{0.0};  ///< metres: cells where a disc of this radius does not fit are costly; 0: none
        double costFactor{1.0};  ///< factor on lengths in costly cells, at least 1
    };

    /** \brief Side in metres of the cells of a RouteHeuristic between these poses.

        \param bodyRadius metres: radius of the largest disc within the car */
    double routeResolution(double turningRadius, double bodyRadius, const std::vector<Pose> &roots,
                           const std::vector<Pose> &targets);

    /** \brief Length of a disc's shortest route around the obstacles to the nearest target.

        A resumable A* from the targets (D. Silver, "Cooperative pathfinding", 2005): each query resumes the search
        until its cell is settled, so the work grows with the area queried, not with the map.

        Routes lead through the cells of a grid, each with eight neighbours. A cell is blocked only if the disc provably
        hits an obstacle or leaves the bounds for every centre in the cell. A straight step counts as 12
        parts of a side, a diagonal one as 17, which is 0.2 % too long. */
    class RouteHeuristic
    {
    public:
        /** \brief Restarts without targets; memory is kept. \e environment and \e stop must outlive all queries.

            \param resolution side of a cell in metres
            \param toward centre of the grid and first aim of the search, near most queries
            \param stop polled during long queries; may be empty
            \param maxCells limit of the cells settled */
        void begin(MotionEnvironment &environment, double resolution, const Disc &disc, const Eigen::Vector2d &toward,
                   const StopFunction &stop, std::uint64_t maxCells);

        /** \brief Adds a target; only before the first query. */
        void addTarget(double x, double y);

        /** \brief Classifies the cells of a box in advance, until the stop function returns true. */
        void load(const Box &box);

        /** \brief Metres from (x, y) to the nearest target. Infinite without a route, or if the stop function returned
            true. 0 if the limit of cells or the reach of the grid leaves the distance unknown. */
        double distance(double x, double y);

        /** \brief distance(), if it requires no further search. */
        std::optional<double> knownDistance(double x, double y) const;

        /** \brief distance() minus the side of a cell, which compensates for the grid; 0 if infinite. */
        double estimate(const Pose &pose);

        /** \brief Lower bound of the length of any route of the disc's centre to a target, on the grid or not; infinite
            without one. */
        double lowerBound(const Pose &pose);

        /** \brief Whether provably no route exists. False if the stop function ended the search. */
        bool provesUnreachable(const Pose &pose);

        /** \brief Centre of the cell nearest to \e goal among those with a route; \e goal if there is none. Settles all
            cells with a route, unless \e goal lies in one of them. */
        Eigen::Vector2d nearestReachable(const Eigen::Vector2d &goal);

        /** \brief The position \e ahead metres along a shortest route from (x, y), with the heading of the route
            between \e around metres before and behind it; std::nullopt if the route is shorter or unknown. */
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

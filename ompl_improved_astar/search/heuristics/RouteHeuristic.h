#pragma once

#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/StopFunction.h"
#include "ompl_improved_astar/search/containers/MonotoneQueue.h"
#include "ompl_improved_astar/search/containers/TiledGrid.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace parking::search
{
    /** \brief A disc that stands for the car. */
    struct Disc
    {
        double radius{0.0};      ///< metres: cells that the disc does not fit into are blocked
        double wideRadius{0.0};  ///< metres: cells that a disc of this radius does not fit into are costly; 0: none
        double costFactor{1.0};  ///< a metre in costly cells counts as that many, at least 1
    };

    /** \brief Side in metres of the cells of a RouteHeuristic between these poses.

        \param bodyRadius metres, of the largest disc within the car */
    double routeResolution(double turningRadius, double bodyRadius, const std::vector<Pose> &roots,
                           const std::vector<Pose> &targets);

    /** \brief The length of a disc's shortest route round the obstacles to the nearest of some targets.

        A resumable A* from the targets over a grid of eight neighbours (D. Silver, "Cooperative pathfinding", 2005):
        a question resumes the search until the cell of the place is settled, so that its cost grows with the area that
        is queried, not with the map.

        A cell is passable unless the disc surely hits an obstacle, or its centre leaves the bounds, at every place of
        the cell. Routes lead from centre to centre of passable cells. Their lengths are whole numbers: 12 for a
        straight step and 17 for a diagonal one, 0.2 % too much. */
    class RouteHeuristic
    {
    public:
        /** \brief Restarts without targets; memory is kept.

            \param environment must outlive the questions
            \param resolution side of a cell in metres
            \param disc the disc whose routes are searched
            \param toward centre of the grid, at which the search aims first: most questions should be near it
            \param stop polled during long questions; may be empty; must outlive the questions
            \param maxCells limit of the cells settled */
        void begin(MotionEnvironment &environment, double resolution, const Disc &disc, const Eigen::Vector2d &toward,
                   const StopFunction &stop, std::uint64_t maxCells);

        /** \brief Adds a target; only before the first question. */
        void addTarget(double x, double y);

        /** \brief Finds the passable cells of a box in advance, as far as the grid reaches and until the stop function
            returns true. The search finds the others when it reaches them. */
        void load(const Box &box);

        /** \brief Metres from (x, y) to the nearest target, costly cells counted as \ref Disc describes.

            Infinite when there is no route, or when the stop function returned true. 0 when the answer is unknown,
            because of the limit of cells or the reach of the grid. */
        double distance(double x, double y);

        /** \brief distance(), if no further search is necessary for it. */
        std::optional<double> knownDistance(double x, double y) const;

        /** \brief distance() less one cell, for what the grid adds to it; 0 when it is infinite. */
        double estimate(const Pose &pose);

        /** \brief Never more than the length of the shortest route of the disc's centre to the nearest target, not
            confined to the grid; infinite when there is no route. */
        double lowerBound(const Pose &pose);

        /** \brief Is there certainly no route from \e pose? False when the search was stopped. */
        bool provesUnreachable(const Pose &pose);

        /** \brief The centre of the cell nearest to \e goal in a straight line, of those with a route to the targets;
            \e goal itself when there is none. Settles all cells with a route, unless \e goal lies in one of them. */
        Eigen::Vector2d nearestReachable(const Eigen::Vector2d &goal);

        /** \brief A place on a route and the direction of the route there. */
        struct PlaceOnRoute
        {
            Eigen::Vector2d place;    ///< the centre of a cell
            Eigen::Vector2d heading;  ///< of any length but zero
        };

        /** \brief A place on a shortest route from (x, y); none where the route is shorter or unknown.

            \param ahead metres along the route from (x, y) to the place
            \param around metres along the route on either side of the place whose chord is the heading, at most
           \e ahead */
        std::optional<PlaceOnRoute> placeOnRoute(double x, double y, double ahead, double around);

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
        static constexpr double INFINITE = std::numeric_limits<double>::infinity();
        static constexpr std::uint32_t UNREACHED = 0xffffffffu;
        static constexpr std::uint8_t NO_PARENT = 8;

        enum class CellClass : std::uint8_t
        {
            Unknown,
            Free,
            Costly,
            Blocked
        };

        struct CellState
        {
            std::uint32_t g{UNREACHED};
            CellClass kind{CellClass::Unknown};
            std::uint8_t direction{NO_PARENT};  // of the step from the parent to this cell
            bool settled{false};
        };

        struct Cell
        {
            std::int32_t column, row;
        };

        std::optional<Cell> cellAt(double x, double y) const;
        Eigen::Vector2d centreOf(const Cell &cell) const;
        CellClass classOf(CellState &state, const Cell &cell);
        bool mayHoldDisc(double radius, const Eigen::Vector2d &middle, double halfSide, int refinements);
        double clearanceBound(double radius, const Eigen::Vector2d &point);
        std::uint32_t lengthToAim(const Cell &cell) const;
        void aimAt(const Cell &cell);
        bool settleNext();
        void step(const Cell &from, std::uint32_t g, std::uint8_t direction);
        double lengthOf(const CellState &settled) const;

        bool isStopped() const
        {
            return *stop_ && (*stop_)();
        }

        /** Has every cell with a route been settled? */
        bool isComplete() const
        {
            return open_.empty() && !leftGrid_;
        }

        MotionEnvironment *environment_{nullptr};
        const StopFunction *stop_{nullptr};
        Box bounds_;
        double resolution_{1.0};
        Disc disc_;
        std::uint32_t costlyLengths_[2]{0, 0};  // of a straight and a diagonal step to a costly cell
        std::uint64_t maxCells_{0};
        Eigen::Vector2d origin_{0.0, 0.0};
        Cell aim_{0, 0};
        TiledGrid<CellState> states_;
        MonotoneQueue<Cell> open_;
        std::uint64_t settled_{0};
        bool stopped_{false};   // the stop function ended the last question
        bool leftGrid_{false};  // a target or a route lies beyond the reach of the grid
    };
}  // namespace parking::search

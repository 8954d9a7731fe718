#pragma once

#include "ompl_improved_astar/search/Heuristic.h"
#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/SearchParameters.h"
#include "ompl_improved_astar/search/containers/MonotoneQueue.h"
#include "ompl_improved_astar/search/containers/Occupancy.h"
#include "ompl_improved_astar/search/containers/TiledGrid.h"
#include "ompl_improved_astar/search/heuristics/DearRoundAim.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace parking::search
{
    /** \brief The disc whose way round the obstacles is looked for. */
    struct Disc
    {
        double radius{0.0};  ///< metres: what it does not fit through is closed
        double wide{0.0};    ///< metres: where a disc of this radius does not fit, the way is dear; 0: nowhere
        double dear{1.0};    ///< a metre there counts as so many, at least 1
    };

    /** \brief How far a disc has to go from here to the nearest of some target points, round the obstacles.

        A resumable A* from the targets over a grid of eight neighbours (D. Silver, "Cooperative pathfinding", 2005:
        reverse resumable A*): asking for a cell continues the search until that cell is settled, so the cost grows with
        the area that is asked about, not with the map. Cells live in tiles that are made when first touched. A cell
        that takes long is made for itself, and looked round: where it lies in a pocket that the disc cannot leave, this
        is found out from within.

        Lengths are whole numbers: twelve for a step to the side and seventeen for a diagonal one, 0.2 % too much.
        Of the many equally short ways through the open only those that begin diagonally are followed (N. Sturtevant
        and S. Rabin, "Canonical orderings on grids", 2016; the turns round blocked cells are those of D. Harabor and
        A. Grastien, "Online graph pruning for pathfinding on grid maps", 2011; what is dear is gone round like what
        is blocked).

        The disc is the circle inscribed in the car at the rear axle: a cell is passable unless that circle surely hits
        an obstacle, or its centre leaves the bounds, wherever in the cell it stands. Ways from centre to centre of such
       cells can be longer than the way of the disc by a factor of 17 / 12, where it slips past the corners of cells;
       see lowerBound(). */
    class ObstacleHeuristic : public Heuristic
    {
    public:
        void begin(const HeuristicQuery &query) override;

        /** \brief As begin(), for another disc than the one inscribed in the car.

            \param mostCells so many are settled; of what lies beyond nothing is known */
        void begin(const HeuristicQuery &query, const Disc &disc, std::uint64_t mostCells);

        /** \brief Forgets everything, for a new world or query; memory is kept.

            \param environment must outlive the questions
            \param resolution side of a cell in metres
            \param disc whose way it is
            \param toward point that most questions will be near: guides the order in which cells are settled
            \param stop asked now and then; must outlive the questions, too */
        void reset(MotionEnvironment &environment, double resolution, const Disc &disc, const Eigen::Vector2d &toward,
                   const StopFunction &stop);

        /** \brief Finds out beforehand which cells of a box are passable, instead of when the search gets there. What
            the grid does not reach, or the stop function leaves, is left to that. */
        void load(const Box &box);

        /** \brief Adds a target; only before the first question. */
        void addTarget(double x, double y);

        /** \brief Metres from (x, y) to the nearest target; infinite when there is no way, or when the stop function
            said so; 0 when the grid does not reach far enough to tell. */
        double distance(double x, double y);

        /** \brief distance(), if it is known without looking any farther. */
        std::optional<double> knownDistance(double x, double y) const;

        /** \brief distance(), less a cell for what the grid adds to it; 0 when there is no way. */
        double estimate(const Pose &pose) override;

        /** \brief A distance that is never more than the way of the disc's centre to the nearest target; infinite when
            there is no way. */
        double lowerBound(const Pose &pose) override;

        bool provesUnreachable(const Pose &pose) override;

        /** \brief The place nearest to \e goal, as the crow flies, that the disc reaches from the targets: the centre
            of a cell. Costs as much as the area that can be reached, unless \e goal is in it. */
        Eigen::Vector2d nearestReachable(const Eigen::Vector2d &goal);

        /** \brief A place on a way of the disc, and where the way is heading there. */
        struct PlaceOnWay
        {
            Eigen::Vector2d place;    ///< the centre of a cell
            Eigen::Vector2d heading;  ///< of any length but zero
        };

        /** \brief The place so far along a shortest way from (x, y); none where the way is shorter, or not known.

            \param ahead metres along the way
            \param around metres along the way to either side over which its heading is taken, at most \e ahead */
        std::optional<PlaceOnWay> placeOnWay(double x, double y, double ahead, double around);

        /** \brief Cells settled. */
        std::uint64_t cells() const override
        {
            return settled_;
        }

        /** \brief Bytes of cells and open list at the most, while the list grows. */
        std::size_t bytes() const
        {
            return states_.bytes() + open_.bytes();
        }

    private:
        enum class Looked : std::uint8_t
        {
            Never,
            Now,
            Before  // there is a way out, or it is too far
        };

        static constexpr std::uint32_t UNREACHED = 0xffffffffu;

        struct CellState
        {
            std::uint32_t g{UNREACHED};
            Occupancy passage{Occupancy::Unknown};  // of the disc
            Looked looked{Looked::Never};           // round this cell, in search of a pocket
            std::uint8_t arrivals{0};               // directions of the last steps of its shortest ways, a bit each
            bool settled : 1;                       // unreached: there is no way
            bool dear : 1;

            CellState() : settled(false), dear(false)
            {
            }
        };

        struct Entry
        {
            std::int32_t column, row;
        };

        /** The cell of a place; none beyond the reach of the grid. */
        std::optional<Entry> cellAt(double x, double y) const
        {
            const double u = std::floor((x - origin_.x()) / resolution_);
            const double v = std::floor((y - origin_.y()) / resolution_);
            if (!TiledGrid<CellState>::contains(u, v))
                return std::nullopt;
            return Entry{static_cast<std::int32_t>(u), static_cast<std::int32_t>(v)};
        }

        Eigen::Vector2d centreOf(const Entry &cell) const
        {
            return origin_ + resolution_ * Eigen::Vector2d(cell.column + 0.5, cell.row + 0.5);
        }

        static bool isReached(const CellState &state)
        {
            return state.g != UNREACHED;
        }

        /** Metres to the nearest target from a cell that is settled; infinite when there is no way. */
        double lengthOf(const CellState &settled) const;

        bool isOpen(CellState &state, std::int32_t column, std::int32_t row)
        {
            if (state.passage == Occupancy::Unknown)
                findPassage(state, column, row);
            return state.passage == Occupancy::Free;
        }

        void findPassage(CellState &state, std::int32_t column, std::int32_t row);
        using Room = double (MotionEnvironment::*)(double x, double y);  // roomAt() or closeRoomAt()
        bool mayHoldDisc(double radius, Room room, double x, double y, double halfSide, int refinements);
        std::uint32_t estimate(std::int32_t column, std::int32_t row) const;
        Ground groundOf(CellState &state, std::int32_t column, std::int32_t row);
        void findDearRoundAim();
        void push(std::uint32_t g, std::int32_t column, std::int32_t row);
        void aimAt(std::int32_t column, std::int32_t row);
        bool settleNext(Entry &settled);
        using Neighbours = TiledGrid<CellState>::Neighbours;
        unsigned int directionsFrom(const Entry &cell, const Neighbours &neighbours, unsigned int arrivals);
        void step(const Entry &cell, const Neighbours &neighbours, std::uint32_t g, unsigned int direction);
        void beginPocket(std::int32_t column, std::int32_t row);
        void widenPocket();
        void endPocket(bool isClosed);

        bool shouldStop()
        {
            return *stop_ && (*stop_)();
        }

        MotionEnvironment *environment_{nullptr};
        Box bounds_;
        const StopFunction *stop_{nullptr};
        double resolution_{1.0};
        Disc disc_;
        StepCost dearer_{0, 0};  // by so much than elsewhere is a step to a dear place
        std::uint64_t mostCells_{0};
        Eigen::Vector2d origin_{0.0, 0.0};
        std::int32_t towardColumn_{0}, towardRow_{0};  // the cell that is made for
        DearRoundAim dearRoundAim_;
        TiledGrid<CellState> states_;
        MonotoneQueue<Entry> open_;
        /** Cells round the one that is asked for, as far as they are known: perhaps there is no way out. */
        struct Pocket
        {
            std::vector<Entry> cells;
            std::size_t next{0};
        } pocket_;
        std::uint64_t settled_{0};
        bool stopped_{false};   // the last answer is what it is for want of time
        bool leftGrid_{false};  // a target or a way lies beyond the reach of the grid
    };
}  // namespace parking::search

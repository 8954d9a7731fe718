#pragma once

#include "ompl_improved_astar/search/GridEnvironment.h"
#include "ompl_improved_astar/search/containers/OpenList.h"
#include "ompl_improved_astar/search/SearchParameters.h"
#include "ompl_improved_astar/search/containers/TiledGrid.h"
#include "parking_geometry/Pose.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace parking::search
{
    /** \brief Parameters of the paper's search on a grid of positions. */
    struct GridParameters
    {
        double resolution{0.5};         ///< side of a cell in metres
        bool sixteenNeighbours{false};  ///< knight's moves besides the eight neighbours ("Neighborhood Expansion")
        Eigen::Vector2d low{0.0, 0.0};  ///< of the box that is searched
        Eigen::Vector2d high{0.0, 0.0};
        HeuristicWeights weights;
        OpenListKind openList{OpenListKind::BinaryHeap};
        bool bidirectional{true};
        bool eagerObstacles{false};  ///< find out which cells are free before the search instead of during it
    };

    /** \brief A* on a grid of positions, as the paper has it ("Summary of Optimizations for Improved A* Algorithm").

        The car moves from cell centre to cell centre, heading where it goes and turning on the spot in between. Whether
       a cell is free is a matrix of three values, unknown, free and blocked, filled when first asked for, or
       beforehand. In the bidirectional search each side aims at the node with the lowest cost of the other side's
       closed list, and a path is found when the closed lists meet. Motions between cells are checked along their whole
       length, so that a knight's move does not jump over a small obstacle. The cells of the start and of the goal hold
       the exact poses. */
    class GridSearch
    {
    public:
        /** \brief Forgets everything and begins a new query; memory is kept. */
        void begin(GridEnvironment &environment, const GridParameters &parameters);

        /** \brief Adds a root; poses must be free and inside of the box. */
        void addStart(const Pose &pose);
        void addGoal(const Pose &pose);

        /** \brief Where the search without any goal shall go. */
        void setTarget(double x, double y);

        enum class Outcome
        {
            Found,
            Exhausted,
            Stopped
        };

        /** \brief With eager loading, first evaluates every cell. May be called again after Stopped. */
        Outcome run(const StopFunction &stop);

        /** \brief The path found: poses joined by straight motions or turns on the spot. */
        const std::vector<Pose> &path() const
        {
            return path_;
        }

        /** \brief The path from a start to the node of the start's tree nearest to (x, y); empty without a start. */
        std::vector<Pose> nearestPath(double x, double y) const;

        /** \brief Seconds spent on evaluating every cell beforehand. */
        double loadingTime() const
        {
            return loadingTime_;
        }

        const SearchStatistics &statistics() const
        {
            return statistics_;
        }

        /** \brief Calls visit(pose, parent index, index, from the start's tree) for every node that was reached. */
        template <class Visit>
        void forEachNode(const Visit &visit) const
        {
            for (std::uint32_t i = 0; i < nodes_.size(); ++i)
                visit(nodes_[i].pose, nodes_[i].parent, i, nodes_[i].side == 0);
        }

        static constexpr std::uint32_t NO_NODE = 0xffffffffu;

    private:
        struct Node
        {
            Pose pose;  // heading of the motion that led here, or, from the goal's side, that leaves from here
            double g;
            double h;
            std::uint32_t parent;
            std::int32_t column, row;
            std::uint8_t side;
            bool closed;
        };

        enum class Occupancy : std::int8_t
        {
            Blocked = -1,
            Unknown = 0,
            Free = 1
        };

        struct Cell
        {
            std::array<std::uint32_t, 2> node{NO_NODE, NO_NODE};
            Occupancy occupancy{Occupancy::Unknown};
            std::array<Occupancy, 16> byHeading{};
        };

        /** An expansion that goes on with this direction; none without a node. */
        struct Expansion
        {
            int side;
            std::uint32_t node;
            std::size_t direction;
        };

        void addRoot(int side, const Pose &pose);
        bool isCellFree(Cell &cell, const Pose &pose, std::size_t direction);
        Outcome load(const StopFunction &stop);
        double remaining(int side, const Pose &pose) const;
        void push(int side, std::uint32_t node);
        int chooseSide();
        bool expand(const StopFunction &stop);
        bool isStepFree(int side, const Node &from, const Pose &to, double heading) const;
        bool meets(std::uint32_t a, std::uint32_t b);
        void appendToRoot(std::uint32_t node, std::vector<Pose> &poses) const;
        Pose centre(std::int32_t column, std::int32_t row) const;
        bool isAtCentre(const Node &node) const;

        GridEnvironment *environment_{nullptr};
        GridParameters parameters_;
        TiledGrid<Cell> cells_;
        std::vector<Node> nodes_;
        std::array<OpenList, 2> open_;
        std::array<std::vector<std::uint32_t>, 2> roots_;
        std::array<std::uint32_t, 2> bestClosed_{NO_NODE, NO_NODE};
        std::array<double, 2> bestClosedF_{};
        Eigen::Vector2d target_{0.0, 0.0};
        std::int32_t columns_{0}, rows_{0};
        std::int64_t loaded_{0};
        bool turn_{false};
        Expansion unfinished_{0, NO_NODE, 0};
        double loadingTime_{0.0};
        std::vector<Pose> path_;
        SearchStatistics statistics_;
    };
}  // namespace parking::search

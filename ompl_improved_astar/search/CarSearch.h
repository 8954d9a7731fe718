#pragma once

#include "ompl_improved_astar/search/CostModel.h"
#include "ompl_improved_astar/search/CurveCheck.h"
#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/SearchParameters.h"
#include "ompl_improved_astar/search/containers/CellTable.h"
#include "ompl_improved_astar/search/containers/OpenList.h"
#include "ompl_improved_astar/search/heuristics/CurveHeuristic.h"
#include "ompl_improved_astar/search/heuristics/ObstacleHeuristic.h"
#include "parking_geometry/curves/Path.h"
#include "parking_geometry/curves/ReedsShepp.h"

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace parking::search
{
    /** \brief Parameters of the car's motion model and of its search. */
    struct CarParameters
    {
        double turningRadius{1.0};       ///< metres, of the rear axle
        bool forwardOnly{false};         ///< never drive in reverse (Dubins)
        unsigned int steeringAngles{3};  ///< odd: straight and as many to the left as to the right
        double xyResolution{0.0};        ///< cell side in metres for steps of one metre; 0: a tenth of the radius
        unsigned int headingBins{72};    ///< cells of heading for steps of one metre
        double inscribedRadius{0.0};     ///< metres: no obstacle can be nearer to the rear axle than this
        HeuristicWeights weights;
        OpenListKind openList{OpenListKind::BinaryHeap};
        bool bidirectional{true};       ///< search from the goal and the start; otherwise from one side only
        bool searchFromGoal{true};      ///< the side, when not bidirectional
        bool adaptiveResolution{true};  ///< refine where coarse steps do not get through
        bool analyticExpansion{true};   ///< try Reeds-Shepp (or Dubins) curves between the trees
        bool obstacleHeuristic{true};   ///< guide round obstacles by ObstacleHeuristic
        bool eagerObstacles{false};     ///< let it find out where the disc can be before the search
        Eigen::Vector2d low{0.0, 0.0};  ///< of the box for eagerObstacles
        Eigen::Vector2d high{0.0, 0.0};
        CostModel cost;
    };

    /** \brief Why CarSearch::run() came back. */
    enum class SearchOutcome
    {
        Improved,   ///< a solution, or a cheaper one than before
        Exhausted,  ///< nothing left to expand: there is none (better) at this resolution
        Stopped     ///< the stop function said so
    };

    /** \brief Multi-resolution, bidirectional best-first search over drivable motions.

        Two trees, one rooted at the starts and one at the goals, grow by arcs at the turning radius and straight lines,
        forwards and backwards, each as far as it is free. Every node keeps its exact pose. What is discretised is only
        which nodes are kept: cells of position and heading, at a ladder of resolutions that halve from one level to the
        next. A node lives on the coarsest level where its cell is not yet taken by a cheaper one. Expanding it there
        tries motions of that level's step and as far as the car can go; then the node is queued again on the next finer
        level. The levels take turns, the coarse ones getting most of them, so that open areas are crossed in a few long
        steps while a tight slot, where long steps end at once, is searched finely (after W. Du, F. Islam and M.
       Likhachev, "Multi-resolution A*", 2020).

        The trees are joined by Reeds-Shepp curves: from each expanded node to the other tree's roots, and to its best
        closed node (paper, section "Bidirectional Search"), every word in the order of its cost until one is free.

        All costs come from one CostModel. Equal inputs give equal outputs. Memory is kept between queries. */
    class CarSearch
    {
    public:
        CarSearch();

        /** \brief Forgets everything and begins a new query.

            The environment must outlive the search. */
        void begin(MotionEnvironment &environment, const CarParameters &parameters);

        /** \brief Adds a root. Poses must be free. May be called between runs. */
        void addStart(const Pose &pose);
        void addGoal(const Pose &pose);

        /** \brief Without any goal: searches for the free pose nearest to \e target, by distance between the rear
           axles.

            run() then ends with Exhausted when it has not come nearer for a while; see nearestPath(). */
        void setTarget(const Pose &target);

        /** \brief Searches until the solution improves, nothing is left, or \e stop says so. */
        SearchOutcome run(const StopFunction &stop);

        bool hasSolution() const
        {
            return bestCost_ < std::numeric_limits<double>::infinity();
        }
        /** \brief Cost of the best solution; infinite without one. */
        double bestCost() const
        {
            return bestCost_;
        }
        /** \brief The best solution, from a start to a goal. */
        const Path &bestPath() const
        {
            return bestPath_;
        }

        const ReedsShepp &curves() const
        {
            return curves_;
        }

        bool hasGoal() const
        {
            return !trees_[1].roots.empty();
        }

        /** \brief Length of the shortest curve from any start to any goal, obstacles or not. */
        double shortestCurve() const;

        /** \brief What the heuristic makes of the way from the starts to the goals: more than the shortest curve where
            obstacles are in the way. Not a bound. */
        double estimate() const;

        /** \brief Tells the search of a cheaper solution found elsewhere, so that it looks for better ones only. */
        void setCostBound(double cost);

        /** \brief Changes the weights of the heuristic and sorts the open lists anew. */
        void setWeights(const HeuristicWeights &weights);

        /** \brief A lower bound of the cost of any solution of the discretised problem: the smallest g + h of the open
            nodes, h being admissible. */
        double lowerBound();

        /** \brief The path from a start to the node whose rear axle is nearest to that of \e target.

            \return false when there is no start */
        bool nearestPath(const Pose &target, Path &path) const;

        /** \brief Calls visit(pose, parent index, index, from the start's tree) for every node. */
        template <class Visit>
        void forEachNode(const Visit &visit) const
        {
            for (int side = 0; side < 2; ++side)
                for (std::uint32_t i = 0; i < trees_[side].nodes.size(); ++i)
                    visit(trees_[side].nodes[i].pose, trees_[side].nodes[i].parent, i, side == 0);
        }

        const SearchStatistics &statistics() const;

        /** \brief Seconds spent on eagerObstacles. */
        double loadingTime() const
        {
            return loadingTime_;
        }

        static constexpr std::uint32_t NO_NODE = CellTable::NONE;

    private:
        static constexpr int LEVELS = 7;

        struct Node
        {
            Pose pose;
            double g;
            double curvature;  // of the arc that led here
            double length;     // signed length of that arc, as driven from the root outwards
            float h;
            float mobility;  // longest free motion from here, known after the first expansion
            std::uint32_t parent;
            std::uint8_t level;  // on which its cell was free
            bool expanded;
            bool queued;    // of roots: has been put into the open list
            bool farthest;  // the arc ended for want of reach, not because a shorter step was wanted
        };

        struct Tree
        {
            std::vector<Node> nodes;
            std::vector<float> freeLengths;  // of the motions of each expanded node, signs left out
            CellTable cells;
            std::array<OpenList, LEVELS> open;
            std::array<std::uint64_t, LEVELS> turns{};
            std::uint32_t bestClosed{NO_NODE};
            std::vector<std::uint32_t> roots;
            double rootMobility{std::numeric_limits<double>::infinity()};
            std::uint64_t seenWhenExhausted{0};
            bool exhausted() const;
        };

        void addRoot(int side, const Pose &pose);
        void prepareHeuristics();
        void measureMobility(int side);
        void guideRoundObstacles();
        double heuristicCell(int side) const;
        void resetObstacleHeuristic(int side, const Pose &toward);
        void aimAtTarget();
        bool isProvenUnreachable();
        void prepareNodes(int side);
        void rekey(int side);
        double heuristic(int side, const Pose &pose);
        double admissibleHeuristic(int side, const Pose &pose);
        double priority(int side, const Node &node) const;
        void push(int side, int level, std::uint32_t node);
        std::uint64_t cellKey(const Pose &pose, int level) const;
        int chooseSide();
        bool isHopeless() const;
        int chooseLevel(const Tree &tree) const;
        void step(int side, int level);
        void expand(int side, std::uint32_t index, int level);
        void collectMotions(int side, const Node &node);
        void addChild(int side, std::uint32_t parent, double curvature, double length, bool farthest);
        bool connect(std::uint32_t fromStart, std::uint32_t fromGoal, CurveEnd sweptFrom);
        void connectAround(int side, std::uint32_t index);
        void appendBranch(int side, std::uint32_t node, Path &path) const;
        Path pathFromStart(std::uint32_t node) const;

        MotionEnvironment *environment_{nullptr};
        CarParameters parameters_;
        ReedsShepp curves_{1.0};
        std::array<Tree, 2> trees_;  // of the starts and of the goals
        std::array<CurveHeuristic, 2> curveHeuristics_;
        std::array<ObstacleHeuristic, 2> obstacleHeuristics_;
        std::array<double, 2> heuristicCells_{};
        std::array<bool, 2> aroundObstacles_{false, false};
        std::array<double, LEVELS> steps_{};
        std::array<double, LEVELS> inverseCell_{};
        std::array<double, LEVELS> headingScale_{};
        double reach_{0.0};
        double shortest_{0.0};
        int confined_{1};  // the side that is harder to get away from, or the only one that is searched
        bool prepared_{false};
        bool provenUnreachable_{false};
        bool hasTarget_{false};
        Pose target_;
        double nearest_{std::numeric_limits<double>::infinity()};
        std::uint64_t nearestSince_{0};
        std::uint64_t sideTurn_{0};
        double bestCost_{std::numeric_limits<double>::infinity()};
        double costBound_{std::numeric_limits<double>::infinity()};
        Path bestPath_;
        bool improved_{false};
        StopFunction stop_;
        double loadingTime_{0.0};
        mutable SearchStatistics statistics_;
        std::vector<Arc> motions_;  // of the node that is expanded
        std::vector<double> free_;
        std::vector<ReedsSheppCurve> candidates_;
        std::vector<std::pair<double, std::size_t>> order_;
    };
}  // namespace parking::search

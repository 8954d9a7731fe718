#pragma once

#include "ompl_improved_astar/search/Frontier.h"
#include "ompl_improved_astar/search/Heuristic.h"
#include "ompl_improved_astar/search/HeuristicWeights.h"
#include "ompl_improved_astar/search/MotionModel.h"
#include "ompl_improved_astar/search/SearchContext.h"
#include "ompl_improved_astar/search/StopFunction.h"
#include "ompl_improved_astar/search/heuristics/RouteHeuristic.h"
#include "ompl_improved_astar/search/proofs/Enclosure.h"
#include "parking_geometry/curves/Path.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace parking::search
{
    /** \brief Why Search::run() came back. */
    enum class SearchOutcome
    {
        Improved,   ///< a solution, or a cheaper one than before
        Exhausted,  ///< nothing left to expand, or no hope: see exhaustion()
        Stopped     ///< the stop function said so
    };

    /** \brief Why there is nothing left to search. */
    enum class Exhaustion
    {
        None,         ///< there is
        WalledIn,     ///< proven: not even a disc inside of the car finds a route round the obstacles
        Enclosed,     ///< proven: not even moving sideways and turning on the spot would the car get out (Enclosure)
        SearchedOut,  ///< one end has been left by every motion, down to the finest resolution
        NoProgress    ///< a search for the place nearest to a goal has not come nearer for long
    };

    /** \brief Bidirectional best-first search over a motion model.

        Two frontiers, one rooted at the starts and one at the goals, grow by the model's motions. Every node keeps its
        exact pose. What is discretised is only which nodes are kept: cells, on a ladder of resolutions. A node lives on
        the coarsest level where its cell is not yet taken by a cheaper one. Expanding it there tries that level's
        motions; then the node is queued again on the next finer level. The levels take turns, the coarse ones getting
        most of them, so that open areas are crossed in a few long steps while a tight slot, where long steps end at
        once, is searched finely (after W. Du, F. Islam and M. Likhachev, "Multi-resolution A*", 2020).

        The more confined frontier gets most of the turns, and is guided by the route of a disc round the obstacles:
        nodes farthest along it drive on towards it without an expansion for each step, and crowded places are left for
        later. When it comes no nearer, the routes of wider discs (detours) guide queues of their own, and a proof that
        there is no path is sought beside the search. Frontiers are joined by the model: from each expanded node to the
        other side's roots and to its best closed node (paper, section "Bidirectional Search"), or where they meet in a
        cell.

        What is interchangeable is the motion model, the heuristic and the open list, each chosen by name. All costs
        come from one CostModel. Equal inputs give equal outputs. Memory is kept between queries. */
    class Search
    {
    public:
        Search() : frontiers_{Frontier(Side::Start), Frontier(Side::Goal)}
        {
        }

        /** \brief Forgets everything and begins a query. \e environment must outlive it.

            Throws parking::Error for a part that is not known. */
        void begin(MotionEnvironment &environment, const PlannerParameters &parameters, const CarInSpace &car);

        /** \brief Adds a root, which must be free. Once nodes have been expanded the search restarts with all roots; it
            keeps its solution. */
        void addStart(const Pose &pose)
        {
            addRoot(Side::Start, pose);
        }

        /** \brief The same for a goal. */
        void addGoal(const Pose &pose)
        {
            addRoot(Side::Goal, pose);
        }

        /** \brief Instead of a goal: searches for the free pose nearest to \e target, by distance between the rear
            axles. run() ends with Exhausted when it has not come nearer for a while; see nearestPath(). */
        void setTarget(const Pose &target)
        {
            target_ = Target{target};
        }

        /** \brief Searches until the solution improves, nothing is left, or \e stop says so.

            \param maxExpansions of the query: after that many none is begun */
        SearchOutcome run(const StopFunction &stop,
                          std::uint64_t maxExpansions = std::numeric_limits<std::uint64_t>::max());

        /** \brief Bytes that nodes, cells, open lists, routes, proofs and the tables of the model take at most, growing
            included. */
        std::size_t memory() const;

        /** \brief Limits memory(), which is max_memory_mb otherwise. */
        void setMaxMemory(std::size_t bytes)
        {
            memory_.max = bytes;
        }

        /** \brief Has it stopped since it would take more memory than it may? */
        bool isFull() const
        {
            return memory_.isFull;
        }

        /** \brief Why the last run() ended with Exhausted; None when it did not. */
        Exhaustion exhaustion() const
        {
            return exhaustion_;
        }

        /** \brief Cost of the best solution; infinite without one. */
        double bestCost() const
        {
            return best_.cost;
        }

        /** \brief The best solution, from a start to a goal. */
        const Path &bestPath() const
        {
            return best_.path;
        }

        /** \brief The motion model of the query. */
        const MotionModel &model() const
        {
            return *model_;
        }

        /** \brief What motions cost in this query. */
        const CostModel &cost() const
        {
            return query_->cost;
        }

        /** \brief Length of the shortest motion between any start and any goal, obstacles or not. */
        double shortestMotion() const;

        /** \brief Expected cost of a path: the least estimate of the roots of the more confined side, and at least
            shortestMotion(). */
        double expectedCost() const;

        /** \brief From now on only solutions that cost less than \e cost are of interest. */
        void setCostBound(double cost)
        {
            costBound_ = std::min(costBound_, cost);
        }

        /** \brief Lowers the weights of the heuristic: paths are then found later, and cheaper. */
        void lowerWeights(double factor);

        /** \brief A cost that no path stays below, whatever it is made of: the least lower bound of the roots. */
        double lowerBound();

        /** \brief The path from a start to the node whose rear axle is nearest to that of \e target.

            \return false when there is no start */
        bool nearestPath(const Pose &target, Path &path) const;

        /** \brief Has the start's side been searched to its end? */
        bool hasSeenAllFromStart() const
        {
            return isPrepared_ && frontier(Side::Start).isExhausted();
        }

        /** \brief What has grown from that end. */
        const Frontier &frontier(Side side) const
        {
            return frontiers_[static_cast<std::size_t>(side)];
        }

        /** \brief Nodes expanded since begin(): statistics().expanded. */
        std::uint64_t expanded() const
        {
            return statistics_.expanded;
        }

        /** \brief What was done since begin(). */
        SearchStatistics statistics() const;

    private:
        struct Solution
        {
            double cost{std::numeric_limits<double>::infinity()};
            Path path;
        };

        /** What guides one side: the heuristic, and the route round obstacles if it has been asked for one. */
        struct Guide
        {
            std::string name;  // of the heuristic
            std::unique_ptr<Heuristic> heuristic;
            RouteHeuristic route;
            bool hasRoute{false};
            std::vector<Pose> targets;
        };

        /** The route of a wider disc, which guides a queue of the confined side. */
        struct Detour
        {
            RouteHeuristic route;
            double fromRoot{0.0};     // metres of that route from the nearest root; 0 or infinite: unknown
            NodeIndex best{NO_NODE};  // the closed node that is farthest along it
            double nearest{std::numeric_limits<double>::infinity()};  // estimate of that node

            double estimate(const Node &node, bool looksFurther);
        };

        /** What has come nearest to a target, or to the other side, and when: in expansions. */
        struct Progress
        {
            double nearest{std::numeric_limits<double>::infinity()};
            std::uint64_t since{0};
        };

        /** Where to go instead of a goal. */
        struct Target
        {
            Pose pose;
            double nearestOfDisc{0.0};  // metres from there to the nearest place that the inscribed disc reaches
        };

        /** Whether memory() is within its limit, which takes too long to ask each time. */
        struct MemoryWatch
        {
            std::size_t max{0};
            std::uint64_t looks{0};
            bool isFull{false};
        };

        Frontier &frontier(Side side)
        {
            return frontiers_[static_cast<std::size_t>(side)];
        }
        Guide &guide(Side side)
        {
            return guides_[static_cast<std::size_t>(side)];
        }
        bool isAdmissible() const
        {
            return !query_->parameters.weights().canBeLowered();
        }
        bool isStopped() const
        {
            return stop_ && stop_();
        }

        // Beginning
        void addRoot(Side side, const Pose &pose);
        void restart(const std::vector<Pose> &starts, const std::vector<Pose> &goals);
        bool prepare();
        Side confinedSide();
        void beginRoute(Side side, const std::vector<Pose> &roots);
        void guideToTarget();
        bool isProvenUnreachable();

        // Choosing
        SearchOutcome search(std::uint64_t maxExpansions);
        bool isHopeless() const;
        bool chooseSide(Side &side);
        void step(Frontier &own);
        bool outgrowsMemory();

        // Expanding
        void expand(Frontier &own, std::size_t queue, std::size_t level, NodeIndex index);
        bool addSuccessors(Frontier &own, NodeIndex index);
        void addSuccessor(Frontier &own, NodeIndex parent, const Successor &successor);
        double costTo(const Frontier &own, const Node &parent, const Successor &successor);
        void close(Frontier &own, NodeIndex index, std::size_t queue);
        void lookAhead(Frontier &own, NodeIndex index, std::size_t queue);
        NodeIndex driveAlong(Frontier &own, NodeIndex index, RouteHeuristic &route);

        // Joining
        void joinAround(const Frontier &own, NodeIndex index);
        void join(const Frontier &own, NodeIndex index, NodeIndex partner);

        // Estimating
        double estimate(Side side, const Pose &pose);
        double admissible(Side side, const Pose &pose);
        float rounded(double estimate) const;
        bool mayImprove(Side side, const Node &node);
        double priority(const Frontier &own, const Node &node);
        float densityPenalty(const Frontier &own, const Node &node) const;
        bool isDeferred(const Frontier &own, const Node &node) const;
        void push(Frontier &own, std::size_t level, NodeIndex index, std::size_t queue = 0);
        void pushFirst(Frontier &own, std::size_t level, NodeIndex index);
        bool sortLists();

        // When the search is stuck
        std::size_t detourCount() const
        {
            return frontier(confined_).queues() - 1;
        }
        void endTurn();
        bool needsDetour() const;
        void addDetour();
        void endDetours();
        void pushToDetour(std::size_t detour, std::size_t level, NodeIndex index, bool looksFurther);
        void seekProof();

        std::optional<SearchContext> query_;
        std::unique_ptr<MotionModel> model_;
        ModelTraits traits_;
        HeuristicWeights weights_;
        std::array<Frontier, 2> frontiers_;
        std::array<Guide, 2> guides_;
        Side confined_{Side::Goal};  // the side that is harder to get away from, or the only one that is searched
        std::optional<Target> target_;
        Progress progress_;  // of the confined side in its turns, or towards the target in expansions
        std::vector<std::unique_ptr<Detour>> detours_;  // of the confined side, for its further queues
        std::uint64_t detoursSince_{0};                 // expansions when the first was added
        EnclosureProof enclosure_;
        Exhaustion proof_{Exhaustion::None}, exhaustion_{Exhaustion::None};
        Solution best_;
        double costBound_{std::numeric_limits<double>::infinity()};
        bool isPrepared_{false}, isSorted_{true}, isImproved_{false};
        StopFunction stop_;  // also when memory runs out
        MemoryWatch memory_;
        std::uint64_t turns_{0};             // of the sides
        std::vector<Successor> successors_;  // of the node that is expanded
        SearchStatistics statistics_;
    };
}  // namespace parking::search

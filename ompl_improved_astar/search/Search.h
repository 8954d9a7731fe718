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
    /** \brief Why Search::run() returned. */
    enum class SearchOutcome
    {
        Improved,   ///< a first or a cheaper solution
        Exhausted,  ///< nothing left to expand, or proven infeasible: see exhaustion()
        Stopped     ///< the stop function returned true
    };

    /** \brief Why a search is exhausted. */
    enum class Exhaustion
    {
        None,         ///< it is not
        WalledIn,     ///< proven: a disc inscribed in the car has no route around the obstacles
        Enclosed,     ///< proven: a car that moves sideways and turns on the spot has no path (Enclosure)
        SearchedOut,  ///< every motion from one end has been tried, down to the finest resolution
        NoProgress    ///< a search for the pose nearest to a goal has stalled
    };

    /** \brief Bidirectional best-first search over a motion model.

        Two frontiers, one rooted at the starts and one at the goals, grow by the model's motions. Nodes keep their
        exact poses; cells at several resolutions only decide which nodes are kept. A node belongs to the coarsest level
        on which no cheaper node occupies its cell. Its expansion tries the motions of that level, then the node is
        queued on the next finer level. Levels alternate, and coarse ones receive most expansions: they cross open
        ground in long steps, while fine levels resolve tight slots (after W. Du, F. Islam and M. Likhachev,
        "Multi-resolution A*", 2020).

        The more confined frontier receives most expansions. The route of a disc around the obstacles guides it: the
        node farthest along the route follows it without an expansion for each step, and dense regions are deferred. If
        the frontier stalls, routes of wider discs (detours) guide additional queues, and the search also seeks a proof
        that no path exists. The model joins the frontiers: each expanded node with the roots of the other side and its
        best closed node (paper, section "Bidirectional Search"), or nodes in a common cell.

        Motion model, heuristic and open list are interchangeable and chosen by name. One CostModel defines all costs.
        Equal inputs give equal outputs. Memory is kept between queries. */
    class Search
    {
    public:
        Search() : frontiers_{Frontier(Side::Start), Frontier(Side::Goal)}
        {
        }

        /** \brief Begins a new query. \e environment must outlive it.

            Throws parking::Error for an unknown motion model, heuristic or open list. */
        void begin(MotionEnvironment &environment, const PlannerParameters &parameters, const CarInSpace &car);

        /** \brief Adds a start, which must be free. If nodes have been expanded, the search restarts with all roots and
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

        /** \brief Searches, instead of for a goal, for the free pose nearest to \e target by distance between the rear
            axles. run() returns Exhausted when it stalls; see nearestPath(). */
        void setTarget(const Pose &target)
        {
            target_ = Target{target};
        }

        /** \brief Searches until the solution improves, the search is exhausted, or \e stop returns true.

            \param maxExpansions upper limit of the expansions of the query */
        SearchOutcome run(const StopFunction &stop,
                          std::uint64_t maxExpansions = std::numeric_limits<std::uint64_t>::max());

        /** \brief Upper limit of the bytes of nodes, cells, open lists, routes, proofs and tables of the model,
            including growth. */
        std::size_t memory() const;

        /** \brief Limits memory(); the default is max_memory_mb. */
        void setMaxMemory(std::size_t bytes)
        {
            memory_.max = bytes;
        }

        /** \brief Whether the search stopped because of its memory limit. */
        bool isFull() const
        {
            return memory_.isFull;
        }

        /** \brief Why the last run() returned Exhausted; None if it did not. */
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

        /** \brief Cost model of the query. */
        const CostModel &cost() const
        {
            return query_->cost;
        }

        /** \brief Length of the shortest motion between any start and any goal, obstacles ignored. */
        double shortestMotion() const;

        /** \brief Expected cost of a path: the least estimate of the roots of the more confined side, and at least
            shortestMotion(). */
        double expectedCost() const;

        /** \brief Restricts the search to solutions that cost less than \e cost. */
        void setCostBound(double cost)
        {
            costBound_ = std::min(costBound_, cost);
        }

        /** \brief Multiplies the heuristic weights by \e factor, down to 1: the search takes longer and finds cheaper
        paths. */
        void lowerWeights(double factor);

        /** \brief Lower bound of the cost of any path: the smallest lower bound of the roots. */
        double lowerBound();

        /** \brief The path from a start to the node whose rear axle is nearest to that of \e target.

            \return false if there is no start */
        bool nearestPath(const Pose &target, Path &path) const;

        /** \brief Whether the start's side is exhausted. */
        bool hasSeenAllFromStart() const
        {
            return isPrepared_ && frontier(Side::Start).isExhausted();
        }

        /** \brief The frontier of one side. */
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

        /** Guide of one side: the heuristic, and the route around obstacles if it is enabled. */
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

        /** Smallest distance to a target or to the other side, and the expansion that reached it. */
        struct Progress
        {
            double nearest{std::numeric_limits<double>::infinity()};
            std::uint64_t since{0};
        };

        /** Replacement of a goal by the nearest reachable pose. */
        struct Target
        {
            Pose pose;
            double nearestOfDisc{0.0};  // metres from there to the nearest place that the inscribed disc reaches
        };

        /** Checks memory() against its limit now and then, because the check is slow. */
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

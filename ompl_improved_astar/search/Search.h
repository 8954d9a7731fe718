#pragma once

#include "ompl_improved_astar/search/Frontier.h"
#include "ompl_improved_astar/search/Heuristic.h"
#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/MotionModel.h"
#include "ompl_improved_astar/search/SearchParameters.h"
#include "ompl_improved_astar/search/heuristics/ObstacleHeuristic.h"
#include "ompl_improved_astar/search/proofs/Enclosure.h"
#include "ompl_improved_astar/search/proofs/RefinedEnclosure.h"
#include "parking_geometry/curves/Path.h"

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
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
        WalledIn,     ///< proven: not even a disc inside of the car finds a way round the obstacles
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

        The more confined frontier gets most of the turns, and is guided round the obstacles. Frontiers are joined by
        the model: from each expanded node to the other side's roots and to its best closed node (paper, section
        "Bidirectional Search"), or where they meet in a cell.

        What is interchangeable is the motion model, the heuristic and the open list, each chosen by name. All costs
        come from one CostModel. Equal inputs give equal outputs. Memory is kept between queries.

        When both heuristic weights are at most 1, estimates are lower bounds, nothing is pruned by more than them, and
        the search keeps account of what it drops: see lowerBound(). */
    class Search
    {
    public:
        /** \brief Empty, and not usable before begin(). */
        Search();

        /** \brief Forgets everything and begins a new query.

            The environment must outlive the search. Throws parking::Error for a part that is not known. */
        void begin(MotionEnvironment &environment, const SearchParameters &parameters);

        /** \brief Adds a root. Poses must be free. May be called between runs. */
        void addStart(const Pose &pose)
        {
            addRoot(Side::Start, pose);
        }

        /** \brief The same for a goal; there is then no target of setTarget() any more. */
        void addGoal(const Pose &pose)
        {
            hasTarget_ = false;
            addRoot(Side::Goal, pose);
        }

        /** \brief Without any goal: searches for the free pose nearest to \e target, by distance between the rear
            axles.

            run() then ends with Exhausted when it has not come nearer for a while; see nearestPath(). */
        void setTarget(const Pose &target);

        /** \brief Searches until the solution improves, nothing is left, or \e stop says so.

            \param mostExpansions of the query: after so many none is begun, and the last one is finished. A flood for
            estimates that \e stop ends leaves them too low */
        SearchOutcome run(const StopFunction &stop,
                          std::uint64_t mostExpansions = std::numeric_limits<std::uint64_t>::max());

        /** \brief Bytes that nodes, cells, open lists, the ways round obstacles, proofs and the tables of the model
            take at most, growing included. */
        std::size_t memory() const;

        /** \brief Changes SearchParameters::maxMemory. */
        void setMaxMemory(std::size_t bytes)
        {
            parameters_.maxMemory = bytes;
        }

        /** \brief Has it stopped since it would take more than SearchParameters::maxMemory? */
        bool isFull() const
        {
            return full_;
        }

        /** \brief Why the last run() ended with Exhausted; None when it did not. */
        Exhaustion exhaustion() const
        {
            return exhaustion_;
        }

        /** \brief Has a path from a start to a goal been found? */
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

        /** \brief The motion model of the query. */
        const MotionModel &model() const
        {
            return *model_;
        }

        /** \brief What motions cost in this query: as begin() was told, with the lock of the car, and with the
            preferred clearance where the model has one. */
        const CostModel &cost() const
        {
            return parameters_.cost;
        }

        /** \brief Has a goal been added? */
        bool hasGoal() const
        {
            return !frontier(Side::Goal).roots().empty();
        }

        /** \brief Length of the shortest motion between any start and any goal, obstacles or not. */
        double shortestMotion() const;

        /** \brief What the search expected of the roots of the more confined side: the least of their estimates. */
        double estimate() const;

        /** \brief From now on only solutions that cost less than \e cost are of interest. */
        void setCostBound(double cost)
        {
            costBound_ = std::min(costBound_, cost);
        }

        /** \brief Changes the weights and sorts the open nodes anew; what \e stop leaves of that is done by the next
            run(). */
        void setWeights(const HeuristicWeights &weights, const StopFunction &stop = {});

        /** \brief A cost that no solution of the discretised problem stays below.

            Always at least what the heuristics promise for the roots, which holds for any path that can be driven. When
            the query was begun with both weights at most 1 it is the bound of the search, too: the least g + h of all
            nodes that are open or were dropped (from a cell that another holds). It holds for every path made of the
            motions from one end and one way that joins them with the other end. */
        double lowerBound();

        /** \brief The path from a start to the node whose rear axle is nearest to that of \e target.

            \return false when there is no start */
        bool nearestPath(const Pose &target, Path &path) const;

        /** \brief Has the start's side been searched to its end? */
        bool hasSeenAllFromStart() const
        {
            return preparation_ == Preparation::Done && frontier(Side::Start).isExhausted();
        }

        /** \brief What has grown from that end. */
        const Frontier &frontier(Side side) const
        {
            return frontiers_[static_cast<std::size_t>(side)];
        }

        /** \brief Nodes expanded since begin(): statistics().expanded, for those who ask at every step. */
        std::uint64_t expanded() const
        {
            return statistics_.expanded;
        }

        /** \brief What was done since begin(); put together when asked for. */
        const SearchStatistics &statistics() const;

        /** \brief Seconds spent on eagerObstacles. */
        double loadingTime() const
        {
            return loadingTime_;
        }

    private:
        // So seldom that asking costs nothing, and so often that, with some hundred goals to be estimated to, it is
        // well within a millisecond.
        static constexpr NodeIndex NODES_BETWEEN_STOPS = 32;

        /** The heuristics of one side. */
        struct Guides
        {
            std::unique_ptr<Heuristic> base;
            ObstacleHeuristic obstacles;
            bool roundObstacles{false};
            std::vector<Pose> roots, targets;
        };

        /** An expansion that goes on with this successor; none without a node. */
        struct UnderWay
        {
            Side side{Side::Start};
            NodeIndex node{NO_NODE};
            std::size_t level{0};
            bool first{true};
            std::size_t next{0};
            bool isCutShort{false};  // the time was up before it was known how far all motions are free
        };

        /** Looking ahead, which goes on from this node by the guide of this queue; none without a node. */
        struct Lookahead
        {
            NodeIndex node{NO_NODE};
            std::size_t queue{0};
        };

        /** What is done with nodes and roots before they are searched from, one after the other. A large search takes
            long to do it, and may be stopped in the middle. */
        enum class Preparation : std::uint8_t
        {
            Guides,     ///< begun anew, for all roots
            Estimates,  ///< of the nodes there are, by these guides
            Lists,      ///< sorted by them
            Queues,     ///< of nodes to be joined with new roots, and of these
            Done
        };

        /** How far something has been done with all nodes, those of the starts first. */
        struct Visited
        {
            std::size_t sides{0};
            NodeIndex nodes{0};
        };

        /** The way of another disc than the inscribed one, and what has come farthest by it. */
        struct Detour
        {
            ObstacleHeuristic way;
            NodeIndex best{NO_NODE};
            double nearest{std::numeric_limits<double>::infinity()};
            Pose root;
            double fromRoot{0.0};  // metres of the disc's way from that root; infinite: none yet, 0: too far to know

            /** \param looksOn else the way is guessed where it is not known yet: each look floods a part of the map */
            double estimate(const Node &node, double noWay, bool looksOn);
        };

        Frontier &frontier(Side side)
        {
            return frontiers_[static_cast<std::size_t>(side)];
        }
        Guides &guides(Side side)
        {
            return guides_[static_cast<std::size_t>(side)];
        }
        const Guides &guides(Side side) const
        {
            return guides_[static_cast<std::size_t>(side)];
        }

        // Search.cpp: turns
        void addRoot(Side side, const Pose &pose);
        void forgetNearest();
        bool load();
        bool isHopeless() const;
        /** The search itself, until it is stopped, has found something or has nothing left. */
        SearchOutcome goOn(std::uint64_t mostExpansions);
        bool chooseSide(Side &side);
        void step(Frontier &own);
        void expand(Frontier &own, std::size_t level, NodeIndex index);
        bool finishExpansion();
        void noteExhaustion(Frontier &own) const;
        void endTurn();
        /** What it costs to get to a successor, but for the obstacles nearby. */
        double costWithoutCloseness(const Frontier &own, const Node &parent, const Successor &successor) const;
        /** What these add to it. */
        double closeness(const Node &parent, const Successor &successor) const;
        /** Keeps a successor, if it is of use. Says no, and does nothing, if the time is up before it is known what it
            costs. */
        bool addSuccessor(Frontier &own, NodeIndex parent, const Successor &successor);
        void close(Frontier &own, NodeIndex index);

        // SearchJoins.cpp: joining the frontiers
        void joinAround(const Frontier &own, NodeIndex index);
        void joinAfar(const Frontier &own, NodeIndex index);
        void joinPair(const Frontier &own, NodeIndex index, NodeIndex partner);
        bool join(NodeIndex fromStart, NodeIndex fromGoal, Side sweptFrom);

        bool outgrowsMemory();

        /** Calls visit(frontier, index) for all nodes that have not been visited yet, and asks after every few whether
            to stop. Says whether none is left. */
        template <class Visit>
        bool visitNodes(Visited &visited, const Visit &visit)
        {
            for (; visited.sides < frontiers_.size(); ++visited.sides, visited.nodes = 0)
                for (Frontier &own = frontiers_[visited.sides]; visited.nodes < own.nodes().size();)
                {
                    visit(own, visited.nodes);
                    if (++visited.nodes % NODES_BETWEEN_STOPS == 0 && stop_ && stop_())
                        return false;
                }
            return true;
        }

        // SearchEstimates.cpp: what nodes are worth
        bool prepare();
        /** Metres that its most confined root can move; of many roots no more are looked at once it is \e enough. */
        double mobility(Frontier &own, double enough);
        void beginGuides(Side side);
        void guideRoundObstacles();
        void aimAtTarget();
        bool isProvenUnreachable();
        void queueAgain(Frontier &own, NodeIndex index);
        bool queueRoots(Frontier &own);
        double estimate(Side side, const Pose &pose);
        double admissible(Side side, const Pose &pose);
        bool mayImprove(Side side, const Node &node);
        /** The same by the least that can lie ahead: no estimate is asked for. */
        bool mayImproveAtBest(Side side, const Node &node) const;
        double weightAt(const Frontier &own, const Node &node) const;
        /** Its priority in the first queue, as it was when it was put there. */
        double priority(const Frontier &own, const Node &node) const;
        bool spreadsOut() const;
        float waitOf(const Frontier &own, const Node &node) const;
        bool hasToGoOnWaiting(const Frontier &own, const Node &node) const;
        void pushToFirst(Frontier &own, std::size_t level, NodeIndex index);
        void push(Frontier &own, std::size_t level, NodeIndex index);
        void unsort(Frontier &own);
        bool sortLists(const StopFunction &stop);
        float estimateOf(Side side, const Pose &pose);
        float rounded(double estimate) const;
        void drop(Side side, double g, const Pose &pose, const Node &keeper);

        /** Length of the shortest motion from a node of that side outwards, obstacles or not. */
        double lengthFrom(Side side, const Pose &node, const Pose &to) const
        {
            return side == Side::Start ? model_->distance(node, to) : model_->distance(to, node);
        }

        // SearchLookahead.cpp: driving on without looking right and left
        void beginLookahead(const Frontier &own, NodeIndex node, std::size_t queue);
        bool finishLookahead();
        NodeIndex nextAhead();
        NodeIndex keepMotions(Frontier &own, NodeIndex from);
        NodeIndex keep(Frontier &own, Node node);

        // SearchDetours.cpp: what is done when the search is stuck
        void noteProgress(const Frontier &own, NodeIndex index);
        static std::size_t detoursOf(const Frontier &own)
        {
            return own.queues() - 1;
        }
        std::size_t detoursTaken() const
        {
            return detoursOf(frontier(confined_));
        }
        bool isOpen(const Node &node) const;
        bool needsDetour() const;
        bool mayExplore() const;
        void takeDetour();
        bool fillDetour();
        void endDetours();
        void pushToDetour(std::size_t detour, std::size_t level, NodeIndex index);
        bool explore();
        void seekProof();
        bool beginProof();
        bool widenEnclosures(std::uint64_t expansions);
        bool refineEnclosure(std::uint64_t expansions);
        double wayAhead(Side side, double x, double y);
        std::size_t bytesOfEnclosures() const;

        /** Which cells are tried to prove that there is no way. */
        enum class ProofStage
        {
            EqualCells,
            RefinedCells,
            Over
        };

        MotionEnvironment *environment_{nullptr};
        SearchParameters parameters_;
        std::unique_ptr<MotionModel> model_;
        std::string modelName_, heuristicName_;
        ModelTraits traits_;
        std::array<Frontier, 2> frontiers_;
        std::array<Guides, 2> guides_;
        Side confined_{Side::Goal};  // the side that is harder to get away from, or the only one that is searched
        Preparation preparation_{Preparation::Guides};
        Visited prepared_;                               // by the stage of the preparation under way
        std::array<std::size_t, 2> listsInOrder_{0, 0};  // of the first queue of each side, the coarsest first
        bool hasLateRoots_{false};                       // that were added after some expansions
        bool joinsAgain_{false};                         // nodes are yet to be joined with such roots
        bool loaded_{false};
        Exhaustion proof_{Exhaustion::None};  // that no way exists
        Exhaustion exhaustion_{Exhaustion::None};
        bool hasTarget_{false};
        Pose target_;
        double nearest_{std::numeric_limits<double>::infinity()};
        double nearestOfDisc_{0.0};  // metres from the target to the nearest place that the inscribed disc reaches
        std::uint64_t nearestSince_{0};
        std::uint64_t sideTurn_{0};
        double bestCost_{std::numeric_limits<double>::infinity()};
        double costBound_{std::numeric_limits<double>::infinity()};
        Path bestPath_;
        bool improved_{false};
        bool boundIsKept_{false};             // weights of at most 1: see lowerBound()
        std::array<double, 2> leastDropped_;  // least g + lower bound of the nodes that were dropped, by side
        StopFunction stop_;                   // also when memory runs out
        bool full_{false};
        std::uint32_t looks_{0};  // at the memory that is left
        double loadingTime_{0.0};
        mutable SearchStatistics statistics_;
        Expansion expansion_;  // of the node under way
        UnderWay underWay_;
        Lookahead ahead_;
        bool turnEnds_{false};                          // what follows an expansion is yet to be done
        std::size_t queueInTurn_{0};                    // 0 also for what is done in no queue's turn
        std::vector<std::unique_ptr<Detour>> detours_;  // of the confined side, for its further queues
        std::uint64_t detoursSince_{0};                 // expansions when the first was taken
        bool fillsDetour_{false};                       // what is open is yet to be put into the last one's queue
        Visited filled_;                                // by that
        Side explored_{Side::Goal};                     // the frontier that was explored last
        std::vector<Successor> motions_;                // towards a pose, one after the other
        ProofStage proofStage_{ProofStage::EqualCells};
        std::vector<Enclosure> enclosures_;  // of the starts and of the goals; none before the first is needed
        std::unique_ptr<RefinedEnclosure> refined_;
        std::unique_ptr<BodyCells> bodyCells_;
        // Estimate of the node with which the confined side came nearer last, and turns of that side up to then.
        double progressEstimate_{std::numeric_limits<double>::infinity()};
        std::uint64_t progressAt_{0};
    };
}  // namespace parking::search

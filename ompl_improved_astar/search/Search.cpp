#include "ompl_improved_astar/search/Search.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace parking::search
{
    namespace
    {
        constexpr double INFINITE = std::numeric_limits<double>::infinity();
        constexpr double ROUNDING = 1e-9;  // metres of cost: nodes and entries that differ by less are equal
    }                                      // namespace

    Search::Search() : frontiers_{Frontier(Side::Start), Frontier(Side::Goal)}, leastDropped_{INFINITE, INFINITE}
    {
    }

    void Search::begin(MotionEnvironment &environment, const SearchParameters &parameters)
    {
        environment_ = &environment;
        parameters_ = parameters;
        parameters_.cost.fullLockCurvature = 1.0 / parameters.turningRadius;
        parameters_.bodyRadius = std::max(parameters.bodyRadius, parameters.inscribedRadius);
        // Made anew only when they are others: models and heuristics keep their memory.
        if (!model_ || modelName_ != parameters.motionModel)
            model_ = motionModels().make(parameters.motionModel);
        modelName_ = parameters.motionModel;
        model_->begin(environment, parameters_);
        traits_ = model_->traits();
        if (!traits_.prefersClearance || !environment.knowsClearance())
            parameters_.cost.preferredClearance = 0.0;
        if (!environment.knowsClearance())
            parameters_.cost.clearanceWeight = 0.0;
        const std::string heuristic = parameters.heuristic == "default" ? model_->heuristic() : parameters.heuristic;
        for (Guides &guides : guides_)
        {
            if (!guides.base || heuristicName_ != heuristic)
                guides.base = heuristics().make(heuristic);
            guides.roundObstacles = false;
        }
        heuristicName_ = heuristic;
        const SearchTuning &tuning = parameters.tuning;
        for (Frontier &each : frontiers_)
        {
            each.begin(parameters.openList, traits_.levels, tuning.turnsRatio);
            each.crowds.begin(tuning.crowdedPlace * parameters.turningRadius, tuning.crowdSectors);
        }
        listsInOrder_ = {traits_.levels, traits_.levels};
        boundIsKept_ = parameters.weights.far <= 1.0 && parameters.weights.near <= 1.0;
        leastDropped_ = {INFINITE, INFINITE};
        hasLateRoots_ = joinsAgain_ = false;
        confined_ = Side::Goal;
        preparation_ = Preparation::Guides;
        loaded_ = false;
        proof_ = Exhaustion::None;
        exhaustion_ = Exhaustion::None;
        hasTarget_ = false;
        sideTurn_ = 0;
        bestCost_ = costBound_ = INFINITE;
        bestPath_ = {};
        improved_ = false;
        underWay_.node = NO_NODE;
        ahead_.node = NO_NODE;
        queueInTurn_ = 0;
        turnEnds_ = false;
        full_ = false;
        looks_ = 0;
        loadingTime_ = 0.0;
        statistics_ = {};
        forgetNearest();
        endDetours();
    }

    void Search::addRoot(Side side, const Pose &pose)
    {
        forgetNearest();
        const NodeIndex index = frontier(side).addRoot(pose);
        model_->addRoot(side, pose);
        // The other side's estimates now have one more target; what had been computed no longer holds.
        preparation_ = Preparation::Guides;
        ahead_.node = NO_NODE;
        hasLateRoots_ = joinsAgain_ = statistics_.expanded > 0;
        if (!traits_.joinsAfar)
            return;
        for (const NodeIndex other : frontier(opposite(side)).roots())
            side == Side::Start ? join(index, other, Side::Goal) : join(other, index, Side::Goal);
    }

    void Search::setTarget(const Pose &target)
    {
        if (!hasTarget_ || positionDistance(target, target_) > 0.0)
            forgetNearest();
        hasTarget_ = true;
        target_ = target;
        preparation_ = Preparation::Guides;
    }

    void Search::forgetNearest()
    {
        nearest_ = INFINITE;
        nearestOfDisc_ = 0.0;
        nearestSince_ = statistics_.expanded;
    }

    bool Search::load()
    {
        const auto begin = std::chrono::steady_clock::now();
        loaded_ = model_->load(stop_);
        loadingTime_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        return loaded_;
    }

    bool Search::isHopeless() const
    {
        const SearchTuning &tuning = parameters_.tuning;
        if (proof_ != Exhaustion::None)
            return true;
        if (hasTarget_)
        {
            const bool isNearEnough = nearest_ <= nearestOfDisc_ + tuning.nearEnough * parameters_.turningRadius;
            const std::uint64_t patience = isNearEnough ? tuning.patienceWhenNear : tuning.patience + nearestSince_ / 2;
            return nearest_ <= tuning.leastProgress ||
                   (!traits_.complete && statistics_.expanded > nearestSince_ + patience);
        }
        if (hasSolution() || !parameters_.bidirectional || traits_.complete)
            return false;
        // With one side seen completely, the other gets as many expansions again: its joins may still reach a root that
        // this lattice cannot leave.
        for (const Frontier &each : frontiers_)
            if (each.isExhausted() && !each.roots().empty())
                return statistics_.expanded > 2 * each.expansionsWhenExhausted + tuning.patience;
        return false;
    }

    bool Search::chooseSide(Side &side)
    {
        const bool startIsEmpty = frontier(Side::Start).isExhausted(), goalIsEmpty = frontier(Side::Goal).isExhausted();
        if (!parameters_.bidirectional)
        {
            side = confined_;
            return !frontier(confined_).isExhausted();
        }
        if (startIsEmpty && goalIsEmpty)
            return false;
        if (traits_.complete && (startIsEmpty || goalIsEmpty))
        {
            // The side that has run dry has seen everything it can reach: the other cannot be there. The start's side
            // is searched to its end all the same, for the place nearest to the goal.
            side = Side::Start;
            return !startIsEmpty;
        }
        side = ++sideTurn_ % traits_.otherSidePeriod == 0 ? opposite(confined_) : confined_;
        if (frontier(side).isExhausted())
            side = opposite(side);
        return true;
    }

    SearchOutcome Search::run(const StopFunction &stop, std::uint64_t mostExpansions)
    {
        stop_ = [this, stop]
        {
            return outgrowsMemory() || (stop && stop());
        };
        const SearchOutcome outcome = goOn(mostExpansions);
        // What is asked between two calls is answered from what is known: whom stop asks may be gone by then.
        stop_ = []
        {
            return true;
        };
        return outcome;
    }

    SearchOutcome Search::goOn(std::uint64_t mostExpansions)
    {
        exhaustion_ = Exhaustion::None;
        for (;;)
        {
            // Also what adding a root has found.
            if (improved_)
            {
                improved_ = false;
                endDetours();
                return SearchOutcome::Improved;
            }
            if (parameters_.eagerObstacles && !loaded_ && !load())
                return SearchOutcome::Stopped;
            if (!sortLists(stop_) || !finishExpansion() || !finishLookahead() || expanded() >= mostExpansions ||
                (stop_ && stop_()))
                return SearchOutcome::Stopped;
            endTurn();
            if (!prepare() || !fillDetour())
                return SearchOutcome::Stopped;
            Side side = confined_;
            if (isHopeless() || !chooseSide(side))
            {
                exhaustion_ = proof_ != Exhaustion::None ? proof_
                              : hasTarget_               ? Exhaustion::NoProgress
                                                         : Exhaustion::SearchedOut;
                return SearchOutcome::Exhausted;
            }
            if (!mayExplore() || !explore())
                step(frontier(side));
        }
    }

    void Search::endTurn()
    {
        queueInTurn_ = 0;
        if (!std::exchange(turnEnds_, false) || preparation_ != Preparation::Done)
            return;
        if (needsDetour())
            takeDetour();
        seekProof();
    }

    void Search::close(Frontier &own, NodeIndex index)
    {
        const Node &node = own.node(index);
        noteProgress(own, index);
        // Models that aim do so at the closed node of least cost (paper, "Bidirectional Search"), the others are joined
        // with the one that has come farthest.
        const double cost = traits_.aims ? priority(own, node) : 0.0;
        if (own.bestClosed != NO_NODE)
        {
            const Node &best = own.node(own.bestClosed);
            const bool isBetter =
                traits_.aims && cost != own.bestClosedCost ? cost < own.bestClosedCost : node.h < best.h;
            if (!isBetter)
                return;
        }
        own.bestClosed = index;
        own.bestClosedCost = cost;
        if (traits_.aims)
        {
            frontier(opposite(own.side())).aim = node.pose;
            guides(opposite(own.side())).base->aim(node.pose);
        }
    }

    void Search::step(Frontier &own)
    {
        const std::size_t queue = queueInTurn_ = own.chooseQueue();
        const std::size_t level = own.chooseLevel(queue);
        const OpenList::Entry entry = own.pop(queue, level);
        const Node &node = own.node(entry.node);
        // Stale: the node has become cheaper since, or was expanded at this level already, or cannot help any more.
        if (node.next != level || !mayImprove(own.side(), node) ||
            (queue == 0 && entry.f > priority(own, node) + ROUNDING))
        {
            noteExhaustion(own);
            return;
        }
        if (queue == 0 && hasToGoOnWaiting(own, node))
        {
            pushToFirst(own, level, entry.node);
            return;
        }
        own.countTurn(queue, level);
        if (own.queues() > 1)
            own.noteEstimate(queue, entry.h, parameters_.tuning.extraTurns);
        expand(own, level, entry.node);
    }

    void Search::expand(Frontier &own, std::size_t level, NodeIndex index)
    {
        turnEnds_ = true;
        const bool first = !own.node(index).isExpanded();
        own.node(index).next = static_cast<std::uint8_t>(level + 1);
        if (first)
            close(own, index);
        if (first && !traits_.joinsAfar)
        {
            joinAround(own, index);
            // For the bound the node has to be expanded all the same: it is in no list any more.
            if (improved_ && !boundIsKept_)
                return;
        }
        ++statistics_.expanded;
        if (spreadsOut())
            own.crowds.add(own.node(index).pose);
        if (detoursTaken() > 0)
            own.exploration.noteExpansion(own.node(index).pose, index);
        expansion_.successors.clear();
        expansion_.mobility = 0.0;
        model_->expand(own.side(), index, own.node(index), level, first, expansion_);
        if (first)
            own.node(index).mobility = static_cast<float>(expansion_.mobility);
        underWay_ = {own.side(), index, level, first, 0, environment_->wasInterrupted()};
        if (first)
            beginLookahead(own, index, queueInTurn_);
        if (finishExpansion())
            finishLookahead();
    }

    bool Search::finishExpansion()
    {
        if (underWay_.node == NO_NODE)
            return true;
        Frontier &own = frontier(underWay_.side);
        for (; underWay_.next < expansion_.successors.size(); ++underWay_.next)
        {
            if (underWay_.next > 0 && traits_.asksMotionByMotion && stop_ && stop_())
                return false;
            if (!addSuccessor(own, underWay_.node, expansion_.successors[underWay_.next]))
                return false;
            ++statistics_.generated;
        }
        const NodeIndex index = std::exchange(underWay_.node, NO_NODE);
        if (underWay_.first && traits_.joinsAfar)
            joinAround(own, index);
        if (underWay_.first && (underWay_.isCutShort || environment_->wasInterrupted()))
        {
            // Its motions hang on it already.
            own.node(index).fixed = true;
            own.node(index).next = own.node(index).level;
            push(own, underWay_.level, index);
            ahead_.node = NO_NODE;
            return true;
        }
        if (parameters_.adaptiveResolution && underWay_.level + 1 < traits_.levels)
            push(own, underWay_.level + 1, index);
        noteExhaustion(own);
        return true;
    }

    void Search::noteExhaustion(Frontier &own) const
    {
        if (own.isExhausted())
            own.expansionsWhenExhausted = statistics_.expanded;
    }

    double Search::costWithoutCloseness(const Frontier &own, const Node &parent, const Successor &successor) const
    {
        const PathPiece drive = successor.motion.drive();
        const double joined = parent.parent != NO_NODE ? parameters_.cost.join(parent.motion.drive(), drive) : 0.0;
        // On the goal's side the car will drive the motion the other way.
        return parent.g + parameters_.cost.drive(own.side() == Side::Start ? drive : drive.reversed()) + joined;
    }

    double Search::closeness(const Node &parent, const Successor &successor) const
    {
        if (!parameters_.cost.pricesCloseness())
            return 0.0;
        return parameters_.cost.closeness(parent.pose, successor.motion.drive(), *environment_, successor.clear);
    }

    bool Search::addSuccessor(Frontier &own, NodeIndex parentIndex, const Successor &successor)
    {
        Node node;
        node.cusps = cuspsThrough(own.node(parentIndex), successor.motion);
        if (node.cusps > parameters_.mostCusps)
            return true;
        node.pose = successor.pose;
        node.motion = successor.motion;
        node.parent = parentIndex;
        node.farthest = successor.farthest;
        node.g = costWithoutCloseness(own, own.node(parentIndex), successor);
        // Once a cost is known about half of what is generated is of no use: what takes least time is asked first.
        const bool isBounded = costBound_ < INFINITE, isEstimated = isBounded && parameters_.cost.pricesCloseness();
        if (isBounded && !mayImproveAtBest(own.side(), node))
            return true;
        if (isEstimated)
        {
            node.h = estimateOf(own.side(), node.pose);
            if (!mayImprove(own.side(), node))
                return true;
        }
        node.g += closeness(own.node(parentIndex), successor);
        if (parameters_.cost.pricesCloseness() && environment_->wasInterrupted())
            return false;
        const double g = node.g;
        if (g >= costBound_)
            return true;

        for (std::size_t level = 0; level < traits_.levels; ++level)
        {
            const std::uint64_t cell = model_->cell(node.pose, level);
            const NodeIndex holder = own.holderOf(cell, level);
            NodeIndex replaced = NO_NODE;
            if (holder != NO_NODE)
            {
                const Node &other = own.node(holder);
                if (other.g > g + ROUNDING && other.level == level && !other.isExpanded() && !other.fixed)
                    replaced = holder;  // not yet expanded: simply replaced by the cheaper one
                else if (!(other.g > g + model_->worthKeeping(level)))
                {
                    if (parameters_.adaptiveResolution && level + 1 < traits_.levels)
                        continue;
                    drop(own.side(), g, node.pose, other);
                    return true;
                }
            }
            if (!model_->isFree(own.side(), own.node(parentIndex), successor))
                return true;
            if (!isEstimated)
                node.h = estimateOf(own.side(), node.pose);
            if (!mayImprove(own.side(), node))
                return true;
            node.level = node.next = static_cast<std::uint8_t>(level);
            if (hasTarget_ && node.h < nearest_ - parameters_.tuning.leastProgress)
            {
                nearest_ = node.h;
                nearestSince_ = statistics_.expanded;
            }
            if (replaced != NO_NODE)
                drop(own.side(), own.node(replaced).g, own.node(replaced).pose, node);
            push(own, level, own.place(node, replaced, cell));
            return true;
        }
        return true;
    }

    std::size_t Search::memory() const
    {
        std::size_t bytes = model_ ? model_->bytes() : 0;
        for (const Frontier &each : frontiers_)
            bytes += each.bytes();
        for (const Guides &guides : guides_)
            if (guides.roundObstacles)
                bytes += guides.obstacles.bytes();
        for (std::size_t i = 0; i < detoursTaken(); ++i)
            bytes += detours_[i]->way.bytes();
        return bytes + bytesOfEnclosures();
    }

    bool Search::outgrowsMemory()
    {
        constexpr std::uint32_t LOOK_EVERY = 64;
        if (!full_ && ++looks_ % LOOK_EVERY == 0)
            full_ = memory() > parameters_.maxMemory;
        return full_;
    }

    const SearchStatistics &Search::statistics() const
    {
        statistics_.heuristicCells = 0;
        for (const Guides &guides : guides_)
            if (guides.roundObstacles)
                statistics_.heuristicCells += guides.obstacles.cells();
        statistics_.openListOperations = statistics_.openListComparisons = 0;
        for (const Frontier &each : frontiers_)
        {
            const OpenList::Work work = each.work();
            statistics_.openListOperations += work.operations;
            statistics_.openListComparisons += work.comparisons;
        }
        return statistics_;
    }
}  // namespace parking::search

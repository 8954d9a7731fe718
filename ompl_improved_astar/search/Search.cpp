#include "ompl_improved_astar/search/Search.h"

#include "ompl_improved_astar/search/Tuning.h"

#include <chrono>
#include <cmath>
#include <iterator>
#include <utility>

namespace parking::search
{
    namespace
    {
        constexpr double ROUNDING = 1e-9;      // metres of cost: nodes and entries that differ by less are equal
        constexpr double MIN_APPROACH = 1e-3;  // metres: nearer to a target by less is no progress

        using Clock = std::chrono::steady_clock;

        double secondsSince(Clock::time_point begin)
        {
            return std::chrono::duration<double>(Clock::now() - begin).count();
        }
    }  // namespace

    // Beginning

    void Search::begin(MotionEnvironment &environment, const PlannerParameters &parameters, const CarInSpace &car)
    {
        // Parts are made again only when they are others: models and heuristics keep their memory.
        if (!model_ || query_->parameters.motionModel != parameters.motionModel)
            model_ = motionModels().make(parameters.motionModel);
        traits_ = model_->traits();
        const std::string heuristic = parameters.heuristic == "default" ? model_->heuristic() : parameters.heuristic;
        for (Guide &guide : guides_)
            if (!guide.heuristic || guide.name != heuristic)
            {
                guide.heuristic = heuristics().make(heuristic);
                guide.name = heuristic;
            }
        query_.emplace(SearchContext{environment, parameters, car, {}});
        query_->car.bodyRadius = std::max(car.bodyRadius, car.inscribedRadius);
        query_->cost = costModel(parameters, car.turningRadius);
        if (!traits_.drivesCurves || !environment.knowsClearance())
            query_->cost.preferredClearance = query_->cost.clearanceCost = 0.0;
        model_->begin(*query_);
        traits_ = model_->traits();
        weights_ = parameters.weights();
        memory_ = {std::size_t{parameters.maxMemoryMb} << 20};
        target_.reset();
        best_ = {};
        costBound_ = HUGE_VAL;
        isImproved_ = false;
        turns_ = 0;
        statistics_ = {};
        exhaustion_ = Exhaustion::None;
        restart({}, {});
    }

    /** Forgets nodes, queues and proofs, and begins with these roots. */
    void Search::restart(const std::vector<Pose> &starts, const std::vector<Pose> &goals)
    {
        for (Frontier &each : frontiers_)
        {
            each.begin(query_->parameters.openList, traits_.levels);
            each.density.begin(tuning::DENSITY_CELL * query_->car.turningRadius);
            for (const Pose &root : each.side() == Side::Start ? starts : goals)
                each.addRoot(root);
        }
        confined_ = Side::Goal;
        isPrepared_ = false;
        isSorted_ = true;
        proof_ = Exhaustion::None;
        endDetours();
    }

    void Search::addRoot(Side side, const Pose &pose)
    {
        if (isPrepared_)
            restart(frontier(Side::Start).rootPoses(),
                    frontier(Side::Goal).rootPoses());  // estimates now have one more target
        const NodeIndex index = frontier(side).addRoot(pose);
        model_->addRoot(side, pose);
        if (traits_.drivesCurves)
            for (const NodeIndex other : frontier(opposite(side)).roots())
                join(frontier(side), index, other);
    }

    bool Search::prepare()
    {
        if (isPrepared_)
            return true;
        const bool isEager = query_->parameters.obstacleLoading == "eager";
        const auto loading = Clock::now();
        const bool isLoaded = !isEager || model_->load(stop_);
        statistics_.loadingTime += isEager ? secondsSince(loading) : 0.0;
        if (!isLoaded)
            return false;
        confined_ = confinedSide();
        if (target_)
            progress_ = {HUGE_VAL, expanded()};
        for (const Side side : {Side::Start, Side::Goal})
        {
            Guide &own = guide(side);
            own.targets = frontier(opposite(side)).rootPoses();
            own.hasRoute = false;
            own.heuristic->begin(*query_, side, own.targets);
        }
        if (target_)
            guideToTarget();
        else if (!guide(confined_).targets.empty())
            // Only for the side that gets most of the turns: flooding the map from the other end, too, would cost more
            // than it spares.
            beginRoute(confined_, frontier(confined_).rootPoses());
        proof_ = isProvenUnreachable() ? Exhaustion::WalledIn : Exhaustion::None;
        constexpr std::size_t ROOTS_BETWEEN_STOPS = 32;
        for (Frontier &each : frontiers_)
            for (std::size_t i = 0; i < each.roots().size(); ++i)
            {
                if (i % ROOTS_BETWEEN_STOPS == ROOTS_BETWEEN_STOPS - 1 && isStopped())
                    return false;
                Node &root = each.node(each.roots()[i]);
                root.h = rounded(estimate(each.side(), root.pose));
            }
        if (isStopped())
            return false;  // what has been estimated may be wrong for want of time
        for (Frontier &each : frontiers_)
            for (const NodeIndex root : each.roots())
            {
                const Node node = each.node(root);
                each.place(node, root, model_->cell(node.pose, 0));
                push(each, 0, root);
            }
        return isPrepared_ = true;
    }

    /** The more confined side is the harder one to get away from. When there is little in it that is the goal's. */
    Side Search::confinedSide()
    {
        if (!query_->parameters.bidirectional)
            return query_->parameters.searchFrom == "goal" && !frontier(Side::Goal).roots().empty() ? Side::Goal
                                                                                                    : Side::Start;
        if (!traits_.drivesCurves)
            return Side::Start;
        double ofStarts = HUGE_VAL;
        for (const Pose &start : frontier(Side::Start).rootPoses())
            ofStarts = std::min(ofStarts, model_->mobility(start));
        for (const Pose &goal : frontier(Side::Goal).rootPoses())
            if (model_->mobility(goal) <= ofStarts + model_->mobilitySlack())
                return Side::Goal;
        return Side::Start;
    }

    void Search::beginRoute(Side side, const std::vector<Pose> &roots)
    {
        if (!query_->parameters.obstacleHeuristic || !traits_.drivesCurves)
            return;
        Guide &own = guide(side);
        own.route.begin(query_->environment,
                        routeResolution(query_->car.turningRadius, query_->car.bodyRadius, roots, own.targets),
                        {query_->car.inscribedRadius, 0.0, 1.0}, {roots.front().x, roots.front().y}, stop_,
                        tuning::MAX_ROUTE_CELLS);
        for (const Pose &target : own.targets)
            own.route.addTarget(target.x, target.y);
        own.hasRoute = true;
        if (query_->parameters.obstacleLoading != "eager")
            return;
        const auto loading = Clock::now();
        own.route.load(query_->car.bounds);
        statistics_.loadingTime += secondsSince(loading);
    }

    void Search::guideToTarget()
    {
        target_->nearestOfDisc = 0.0;
        const std::vector<Pose> starts = frontier(Side::Start).rootPoses();
        if (starts.empty() || !query_->parameters.obstacleHeuristic || !traits_.drivesCurves)
            return;
        // Flooding from the starts finds the place to drive to; the route there is then counted from that place.
        guide(Side::Goal).targets = starts;
        beginRoute(Side::Goal, {target_->pose});
        const Eigen::Vector2d place = guide(Side::Goal).route.nearestReachable({target_->pose.x, target_->pose.y});
        target_->nearestOfDisc = std::hypot(place.x() - target_->pose.x, place.y() - target_->pose.y);
        guide(Side::Start).targets.assign(1, {place.x(), place.y(), 0.0});
        beginRoute(Side::Start, starts);
    }

    /** Does a disc inside of the car find no route round the obstacles? Neither will the car. */
    bool Search::isProvenUnreachable()
    {
        Guide &own = guide(confined_);
        const std::vector<Pose> roots = frontier(confined_).rootPoses();
        return own.hasRoute && !target_ && !roots.empty() &&
               std::all_of(roots.begin(), roots.end(),
                           [&](const Pose &root) { return own.route.provesUnreachable(root) && !isStopped(); });
    }

    // Choosing

    SearchOutcome Search::run(const StopFunction &stop, std::uint64_t maxExpansions)
    {
        stop_ = [this, stop]
        {
            return outgrowsMemory() || (stop && stop());
        };
        const SearchOutcome outcome = search(maxExpansions);
        // Questions between two calls are answered from what is known: stop may refer to what is gone by then.
        stop_ = []
        {
            return true;
        };
        return outcome;
    }

    SearchOutcome Search::search(std::uint64_t maxExpansions)
    {
        exhaustion_ = Exhaustion::None;
        for (;;)
        {
            if (std::exchange(isImproved_, false))
            {
                endDetours();
                return SearchOutcome::Improved;
            }
            if (expanded() >= maxExpansions || isStopped() || !prepare() || !sortLists())
                return SearchOutcome::Stopped;
            Side side = confined_;
            if (isHopeless() || !chooseSide(side))
            {
                exhaustion_ = proof_ != Exhaustion::None ? proof_
                              : target_                  ? Exhaustion::NoProgress
                                                         : Exhaustion::SearchedOut;
                return SearchOutcome::Exhausted;
            }
            step(frontier(side));
        }
    }

    bool Search::isHopeless() const
    {
        if (proof_ != Exhaustion::None)
            return true;
        if (target_)
        {
            const bool isNear =
                progress_.nearest <= target_->nearestOfDisc + tuning::NEAR_TARGET * query_->car.turningRadius;
            const std::uint64_t limit = isNear ? tuning::STALL_LIMIT_NEAR : tuning::STALL_LIMIT + progress_.since / 2;
            return progress_.nearest <= MIN_APPROACH || (!traits_.isComplete && expanded() > progress_.since + limit);
        }
        if (best_.cost < HUGE_VAL || !query_->parameters.bidirectional || traits_.isComplete)
            return false;
        // With one side seen completely, the other gets as many expansions again: its joins may still reach a root that
        // this lattice cannot leave.
        return std::any_of(frontiers_.begin(), frontiers_.end(),
                           [&](const Frontier &each)
                           {
                               return each.isExhausted() && !each.roots().empty() &&
                                      expanded() > 2 * each.expansionsWhenExhausted + tuning::STALL_LIMIT;
                           });
    }

    bool Search::chooseSide(Side &side)
    {
        const bool startIsEmpty = frontier(Side::Start).isExhausted(), goalIsEmpty = frontier(Side::Goal).isExhausted();
        side = confined_;
        if (!query_->parameters.bidirectional)
            return !frontier(side).isExhausted();
        if (startIsEmpty && goalIsEmpty)
            return false;
        if (traits_.isComplete && (startIsEmpty || goalIsEmpty))
        {
            // The side that has run dry has seen everything it can reach: the other cannot be there. The start's side
            // is searched to its end all the same, for the place nearest to the goal.
            side = Side::Start;
            return !startIsEmpty;
        }
        if (++turns_ % traits_.otherSidePeriod == 0)
            side = opposite(side);
        if (frontier(side).isExhausted())
            side = opposite(side);
        return true;
    }

    void Search::step(Frontier &own)
    {
        const std::size_t queue = own.chooseQueue(), level = own.chooseLevel(queue);
        const OpenList::Entry entry = own.pop(queue, level);
        const Node &node = own.node(entry.node);
        // Stale: the node has become cheaper since, or was expanded at this level already, or cannot help any more.
        const bool isStale = node.next != level || !mayImprove(own.side(), node) ||
                             (queue == 0 && entry.f > priority(own, node) + ROUNDING);
        if (!isStale && queue == 0 && isDeferred(own, node))
            pushFirst(own, level, entry.node);
        else if (!isStale)
        {
            own.countTurn(queue, level);
            expand(own, queue, level, entry.node);
            endTurn();
        }
        if (own.isExhausted() && own.expansionsWhenExhausted == 0)
            own.expansionsWhenExhausted = expanded();
    }

    bool Search::outgrowsMemory()
    {
        constexpr std::uint64_t LOOK_EVERY = 64;
        if (!memory_.isFull && ++memory_.looks % LOOK_EVERY == 0)
            memory_.isFull = memory() > memory_.max;
        return memory_.isFull;
    }

    std::size_t Search::memory() const
    {
        std::size_t bytes = model_ ? model_->bytes() : 0;
        for (const Frontier &each : frontiers_)
            bytes += each.bytes();
        for (const Guide &guide : guides_)
            bytes += guide.hasRoute ? guide.route.bytes() : 0;
        for (std::size_t i = 0; i < detourCount(); ++i)
            bytes += detours_[i]->route.bytes();
        return bytes + enclosure_.bytes();
    }

    // Expanding

    void Search::expand(Frontier &own, std::size_t queue, std::size_t level, NodeIndex index)
    {
        const bool isFirst = !own.node(index).isExpanded();
        own.node(index).next = static_cast<std::uint8_t>(level + 1);
        if (isFirst)
            close(own, index, queue);
        if (isFirst && !traits_.drivesCurves)
        {
            joinAround(own, index);
            if (isImproved_)
                return;
        }
        ++statistics_.expanded;
        own.density.add(own.node(index).pose);
        successors_.clear();
        model_->expand(own.side(), index, own.node(index), level, isFirst, successors_);
        const bool isComplete = addSuccessors(own, index);
        if (isFirst && isComplete && traits_.drivesCurves)
            joinAround(own, index);
        if (!isComplete || query_->environment.wasInterrupted())
        {
            // Expanded again when there is time: what hangs on it already must stay.
            own.node(index).fixed = true;
            own.node(index).next = static_cast<std::uint8_t>(level);
            push(own, level, index, queue);
            return;
        }
        if (query_->parameters.adaptiveResolution && level + 1 < traits_.levels)
            push(own, level + 1, index, queue);
        if (isFirst)
            lookAhead(own, index, queue);
    }

    /** Says no if the time is up before all of them have been tried. */
    bool Search::addSuccessors(Frontier &own, NodeIndex index)
    {
        for (std::size_t i = 0; i < successors_.size(); ++i)
        {
            // Models that are asked whether a motion is free may take long to answer.
            if (i > 0 && traits_.isComplete && isStopped())
                return false;
            addSuccessor(own, index, successors_[i]);
            ++statistics_.generated;
        }
        return true;
    }

    double Search::costTo(const Frontier &own, const Node &parent, const Successor &successor)
    {
        const PathPiece drive = successor.motion.drive();
        // On the goal's side the car will drive the motion the other way.
        return parent.g + query_->cost.drive(own.side() == Side::Start ? drive : drive.reversed()) +
               (parent.parent != NO_NODE ? query_->cost.join(parent.motion.drive(), drive) : 0.0) +
               query_->cost.proximity(parent.pose, drive, query_->environment, successor.clear);
    }

    void Search::addSuccessor(Frontier &own, NodeIndex parentIndex, const Successor &successor)
    {
        Node node;
        node.cusps = cuspsThrough(own.node(parentIndex), successor.motion);
        if (node.cusps > query_->car.maxCusps)
            return;
        node.pose = successor.pose;
        node.motion = successor.motion;
        node.parent = parentIndex;
        node.farthest = successor.farthest;
        node.g = costTo(own, own.node(parentIndex), successor);
        if (node.g >= costBound_)
            return;
        for (std::size_t level = 0; level < traits_.levels; ++level)
        {
            const std::uint64_t cell = model_->cell(node.pose, level);
            const NodeIndex holder = own.holderOf(cell, level);
            NodeIndex replaced = NO_NODE;
            if (holder != NO_NODE)
            {
                const Node &other = own.node(holder);
                const bool isReplaceable = other.level == level && !other.isExpanded() && !other.fixed;
                if (isReplaceable && other.g > node.g + ROUNDING)
                    replaced = holder;
                else if (query_->parameters.adaptiveResolution)
                    continue;
                else
                    return;
            }
            if (!model_->isFree(own.side(), own.node(parentIndex), successor))
                return;
            node.h = rounded(estimate(own.side(), node.pose));
            if (!mayImprove(own.side(), node))
                return;
            node.level = node.next = static_cast<std::uint8_t>(level);
            if (target_ && node.h < progress_.nearest - MIN_APPROACH)
                progress_ = {node.h, expanded()};
            push(own, level, own.place(node, replaced, cell));
            return;
        }
    }

    void Search::close(Frontier &own, NodeIndex index, std::size_t queue)
    {
        const Node &node = own.node(index);
        if (own.side() == confined_ && !target_)
        {
            if (node.h < progress_.nearest)
                progress_ = {node.h, own.turns()};
            for (std::size_t i = 0; i < detourCount(); ++i)
                if (const double ahead = detours_[i]->estimate(node, queue == i + 1); ahead < detours_[i]->nearest)
                {
                    detours_[i]->nearest = ahead;
                    detours_[i]->best = index;
                }
        }
        // Models that aim do so at the closed node of least cost (paper, "Bidirectional Search"), the others are joined
        // with the one that has come farthest.
        const double cost = traits_.aims ? priority(own, node) : 0.0;
        if (own.bestClosed != NO_NODE)
        {
            const bool isBetter = traits_.aims && cost != own.bestClosedCost ? cost < own.bestClosedCost
                                                                             : node.h < own.node(own.bestClosed).h;
            if (!isBetter)
                return;
        }
        own.bestClosed = index;
        own.bestClosedCost = cost;
        if (traits_.aims)
            guide(opposite(own.side())).heuristic->aim(node.pose);
    }

    /** Drives on along the route from what has just come farthest along it, without an expansion for each step. */
    void Search::lookAhead(Frontier &own, NodeIndex index, std::size_t queue)
    {
        const bool isFarthest = index == (queue == 0 ? own.bestClosed : detours_[queue - 1]->best);
        if (!query_->parameters.detours || own.side() != confined_ || !guide(confined_).hasRoute || target_ ||
            best_.cost < HUGE_VAL || isAdmissible() || !isFarthest)
            return;
        RouteHeuristic &route = queue == 0 ? guide(confined_).route : detours_[queue - 1]->route;
        while (index != NO_NODE && !isStopped() && !query_->environment.wasInterrupted())
            index = driveAlong(own, index, route);
    }

    /** The end of one more curve along the route; NO_NODE when there is none. */
    NodeIndex Search::driveAlong(Frontier &own, NodeIndex index, RouteHeuristic &route)
    {
        const double radius = query_->car.turningRadius;
        const Pose from = own.node(index).pose;
        const std::optional<Pose> place =
            route.placeOnRoute(from.x, from.y, tuning::LOOKAHEAD * radius, tuning::LOOKAHEAD_HEADING * radius);
        if (!place)
            return NO_NODE;
        Pose to = *place;
        const bool inReverse = std::cos(from.yaw) * (to.x - from.x) + std::sin(from.yaw) * (to.y - from.y) < 0.0;
        if (inReverse)
            to.yaw = wrapAngle(to.yaw + PI);
        // Where the heading is too far off, the curve turns round: not without looking.
        const double length = own.side() == Side::Start ? model_->distance(from, to) : model_->distance(to, from);
        if (length > tuning::MAX_LOOKAHEAD_RATIO * positionDistance(from, to))
            return NO_NODE;
        std::vector<Successor> motions;
        model_->moveTowards(own.side(), from, to, motions);
        const bool hasCusp =
            std::any_of(motions.begin(), motions.end(),
                        [&](const Successor &each) { return (each.motion.length < 0.0) != inReverse; });
        // Where obstacles are near, driving up to them is no better than anything else. Pieces too short to be driven
        // are left out.
        if (motions.empty() || hasCusp || positionDistance(motions.back().pose, to) > 3.0 * tuning::MIN_MOTION * radius)
            return NO_NODE;
        for (const Successor &successor : motions)
        {
            Node node;
            node.pose = successor.pose;
            node.g = costTo(own, own.node(index), successor);
            node.motion = successor.motion;
            node.parent = index;
            node.farthest = node.fixed = true;
            node.cusps = cuspsThrough(own.node(index), successor.motion);
            if (node.cusps > query_->car.maxCusps || query_->environment.wasInterrupted())
                return NO_NODE;
            node.h = rounded(estimate(own.side(), node.pose));
            // Only cells that are empty are left from: else a search without a path would never end.
            const std::size_t levels = query_->parameters.adaptiveResolution ? traits_.levels : 1;
            std::size_t level = 0;
            while (level < levels && own.holderOf(model_->cell(node.pose, level), level) != NO_NODE)
                ++level;
            node.level = node.next = static_cast<std::uint8_t>(level < levels ? level : traits_.levels);
            index = level < levels ? own.place(node, NO_NODE, model_->cell(node.pose, level)) : own.append(node);
            if (level < levels)
                push(own, level, index);
        }
        return index;
    }

    // Joining

    void Search::joinAround(const Frontier &own, NodeIndex index)
    {
        const Frontier &other = frontier(opposite(own.side()));
        if (!traits_.drivesCurves)
        {
            // The other side's node must be closed, too; a root that never moved counts as such.
            const NodeIndex partner = other.holderOf(model_->cell(own.node(index).pose, 0), 0);
            if (partner != NO_NODE && (other.node(partner).isExpanded() || other.node(partner).parent == NO_NODE))
                join(own, index, partner);
            return;
        }
        for (const NodeIndex root : other.roots())
            join(own, index, root);
        if (query_->parameters.bidirectional && other.bestClosed != NO_NODE &&
            other.node(other.bestClosed).parent != NO_NODE)
            join(own, index, other.bestClosed);
    }

    /** Joins a node with one of the other side. Swept from the own side's node, where a collision is more likely. */
    void Search::join(const Frontier &own, NodeIndex index, NodeIndex partner)
    {
        const NodeIndex fromStart = own.side() == Side::Start ? index : partner,
                        fromGoal = own.side() == Side::Start ? partner : index;
        const Node &a = frontier(Side::Start).node(fromStart), &b = frontier(Side::Goal).node(fromGoal);
        if (a.g + b.g >= costBound_ || (traits_.drivesCurves && !query_->parameters.analyticExpansion))
            return;
        ++statistics_.connections;
        model_->join(a, b, own.side(), costBound_,
                     [&](const PathPiece *pieces, std::size_t count, double cost)
                     {
                         Path path = frontier(Side::Start).pathTo(fromStart);
                         for (std::size_t i = 0; i < count; ++i)
                             path.append(pieces[i]);
                         frontier(Side::Goal).appendToRoot(fromGoal, path);
                         // Where nodes meet in a cell, every motion has been checked by itself.
                         if (traits_.drivesCurves &&
                             ((query_->car.maxCusps != ANY_CUSPS && path.cusps() > query_->car.maxCusps) ||
                              !query_->environment.acceptPath(path)))
                             return false;
                         best_.path = std::move(path);
                         best_.cost = costBound_ = cost;
                         isImproved_ = true;
                         return true;
                     });
    }

    double Search::shortestMotion() const
    {
        double shortest = HUGE_VAL;
        for (const Pose &start : frontier(Side::Start).rootPoses())
            for (const Pose &goal : frontier(Side::Goal).rootPoses())
                shortest = std::min(shortest, model_->distance(start, goal));
        return shortest;
    }

    bool Search::nearestPath(const Pose &target, Path &path) const
    {
        const NodeIndex nearest = frontier(Side::Start).nearestTo(target);
        if (nearest == NO_NODE)
            return false;
        path = frontier(Side::Start).pathTo(nearest);
        return true;
    }

    SearchStatistics Search::statistics() const
    {
        SearchStatistics sum = statistics_;
        for (const Guide &guide : guides_)
            sum.heuristicCells += guide.hasRoute ? guide.route.cells() : 0;
        for (const Frontier &each : frontiers_)
        {
            const OpenList::Work work = each.work();
            sum.openListOperations += work.operations;
            sum.openListComparisons += work.comparisons;
        }
        return sum;
    }

    // Estimating

    double Search::estimate(Side side, const Pose &pose)
    {
        Guide &own = guide(side);
        if (target_)
        {
            const double straight = positionDistance(pose, target_->pose);
            const double route = own.hasRoute ? own.route.distance(pose.x, pose.y) : 0.0;
            return route < HUGE_VAL ? std::max(straight, route) : straight;
        }
        if (own.targets.empty())
            return 0.0;
        if (isAdmissible() && !traits_.aims)
            return admissible(side, pose);
        const double ahead = own.heuristic->estimate(pose);
        return own.hasRoute ? std::max(ahead, own.route.estimate(pose)) : ahead;
    }

    double Search::admissible(Side side, const Pose &pose)
    {
        Guide &own = guide(side);
        const double ahead = own.heuristic->lowerBound(pose);
        return own.hasRoute ? std::max(ahead, own.route.lowerBound(pose)) : ahead;
    }

    float Search::rounded(double estimate) const
    {
        // As a bound it must not be rounded up.
        const auto nearest = static_cast<float>(estimate);
        return isAdmissible() ? std::nextafter(nearest, 0.0f) : nearest;
    }

    bool Search::mayImprove(Side side, const Node &node)
    {
        // An estimate that counts to an aim is no bound: the path to a root may be shorter.
        // Towards a target there is no root on the other side.
        return node.g + (isAdmissible() && traits_.aims && !target_ ? admissible(side, node.pose) : node.h) <
               costBound_;
    }

    double Search::priority(const Frontier &own, const Node &node)
    {
        // An estimate that counts to an aim that moves must not depend on where it is now. Where both weights are equal
        // no distance matters.
        double distance = node.h;
        if (!target_ && traits_.drivesCurves && weights_.far != weights_.near)
        {
            distance = HUGE_VAL;
            for (const Pose &target : guide(own.side()).targets)
                distance = std::min(distance, positionDistance(node.pose, target));
        }
        return node.g + weights_.at(distance) * node.h + node.densityPenalty;
    }

    float Search::densityPenalty(const Frontier &own, const Node &node) const
    {
        // Until there is a solution; models that aim go by the least f of all that was closed.
        if (!query_->parameters.detours || !traits_.drivesCurves || target_ || isAdmissible() || best_.cost < HUGE_VAL)
            return node.densityPenalty;
        return static_cast<float>(tuning::DENSITY_PENALTY * query_->car.turningRadius *
                                  std::min(own.density.at(node.pose), tuning::MAX_DENSITY));
    }

    bool Search::isDeferred(const Frontier &own, const Node &node) const
    {
        // Twice as long each time at least, so that a node is put back a few times only.
        const double much = tuning::MIN_DEFERRAL * query_->car.turningRadius;
        return densityPenalty(own, node) > node.densityPenalty + std::max<double>(much, node.densityPenalty);
    }

    void Search::pushFirst(Frontier &own, std::size_t level, NodeIndex index)
    {
        Node &node = own.node(index);
        node.densityPenalty = densityPenalty(own, node);
        own.push(0, level, priority(own, node), node.h, index);
    }

    /** \param queue in whose turn this happens: its route may be looked for further */
    void Search::push(Frontier &own, std::size_t level, NodeIndex index, std::size_t queue)
    {
        pushFirst(own, level, index);
        if (own.side() == confined_)
            for (std::size_t i = 0; i < detourCount(); ++i)
                pushToDetour(i, level, index, queue == i + 1);
    }

    bool Search::sortLists()
    {
        if (isSorted_)
            return true;
        for (Frontier &own : frontiers_)
            if (!own.rekey(
                    [&](OpenList::Entry &entry)
                    {
                        const Node &node = own.node(entry.node);
                        entry.f = priority(own, node);
                        return mayImprove(own.side(), node);
                    },
                    stop_))
                return false;
        return isSorted_ = true;
    }

    void Search::lowerWeights(double factor)
    {
        if (!weights_.canBeLowered())
            return;
        weights_ = weights_.lowered(factor);
        isSorted_ = false;
    }

    double Search::expectedCost() const
    {
        double least = HUGE_VAL;
        for (const NodeIndex root : frontier(confined_).roots())
            least = std::min<double>(least, frontier(confined_).node(root).h);
        return std::max(shortestMotion(), least);
    }

    double Search::lowerBound()
    {
        double bound = shortestMotion();
        if (!(bound < HUGE_VAL))
            return 0.0;
        for (Frontier &each : frontiers_)
        {
            double least = isPrepared_ ? HUGE_VAL : 0.0;
            for (const NodeIndex root : each.roots())
                least = std::min(least, isPrepared_ ? admissible(each.side(), each.node(root).pose) : 0.0);
            bound = std::max(bound, least);
        }
        return std::min(bound, costBound_);
    }

    // When the search is stuck

    void Search::endTurn()
    {
        if (needsDetour())
            addDetour();
        seekProof();
    }

    bool Search::needsDetour() const
    {
        const Guide &own = guides_[static_cast<std::size_t>(confined_)];
        if (!query_->parameters.detours || !traits_.drivesCurves || target_ || best_.cost < HUGE_VAL ||
            own.targets.empty() || detourCount() == std::size(tuning::DETOURS))
            return false;
        if (const std::size_t count = detourCount(); count > 0)
        {
            // Where nothing is known of the room, all discs take the same route.
            const Pose &root = frontier(confined_).node(frontier(confined_).roots().front()).pose;
            return expanded() >= detoursSince_ + count * tuning::DETOUR_EXPANSIONS &&
                   query_->environment.roomAt(root.x, root.y) < HUGE_VAL;
        }
        // A side that has run dry comes no nearer, and gets no turns any more.
        const Frontier &stuck = frontier(confined_);
        return expanded() >= tuning::MIN_EXPANSIONS &&
               (stuck.isExhausted() || stuck.turns() >= progress_.since + tuning::STALL_EXPANSIONS);
    }

    /** What lies ahead along the detour. Where its route is not known yet it is guessed, unless it \e looksFurther:
       each look floods a part of the map. */
    double Search::Detour::estimate(const Node &node, bool looksFurther)
    {
        // Back to the root, and on from there.
        double length = fromRoot > 0.0 ? fromRoot + node.g : 0.0;
        if (looksFurther)
            length = route.distance(node.pose.x, node.pose.y);
        else if (const std::optional<double> known = route.knownDistance(node.pose.x, node.pose.y))
            length = *known;
        return length < HUGE_VAL ? std::max<double>(node.h, length) : node.h;
    }

    void Search::addDetour()
    {
        const std::size_t number = detourCount();
        if (number == 0)
            detoursSince_ = expanded();
        if (detours_.size() <= number)
            detours_.push_back(std::make_unique<Detour>());
        Frontier &stuck = frontier(confined_);
        const std::vector<Pose> &targets = guide(confined_).targets;
        const tuning::DetourDisc &disc = tuning::DETOURS[number];
        const double wide = std::max(query_->car.bodyRadius + disc.wider * query_->car.turningRadius,
                                     disc.lanes * query_->car.turningLane);
        const NodeIndex nearest =
            *std::min_element(stuck.roots().begin(), stuck.roots().end(),
                              [&](NodeIndex a, NodeIndex b) { return stuck.node(a).h < stuck.node(b).h; });
        const Pose root = stuck.node(nearest).pose;
        Detour &detour = *detours_[number];
        detour.route.begin(
            query_->environment,
            routeResolution(query_->car.turningRadius, query_->car.bodyRadius, stuck.rootPoses(), targets),
            {query_->car.inscribedRadius, wide, disc.costFactor}, {root.x, root.y}, stop_, tuning::MAX_DETOUR_CELLS);
        for (const Pose &target : targets)
            detour.route.addTarget(target.x, target.y);
        detour.best = NO_NODE;
        detour.nearest = HUGE_VAL;
        detour.fromRoot = detour.route.distance(root.x, root.y);
        stuck.setQueues(number + 2);
        for (NodeIndex i = 0; i < stuck.nodes().size(); ++i)
            if (const Node &node = stuck.node(i);
                node.next < traits_.levels && (query_->parameters.adaptiveResolution || !node.isExpanded()))
                pushToDetour(number, node.next, i, false);
    }

    void Search::pushToDetour(std::size_t detour, std::size_t level, NodeIndex index, bool looksFurther)
    {
        Frontier &own = frontier(confined_);
        // By what lies ahead alone: with the cost so far it would flood what is cheap before it drives where there is
        // less room than preferred.
        const double ahead = detours_[detour]->estimate(own.node(index), looksFurther);
        own.push(1 + detour, level, ahead, ahead, index);
    }

    void Search::endDetours()
    {
        for (Frontier &each : frontiers_)
            each.setQueues(1);
        enclosure_.reset();
        progress_ = {HUGE_VAL, frontier(confined_).turns()};
    }

    void Search::seekProof()
    {
        const CarInSpace &car = query_->car;
        if (detourCount() == 0 || isImproved_ || car.bodyRadius <= 0.0 ||
            expanded() < detoursSince_ + tuning::PROOF_EXPANSIONS)
            return;
        if (!enclosure_.hasBegun())
        {
            const Enclosure::Cells cells{tuning::PROOF_CELL * car.bodyRadius, tuning::PROOF_HEADINGS, car.centreOffset,
                                         tuning::MAX_PROOF_COLUMNS};
            enclosure_.begin(query_->environment.blockedHeadings(cells.side, cells.headings), frontiers_[0].rootPoses(),
                             frontiers_[1].rootPoses(), cells);
        }
        const std::uint64_t effort = expanded() - detoursSince_ - tuning::PROOF_EXPANSIONS;
        if (enclosure_.widen(1 + effort / tuning::PROOF_PACE))
            proof_ = Exhaustion::Enclosed;
    }
}  // namespace parking::search

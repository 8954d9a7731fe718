// What the nodes of a search are worth, and what follows from it.

#include "ompl_improved_astar/search/Search.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace parking::search
{
    namespace
    {
        constexpr double INFINITE = std::numeric_limits<double>::infinity();
    }  // namespace

    bool Search::prepare()
    {
        if (preparation_ == Preparation::Guides)
        {
            // The more confined side is the harder one to get away from. When there is little in it that is the goal's.
            const double startMobility = mobility(frontier(Side::Start), 0.0),
                         confinedGoal = startMobility + 0.5 * traits_.reach;
            const bool isGoalConfined = mobility(frontier(Side::Goal), confinedGoal) <= confinedGoal;
            confined_ = traits_.joinsAfar && isGoalConfined ? Side::Goal : Side::Start;
            if (!parameters_.bidirectional)
                confined_ = parameters_.searchFromGoal && hasGoal() ? Side::Goal : Side::Start;
            for (const Side side : {Side::Start, Side::Goal})
                beginGuides(side);
            endDetours();
            if (hasTarget_)
                aimAtTarget();
            else
                guideRoundObstacles();
            proof_ = isProvenUnreachable() ? Exhaustion::WalledIn : Exhaustion::None;
            preparation_ = Preparation::Estimates;
            prepared_ = {};
        }
        if (preparation_ == Preparation::Estimates)
        {
            // Roots added later change what the nodes of the other side are worth.
            const auto hasNodes = [](const Frontier &own)
            {
                return own.nodes().size() > own.roots().size();
            };
            const auto estimateAnew = [&](Frontier &own, NodeIndex index)
            {
                if (hasNodes(own))
                    own.node(index).h = estimateOf(own.side(), own.node(index).pose);
            };
            if (!visitNodes(prepared_, estimateAnew))
                return false;
            for (Frontier &each : frontiers_)
                if (hasNodes(each))
                    unsort(each);
            preparation_ = Preparation::Lists;
        }
        if (preparation_ == Preparation::Lists)
        {
            if (!sortLists(stop_))
                return false;
            preparation_ = Preparation::Queues;
            prepared_ = {};
        }
        if (preparation_ == Preparation::Queues)
        {
            // Nodes are joined when they are expanded: those that are so far have never met the new ones.
            if (joinsAgain_ &&
                !visitNodes(prepared_, [this](Frontier &own, NodeIndex index) { queueAgain(own, index); }))
                return false;
            for (Frontier &each : frontiers_)
                if (!queueRoots(each))
                    return false;
            joinsAgain_ = false;
            preparation_ = Preparation::Done;
        }
        return true;
    }

    double Search::mobility(Frontier &own, double enough)
    {
        for (const NodeIndex root : own.roots())
            if (!own.node(root).queued && own.rootMobility > enough)
                own.rootMobility = std::min(own.rootMobility, model_->mobility(own.node(root).pose));
        return own.rootMobility;
    }

    void Search::beginGuides(Side side)
    {
        Guides &own = guides(side);
        own.roots = frontier(side).rootPoses();
        own.targets = frontier(opposite(side)).rootPoses();
        own.roundObstacles = false;
        own.base->begin({*environment_, parameters_, side, own.roots, own.targets, stop_});
        if (const std::optional<Pose> &aim = frontier(side).aim)
            own.base->aim(*aim);
    }

    void Search::guideRoundObstacles()
    {
        // Of the side that gets most of the turns only: flooding the map from the other end, too, would cost more than
        // it spares.
        Guides &own = guides(confined_);
        if (own.targets.empty() || !parameters_.obstacleHeuristic || !traits_.joinsAfar)
            return;
        const auto begin = std::chrono::steady_clock::now();
        own.obstacles.begin({*environment_, parameters_, confined_, own.roots, own.targets, stop_});
        if (parameters_.eagerObstacles)
            loadingTime_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        own.roundObstacles = true;
    }

    void Search::aimAtTarget()
    {
        const Frontier &starts = frontier(Side::Start);
        if (starts.roots().empty() || !parameters_.obstacleHeuristic || !traits_.joinsAfar)
            return;
        // Flooding from the starts finds the place to make for; the way there is then counted from that place.
        Guides &flood = guides(Side::Goal), &way = guides(Side::Start);
        flood.roots.assign(1, target_);
        flood.targets = starts.rootPoses();
        flood.obstacles.begin({*environment_, parameters_, Side::Goal, flood.roots, flood.targets, stop_});
        flood.roundObstacles = true;
        const Eigen::Vector2d place = flood.obstacles.nearestReachable({target_.x, target_.y});
        nearestOfDisc_ = (place - Eigen::Vector2d(target_.x, target_.y)).norm();
        way.targets.assign(1, {place.x(), place.y(), 0.0});
        way.obstacles.begin({*environment_, parameters_, Side::Start, way.roots, way.targets, stop_});
        way.roundObstacles = true;
    }

    bool Search::isProvenUnreachable()
    {
        // A disc inside of the car finds no way round the obstacles: neither will the car.
        Guides &own = guides(confined_);
        if (!own.roundObstacles || hasTarget_ || own.roots.empty())
            return false;
        for (const Pose &root : own.roots)
            if (!own.obstacles.provesUnreachable(root) || (stop_ && stop_()))
                return false;
        return true;
    }

    void Search::queueAgain(Frontier &own, NodeIndex index)
    {
        Node &node = own.node(index);
        if (!node.isExpanded())
            return;
        node.fixed = true;  // its motions hang on it already
        node.next = node.level;
        push(own, node.level, index);
        own.expansionsWhenExhausted = 0;
    }

    bool Search::queueRoots(Frontier &own)
    {
        NodeIndex queued = 0;
        for (const NodeIndex root : own.roots())
        {
            Node &node = own.node(root);
            if (node.queued)
                continue;
            if (++queued % NODES_BETWEEN_STOPS == 0 && stop_ && stop_())
                return false;
            node.queued = true;
            node.h = estimateOf(own.side(), node.pose);
            own.place(node, root, model_->cell(node.pose, 0));
            push(own, 0, root);
        }
        return true;
    }

    double Search::estimate() const
    {
        double least = INFINITE;
        for (const NodeIndex root : frontier(confined_).roots())
            least = std::min<double>(least, frontier(confined_).node(root).h);
        return least;
    }

    double Search::estimate(Side side, const Pose &pose)
    {
        Guides &own = guides(side);
        if (hasTarget_)
        {
            const double straight = positionDistance(pose, target_);
            const double way = own.roundObstacles ? own.obstacles.distance(pose.x, pose.y) : 0.0;
            return way < INFINITE ? std::max(straight, way) : straight;
        }
        if (own.targets.empty())
            return 0.0;
        if (boundIsKept_)
            return traits_.aims ? own.base->estimate(pose) : admissible(side, pose);
        const double ahead = own.base->estimate(pose);
        return own.roundObstacles ? std::max(ahead, own.obstacles.estimate(pose)) : ahead;
    }

    float Search::estimateOf(Side side, const Pose &pose)
    {
        return rounded(estimate(side, pose));
    }

    float Search::rounded(double estimate) const
    {
        // As a bound it must not be rounded up.
        const auto nearest = static_cast<float>(estimate);
        return boundIsKept_ ? std::nextafter(nearest, 0.0f) : nearest;
    }

    double Search::admissible(Side side, const Pose &pose)
    {
        Guides &own = guides(side);
        const double ahead = own.base->lowerBound(pose);
        return own.roundObstacles ? std::max(ahead, own.obstacles.lowerBound(pose)) : ahead;
    }

    bool Search::mayImprove(Side side, const Node &node)
    {
        // What is estimated to an aim is no bound of what lies ahead: the way to a root may be shorter.
        return node.g + (boundIsKept_ && traits_.aims ? admissible(side, node.pose) : node.h) < costBound_;
    }

    bool Search::mayImproveAtBest(Side side, const Node &node) const
    {
        // Rounded as estimates are, so that nothing is refused that only they make look cheaper.
        const auto mayImproveTo = [&](const Pose &target)
        {
            return node.g + rounded(model_->leastDistance(node.pose, target)) < costBound_;
        };
        const std::vector<Pose> &targets = guides_[static_cast<std::size_t>(side)].targets;
        return hasTarget_ || targets.empty() || std::any_of(targets.begin(), targets.end(), mayImproveTo);
    }

    double Search::weightAt(const Frontier &own, const Node &node) const
    {
        // What is estimated to an aim that moves must not depend on where it is now. Where both weights are equal no
        // distance matters.
        double distance = node.h;
        if (!hasTarget_ && !traits_.aims && !traits_.complete && parameters_.weights.far != parameters_.weights.near)
        {
            distance = INFINITE;
            for (const Pose &target : guides(own.side()).targets)
                distance = std::min(distance, positionDistance(node.pose, target));
        }
        return parameters_.weights.at(distance);
    }

    double Search::priority(const Frontier &own, const Node &node) const
    {
        return node.g + weightAt(own, node) * node.h + node.wait;
    }

    bool Search::spreadsOut() const
    {
        // Models that aim go by the least f of all that was closed, and bounds by the costs alone.
        return parameters_.spreadOut && traits_.joinsAfar && !hasTarget_ && !boundIsKept_ && !hasSolution();
    }

    float Search::waitOf(const Frontier &own, const Node &node) const
    {
        if (!spreadsOut())
            return node.wait;
        const SearchTuning &tuning = parameters_.tuning;
        const std::uint32_t expansions = own.crowds.at(node.pose);
        return static_cast<float>(tuning.waitPerExpansion * parameters_.turningRadius *
                                  std::min(expansions, tuning.mostCrowded));
    }

    bool Search::hasToGoOnWaiting(const Frontier &own, const Node &node) const
    {
        // Twice as long each time at least, so that a node is put back a few times and no more.
        const double much = parameters_.tuning.longerWait * parameters_.turningRadius;
        return waitOf(own, node) > node.wait + std::max<double>(much, node.wait);
    }

    void Search::pushToFirst(Frontier &own, std::size_t level, NodeIndex index)
    {
        Node &node = own.node(index);
        node.wait = waitOf(own, node);
        own.push(0, level, priority(own, node), node.h, index);
    }

    void Search::push(Frontier &own, std::size_t level, NodeIndex index)
    {
        // Nothing waits in the queues of detours: those are followed rather than searched.
        pushToFirst(own, level, index);
        for (std::size_t i = 0; i < detoursOf(own); ++i)
            pushToDetour(i, level, index);
        if (detoursTaken() > 0)
            own.exploration.push(own.node(index).pose, level, index);
    }

    void Search::unsort(Frontier &own)
    {
        for (const std::unique_ptr<OpenList> &list : own.openLists())
            list->beginRekeying();
        listsInOrder_[static_cast<std::size_t>(own.side())] = 0;
    }

    bool Search::sortLists(const StopFunction &stop)
    {
        constexpr std::size_t ENTRIES_BETWEEN_STOPS = 512;
        for (Frontier &own : frontiers_)
            for (std::size_t &level = listsInOrder_[static_cast<std::size_t>(own.side())]; level < traits_.levels;
                 ++level)
            {
                const auto key = [this, &own](OpenList::Entry &entry)
                {
                    const Node &node = own.node(entry.node);
                    entry.f = priority(own, node);
                    return mayImprove(own.side(), node);
                };
                while (!own.openLists()[level]->rekey(key, ENTRIES_BETWEEN_STOPS))
                    if (stop && stop())
                        return false;
            }
        return true;
    }

    void Search::setWeights(const HeuristicWeights &weights, const StopFunction &stop)
    {
        parameters_.weights = weights;
        for (Frontier &each : frontiers_)
            unsort(each);
        sortLists(stop);
    }

    void Search::drop(Side side, double g, const Pose &pose, const Node &keeper)
    {
        double &least = leastDropped_[static_cast<std::size_t>(side)];
        if (!boundIsKept_ || hasTarget_ || g >= least)
            return;
        // Nothing is lost with a node whose place another holds at no more cost, but for rounding; unless what comes
        // next depends on how it was arrived at, as with cars.
        const bool samePlace = traits_.complete && pose.x == keeper.pose.x && pose.y == keeper.pose.y &&
                               (pose.yaw == keeper.pose.yaw || !environment_->headingMatters());
        if (!samePlace || g < keeper.g - 1e-9)
            least = std::min(least, g + admissible(side, pose));
    }

    double Search::lowerBound()
    {
        if (hasTarget_ || !hasGoal() || frontier(Side::Start).roots().empty())
            return 0.0;
        if (preparation_ != Preparation::Done)
            return std::min(shortestMotion(), costBound_);
        double ofRoots = shortestMotion();
        for (const Side side : {Side::Start, Side::Goal})
        {
            double least = INFINITE;
            for (const Pose &root : guides(side).roots)
                least = std::min(least, admissible(side, root));
            ofRoots = std::max(ofRoots, least);
        }
        // What was dropped or pruned before a root was added was so without it.
        if (!boundIsKept_ || hasLateRoots_ || guides_.front().base->overestimates())
            return std::min(ofRoots, costBound_);
        // A complete model's motions are the same from both ends, so that either side bounds all paths; otherwise each
        // bounds those that are made of its own motions.
        double ofSearch = traits_.complete ? 0.0 : INFINITE;
        for (const Side side : {Side::Start, Side::Goal})
        {
            if (!parameters_.bidirectional && side != confined_)
                continue;
            double least = leastDropped_[static_cast<std::size_t>(side)];
            // The node under way is in no list, and not all of its successors are yet.
            if (underWay_.node != NO_NODE && underWay_.side == side)
            {
                const Node &node = frontier(side).node(underWay_.node);
                least = std::min(least, node.g + admissible(side, node.pose));
            }
            for (std::size_t level = 0; level < traits_.levels; ++level)
                for (const OpenList::Entry &entry : frontier(side).openLists()[level]->entries())
                {
                    const Node &node = frontier(side).node(entry.node);
                    if (node.next == level)  // else a stale entry
                        least = std::min(least, node.g + admissible(side, node.pose));
                }
            ofSearch = traits_.complete ? std::max(ofSearch, least) : std::min(ofSearch, least);
        }
        return std::min(std::max(ofRoots, ofSearch), costBound_);
    }
}  // namespace parking::search

// Driving on along a way of the disc, without an expansion for each step.

#include "ompl_improved_astar/search/Search.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace parking::search
{
    void Search::beginLookahead(const Frontier &own, NodeIndex node, std::size_t queue)
    {
        // Only while a way to drive is looked for, and from what has just come farthest by one of the guides.
        if (parameters_.lookAhead && own.side() == confined_ && guides(confined_).roundObstacles && !hasTarget_ &&
            !hasSolution() && !boundIsKept_ && node == (queue == 0 ? own.bestClosed : detours_[queue - 1]->best))
            ahead_ = {node, queue};
    }

    bool Search::finishLookahead()
    {
        while (ahead_.node != NO_NODE)
        {
            const NodeIndex next = improved_ ? NO_NODE : nextAhead();
            if (next == NO_NODE && environment_->wasInterrupted())
                return false;
            ahead_.node = next;
            if (next != NO_NODE && stop_ && stop_())
                return false;
        }
        return true;
    }

    /** The end of one more curve from the node that has been reached; NO_NODE when there is none. */
    NodeIndex Search::nextAhead()
    {
        Frontier &own = frontier(confined_);
        ObstacleHeuristic &way = ahead_.queue == 0 ? guides(confined_).obstacles : detours_[ahead_.queue - 1]->way;
        const SearchTuning &tuning = parameters_.tuning;
        const double radius = parameters_.turningRadius;
        const Pose from = own.node(ahead_.node).pose;
        const auto place = way.placeOnWay(from.x, from.y, tuning.lookahead * radius, tuning.lookaheadHeading * radius);
        if (!place)
            return NO_NODE;
        Pose to{place->place.x(), place->place.y(), std::atan2(place->heading.y(), place->heading.x())};
        const bool inReverse = std::cos(from.yaw) * (to.x - from.x) + std::sin(from.yaw) * (to.y - from.y) < 0.0;
        if (inReverse)
            to.yaw = wrapAngle(to.yaw + PI);
        // Where the heading is too far off, the curve turns round: nothing to be done without looking.
        if (lengthFrom(own.side(), from, to) > tuning.mostLookahead * positionDistance(from, to))
            return NO_NODE;
        model_->moveTowards(own.side(), from, to, motions_);
        const bool hasCusp =
            std::any_of(motions_.begin(), motions_.end(),
                        [&](const Successor &each) { return (each.motion.length < 0.0) != inReverse; });
        // Where obstacles are near, the way to the contact is no better than any other. Pieces too short to be driven
        // are left out.
        if (motions_.empty() || hasCusp ||
            positionDistance(motions_.back().pose, to) > 3.0 * tuning.shortestMotion * radius)
            return NO_NODE;
        const NodeIndex last = keepMotions(own, ahead_.node);
        return last != ahead_.node ? last : NO_NODE;
    }

    NodeIndex Search::keepMotions(Frontier &own, NodeIndex index)
    {
        for (const Successor &successor : motions_)
        {
            Node node;
            node.pose = successor.pose;
            node.g = costWithoutCloseness(own, own.node(index), successor) + closeness(own.node(index), successor);
            if (parameters_.cost.pricesCloseness() && environment_->wasInterrupted())
                break;
            node.motion = successor.motion;
            node.parent = index;
            node.farthest = node.fixed = true;
            node.cusps = cuspsThrough(own.node(index), successor.motion);
            if (node.cusps > parameters_.mostCusps)
                break;
            node.h = estimateOf(own.side(), node.pose);
            index = keep(own, node);
        }
        return index;
    }

    NodeIndex Search::keep(Frontier &own, Node node)
    {
        // Only cells that are empty are left from: else a search without a way would never end.
        const std::size_t levels = parameters_.adaptiveResolution ? traits_.levels : 1;
        for (std::size_t level = 0; level < levels; ++level)
        {
            const std::uint64_t cell = model_->cell(node.pose, level);
            if (own.holderOf(cell, level) != NO_NODE)
                continue;
            node.level = node.next = static_cast<std::uint8_t>(level);
            const NodeIndex index = own.place(node, NO_NODE, cell);
            push(own, level, index);
            return index;
        }
        node.level = node.next = static_cast<std::uint8_t>(traits_.levels);
        return own.append(node);
    }
}  // namespace parking::search

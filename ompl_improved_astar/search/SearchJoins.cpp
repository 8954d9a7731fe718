// Joining the two frontiers, and reading paths off them.

#include "ompl_improved_astar/search/Search.h"

#include <algorithm>

namespace parking::search
{
    void Search::joinAround(const Frontier &own, NodeIndex index)
    {
        const Frontier &other = frontier(opposite(own.side()));
        const Node &node = own.node(index);
        if (!traits_.joinsAfar)
        {
            // The other side's node must be closed, too; a root that never moved counts as such.
            const NodeIndex partner = other.holderOf(model_->cell(node.pose, 0), 0);
            if (partner != NO_NODE && (other.node(partner).isExpanded() || other.node(partner).parent == NO_NODE))
                joinPair(own, index, partner);
            return;
        }
        // Curves from a node that can hardly move hardly ever get away. Leaving them out would make the bound false.
        if (node.mobility < parameters_.tuning.confined * std::min<double>(node.h, 2.0 * traits_.reach) &&
            !boundIsKept_)
            return;
        joinAfar(own, index);
    }

    void Search::joinPair(const Frontier &own, NodeIndex index, NodeIndex partner)
    {
        // Swept from the own side's node, where a collision is more likely than at what the other side has reached.
        own.side() == Side::Start ? join(index, partner, Side::Start) : join(partner, index, Side::Goal);
    }

    void Search::joinAfar(const Frontier &own, NodeIndex index)
    {
        const Frontier &other = frontier(opposite(own.side()));
        for (const NodeIndex root : other.roots())
            joinPair(own, index, root);
        if (parameters_.bidirectional && other.bestClosed != NO_NODE && other.node(other.bestClosed).parent != NO_NODE)
            joinPair(own, index, other.bestClosed);
        for (std::size_t i = 0; i < detoursOf(other); ++i)
            if (const NodeIndex best = detours_[i]->best; best != NO_NODE && best != other.bestClosed)
                joinPair(own, index, best);
        // Where both have come to the same place they are near to each other, whatever is thought of the way on.
        const NodeIndex neighbour =
            detoursTaken() > 0 ? other.exploration.lastExpandedAt(own.node(index).pose) : NO_NODE;
        if (neighbour == NO_NODE || neighbour == other.bestClosed || other.node(neighbour).parent == NO_NODE)
            return;
        for (std::size_t i = 0; i < detoursOf(other); ++i)
            if (detours_[i]->best == neighbour)
                return;
        joinPair(own, index, neighbour);
    }

    bool Search::join(NodeIndex fromStart, NodeIndex fromGoal, Side sweptFrom)
    {
        const Node &a = frontier(Side::Start).node(fromStart), &b = frontier(Side::Goal).node(fromGoal);
        if (a.g + b.g >= costBound_ || (traits_.joinsAfar && !parameters_.analyticExpansion))
            return false;
        ++statistics_.connections;
        const MotionModel::Offer offer = [&](const PathPiece *pieces, std::size_t count, double cost)
        {
            Path path = frontier(Side::Start).pathTo(fromStart);
            for (std::size_t i = 0; i < count; ++i)
                path.append(pieces[i]);
            frontier(Side::Goal).appendToRoot(fromGoal, path);
            // Where nodes meet in a cell, every motion has been checked by itself.
            if (traits_.joinsAfar && !environment_->acceptPath(path))
                return false;
            bestPath_ = std::move(path);
            bestCost_ = costBound_ = cost;
            improved_ = true;
            return true;
        };
        return model_->join(a, b, sweptFrom, costBound_, offer);
    }

    double Search::shortestMotion() const
    {
        double shortest = std::numeric_limits<double>::infinity();
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
}  // namespace parking::search

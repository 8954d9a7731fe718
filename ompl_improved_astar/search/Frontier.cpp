#include "ompl_improved_astar/search/Frontier.h"

#include <algorithm>

namespace parking::search
{
    void Frontier::begin(const std::string &openList, std::size_t levels, double turnsRatio)
    {
        if (openListName_ != openList)
            open_.clear();
        openListName_ = openList;
        open_.resize(levels);
        for (std::unique_ptr<OpenList> &list : open_)
            if (list)
                list->clear();
            else
                list = search::openLists().make(openList);
        turns_.assign(levels, 0);
        turnsRatio_ = turnsRatio;
        nodes_.clear();
        cells_.clear();
        roots_.clear();
        bestClosed = NO_NODE;
        bestClosedCost = 0.0;
        rootMobility = std::numeric_limits<double>::infinity();
        expansionsWhenExhausted = 0;
        aim.reset();
    }

    NodeIndex Frontier::addRoot(const Pose &pose)
    {
        Node root;
        root.pose = pose;
        root.farthest = true;
        const auto index = static_cast<NodeIndex>(nodes_.size());
        nodes_.push_back(root);
        roots_.push_back(index);
        return index;
    }

    std::vector<Pose> Frontier::rootPoses() const
    {
        std::vector<Pose> poses;
        for (const NodeIndex root : roots_)
            poses.push_back(nodes_[root].pose);
        return poses;
    }

    NodeIndex Frontier::place(const Node &node, NodeIndex index, std::uint64_t cell)
    {
        if (index == NO_NODE)
        {
            index = static_cast<NodeIndex>(nodes_.size());
            nodes_.push_back(node);
        }
        else
            nodes_[index] = node;
        cells_.set(keyOf(cell, node.level), index);
        return index;
    }

    bool Frontier::isExhausted() const
    {
        return std::all_of(open_.begin(), open_.end(),
                           [](const std::unique_ptr<OpenList> &list) { return list->empty(); });
    }

    std::size_t Frontier::chooseLevel() const
    {
        std::size_t best = 0;
        double fewest = std::numeric_limits<double>::infinity(), ratio = 1.0;
        for (std::size_t level = 0; level < open_.size(); ++level, ratio *= turnsRatio_)
        {
            const double turns = static_cast<double>(turns_[level]) * ratio;
            if (!open_[level]->empty() && turns < fewest)
            {
                fewest = turns;
                best = level;
            }
        }
        return best;
    }

    void Frontier::appendToRoot(NodeIndex index, Path &path) const
    {
        for (; nodes_[index].parent != NO_NODE; index = nodes_[index].parent)
        {
            const Motion &motion = nodes_[index].motion;
            path.append(motion.drive().reversed());
            path.append(PathPiece::turnOnTheSpot(-motion.turn));
        }
    }

    Path Frontier::pathTo(NodeIndex index) const
    {
        Path outward{nodes_[index].pose, {}};
        appendToRoot(index, outward);
        NodeIndex root = index;
        while (nodes_[root].parent != NO_NODE)
            root = nodes_[root].parent;
        Path path = outward.reversed();
        path.start = nodes_[root].pose;
        return path;
    }

    NodeIndex Frontier::nearestTo(const Pose &target) const
    {
        NodeIndex best = NO_NODE;
        double nearest = std::numeric_limits<double>::infinity();
        for (NodeIndex i = 0; i < nodes_.size(); ++i)
            if (const double distance = positionDistance(nodes_[i].pose, target); distance < nearest)
            {
                nearest = distance;
                best = i;
            }
        return best;
    }
}  // namespace parking::search

#include "ompl_improved_astar/search/Frontier.h"

#include "ompl_improved_astar/search/Tuning.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace parking::search
{
    namespace
    {
        constexpr std::size_t GROWING = 3;  // an array that grows is there twice, once of double the size
    }

    void Frontier::begin(const std::string &openList, std::size_t levels)
    {
        if (openListName_ != openList)
            queues_.clear();
        openListName_ = openList;
        levels_ = levels;
        queueCount_ = queueTurn_ = 0;
        turns_ = 0;
        for (Queue &queue : queues_)
            for (const std::unique_ptr<OpenList> &list : queue.open)
                list->clear();
        setQueues(1);
        nodes_.clear();
        cells_.clear();
        roots_.clear();
        bestClosed = NO_NODE;
        bestClosedCost = 0.0;
        expansionsWhenExhausted = 0;
    }

    NodeIndex Frontier::addRoot(const Pose &pose)
    {
        Node root;
        root.pose = pose;
        root.farthest = true;
        roots_.push_back(append(root));
        return roots_.back();
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
            index = append(node);
        else
            nodes_[index] = node;
        cells_.set(keyOf(cell, node.level), index);
        return index;
    }

    bool Frontier::rekey(const std::function<bool(OpenList::Entry &)> &key, const StopFunction &stop)
    {
        return std::all_of(queues_.front().open.begin(), queues_.front().open.end(),
                           [&](const std::unique_ptr<OpenList> &list) { return list->rekey(key, stop); });
    }

    OpenList::Work Frontier::work() const
    {
        OpenList::Work sum;
        for (const Queue &queue : queues_)
            for (const std::unique_ptr<OpenList> &list : queue.open)
            {
                sum.operations += list->work().operations;
                sum.comparisons += list->work().comparisons;
            }
        return sum;
    }

    std::size_t Frontier::bytes() const
    {
        std::size_t bytes = cells_.bytes() + density.bytes() + GROWING * nodes_.size() * sizeof(Node);
        for (std::size_t queue = 0; queue < queueCount_; ++queue)
            for (const std::unique_ptr<OpenList> &list : queues_[queue].open)
                bytes += GROWING * list->size() * sizeof(OpenList::Entry);
        return bytes;
    }

    void Frontier::setQueues(std::size_t count)
    {
        if (queues_.size() < count)
            queues_.resize(count);
        for (; queueCount_ < count; ++queueCount_)
        {
            Queue &queue = queues_[queueCount_];
            queue.open.resize(levels_);
            queue.turns.assign(levels_, 0);
            for (std::unique_ptr<OpenList> &list : queue.open)
                if (!list)
                    list = openLists().make(openListName_);
                else
                    list->clear();
        }
        queueCount_ = count;
    }

    bool Frontier::Queue::isEmpty() const
    {
        return std::all_of(open.begin(), open.end(),
                           [](const std::unique_ptr<OpenList> &list) { return list->empty(); });
    }

    std::size_t Frontier::chooseQueue()
    {
        do
            queueTurn_ = (queueTurn_ + 1) % queueCount_;
        while (queues_[queueTurn_].isEmpty());
        return queueTurn_;
    }

    std::size_t Frontier::chooseLevel(std::size_t queue) const
    {
        const Queue &chosen = queues_[queue];
        std::size_t best = 0;
        double fewest = std::numeric_limits<double>::infinity(), ratio = 1.0;
        for (std::size_t level = 0; level < chosen.open.size(); ++level, ratio *= tuning::LEVEL_TURN_RATIO)
        {
            const double turns = static_cast<double>(chosen.turns[level]) * ratio;
            if (!chosen.open[level]->empty() && turns < fewest)
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
        {
            // There may be millions of them when the time is up: most are told apart by one coordinate.
            const Pose &pose = nodes_[i].pose;
            if (!(std::abs(pose.x - target.x) < nearest && std::abs(pose.y - target.y) < nearest))
                continue;
            if (const double distance = positionDistance(pose, target); distance < nearest)
            {
                nearest = distance;
                best = i;
            }
        }
        return best;
    }
}  // namespace parking::search

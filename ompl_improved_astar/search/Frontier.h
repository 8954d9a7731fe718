#pragma once

#include "ompl_improved_astar/search/Node.h"
#include "ompl_improved_astar/search/OpenList.h"
#include "ompl_improved_astar/search/containers/CellTable.h"
#include "ompl_improved_astar/search/containers/ExpansionDensity.h"
#include "parking_geometry/curves/Path.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace parking::search
{
    /** \brief One side of a search: the tree that grows from its roots, the cells that it occupies, and its open nodes:
       a queue, with a list for each level of resolution.

        A side that is stuck gets further queues, which order the open nodes by other estimates and take turns with the
        first one. Every open node is in the first queue, whatever the others hold. */
    class Frontier
    {
    public:
        /** \brief Empty, and not usable before begin(). */
        explicit Frontier(Side side) : side_(side)
        {
        }
        Frontier(const Frontier &) = delete;
        Frontier &operator=(const Frontier &) = delete;

        /** \brief Forgets everything; memory is kept. */
        void begin(const std::string &openList, std::size_t levels);

        /** \brief The end of the problem that it grows from. */
        Side side() const
        {
            return side_;
        }

        /** \brief Adds a root that costs nothing and holds no cell; it is not yet open. */
        NodeIndex addRoot(const Pose &pose);

        /** \brief The roots in the order in which they were added. */
        const std::vector<NodeIndex> &roots() const
        {
            return roots_;
        }

        /** \brief The poses of roots(), in that order. */
        std::vector<Pose> rootPoses() const;

        /** \brief All nodes; a NodeIndex is a position among them. */
        const std::vector<Node> &nodes() const
        {
            return nodes_;
        }

        /** \brief A node to be changed. The reference holds until a node is added. */
        Node &node(NodeIndex index)
        {
            return nodes_[index];
        }

        /** \brief A node. The reference holds until a node is added. */
        const Node &node(NodeIndex index) const
        {
            return nodes_[index];
        }

        /** \brief The node that holds a cell; NO_NODE when it is empty. */
        NodeIndex holderOf(std::uint64_t cell, std::size_t level) const
        {
            return cells_.find(keyOf(cell, level));
        }

        /** \brief Puts a node into a cell of its level, as a new one or in the place of \e index. */
        NodeIndex place(const Node &node, NodeIndex index, std::uint64_t cell);

        /** \brief Adds a node that holds no cell. */
        NodeIndex append(const Node &node)
        {
            nodes_.push_back(node);
            return static_cast<NodeIndex>(nodes_.size() - 1);
        }

        /** \brief Puts a node into the list of that level of a queue; see OpenList::push(). */
        void push(std::size_t queue, std::size_t level, double f, double h, NodeIndex index)
        {
            queues_[queue].open[level]->push(f, h, index);
        }

        /** \brief Takes the best entry out of such a list, which must not be empty. The entry may be stale. */
        OpenList::Entry pop(std::size_t queue, std::size_t level)
        {
            return queues_[queue].open[level]->pop();
        }

        /** \brief Sorts all lists of the first queue again; see OpenList::rekey(). */
        bool rekey(const std::function<bool(OpenList::Entry &)> &key, const StopFunction &stop);

        /** \brief Is nothing open on any level? */
        bool isExhausted() const
        {
            return queues_.front().isEmpty();
        }

        /** \brief How many queues take turns. */
        std::size_t queues() const
        {
            return queueCount_;
        }

        /** \brief From now on that many queues take turns; those that are new are empty. */
        void setQueues(std::size_t count);

        /** \brief The queue whose turn it is among those that are not empty; something must be open. */
        std::size_t chooseQueue();

        /** \brief The level whose turn it is among those of a queue with open nodes. */
        std::size_t chooseLevel(std::size_t queue) const;

        /** \brief Notes that the level had its turn; chooseLevel() goes by that. */
        void countTurn(std::size_t queue, std::size_t level)
        {
            ++queues_[queue].turns[level];
            ++turns_;
        }

        /** \brief How often countTurn() has been called since begin(). */
        std::uint64_t turns() const
        {
            return turns_;
        }

        /** \brief What the lists of all queues have done since begin(). */
        OpenList::Work work() const;

        /** \brief Bytes of nodes, cells and open entries at the most, while their arrays grow. */
        std::size_t bytes() const;

        /** \brief Adds the pieces between a node and its root, as the car drives them on the goal's side. */
        void appendToRoot(NodeIndex index, Path &path) const;

        /** \brief The path from the root to a node, as the car drives it on the start's side. */
        Path pathTo(NodeIndex index) const;

        /** \brief The node whose position is nearest to that of \e target; NO_NODE when there is none. */
        NodeIndex nearestTo(const Pose &target) const;

        NodeIndex bestClosed{NO_NODE};             ///< the closed node that the other side is joined with, or aims at
        double bestClosedCost{0.0};                ///< by which it is the best
        std::uint64_t expansionsWhenExhausted{0};  ///< of both sides, when this one ran out of open nodes
        ExpansionDensity density;                  ///< of the nodes expanded until there was a solution

    private:
        /** Open nodes in one order: a list for each level. */
        struct Queue
        {
            std::vector<std::unique_ptr<OpenList>> open;
            std::vector<std::uint64_t> turns;

            bool isEmpty() const;
        };

        static std::uint64_t keyOf(std::uint64_t cell, std::size_t level)
        {
            return (static_cast<std::uint64_t>(level + 1) << 61) | cell;
        }

        Side side_;
        std::vector<Node> nodes_;
        CellTable cells_;
        std::vector<Queue> queues_;
        std::size_t queueCount_{1}, queueTurn_{0}, levels_{1};
        std::uint64_t turns_{0};
        std::string openListName_;
        std::vector<NodeIndex> roots_;
    };
}  // namespace parking::search

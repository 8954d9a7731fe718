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
    /** \brief One side of a search: the tree that grows from its roots, its cells, and its open nodes in a queue with
       one list per level.

        A side that is stuck receives further queues, which order open nodes by other estimates and alternate with the
        first one. The first queue always contains all open nodes. */
    class Frontier
    {
    public:
        /** \brief Creates an empty frontier; call begin() before use. */
        explicit Frontier(Side side) : side_(side)
        {
        }
        Frontier(const Frontier &) = delete;
        Frontier &operator=(const Frontier &) = delete;

        /** \brief Removes everything; memory is kept. */
        void begin(const std::string &openList, std::size_t levels);

        /** \brief The end of the problem from which it grows. */
        Side side() const
        {
            return side_;
        }

        /** \brief Adds a root without cost and cell; it is not yet open. */
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

        /** \brief A node, for changes. The reference is valid until a node is added. */
        Node &node(NodeIndex index)
        {
            return nodes_[index];
        }

        /** \brief A node. The reference is valid until a node is added. */
        const Node &node(NodeIndex index) const
        {
            return nodes_[index];
        }

        /** \brief The node that occupies a cell; NO_NODE if it is empty. */
        NodeIndex holderOf(std::uint64_t cell, std::size_t level) const
        {
            return cells_.find(keyOf(cell, level));
        }

        /** \brief Stores a node in a cell of its level, as a new one or in place of \e index. */
        NodeIndex place(const Node &node, NodeIndex index, std::uint64_t cell);

        /** \brief Adds a node without a cell. */
        NodeIndex append(const Node &node)
        {
            nodes_.push_back(node);
            return static_cast<NodeIndex>(nodes_.size() - 1);
        }

        /** \brief Adds a node to the list of a level of a queue; see OpenList::push(). */
        void push(std::size_t queue, std::size_t level, double f, double h, NodeIndex index)
        {
            queues_[queue].open[level]->push(f, h, index);
        }

        /** \brief Removes the best entry of the list of a level of a queue, which must not be empty. It may be stale.
         */
        OpenList::Entry pop(std::size_t queue, std::size_t level)
        {
            return queues_[queue].open[level]->pop();
        }

        /** \brief Sorts all lists of the first queue again; see OpenList::rekey(). */
        bool rekey(const std::function<bool(OpenList::Entry &)> &key, const StopFunction &stop);

        /** \brief Whether no level has an open node. */
        bool isExhausted() const
        {
            return queues_.front().isEmpty();
        }

        /** \brief Number of alternating queues. */
        std::size_t queues() const
        {
            return queueCount_;
        }

        /** \brief Sets the number of alternating queues; new ones are empty. */
        void setQueues(std::size_t count);

        /** \brief The next queue among those that are not empty; a node must be open. */
        std::size_t chooseQueue();

        /** \brief The next level among those of a queue with open nodes. */
        std::size_t chooseLevel(std::size_t queue) const;

        /** \brief Counts a turn of the level, for chooseLevel(). */
        void countTurn(std::size_t queue, std::size_t level)
        {
            ++queues_[queue].turns[level];
            ++turns_;
        }

        /** \brief Number of calls of countTurn() since begin(). */
        std::uint64_t turns() const
        {
            return turns_;
        }

        /** \brief Work of the lists of all queues since begin(). */
        OpenList::Work work() const;

        /** \brief Upper limit of the bytes of nodes, cells and open entries, including growth. */
        std::size_t bytes() const;

        /** \brief Adds the pieces between a node and its root, as the car drives them on the goal's side. */
        void appendToRoot(NodeIndex index, Path &path) const;

        /** \brief The path from the root to a node, as the car drives it on the start's side. */
        Path pathTo(NodeIndex index) const;

        /** \brief The node whose position is nearest to that of \e target; NO_NODE without nodes. */
        NodeIndex nearestTo(const Pose &target) const;

        NodeIndex bestClosed{NO_NODE};  ///< the closed node to which the other side is joined, or at which it aims
        double bestClosedCost{0.0};     ///< value that bestClosed minimises
        std::uint64_t expansionsWhenExhausted{0};  ///< of both sides when this side ran out of open nodes
        ExpansionDensity density;                  ///< of the nodes expanded before the first solution

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

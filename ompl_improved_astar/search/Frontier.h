#pragma once

#include "ompl_improved_astar/search/Node.h"
#include "ompl_improved_astar/search/containers/CellTable.h"
#include "ompl_improved_astar/search/openlists/OpenList.h"
#include "parking_geometry/curves/Path.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace parking::search
{
    /** \brief One side of a search: the tree that grows from its roots, the cells that it occupies, and what is open, a
        list for each level of resolution. */
    class Frontier
    {
    public:
        explicit Frontier(Side side) : side_(side)
        {
        }
        Frontier(const Frontier &) = delete;
        Frontier &operator=(const Frontier &) = delete;

        /** \brief Forgets everything; memory is kept.

            \param turnsRatio each finer level gets so many times fewer turns */
        void begin(const std::string &openList, std::size_t levels, double turnsRatio);

        Side side() const
        {
            return side_;
        }

        NodeIndex addRoot(const Pose &pose);

        const std::vector<NodeIndex> &roots() const
        {
            return roots_;
        }
        std::vector<Pose> rootPoses() const;

        const std::vector<Node> &nodes() const
        {
            return nodes_;
        }
        Node &node(NodeIndex index)
        {
            return nodes_[index];
        }
        const Node &node(NodeIndex index) const
        {
            return nodes_[index];
        }

        /** \brief The node that holds a cell; NO_NODE when it is empty. */
        NodeIndex holderOf(std::uint64_t cell, std::size_t level) const
        {
            return cells_.find(keyOf(cell, level));
        }

        /** \brief Puts a node into a cell, as a new one or in the place of \e index. */
        NodeIndex place(const Node &node, NodeIndex index, std::uint64_t cell);

        void push(std::size_t level, double f, NodeIndex index)
        {
            open_[level]->push(f, nodes_[index].h, index);
        }
        OpenList::Entry pop(std::size_t level)
        {
            return open_[level]->pop();
        }

        /** \brief Nothing is open on any level. */
        bool isExhausted() const;

        /** \brief The level whose turn it is among those with open nodes; something must be open. */
        std::size_t chooseLevel() const;

        void countTurn(std::size_t level)
        {
            ++turns_[level];
        }

        /** \brief The open lists, one for each level. */
        const std::vector<std::unique_ptr<OpenList>> &openLists() const
        {
            return open_;
        }
        std::vector<std::unique_ptr<OpenList>> &openLists()
        {
            return open_;
        }

        /** \brief Adds the pieces between a node and its root, as the car drives them on the goal's side. */
        void appendToRoot(NodeIndex index, Path &path) const;

        /** \brief The path from the root to a node, as the car drives it on the start's side. */
        Path pathTo(NodeIndex index) const;

        /** \brief The node whose position is nearest to that of \e target; NO_NODE when there is none. */
        NodeIndex nearestTo(const Pose &target) const;

        NodeIndex bestClosed{NO_NODE};  ///< the closed node that the other side is joined with, or aims at
        double bestClosedCost{0.0};     ///< by which it is the best
        double rootMobility{std::numeric_limits<double>::infinity()};  ///< metres, of the most confined root
        std::uint64_t expansionsWhenExhausted{0};
        std::optional<Pose> aim;  ///< what its estimates count to, when it is not the other side's roots

    private:
        static std::uint64_t keyOf(std::uint64_t cell, std::size_t level)
        {
            return (static_cast<std::uint64_t>(level + 1) << 61) | cell;
        }

        Side side_;
        std::vector<Node> nodes_;
        CellTable cells_;
        std::vector<std::unique_ptr<OpenList>> open_;
        std::string openListName_;
        std::vector<std::uint64_t> turns_;
        double turnsRatio_{1.0};
        std::vector<NodeIndex> roots_;
    };
}  // namespace parking::search

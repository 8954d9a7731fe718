#pragma once

#include "ompl_improved_astar/search/Node.h"
#include "ompl_improved_astar/search/containers/CellTable.h"
#include "ompl_improved_astar/search/containers/Crowds.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <queue>
#include <tuple>
#include <vector>

namespace parking::search
{
    /** \brief The open nodes of a frontier in an order that asks for new places only: first what lies where there
        were the fewest expansions, and of these what was opened last.

        A place is a square with a sector of headings, as in Crowds. Costs and estimates do not count, so that no guide
        can draw it to the same places over and over (compare the cells of KPIECE: I. A. Sucan and L. E. Kavraki, "A
        sampling-based tree planner for systems with complex dynamics", 2012, and N. Lipovetzky and H. Geffner,
        "Best-first width search", 2017). */
    class Exploration
    {
    public:
        /** \brief An open node, and the level on which it waits. */
        struct Candidate
        {
            NodeIndex node{NO_NODE};  ///< none: nothing is open
            std::size_t level{0};     ///< of its resolution
        };

        /** \brief Forgets everything.

            \param side of a place, in metres
            \param sectors of headings, at most 16 */
        void begin(double side, unsigned int sectors);

        /** \brief Forgets all nodes. */
        void clear();

        /** \brief Notes that a node was expanded. */
        void noteExpansion(const Pose &pose, NodeIndex node);

        /** \brief The node that was noted last in the place of that pose; NO_NODE when there is none. */
        NodeIndex lastExpandedAt(const Pose &pose) const
        {
            return last_.find(counts_.placeOf(pose));
        }

        /** \brief Adds an open node. */
        void push(const Pose &pose, std::size_t level, NodeIndex node);

        /** \brief Takes out the node whose turn it is; NO_NODE when none waits. It may have been expanded since. */
        Candidate pop();

        /** \brief The most bytes that all of it takes, growing included. */
        std::size_t bytes() const;

    private:
        static constexpr std::uint32_t NOTHING = 0xffffffffu;

        /** An open node, on a stack of those in its place. */
        struct Item
        {
            NodeIndex node;
            std::uint32_t level;
            std::uint32_t number;  // the later the smaller
            std::uint32_t below;   // the item under it
        };

        /** What is open in a place, and what its entry in the queue says: others of the place have been overtaken. */
        struct Place
        {
            std::uint64_t key;
            std::uint32_t top{NOTHING};
            std::uint32_t expansions{0}, number{0};
        };

        /** A place in the queue. */
        struct Waiting
        {
            std::uint32_t expansions;  // in the place, when it was put here
            std::uint32_t number;      // of its newest node
            std::uint32_t place;

            bool operator>(const Waiting &other) const
            {
                return std::tie(expansions, number) > std::tie(other.expansions, other.number);
            }
        };

        std::uint32_t placeAt(std::uint64_t key);
        void enqueue(std::uint32_t place);

        static constexpr std::size_t FIRST_SLOTS = 1u << 8;  // most searches are never stuck

        Crowds counts_;
        CellTable last_{FIRST_SLOTS};
        CellTable indices_{FIRST_SLOTS};  // of places_
        std::vector<Place> places_;
        std::vector<Item> items_;
        std::uint32_t freeItem_{NOTHING};  // the first of those that nothing lies in
        std::priority_queue<Waiting, std::vector<Waiting>, std::greater<Waiting>> waiting_;
        std::uint32_t number_{0};
    };
}  // namespace parking::search

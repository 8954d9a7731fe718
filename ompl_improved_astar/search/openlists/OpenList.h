#pragma once

#include "ompl_improved_astar/search/Node.h"
#include "ompl_improved_astar/search/Registry.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace parking::search
{
    /** \brief The open list: entries in the order of f, then h, then insertion, so that equal inputs give equal
        searches. How the best one is found is what implementations differ in.

        Entries are never changed in place: a node that becomes cheaper is pushed again, and the owner drops the stale
        entry when it comes out (its f is above the node's). */
    class OpenList
    {
    public:
        /** \brief A node that waits, with what it is ordered by. */
        struct Entry
        {
            double f;                ///< weighted cost of the whole way, the smallest first
            double h;                ///< estimated cost of the way on, the smallest first among equal f
            std::uint32_t sequence;  ///< insertion number, the smallest first among equal f and h
            NodeIndex node;          ///< the node that waits
        };

        virtual ~OpenList() = default;

        /** \brief Does no entry wait, stale ones included? */
        bool empty() const
        {
            return entries_.empty();
        }

        /** \brief Number of entries, stale ones included. */
        std::size_t size() const
        {
            return entries_.size();
        }

        /** \brief Forgets the entries; memory is kept. */
        void clear()
        {
            entries_.clear();
            sequence_ = 0;
        }

        /** \brief Adds an entry. Neither f nor h may be NaN. */
        void push(double f, double h, NodeIndex node)
        {
            entries_.push_back({f, h, sequence_++, node});
            pushed();
        }

        /** \brief Removes and returns the best entry. The list must not be empty. */
        Entry pop()
        {
            moveBestToEnd();
            const Entry best = entries_.back();
            entries_.pop_back();
            return best;
        }

        /** \brief Gives every entry a new f: \e key changes the entry, and returns false for one to be dropped. */
        void rekey(const std::function<bool(Entry &)> &key);

        /** \brief In no order that means anything. */
        const std::vector<Entry> &entries() const
        {
            return entries_;
        }

    protected:
        /** \brief Does \e a come out after \e b? */
        static bool isAfter(const Entry &a, const Entry &b)
        {
            if (a.f != b.f)
                return a.f > b.f;
            if (a.h != b.h)
                return a.h > b.h;
            return a.sequence > b.sequence;
        }

        /** \brief Called when an entry has been put at the end. */
        virtual void pushed() = 0;

        /** \brief Called before the last entry is taken. */
        virtual void moveBestToEnd() = 0;

        /** \brief Called when all may have changed. */
        virtual void arrange() = 0;

        /** \brief What waits, in the order of the implementation. */
        std::vector<Entry> entries_;

    private:
        std::uint32_t sequence_{0};
    };

    /** \brief The open lists by name. */
    Registry<OpenList> &openLists();
}  // namespace parking::search

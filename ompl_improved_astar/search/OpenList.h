#pragma once

#include "ompl_improved_astar/search/Node.h"
#include "ompl_improved_astar/search/Registry.h"
#include "ompl_improved_astar/search/StopFunction.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace parking::search
{
    /** \brief The open list: entries in order of f, then h, then insertion, so that equal inputs give equal searches.
        Implementations differ in how they find the best entry.

        Entries are never changed in place: a node that becomes cheaper is pushed again, and the owner discards the
        stale entry when it is popped (its f exceeds the node's). */
    class OpenList
    {
    public:
        /** \brief An open node and its place in the order. */
        struct Entry
        {
            double f;                ///< priority, the smallest first
            double h;                ///< estimated cost of the rest, the smallest first among equal f
            std::uint32_t sequence;  ///< insertion number, the smallest first among equal f and h
            NodeIndex node;          ///< the open node
        };

        /** \brief Work since clear(), to compare kinds of lists. */
        struct Work
        {
            std::uint64_t operations{0};   ///< entries pushed and popped
            std::uint64_t comparisons{0};  ///< between two entries
        };

        virtual ~OpenList() = default;

        /** \brief Whether the list has no entry, not even a stale one. */
        bool empty() const
        {
            return entries_.empty();
        }

        /** \brief Number of entries, stale ones included. */
        std::size_t size() const
        {
            return entries_.size();
        }

        /** \brief Removes all entries; memory is kept. */
        void clear()
        {
            entries_.clear();
            sequence_ = 0;
            work_ = {};
        }

        /** \brief Adds an entry. Neither f nor h may be NaN. */
        void push(double f, double h, NodeIndex node)
        {
            ++work_.operations;
            entries_.push_back({f, h, sequence_++, node});
            pushed();
        }

        /** \brief Removes and returns the best entry. The list must not be empty. */
        Entry pop()
        {
            ++work_.operations;
            moveBestToEnd();
            const Entry best = entries_.back();
            entries_.pop_back();
            return best;
        }

        /** \brief Gives every entry a new f: \e key changes the entry, or returns false to drop it.

            \return false, and nothing has changed, if \e stop returned true */
        bool rekey(const std::function<bool(Entry &)> &key, const StopFunction &stop);

        /** \brief Work since clear(). */
        const Work &work() const
        {
            return work_;
        }

    protected:
        /** \brief Whether \e a is popped after \e b. Counts its calls. */
        bool isAfter(const Entry &a, const Entry &b)
        {
            ++work_.comparisons;
            if (a.f != b.f)
                return a.f > b.f;
            return a.h != b.h ? a.h > b.h : a.sequence > b.sequence;
        }

        /** \brief isAfter() as a function object for the algorithms of the standard library. */
        auto order()
        {
            return [this](const Entry &a, const Entry &b)
            {
                return isAfter(a, b);
            };
        }

        /** \brief Called after an entry was added at the end. */
        virtual void pushed() = 0;

        /** \brief Called before the last entry is popped. */
        virtual void moveBestToEnd() = 0;

        /** \brief Called after all entries may have changed. */
        virtual void rearrange() = 0;

        std::vector<Entry> entries_;  ///< in the order of the implementation

    private:
        std::uint32_t sequence_{0};
        Work work_;
    };

    /** \brief The open lists by name. */
    Registry<OpenList> &openLists();
}  // namespace parking::search

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
    /** \brief The open list: entries in the order of f, then h, then insertion, so that equal inputs give equal
        searches. How the best one is found is what implementations differ in.

        Entries are never changed in place: a node that becomes cheaper is pushed again, and the owner drops the stale
        entry when it comes out (its f is above the node's). */
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

        /** \brief What was done since clear(): the work that one kind of list has more of than another. */
        struct Work
        {
            std::uint64_t operations{0};   ///< entries that were pushed, and entries that were popped
            std::uint64_t comparisons{0};  ///< of two entries with each other
        };

        virtual ~OpenList() = default;

        /** \brief Is there no entry, stale ones included? */
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

        /** \brief Gives every entry a new f: \e key changes the entry, and returns false for one to be dropped.

            \return false, and nothing has changed, if \e stop says so meanwhile */
        bool rekey(const std::function<bool(Entry &)> &key, const StopFunction &stop);

        /** \brief What was done since clear(). */
        const Work &work() const
        {
            return work_;
        }

    protected:
        /** \brief Does \e a come out after \e b? Counts how often that is asked. */
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

        /** \brief Called when an entry has been put at the end. */
        virtual void pushed() = 0;

        /** \brief Called before the last entry is taken. */
        virtual void moveBestToEnd() = 0;

        /** \brief Called when all entries may have changed. */
        virtual void rearrange() = 0;

        std::vector<Entry> entries_;  ///< in the order of the implementation

    private:
        std::uint32_t sequence_{0};
        Work work_;
    };

    /** \brief The open lists by name. */
    Registry<OpenList> &openLists();
}  // namespace parking::search

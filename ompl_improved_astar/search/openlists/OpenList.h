#pragma once

#include "ompl_improved_astar/search/Node.h"
#include "ompl_improved_astar/search/Registry.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
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
            double f;                ///< weighted cost of the whole way, or what a detour goes by, the smallest first
            double h;                ///< estimated cost of the way on, the smallest first among equal f
            std::uint32_t sequence;  ///< insertion number, the smallest first among equal f and h
            NodeIndex node;          ///< the node that waits
        };

        /** \brief What was done since clear(): the work that one kind of list has more of than another. */
        struct Work
        {
            std::uint64_t operations{0};   ///< entries that were pushed, and entries that were popped
            std::uint64_t comparisons{0};  ///< of two entries with each other

            /** \brief Adds what another list has done. */
            Work &operator+=(const Work &other)
            {
                operations += other.operations;
                comparisons += other.comparisons;
                return *this;
            }
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
            kept_ = rekeyed_ = arranged_ = 0;
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

            \param most of a long list no more is done at a time: to so many entries something is done in each of two
            passes. Nothing may be pushed or popped until it is done
            \return whether it is done; else the next call goes on */
        bool rekey(const std::function<bool(Entry &)> &key, std::size_t most = std::numeric_limits<std::size_t>::max());

        /** \brief From now on rekey() begins anew, with what it has not dropped so far. */
        void beginRekeying();

        /** \brief What was done since clear(). */
        const Work &work() const
        {
            return work_;
        }

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

        /** \brief Calls \e arrangement with isAfter(), and counts how often that is asked. */
        template <class Arrangement>
        void counted(const Arrangement &arrangement)
        {
            std::uint64_t comparisons = 0;
            arrangement(
                [&comparisons](const Entry &a, const Entry &b)
                {
                    ++comparisons;
                    return isAfter(a, b);
                });
            work_.comparisons += comparisons;
        }

        /** \brief Called when an entry has been put at the end. */
        virtual void pushed() = 0;

        /** \brief Called before the last entry is taken. */
        virtual void moveBestToEnd() = 0;

        /** \brief Called for each entry from the last to the first when all may have changed: what comes after it is in
            order. */
        virtual void arrange(std::size_t place) = 0;

        /** \brief What waits, in the order of the implementation. */
        std::vector<Entry> entries_;

    private:
        std::uint32_t sequence_{0};
        std::size_t rekeyed_{0}, kept_{0};  // that rekey() has asked about so far, and of them, at the front, kept
        std::size_t arranged_{0};           // from the last on
        Work work_;
    };

    /** \brief The open lists by name. */
    Registry<OpenList> &openLists();
}  // namespace parking::search

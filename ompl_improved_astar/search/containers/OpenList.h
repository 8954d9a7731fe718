#pragma once

#include "ompl_improved_astar/search/SearchParameters.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace parking::search
{
    /** \brief The open list: entries in the order of f, then h, then insertion, so that equal inputs give equal
        searches.

        Entries are never changed in place: a node that becomes cheaper is pushed again, and the owner drops the stale
        entry when it comes out (its f is above the node's). */
    class OpenList
    {
    public:
        struct Entry
        {
            double f;
            double h;
            std::uint32_t sequence;
            std::uint32_t node;
        };

        explicit OpenList(OpenListKind kind = OpenListKind::BinaryHeap) : kind_(kind)
        {
        }

        bool empty() const
        {
            return entries_.empty();
        }
        std::size_t size() const
        {
            return entries_.size();
        }
        void clear()
        {
            entries_.clear();
            sequence_ = 0;
        }

        void push(double f, double h, std::uint32_t node)
        {
            entries_.push_back({f, h, sequence_++, node});
            if (kind_ == OpenListKind::BinaryHeap)
                std::push_heap(entries_.begin(), entries_.end(), isAfter);
        }

        /** \brief Removes and returns the best entry. The list must not be empty. */
        Entry pop()
        {
            if (kind_ == OpenListKind::BinaryHeap)
                std::pop_heap(entries_.begin(), entries_.end(), isAfter);
            else
                std::iter_swap(std::max_element(entries_.begin(), entries_.end(), isAfter), entries_.end() - 1);
            const Entry best = entries_.back();
            entries_.pop_back();
            return best;
        }

        /** \brief The best entry without removing it. The list must not be empty. */
        const Entry &top() const
        {
            return kind_ == OpenListKind::BinaryHeap ? entries_.front()
                                                     : *std::max_element(entries_.begin(), entries_.end(), isAfter);
        }

        /** \brief Sorts anew after \e key has given every entry a new f; entries for which it returns false are
            dropped. */
        template <class Key>
        void rekey(const Key &key)
        {
            entries_.erase(
                std::remove_if(entries_.begin(), entries_.end(), [&key](Entry &entry) { return !key(entry); }),
                entries_.end());
            if (kind_ == OpenListKind::BinaryHeap)
                std::make_heap(entries_.begin(), entries_.end(), isAfter);
        }

        const std::vector<Entry> &entries() const
        {
            return entries_;
        }

    private:
        static bool isAfter(const Entry &a, const Entry &b)
        {
            if (a.f != b.f)
                return a.f > b.f;
            if (a.h != b.h)
                return a.h > b.h;
            return a.sequence > b.sequence;
        }

        OpenListKind kind_;
        std::uint32_t sequence_{0};
        std::vector<Entry> entries_;
    };
}  // namespace parking::search

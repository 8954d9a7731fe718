#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace parking::search
{
    /** \brief A priority queue for whole priorities that do not fall below the one taken last, as those of A* with a
        consistent heuristic.

        A radix heap (R. K. Ahuja, K. Mehlhorn, J. Orlin, R. E. Tarjan, "Faster algorithms for the shortest path
        problem", 1990): the bucket of an item is the highest bit in which its priority differs from the one taken last.
        When bucket 0 is empty, the first other bucket is distributed over those before it, so that an item moves 32
        times at most. Of equal priorities the latest item usually comes first. Memory is kept by clear(). */
    template <class Item>
    class MonotoneQueue
    {
    public:
        /** \brief Is the queue empty? */
        bool empty() const
        {
            return size_ == 0;
        }

        /** \brief Number of items. */
        std::size_t size() const
        {
            return size_;
        }

        /** \brief Upper limit of the bytes of the items, old and new arrays of growing buckets together. */
        std::size_t bytes() const
        {
            constexpr std::size_t GROWING = 3;
            return GROWING * size_ * sizeof(Entry);
        }

        /** \brief Removes all items; the next priorities may be small again. */
        void clear()
        {
            for (std::vector<Entry> &bucket : buckets_)
                bucket.clear();
            size_ = 0;
            last_ = 0;
        }

        /** \brief Adds an item.

            \param priority raised to the priority taken last if it is below that */
        void push(std::uint32_t priority, const Item &item)
        {
            place({std::max(priority, last_), item});
            ++size_;
        }

        /** \brief Removes and returns an item of the smallest priority. The queue must not be empty. */
        Item pop()
        {
            if (buckets_[0].empty())
                fillFirstBucket();
            const Item item = buckets_[0].back().item;
            buckets_[0].pop_back();
            --size_;
            return item;
        }

        /** \brief Changes the priorities of all items, also to smaller ones than that taken last.

            \param renew gets an item and its priority, to be set; returns whether the item is kept */
        template <class Renew>
        void renewAll(const Renew &renew)
        {
            std::vector<Entry> entries;
            entries.reserve(size_);
            for (const std::vector<Entry> &bucket : buckets_)
                entries.insert(entries.end(), bucket.begin(), bucket.end());
            clear();
            for (Entry &each : entries)
                if (renew(each.item, each.priority))
                    push(each.priority, each.item);
        }

    private:
        struct Entry
        {
            std::uint32_t priority;
            Item item;
        };

        void place(const Entry &entry)
        {
            const std::uint32_t difference = entry.priority ^ last_;
            buckets_[difference == 0 ? 0 : 32 - __builtin_clz(difference)].push_back(entry);
        }

        void fillFirstBucket()
        {
            std::vector<Entry> &bucket = *std::find_if(buckets_.begin(), buckets_.end(),
                                                       [](const std::vector<Entry> &each) { return !each.empty(); });
            last_ = std::min_element(bucket.begin(), bucket.end(),
                                     [](const Entry &a, const Entry &b) { return a.priority < b.priority; })
                        ->priority;
            for (const Entry &each : bucket)
                place(each);
            bucket.clear();
        }

        std::array<std::vector<Entry>, 33> buckets_;
        std::size_t size_{0};
        std::uint32_t last_{0};  // the priority taken last
    };
}  // namespace parking::search

#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace parking::search
{
    /** \brief A priority queue for integer priorities that do not fall below the last one popped, as in A* with a
        consistent heuristic.

        A radix heap (R. K. Ahuja et al., "Faster algorithms for the shortest path problem", 1990): an item's bucket is
        the highest bit in which its priority differs from the one popped last, so that it moves to lower buckets only.
        Of equal priorities the latest usually comes first. */
    template <class Item>
    class MonotoneQueue
    {
    public:
        /** \brief Whether the queue is empty. */
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
            return 3 * size_ * sizeof(Entry);
        }

        /** \brief Removes all items; the next priorities may be small again. Memory is kept. */
        void clear()
        {
            for (std::vector<Entry> &bucket : buckets_)
                bucket.clear();
            size_ = 0;
            last_ = 0;
        }

        /** \brief Adds an item. A priority below the one popped last counts as equal to it. */
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
            Item item = buckets_[0].back().item;
            buckets_[0].pop_back();
            --size_;
            return item;
        }

        /** \brief Removes and returns all items; the next priorities may be small again. */
        std::vector<Item> takeAll()
        {
            std::vector<Item> items;
            items.reserve(size_);
            for (const std::vector<Entry> &bucket : buckets_)
                for (const Entry &each : bucket)
                    items.push_back(each.item);
            clear();
            return items;
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
            const auto isUsed = [](const std::vector<Entry> &bucket)
            {
                return !bucket.empty();
            };
            std::vector<Entry> &bucket = *std::find_if(buckets_.begin(), buckets_.end(), isUsed);
            last_ = bucket.front().priority;
            for (const Entry &each : bucket)
                last_ = std::min(last_, each.priority);
            for (const Entry &each : bucket)
                place(each);
            bucket.clear();
        }

        std::array<std::vector<Entry>, 33> buckets_;
        std::size_t size_{0};
        std::uint32_t last_{0};  // the priority popped last
    };
}  // namespace parking::search

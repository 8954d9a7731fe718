#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace parking::search
{
    /** \brief A priority queue for priorities that rarely fall below the one taken last, as those of A* with a
        consistent heuristic: exact for all others, too, but not faster than a heap for them.

        Items wait unsorted in buckets by their priority; only those of the bucket whose turn it is are kept as a heap,
        which is small (after R. B. Dial, "Algorithm 360: shortest-path forest with topological ordering", 1969, with a
        heap within the bucket so that the order is exact). Memory is kept by clear().

        \tparam Item has \c key, an unsigned number: the one with the smallest comes out first. Items of larger priority
        must not have smaller keys. */
    template <class Item>
    class MonotoneQueue
    {
    public:
        MonotoneQueue()
        {
            first_.fill(NONE);
        }

        /** \brief Is there nothing to take? */
        bool empty() const
        {
            return heap_.empty() && inRing_ == 0 && beyond_.empty();
        }

        /** \brief Bytes in use. */
        std::size_t bytes() const
        {
            return heap_.capacity() * sizeof(Item) + (pool_.capacity() + beyond_.capacity()) * sizeof(Waiting);
        }

        /** \brief Forgets the items; memory is kept, and priorities may be small again. */
        void clear()
        {
            if (inRing_ > 0)
                first_.fill(NONE);
            inRing_ = 0;
            current_ = 0;
            heap_.clear();
            pool_.clear();
            beyond_.clear();
            unused_ = NONE;
        }

        /** \brief Adds an item.

            \param priority finite, not negative
            \param item its key grows with the priority */
        void push(float priority, const Item &item)
        {
            const std::uint64_t bucket = bucketOf(priority);
            if (bucket <= current_)
            {
                heap_.push_back(item);
                std::push_heap(heap_.begin(), heap_.end(), After());
            }
            else
                keep({item, bucket, NONE});
        }

        /** \brief Takes the first item. The queue must not be empty. */
        Item pop()
        {
            if (heap_.empty())
                nextBucket();
            std::pop_heap(heap_.begin(), heap_.end(), After());
            const Item item = heap_.back();
            heap_.pop_back();
            return item;
        }

        /** \brief Number of items. */
        std::size_t size() const
        {
            return heap_.size() + inRing_ + beyond_.size();
        }

        /** \brief Gives all items new priorities, which may be smaller than any before.

            \param renew gets an item, sets its key, and returns its priority; a negative one drops the item */
        template <class Renew>
        void renewAll(const Renew &renew)
        {
            std::vector<Item> items;
            items.reserve(size());
            items.insert(items.end(), heap_.begin(), heap_.end());
            for (std::size_t k = 0, left = inRing_; left > 0; ++k)
                for (std::uint32_t place = first_[k]; place != NONE; place = pool_[place].next, --left)
                    items.push_back(pool_[place].item);
            for (const Waiting &each : beyond_)
                items.push_back(each.item);
            clear();
            std::vector<float> priorities(items.size());
            std::transform(items.begin(), items.end(), priorities.begin(), renew);
            float least = -1.0f;
            for (const float priority : priorities)
                if (priority >= 0.0f && (least < 0.0f || priority < least))
                    least = priority;
            current_ = least < 0.0f ? 0 : bucketOf(least);
            for (std::size_t k = 0; k < items.size(); ++k)
                if (priorities[k] >= 0.0f)
                    push(priorities[k], items[k]);
        }

    private:
        static constexpr float PER_UNIT = 32.0f;     // buckets
        static constexpr std::uint64_t RING = 1024;  // buckets that are told apart at a time, a power of two
        static constexpr std::uint32_t NONE = 0xffffffffu;

        static std::uint64_t bucketOf(float priority)
        {
            return static_cast<std::uint64_t>(priority * PER_UNIT);
        }

        struct Waiting
        {
            Item item;
            std::uint64_t bucket;
            std::uint32_t next;  // in the same bucket, or of the unused ones
        };

        struct After
        {
            bool operator()(const Item &a, const Item &b) const
            {
                return a.key > b.key;
            }
        };

        void keep(Waiting waiting)
        {
            if (waiting.bucket >= current_ + RING)
            {
                beyond_.push_back(waiting);
                return;
            }
            std::uint32_t place = unused_;
            if (place != NONE)
                unused_ = pool_[place].next;
            else
            {
                place = static_cast<std::uint32_t>(pool_.size());
                pool_.emplace_back();
            }
            std::uint32_t &first = first_[waiting.bucket % RING];
            waiting.next = first;
            pool_[place] = waiting;
            first = place;
            ++inRing_;
        }

        /** Makes the next bucket with anything in it the current one. */
        void nextBucket()
        {
            if (inRing_ == 0)
                current_ = leastBeyond() - 1;
            for (bool some = false; !some;)
            {
                ++current_;
                if (!beyond_.empty() && (inRing_ == 0 || current_ % (RING / 2) == 0))
                    sortBeyond();
                some = first_[current_ % RING] != NONE;
            }
            std::uint32_t &first = first_[current_ % RING];
            while (first != NONE)
            {
                Waiting &waiting = pool_[first];
                heap_.push_back(waiting.item);
                const std::uint32_t next = waiting.next;
                waiting.next = unused_;
                unused_ = first;
                first = next;
                --inRing_;
            }
            std::make_heap(heap_.begin(), heap_.end(), After());
        }

        std::uint64_t leastBeyond() const
        {
            return std::min_element(beyond_.begin(), beyond_.end(),
                                    [](const Waiting &a, const Waiting &b) { return a.bucket < b.bucket; })
                ->bucket;
        }

        /** Moves what has come within reach into the ring. */
        void sortBeyond()
        {
            const auto far = std::partition(beyond_.begin(), beyond_.end(),
                                            [this](const Waiting &each) { return each.bucket >= current_ + RING; });
            std::vector<Waiting> near(far, beyond_.end());
            beyond_.erase(far, beyond_.end());
            for (const Waiting &each : near)
                keep(each);
        }

        std::uint64_t current_{0};
        std::vector<Item> heap_;  // of the current bucket and of what came in below it
        std::array<std::uint32_t, RING> first_;
        std::size_t inRing_{0};
        std::vector<Waiting> pool_;
        std::uint32_t unused_{NONE};
        std::vector<Waiting> beyond_;  // what lies beyond the ring
    };
}  // namespace parking::search

#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace parking::search
{
    /** \brief A priority queue for whole priorities that never fall below the one taken last, as those of A* with a
        consistent heuristic.

        Items wait in one bucket for each priority, so that adding and taking cost the same however many there are
        (R. B. Dial, "Algorithm 360: shortest-path forest with topological ordering", 1969). Of equal priorities the
        one added last comes out first. Memory is kept by clear(). */
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
            return inRing_ == 0 && beyond_.empty();
        }

        /** \brief Number of items. */
        std::size_t size() const
        {
            return inRing_ + beyond_.size();
        }

        /** \brief The most bytes that the items since clear() take up to the next growth, old and new arrays
            together. */
        std::size_t bytes() const
        {
            constexpr std::size_t GROWING = 3;
            return GROWING * (pool_.size() + beyond_.size()) * sizeof(Waiting);
        }

        /** \brief Forgets the items; memory is kept, and priorities may be small again. */
        void clear()
        {
            if (inRing_ > 0)
                first_.fill(NONE);
            inRing_ = 0;
            current_ = 0;
            pool_.clear();
            beyond_.clear();
            unused_ = NONE;
        }

        /** \brief Adds an item.

            \param priority what is below the priority taken last counts as equal to it */
        void push(std::uint32_t priority, const Item &item)
        {
            keep({item, std::max(priority, current_), NONE});
        }

        /** \brief Takes an item of the smallest priority. The queue must not be empty. */
        Item pop()
        {
            if (first_[current_ % RING] == NONE)
                nextBucket();
            std::uint32_t &first = first_[current_ % RING];
            const std::uint32_t place = first;
            Waiting &waiting = pool_[place];
            first = waiting.next;
            waiting.next = unused_;
            unused_ = place;
            --inRing_;
            return waiting.item;
        }

        /** \brief Gives all items new priorities, which may be smaller than any before.

            \param renew gets an item and its priority, to be set; returns whether the item is to be kept */
        template <class Renew>
        void renewAll(const Renew &renew)
        {
            std::vector<Waiting> items;
            items.reserve(size());
            for (std::size_t k = 0, left = inRing_; left > 0; ++k)
                for (std::uint32_t place = first_[k]; place != NONE; place = pool_[place].next, --left)
                    items.push_back(pool_[place]);
            items.insert(items.end(), beyond_.begin(), beyond_.end());
            clear();
            items.erase(std::remove_if(items.begin(), items.end(),
                                       [&renew](Waiting &each) { return !renew(each.item, each.priority); }),
                        items.end());
            if (items.empty())
                return;
            current_ = leastOf(items);
            for (const Waiting &each : items)
                keep(each);
        }

    private:
        static constexpr std::uint32_t RING = 1024;  // priorities that are told apart at a time, a power of two
        static constexpr std::uint32_t NONE = 0xffffffffu;

        struct Waiting
        {
            Item item;
            std::uint32_t priority;
            std::uint32_t next;  // in the same bucket, or of the unused ones
        };

        void keep(Waiting waiting)
        {
            if (waiting.priority >= current_ + RING)
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
            std::uint32_t &first = first_[waiting.priority % RING];
            waiting.next = first;
            pool_[place] = waiting;
            first = place;
            ++inRing_;
        }

        /** Goes on to the next priority that anything waits with. */
        void nextBucket()
        {
            if (inRing_ == 0)
            {
                current_ = leastOf(beyond_);
                sortBeyond();
            }
            while (first_[current_ % RING] == NONE)
            {
                ++current_;
                if (!beyond_.empty() && current_ % (RING / 2) == 0)
                    sortBeyond();
            }
        }

        static std::uint32_t leastOf(const std::vector<Waiting> &items)
        {
            return std::min_element(items.begin(), items.end(),
                                    [](const Waiting &a, const Waiting &b) { return a.priority < b.priority; })
                ->priority;
        }

        /** Moves what has come within reach into the ring. */
        void sortBeyond()
        {
            const auto far = std::partition(beyond_.begin(), beyond_.end(),
                                            [this](const Waiting &each) { return each.priority >= current_ + RING; });
            std::vector<Waiting> near(far, beyond_.end());
            beyond_.erase(far, beyond_.end());
            for (const Waiting &each : near)
                keep(each);
        }

        std::uint32_t current_{0};
        std::array<std::uint32_t, RING> first_;  // of each bucket, by priority
        std::size_t inRing_{0};
        std::vector<Waiting> pool_;
        std::uint32_t unused_{NONE};
        std::vector<Waiting> beyond_;  // what lies beyond the ring
    };
}  // namespace parking::search

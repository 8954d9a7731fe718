#pragma once

#include "ompl_improved_astar/search/openlists/OpenList.h"

#include <algorithm>
#include <cstddef>

namespace parking::search
{
    /** \brief The best entry in logarithmic time (paper, "Binary Heap"). */
    class BinaryHeap final : public OpenList
    {
    protected:
        void pushed() override
        {
            counted([this](const auto &isAfter) { std::push_heap(entries_.begin(), entries_.end(), isAfter); });
        }

        void moveBestToEnd() override
        {
            counted([this](const auto &isAfter) { std::pop_heap(entries_.begin(), entries_.end(), isAfter); });
        }

        void arrange(std::size_t place) override
        {
            counted([this, place](const auto &isAfter) { sift(place, isAfter); });
        }

    private:
        /** Lets an entry sink among those below it: to the bottom, always past the better child, and up again from
            there, which takes fewer comparisons than to ask at each step whether it has sunk far enough. */
        template <class IsAfter>
        void sift(std::size_t place, const IsAfter &isAfter)
        {
            const Entry entry = entries_[place];
            std::size_t gap = place;
            for (std::size_t child = 2 * gap + 2; child <= entries_.size(); child = 2 * gap + 2)
            {
                if (child == entries_.size() || isAfter(entries_[child], entries_[child - 1]))
                    --child;
                entries_[gap] = entries_[child];
                gap = child;
            }
            for (; gap > place && isAfter(entries_[(gap - 1) / 2], entry); gap = (gap - 1) / 2)
                entries_[gap] = entries_[(gap - 1) / 2];
            entries_[gap] = entry;
        }
    };
}  // namespace parking::search

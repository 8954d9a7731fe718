#pragma once

#include "ompl_improved_astar/search/openlists/OpenList.h"

#include <algorithm>

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

        void arrange() override
        {
            counted([this](const auto &isAfter) { std::make_heap(entries_.begin(), entries_.end(), isAfter); });
        }
    };
}  // namespace parking::search

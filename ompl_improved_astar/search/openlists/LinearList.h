#pragma once

#include "ompl_improved_astar/search/openlists/OpenList.h"

#include <algorithm>

namespace parking::search
{
    /** \brief A scan of the whole list for the best entry, as in the plain A* of the paper's comparison. */
    class LinearList final : public OpenList
    {
    protected:
        void pushed() override
        {
        }

        void moveBestToEnd() override
        {
            counted(
                [this](const auto &isAfter)
                { std::iter_swap(std::max_element(entries_.begin(), entries_.end(), isAfter), entries_.end() - 1); });
        }

        void arrange(std::size_t /*place*/) override
        {
        }
    };
}  // namespace parking::search

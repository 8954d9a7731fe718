#pragma once

#include "ompl_improved_astar/search/SearchParameters.h"

namespace parking_test
{
    /** \brief Stops what is asked for the so-many-th time and always from then on, so that a search that would never
        end fails its test instead of hanging. What ends by itself asks far less often than by default. */
    inline parking::search::StopFunction afterAsking(int times = 300000)
    {
        return [times, asked = 0]() mutable
        {
            return ++asked > times;
        };
    }
}  // namespace parking_test

#pragma once

#include "ompl_improved_astar/search/StopFunction.h"

#include <cstdint>

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

    /** \brief Stops once \e planner, which must outlive it, has expanded more nodes than that, or as afterAsking(). */
    template <class Planner>
    parking::search::StopFunction afterExpanding(const Planner &planner, std::uint64_t most)
    {
        return [&planner, most, asked = afterAsking()]
        {
            return planner.expanded() > most || asked();
        };
    }
}  // namespace parking_test

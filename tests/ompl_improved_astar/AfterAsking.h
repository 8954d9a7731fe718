#pragma once

#include "ompl_improved_astar/search/StopFunction.h"

#include <cstdint>

namespace parking_test
{
    /** \brief Stops after that many polls: a search that never ends fails its test instead of hanging. */
    inline parking::search::StopFunction afterAsking(int times = 300000)
    {
        return [times, asked = 0]() mutable
        {
            return ++asked > times;
        };
    }

    /** \brief Stops once \e planner, which must outlive it, has expanded more nodes, or as afterAsking(). */
    template <class Planner>
    parking::search::StopFunction afterExpanding(const Planner &planner, std::uint64_t most)
    {
        return [&planner, most, asked = afterAsking()]
        {
            return planner.expanded() > most || asked();
        };
    }
}  // namespace parking_test

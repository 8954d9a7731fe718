#pragma once

#include "ompl_improved_astar/search/models/Grid8.h"

#include <vector>

namespace parking::search
{
    /** \brief The eight neighbours and the knight's moves between them (paper, "Neighborhood Expansion"). */
    inline std::vector<GridStep> grid16Steps()
    {
        std::vector<GridStep> steps = grid8Steps();
        for (const GridStep &step : {GridStep{2, 1}, {1, 2}, {-1, 2}, {-2, 1}, {-2, -1}, {-1, -2}, {1, -2}, {2, -1}})
            steps.push_back(step);
        return steps;
    }
}  // namespace parking::search

#pragma once

#include "ompl_improved_astar/search/models/Grid16.h"

#include <vector>

namespace parking::search
{
    /** \brief The sixteen neighbours and, between each two of them, a step of three cells: headings 7 to 11 degrees
        apart. */
    inline std::vector<GridStep> grid32Steps()
    {
        std::vector<GridStep> steps = grid16Steps();
        for (const GridStep &step : {GridStep{3, 1}, {3, 2}, {2, 3}, {1, 3}, {-1, 3}, {-2, 3}, {-3, 2}, {-3, 1}})
        {
            steps.push_back(step);
            steps.push_back({-step.columns, -step.rows});
        }
        return steps;
    }
}  // namespace parking::search

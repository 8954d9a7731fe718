#pragma once

#include "ompl_improved_astar/search/models/GridModel.h"

#include <vector>

namespace parking::search
{
    /** \brief The eight neighbours of a cell, in the order of their directions. */
    inline std::vector<GridStep> grid8Steps()
    {
        return {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
    }
}  // namespace parking::search

#pragma once

#include "parking_geometry/Box.h"
#include "parking_geometry/OccupancyGrid.h"
#include "parking_geometry/Polygon.h"

#include <vector>

namespace parking
{
    /** \brief The outlines of all cells of one kind within a window: far fewer shapes than cells, without seams.

        Outer outlines run counter-clockwise and holes clockwise, in the frame that the grid's origin is given in;
        filled by the even-odd rule they cover exactly the cells.

        \param window only cells near it are taken, in the same frame */
    std::vector<Polygon> outlineCells(const OccupancyGrid &grid, Cell kind, const Box &window);
}  // namespace parking

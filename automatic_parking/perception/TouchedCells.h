#pragma once

#include "parking_geometry/OccupancyGrid.h"
#include "parking_geometry/Polygon.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace parking
{
    /** \brief Called with the index of a touched cell and, for cells on the outline, the number of the polygon's edge
        that crosses it; otherwise with INNER_CELL. */
    using VisitCell = std::function<void(std::size_t cell, std::size_t edge)>;

    /** \brief Edge number of cells with a centre inside of the polygon. */
    constexpr std::size_t INNER_CELL = static_cast<std::size_t>(-1);

    /** \brief Corners of a polygon in the frame of \e map, in cells instead of metres, counter-clockwise. */
    Polygon inCells(const OccupancyGrid &map, const Polygon &polygon);

    /** \brief Visits every cell of \e map that a solid polygon touches; some of them several times.

        A cell whose border the polygon only touches from outside is not visited, and overlaps below a nanometre may be
        missed. The visited cells then cover the polygon up to that length.

        \param polygon the result of inCells(); parts outside of the map are ignored */
    void visitTouchedCells(const OccupancyGrid &map, const Polygon &polygon, const VisitCell &visit);
}  // namespace parking

#pragma once

#include "parking_geometry/Polygon.h"

#include <vector>

namespace parking
{
    /** \brief Cuts a simple counter-clockwise polygon into convex counter-clockwise pieces that cover it exactly.

        The function clips ears (G. H. Meisters, "Polygons have ears", 1975). It then joins triangles across every
        diagonal that leaves the result convex (S. Hertel and K. Mehlhorn, 1983). The number of pieces is at most four
        times the minimum. Pieces without area are dropped.

        Throws parking::Error if the outline crosses itself. */
    std::vector<Polygon> convexPieces(const Polygon &polygon);
}  // namespace parking

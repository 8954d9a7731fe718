#pragma once

#include "parking_geometry/Polygon.h"

#include <vector>

namespace parking
{
    /** \brief Cuts a simple counter-clockwise polygon into convex counter-clockwise pieces that cover it exactly.

        Ears are clipped (G. H. Meisters, "Polygons have ears", 1975) and triangles joined again across every diagonal
        that leaves the result convex (S. Hertel and K. Mehlhorn, 1983), at most four times the smallest number of
        pieces. Pieces of no area are dropped.

        Throws parking::Error when the outline crosses itself. */
    std::vector<Polygon> convexPieces(const Polygon &polygon);
}  // namespace parking

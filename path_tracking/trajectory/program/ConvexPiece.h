#pragma once

#include "state_validity/ObstacleSet.h"

#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief A convex obstacle: its corners and the lines of its sides. */
    struct ConvexPiece
    {
        std::vector<Eigen::Vector2d> corners;  ///< metres, counter-clockwise, no two of them in one place
        std::vector<Eigen::Vector2d> normals;  ///< outwards, of unit length; side k leads from corner k to the next
        std::vector<double> offsets;           ///< normals[k] . p = offsets[k] on side k
        Box box;                               ///< bounding box of the corners

        /** \brief Creates a piece from corners in counter-clockwise order. Sides shorter than a micrometre are
            removed. */
        explicit ConvexPiece(std::vector<Eigen::Vector2d> corners);
    };

    /** \brief The obstacles of a world as convex pieces, in its local frame. Four rectangles represent the outside of
        the bounds. Throws parking::Error as convexPieces() does. */
    std::vector<ConvexPiece> convexPieces(const ObstacleSet &obstacles);
}  // namespace parking

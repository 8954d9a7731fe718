#pragma once

#include "state_validity/Body.h"
#include "state_validity/ObstacleSet.h"

#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief A convex obstacle or part of a body: its corners and the lines of its sides.

        An obstacle that is hardly wider than a line or a point has the sides of its bounding rectangle. */
    struct ConvexPiece
    {
        std::vector<Eigen::Vector2d> corners;  ///< metres, counter-clockwise, no two of them in one place
        /** Outwards, of unit length. Unless the piece is thin, side k leads from corner k to the next. */
        std::vector<Eigen::Vector2d> normals;
        std::vector<double> offsets;  ///< normals[k] . p = offsets[k] on side k
        Box box;                      ///< bounding box of the corners
        bool isThin{false};           ///< whether its width is at most ten micrometres

        /** \brief Creates a piece from corners in counter-clockwise order, at least one. Sides shorter than a
            micrometre are removed. */
        explicit ConvexPiece(std::vector<Eigen::Vector2d> corners);
    };

    /** \brief A body as convex parts in the frame of the car, whose origin is the middle of the rear axle. A rectangle
       is one part with the sides front, left, rear and right. */
    std::vector<ConvexPiece> partsOf(const Body &body);

    /** \brief The obstacles of a world as convex pieces, in its local frame. Four rectangles represent the outside of
        the bounds. Throws parking::Error as convexPieces() does. */
    std::vector<ConvexPiece> convexPieces(const ObstacleSet &obstacles);
}  // namespace parking

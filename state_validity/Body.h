#pragma once

#include "parking_geometry/OrientedBox.h"
#include "parking_geometry/Polygon.h"
#include "parking_geometry/Vehicle.h"

#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief A convex piece of a body that can be enlarged: corners and sides, counter-clockwise.

        To enlarge the piece, each side moves outwards. A corner sharper than a right angle is two corners in one place
        with a side of no length between them, which cuts off the tip of the enlarged piece. No point of it is therefore
        farther from the piece than sqrt(2) times the enlargement. */
    struct BodyPiece
    {
        /** \brief A side and the corner at which it begins. */
        struct Side
        {
            Eigen::Vector2d corner;    ///< metres
            Eigen::Vector2d outwards;  ///< displacement of the corner per metre of enlargement
            Eigen::Vector2d normal;    ///< of the side, outwards, of unit length
            double offset;             ///< of the side along its normal, metres
        };

        std::vector<Side> sides;  ///< counter-clockwise

        /** \brief Corner \e index, counted round the piece, after an enlargement by \e more metres. */
        Eigen::Vector2d corner(std::size_t index, double more) const
        {
            const Side &side = sides[index < sides.size() ? index : 0];
            return side.corner + more * side.outwards;
        }
    };

    /** \brief The body of a vehicle, enlarged by a margin: a rectangle, or convex pieces in a bounding rectangle.

        The pieces cover the outline of the vehicle exactly; each is enlarged as BodyPiece describes. The enlarged body
        contains all points within the margin of the outline, and none farther than sqrt(2) times the margin.

        Lengths are in metres, and the frame is that of the bounding rectangle: its centre lies
        Vehicle::centreOffset() ahead of the rear axle, and x points forwards. */
    struct Body
    {
        /** \brief The body of \e vehicle. Throws parking::Error for an invalid vehicle or margin. */
        Body(const Vehicle &vehicle, double margin);

        /** \brief The bounding rectangle for a rear axle at \e pose. */
        OrientedBox at(const Pose &pose) const
        {
            return bodyAt(pose, centreOffset, halfLength, halfWidth);
        }

        /** \brief Radius of the largest circle in the body about the point \e offset metres ahead of its centre; minus
            infinity if this point is outside. */
        double depthAt(double offset) const;

        /** \brief Distance of the farthest point of the body between two lines across it from the point half way
            between them on the axis; minus infinity if there is none. */
        double reachBetween(double rear, double front) const;

        /** \brief The corners of the pieces; none for a rectangle. */
        std::vector<Polygon> polygons() const;

        double centreOffset;              ///< of the centre ahead of the rear axle
        double halfLength;                ///< half length of the bounding rectangle
        double halfWidth;                 ///< half width of the bounding rectangle
        std::vector<BodyPiece> pieces;    ///< none for a rectangle
        Eigen::Vector2d inner{0.0, 0.0};  ///< a point inside, not near the outline

    private:
        Polygon outline_;
        double margin_;
    };
}  // namespace parking

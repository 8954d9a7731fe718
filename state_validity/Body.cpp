#include "state_validity/Body.h"

#include "parking_geometry/text/Require.h"
#include "state_validity/ConvexDecomposition.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        double checked(const Vehicle &vehicle, double margin)
        {
            vehicle.validate();
            Require("footprint checker").notNegative("safety margin", margin, "metres");
            return margin;
        }

        Eigen::Vector2d normalOf(const Eigen::Vector2d &from, const Eigen::Vector2d &to)
        {
            return Eigen::Vector2d(to.y() - from.y(), from.x() - to.x()).normalized();
        }

        /** The displacement that moves a corner along with both of its sides. */
        Eigen::Vector2d mitre(const Eigen::Vector2d &before, const Eigen::Vector2d &after)
        {
            return (before + after) / (1.0 + before.dot(after));
        }

        /** The piece with these corners, enlarged by \e margin. */
        BodyPiece pieceOf(const Polygon &corners, double margin)
        {
            BodyPiece piece;
            const std::size_t count = corners.size();
            const auto add =
                [&](const Eigen::Vector2d &corner, const Eigen::Vector2d &before, const Eigen::Vector2d &normal)
            {
                const Eigen::Vector2d outwards = mitre(before, normal);
                piece.sides.push_back({corner + margin * outwards, outwards, normal, normal.dot(corner) + margin});
            };
            for (std::size_t i = 0; i < count; ++i)
            {
                const Eigen::Vector2d &corner = corners[i];
                const Eigen::Vector2d before = normalOf(corners[(i + count - 1) % count], corner);
                const Eigen::Vector2d after = normalOf(corner, corners[(i + 1) % count]);
                if (before.dot(after) < -1e-9)
                {
                    // Perpendicular to the direction half way between the normals, which is stable for spikes too.
                    const Eigen::Vector2d along = before - after;
                    const Eigen::Vector2d tip = Eigen::Vector2d(-along.y(), along.x()).normalized();
                    add(corner, before, tip);
                    add(corner, tip, after);
                }
                else
                    add(corner, before, after);
            }
            return piece;
        }

        /** Clips a segment to x within [rear, front]. \return false if no part is left */
        bool clip(Eigen::Vector2d &from, Eigen::Vector2d &to, double rear, double front)
        {
            if (std::max(from.x(), to.x()) < rear || std::min(from.x(), to.x()) > front)
                return false;
            const Eigen::Vector2d begin = from, along = to - from;
            for (Eigen::Vector2d *const end : {&from, &to})
                if (const double x = std::clamp(end->x(), rear, front); x != end->x())
                    *end = {x, begin.y() + along.y() * ((x - begin.x()) / along.x())};
            return true;
        }
    }  // namespace

    Body::Body(const Vehicle &vehicle, double margin)
      : centreOffset(vehicle.centreOffset()),
        halfLength(0.5 * vehicle.length() + margin),
        halfWidth(0.5 * vehicle.width + margin),
        outline_(vehicle.outline),
        margin_(checked(vehicle, margin))
    {
        if (outline_.empty())
            return;
        for (Eigen::Vector2d &corner : outline_)
            corner.x() -= centreOffset;
        inner = deepestPoint(outline_);
        for (const Polygon &corners : convexPieces(outline_))
        {
            pieces.push_back(pieceOf(corners, margin));
            // Mitred corners may lie beyond the rectangle.
            for (const BodyPiece::Side &side : pieces.back().sides)
            {
                halfLength = std::max(halfLength, std::abs(side.corner.x()));
                halfWidth = std::max(halfWidth, std::abs(side.corner.y()));
            }
        }
    }

    double Body::depthAt(double offset) const
    {
        if (pieces.empty())
            return std::min(halfWidth, halfLength - std::abs(offset));
        const double depth = depthWithin(outline_, {offset, 0.0});
        return depth > 0.0 ? depth + margin_ : -HUGE_VAL;
    }

    double Body::reachBetween(double rear, double front) const
    {
        if (pieces.empty())
            return std::hypot(0.5 * (front - rear), halfWidth);
        const Eigen::Vector2d middle(0.5 * (rear + front), 0.0);
        double reach = -HUGE_VAL;
        for (const BodyPiece &piece : pieces)
            for (std::size_t i = 0; i < piece.sides.size(); ++i)
            {
                Eigen::Vector2d from = piece.corner(i, 0.0), to = piece.corner(i + 1, 0.0);
                if (clip(from, to, rear, front))
                    reach = std::max({reach, (from - middle).norm(), (to - middle).norm()});
            }
        return reach;
    }

    std::vector<Polygon> Body::polygons() const
    {
        std::vector<Polygon> result;
        for (const BodyPiece &piece : pieces)
        {
            Polygon polygon;
            for (const BodyPiece::Side &side : piece.sides)
                if (polygon.empty() || side.corner != polygon.back())
                    polygon.push_back(side.corner);
            if (polygon.size() > 1 && polygon.front() == polygon.back())
                polygon.pop_back();
            result.push_back(std::move(polygon));
        }
        return result;
    }
}  // namespace parking

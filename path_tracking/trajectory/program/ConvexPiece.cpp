#include "path_tracking/trajectory/program/ConvexPiece.h"

#include "state_validity/ConvexDecomposition.h"

#include <algorithm>
#include <utility>

namespace parking
{
    namespace
    {
        constexpr double SHORTEST_SIDE = 1e-6;  // metres
        constexpr double THIN = 1e-5;           // metres: sides of what is thinner have no direction to rely on
        constexpr double OUTSIDE = 20.0;        // metres beyond the bounds that are spelled out

        ConvexPiece rectangle(double x0, double y0, double x1, double y1)
        {
            return ConvexPiece({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
        }

        /** The direction in which the corners extend farthest; that of x when they lie in one place. */
        Eigen::Vector2d lengthwise(const std::vector<Eigen::Vector2d> &corners)
        {
            Eigen::Vector2d along(0.0, 0.0);
            for (const Eigen::Vector2d &corner : corners)
                if ((corner - corners.front()).squaredNorm() > along.squaredNorm())
                    along = corner - corners.front();
            return along.squaredNorm() > 0.0 ? Eigen::Vector2d(along.normalized()) : Eigen::Vector2d(1.0, 0.0);
        }

        /** The largest n . p of all corners. */
        double farthestAlong(const std::vector<Eigen::Vector2d> &corners, const Eigen::Vector2d &normal)
        {
            double most = normal.dot(corners.front());
            for (const Eigen::Vector2d &corner : corners)
                most = std::max(most, normal.dot(corner));
            return most;
        }

        /** Adds what has no area: as one piece when it is straight, else each of its sides. */
        void addWithoutArea(const Polygon &polygon, std::vector<ConvexPiece> &pieces)
        {
            ConvexPiece whole(polygon);
            if (whole.isThin)
            {
                pieces.push_back(std::move(whole));
                return;
            }
            for (std::size_t i = 0; i < polygon.size(); ++i)
                pieces.emplace_back(std::vector<Eigen::Vector2d>{polygon[i], polygon[(i + 1) % polygon.size()]});
        }
    }  // namespace

    ConvexPiece::ConvexPiece(std::vector<Eigen::Vector2d> all)
    {
        const Eigen::Vector2d along = lengthwise(all), across(-along.y(), along.x());
        isThin = farthestAlong(all, across) + farthestAlong(all, -across) <= THIN;
        for (const Eigen::Vector2d &corner : all)
            if (corners.empty() || (corner - corners.back()).norm() > SHORTEST_SIDE)
                corners.push_back(corner);
        while (corners.size() > 1 && (corners.front() - corners.back()).norm() <= SHORTEST_SIDE)
            corners.pop_back();
        box = {corners.front(), corners.front()};
        for (const Eigen::Vector2d &corner : corners)
            box.include(corner);
        if (isThin)
        {
            normals = {-across, along, across, -along};
            for (const Eigen::Vector2d &normal : normals)
                offsets.push_back(farthestAlong(all, normal));
            return;
        }
        for (std::size_t k = 0; k < corners.size(); ++k)
        {
            const Eigen::Vector2d side = corners[(k + 1) % corners.size()] - corners[k];
            normals.push_back(Eigen::Vector2d(side.y(), -side.x()).normalized());
            offsets.push_back(normals.back().dot(corners[k]));
        }
    }

    std::vector<ConvexPiece> partsOf(const Body &body)
    {
        const double front = body.centreOffset + body.halfLength, rear = body.centreOffset - body.halfLength;
        const double half = body.halfWidth;
        if (body.pieces.empty())
            return {ConvexPiece({{front, -half}, {front, half}, {rear, half}, {rear, -half}})};
        std::vector<ConvexPiece> parts;
        for (Polygon &piece : body.polygons())
        {
            for (Eigen::Vector2d &corner : piece)
                corner.x() += body.centreOffset;
            parts.emplace_back(std::move(piece));
        }
        return parts;
    }

    std::vector<ConvexPiece> convexPieces(const ObstacleSet &obstacles)
    {
        std::vector<ConvexPiece> pieces;
        for (const Polygon &polygon : obstacles.polygons())
        {
            std::vector<Polygon> solid = convexPieces(polygon);
            if (solid.empty())
                addWithoutArea(polygon, pieces);
            for (Polygon &piece : solid)
                pieces.emplace_back(std::move(piece));
        }
        for (const Box &cells : obstacles.rectangles())
            pieces.push_back(rectangle(cells.min.x(), cells.min.y(), cells.max.x(), cells.max.y()));
        const Eigen::Vector2d &a = obstacles.bounds().min, &b = obstacles.bounds().max;
        pieces.push_back(rectangle(a.x() - OUTSIDE, a.y() - OUTSIDE, a.x(), b.y() + OUTSIDE));
        pieces.push_back(rectangle(b.x(), a.y() - OUTSIDE, b.x() + OUTSIDE, b.y() + OUTSIDE));
        pieces.push_back(rectangle(a.x() - OUTSIDE, a.y() - OUTSIDE, b.x() + OUTSIDE, a.y()));
        pieces.push_back(rectangle(a.x() - OUTSIDE, b.y(), b.x() + OUTSIDE, b.y() + OUTSIDE));
        return pieces;
    }
}  // namespace parking

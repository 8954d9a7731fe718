#include "path_tracking/trajectory/program/ConvexPiece.h"

#include "state_validity/ConvexDecomposition.h"

#include <utility>

namespace parking
{
    namespace
    {
        constexpr double SHORTEST_SIDE = 1e-6;  // metres
        constexpr double OUTSIDE = 20.0;        // metres beyond the bounds that are spelled out

        ConvexPiece rectangle(double x0, double y0, double x1, double y1)
        {
            return ConvexPiece({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
        }
    }  // namespace

    ConvexPiece::ConvexPiece(std::vector<Eigen::Vector2d> all)
    {
        for (const Eigen::Vector2d &corner : all)
            if (corners.empty() || (corner - corners.back()).norm() > SHORTEST_SIDE)
                corners.push_back(corner);
        while (corners.size() > 1 && (corners.front() - corners.back()).norm() <= SHORTEST_SIDE)
            corners.pop_back();
        box = {corners.front(), corners.front()};
        for (std::size_t k = 0; k < corners.size(); ++k)
        {
            const Eigen::Vector2d side = corners[(k + 1) % corners.size()] - corners[k];
            box.min = box.min.cwiseMin(corners[k]);
            box.max = box.max.cwiseMax(corners[k]);
            if (corners.size() == 1)
                break;
            normals.push_back(Eigen::Vector2d(side.y(), -side.x()).normalized());
            offsets.push_back(normals.back().dot(corners[k]));
        }
    }

    std::vector<ConvexPiece> convexPieces(const ObstacleSet &obstacles)
    {
        std::vector<ConvexPiece> pieces;
        for (const Polygon &polygon : obstacles.polygons())
            for (Polygon &piece : convexPieces(polygon))
                pieces.emplace_back(std::move(piece));
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

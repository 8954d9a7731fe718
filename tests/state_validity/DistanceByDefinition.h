#pragma once

#include "state_validity/ObstacleSet.h"

#include <algorithm>
#include <limits>

namespace parking_test
{
    using namespace parking;

    inline double distanceToSegment(const Eigen::Vector2d &point, const Edge &edge)
    {
        const Eigen::Vector2d along = edge.to - edge.from;
        const double t = std::clamp((point - edge.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
        return (point - edge.from - t * along).norm();
    }

    /** The distance from a local point to the nearest obstacle; negative inside of one. */
    inline double signedDistance(const ObstacleSet &obstacles, const Eigen::Vector2d &point)
    {
        double least = std::numeric_limits<double>::infinity();
        for (const Edge &edge : obstacles.edges())
            least = std::min(least, distanceToSegment(point, edge));
        bool inside = (point.array() <= obstacles.bounds().min.array()).any() ||
                      (point.array() >= obstacles.bounds().max.array()).any();
        for (const Polygon &polygon : obstacles.polygons())
            inside = inside || contains(polygon, point);
        for (const Box &rectangle : obstacles.rectangles())
            inside = inside ||
                     ((point.array() > rectangle.min.array()).all() && (point.array() < rectangle.max.array()).all());
        return inside ? -least : least;
    }
}  // namespace parking_test

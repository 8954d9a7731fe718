#pragma once

#include <Eigen/Core>

namespace parking
{
    /** \brief An axis-parallel box in metres, for example the bounds of a world, an obstacle or the view of a drawing.

        Each user documents the frame of its boxes. A rectangle at any angle is an OrientedBox. */
    struct Box
    {
        Eigen::Vector2d min{0.0, 0.0};  ///< lower left corner
        Eigen::Vector2d max{0.0, 0.0};  ///< upper right corner

        /** \brief Lengths along x and y in metres; negative where max lies below min. */
        Eigen::Vector2d size() const
        {
            return max - min;
        }

        /** \brief Whether the point lies inside or on the outline. */
        bool contains(double x, double y) const
        {
            return x >= min.x() && x <= max.x() && y >= min.y() && y <= max.y();
        }

        /** \brief The point of the box nearest to \e point. */
        Eigen::Vector2d nearest(const Eigen::Vector2d &point) const
        {
            return point.cwiseMax(min).cwiseMin(max);
        }

        /** \brief Enlarges the box until it contains the point. */
        void include(const Eigen::Vector2d &point)
        {
            min = min.cwiseMin(point);
            max = max.cwiseMax(point);
        }
    };
}  // namespace parking

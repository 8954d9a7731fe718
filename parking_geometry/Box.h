#pragma once

#include <Eigen/Core>

namespace parking
{
    /** \brief An axis-parallel box in metres: the bounds of a world, an obstacle, what a drawing shows.

        In which frame it lies is said where it is used. A rectangle at any angle is an OrientedBox. */
    struct Box
    {
        Eigen::Vector2d min{0.0, 0.0};  ///< the lower left corner
        Eigen::Vector2d max{0.0, 0.0};  ///< the upper right corner

        /** \brief Lengths along x and y in metres; negative where max lies below min. */
        Eigen::Vector2d size() const
        {
            return max - min;
        }

        /** \brief Does the point lie inside, or on the outline? */
        bool contains(double x, double y) const
        {
            return x >= min.x() && x <= max.x() && y >= min.y() && y <= max.y();
        }

        /** \brief The point of the box that is nearest to the given one. */
        Eigen::Vector2d nearest(const Eigen::Vector2d &point) const
        {
            return point.cwiseMax(min).cwiseMin(max);
        }

        /** \brief Grows until it contains the point. */
        void include(const Eigen::Vector2d &point)
        {
            min = min.cwiseMin(point);
            max = max.cwiseMax(point);
        }
    };
}  // namespace parking

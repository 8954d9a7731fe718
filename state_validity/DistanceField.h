#pragma once

#include "state_validity/ObstacleSet.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    /** \brief Distances to the nearest obstacle on a grid of cells, with bounds that hold for every point.

        Each cell stores the exact Euclidean distance between its centre and the nearest centre of a blocked cell
        (P. Felzenszwalb and D. Huttenlocher, "Distance transforms of sampled functions", 2012: linear time). A cell is
        blocked when an obstacle touches it. For a point q in a cell whose centre is c, and the nearest obstacle point w
        in a blocked cell whose centre is b:

            | |q - w| - |c - b| | <= |q - c| + |w - b| <= side * sqrt(2),

        both terms being at most half a diagonal. So

            value - side * sqrt(2)  <=  distance(q, obstacles)  <=  value + side * sqrt(2),

        The upper bound holds because a blocked cell contains at least one obstacle point. In a grid world, whose cells
        may be a metre wide, every blocked cell is entirely an obstacle. It contains the circle about b with a radius of
        half a side, so

            distance(q, obstacles)  <=  value + |q - c| - side / 2.

        The field marks cells that lie entirely inside of an obstacle, so it proves that a point deep inside of a large
        obstacle is blocked. The outside of the bounds is an obstacle; points there have distance zero.

        The field of a grid world may have a limited reach. Cells that are farther from all obstacles store the reach.
        There the upper bound is that of the distance to the outside of the map. A changed cell affects the cells within
        reach only, which update() computes again.

        Const calls from several threads are safe. */
    class DistanceField
    {
    public:
        /** \brief Largest reach in cells; a longer one is reduced to it. */
        static constexpr int MAX_REACH = 127;

        /** \brief Computes the field of \e obstacles.

            \param resolution side of a cell in metres for polygon worlds; 0 selects it automatically. Grid worlds use
            their own cells.
            \param reach metres up to which distances are exact in a grid world, above zero; ignored in polygon worlds
            Throws parking::Error for a reach that is not positive, and if the resolution is negative, not finite or
            would require more than 2^28 cells. */
        explicit DistanceField(const ObstacleSet &obstacles, double resolution = 0.0,
                               double reach = std::numeric_limits<double>::infinity());

        /** \brief Takes over changed cells of a grid world. The result equals a field made from the changed obstacles.

            \param obstacles those of the constructor, after their update
            \param changed the result of ObstacleSet::update() */
        void update(const ObstacleSet &obstacles, const std::vector<std::size_t> &changed);

        /** \brief Metres up to which distances are exact; infinite without a limit. */
        double reach() const
        {
            return reach_;
        }

        /** \brief Side of a cell in metres. */
        double resolution() const
        {
            return resolution_;
        }

        /** \brief Distance of lowerBound() and upperBound() from the value of the cell, in metres. */
        double errorBound() const
        {
            return error_;
        }

        /** \brief Lower bound of the distance from the local point to the nearest obstacle; 0 if the point may be
            blocked or is not finite. */
        double lowerBound(double x, double y) const
        {
            return lowerBoundOf(valueAt(x, y));
        }

        /** \brief Upper bound of the distance from the local point to the nearest obstacle; 0 if the point is certainly
            inside of one. */
        double upperBound(double x, double y) const
        {
            return upperBoundOf(valueAt(x, y));
        }

        /** \brief An upper bound that in grid worlds is tighter than upperBound() by up to two sides, at the cost of a
            square root. */
        double closeUpperBound(double x, double y) const
        {
            const double value = valueAt(x, y);
            if (value < 0.0 || value >= reach_ || !isGrid_)
                return upperBoundOf(value);
            const double u = (x - origin_.x()) * inverse_, v = (y - origin_.y()) * inverse_;
            // Neither is negative, and a conversion is faster than std::floor.
            const double du = u - static_cast<double>(static_cast<std::ptrdiff_t>(u)) - 0.5,
                         dv = v - static_cast<double>(static_cast<std::ptrdiff_t>(v)) - 0.5;
            return value * (1.0 + ROUNDING) + (std::sqrt(du * du + dv * dv) - INSCRIBED) * resolution_;
        }

        /** \brief Bounds of the distance from a point to the nearest obstacle, in metres. */
        struct Bounds
        {
            double lower;  ///< lower bound of the distance
            double upper;  ///< upper bound of the distance
        };

        /** \brief lowerBound() and upperBound() of the local point at the cost of one. */
        Bounds bounds(double x, double y) const
        {
            const double value = valueAt(x, y);
            return {lowerBoundOf(value), upperBoundOf(value)};
        }

        /** \brief Whether the local point is certainly inside of an obstacle or outside of the bounds. */
        bool isInside(double x, double y) const
        {
            return valueAt(x, y) < 0.0;
        }

        /** \brief Whether no obstacle touches the cell of the local point. */
        bool isOutside(double x, double y) const
        {
            return valueAt(x, y) > 0.0;
        }

    private:
        /** Twice the relative error of a float. */
        static constexpr double ROUNDING = 1.2e-7;
        /** Radius of a circle inside of a cell, in sides: slightly less than half because of rounding. */
        static constexpr double INSCRIBED = 0.5 * (1.0 - 1e-5);

        double lowerBoundOf(double value) const
        {
            const double lower = value * (1.0 - ROUNDING) - error_;
            return lower > 0.0 ? lower : 0.0;
        }

        double upperBoundOf(double value) const
        {
            if (value >= reach_)
                return farthest_;
            return value < 0.0 ? 0.0 : value * (1.0 + ROUNDING) + error_;
        }

        double valueAt(double x, double y) const
        {
            const double u = (x - origin_.x()) * inverse_, v = (y - origin_.y()) * inverse_;
            // Written so that NaN takes the branch.
            if (!(u >= 0.0 && v >= 0.0 && u < width_ && v < height_))
                return -1.0;
            // A double becomes a signed integer in one instruction.
            return values_[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(v)) * columns_ +
                           static_cast<std::size_t>(static_cast<std::ptrdiff_t>(u))];
        }

        class Transform;

        void prepare(double resolution, std::size_t columns, std::size_t rows, const Eigen::Vector2d &origin);
        void limit(double reach);
        void transform(const std::vector<std::uint8_t> &blocked);
        void transformGrid(const ObstacleSet &obstacles);

        std::size_t columns_{0};
        std::size_t rows_{0};
        double width_{0.0}, height_{0.0};  // columns and rows as doubles, for comparisons
        double resolution_{1.0};
        double inverse_{1.0};
        double error_{0.0};
        double reach_{std::numeric_limits<double>::infinity()};
        double farthest_{0.0};  // upper bound of the distance to the outside of the map from any point
        bool isGrid_{false};    // whether a blocked cell is entirely an obstacle
        Eigen::Vector2d origin_{0.0, 0.0};
        std::vector<float> values_;
        // With a limited reach only:
        int reachCells_{0};                  // 0 without a limit
        std::vector<float> ofSquare_;        // value of a cell by the square of its distance in cells
        std::vector<std::uint8_t> heights_;  // cells along the column to the nearest blocked one, at most the reach
    };
}  // namespace parking

#pragma once

#include "state_validity/ObstacleSet.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
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

        the upper bound since a blocked cell holds at least one obstacle point. In a grid world, whose cells may be a
        metre wide, a blocked cell is an obstacle as a whole, and with it the circle round b of half a side, so that

            distance(q, obstacles)  <=  value + |q - c| - side / 2.

        Cells that lie entirely inside of an obstacle are marked, so that a point deep inside of a large obstacle is
        known to be blocked. The outside of the bounds is an obstacle; points there have distance zero.

        Immutable after construction, so const calls from several threads are safe. */
    class DistanceField
    {
    public:
        /** \brief The field of \e obstacles.

            \param resolution side of a cell in metres for polygon worlds; 0 chooses one. Grid worlds use their own
            cells. Throws parking::Error when the resolution is negative, not finite, or would need more than 2^28
            cells. */
        explicit DistanceField(const ObstacleSet &obstacles, double resolution = 0.0);

        /** \brief Side of a cell in metres. */
        double resolution() const
        {
            return resolution_;
        }

        /** \brief How far lowerBound() and upperBound() are from the value of the cell, in metres. */
        double errorBound() const
        {
            return error_;
        }

        /** \brief Never more than the distance from the local point to the nearest obstacle; 0 when it may be blocked.
            Points that are not finite give 0. */
        double lowerBound(double x, double y) const
        {
            return lowerBoundOf(valueAt(x, y));
        }

        /** \brief Never less than the distance from the local point to the nearest obstacle; 0 when it is surely inside
            of one. */
        double upperBound(double x, double y) const
        {
            return upperBoundOf(valueAt(x, y));
        }

        /** \brief upperBound(), in a grid world closer by up to two sides, at the price of a square root. */
        double closeUpperBound(double x, double y) const
        {
            const double value = valueAt(x, y);
            if (value < 0.0 || !isGrid_)
                return upperBoundOf(value);
            const double u = (x - origin_.x()) * inverse_, v = (y - origin_.y()) * inverse_;
            // Neither is negative here, and a conversion is cheaper than std::floor.
            const double du = u - static_cast<double>(static_cast<std::ptrdiff_t>(u)) - 0.5,
                         dv = v - static_cast<double>(static_cast<std::ptrdiff_t>(v)) - 0.5;
            return value * (1.0 + ROUNDING) + (std::sqrt(du * du + dv * dv) - INSCRIBED) * resolution_;
        }

        /** \brief Between what the distance from a point to the nearest obstacle lies, in metres. */
        struct Bounds
        {
            double lower;  ///< never more than the distance
            double upper;  ///< never less
        };

        /** \brief lowerBound() and upperBound() of the local point, at the price of one. */
        Bounds bounds(double x, double y) const
        {
            const double value = valueAt(x, y);
            return {lowerBoundOf(value), upperBoundOf(value)};
        }

        /** \brief Is the local point surely inside of an obstacle, or outside of the bounds? */
        bool isInside(double x, double y) const
        {
            return valueAt(x, y) < 0.0;
        }

        /** \brief Does no obstacle touch the cell of the local point? */
        bool isOutside(double x, double y) const
        {
            return valueAt(x, y) > 0.0;
        }

    private:
        /** Relative error of a float, twice over. */
        static constexpr double ROUNDING = 1.2e-7;
        /** Radius of a circle inside of a cell, in sides: a hair less than half, for rounding. */
        static constexpr double INSCRIBED = 0.5 * (1.0 - 1e-5);

        double lowerBoundOf(double value) const
        {
            const double lower = value * (1.0 - ROUNDING) - error_;
            return lower > 0.0 ? lower : 0.0;
        }

        double upperBoundOf(double value) const
        {
            return value < 0.0 ? 0.0 : value * (1.0 + ROUNDING) + error_;
        }

        double valueAt(double x, double y) const
        {
            const double u = (x - origin_.x()) * inverse_, v = (y - origin_.y()) * inverse_;
            // Written so that NaN takes the branch.
            if (!(u >= 0.0 && v >= 0.0 && u < width_ && v < height_))
                return -1.0;
            // Signed: doubles become such in one instruction.
            return values_[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(v)) * columns_ +
                           static_cast<std::size_t>(static_cast<std::ptrdiff_t>(u))];
        }

        void transform(const std::vector<std::uint8_t> &blocked);

        std::size_t columns_{0};
        std::size_t rows_{0};
        double width_{0.0}, height_{0.0};  // columns and rows once more, to compare with
        double resolution_{1.0};
        double inverse_{1.0};
        double error_{0.0};
        bool isGrid_{false};  // blocked cells are obstacles as a whole
        Eigen::Vector2d origin_{0.0, 0.0};
        std::vector<float> values_;
    };
}  // namespace parking

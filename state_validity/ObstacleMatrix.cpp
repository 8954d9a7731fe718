#include "state_validity/ObstacleMatrix.h"

#include "parking_geometry/Error.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>

namespace parking
{
    namespace
    {
        constexpr double MAX_CELLS = 1073741824.0;  // 2^30: a gigabyte

        using Clock = std::chrono::steady_clock;

        double secondsSince(Clock::time_point begin)
        {
            return std::chrono::duration<double>(Clock::now() - begin).count();
        }
    }  // namespace

    ObstacleMatrix::ObstacleMatrix(const Bounds &bounds, double resolution, Check isFree)
      : origin_(bounds.min),
        resolution_(resolution),
        isFree_(std::move(isFree))
    {
        if (!(resolution > 0.0) || !std::isfinite(resolution))
            throw Error("resolution of the obstacle matrix must be a positive number of metres, not " +
                        std::to_string(resolution));
        const Eigen::Vector2d size = bounds.max - bounds.min;
        if (!bounds.min.allFinite() || !bounds.max.allFinite() || !(size.minCoeff() > 0.0))
            throw Error("bounds of the obstacle matrix must be finite and span more than 0 m in x and in y");
        const double columns = std::ceil(size.x() / resolution), rows = std::ceil(size.y() / resolution);
        if (!(columns * rows <= MAX_CELLS))
            throw Error("resolution of " + std::to_string(resolution) +
                        " m is too fine for bounds of this size: the obstacle matrix would need more than 2^30 cells");
        if (!isFree_)
            throw Error("the obstacle matrix needs a callable that tells where the car is free, not an empty one");
        columns_ = static_cast<std::size_t>(columns);
        rows_ = static_cast<std::size_t>(rows);
        clear();
    }

    Eigen::Vector2d ObstacleMatrix::middle(std::size_t column, std::size_t row) const
    {
        return {origin_.x() + (static_cast<double>(column) + 0.5) * resolution_,
                origin_.y() + (static_cast<double>(row) + 0.5) * resolution_};
    }

    void ObstacleMatrix::evaluate(std::size_t column, std::size_t row)
    {
        const Eigen::Vector2d at = middle(column, row);
        ++evaluations_;
        cells_[row * columns_ + column] = static_cast<std::int8_t>(
            isFree_(at.x(), at.y()) ? Traversability::Traversable : Traversability::Impassable);
    }

    bool ObstacleMatrix::isTraversable(std::size_t column, std::size_t row)
    {
        if (known(column, row) == Traversability::Unknown)
        {
            const Clock::time_point begin = Clock::now();
            evaluate(column, row);
            fillingTime_ += secondsSince(begin);
        }
        return known(column, row) == Traversability::Traversable;
    }

    bool ObstacleMatrix::isTraversableAt(double x, double y)
    {
        const double u = (x - origin_.x()) / resolution_, v = (y - origin_.y()) / resolution_;
        if (!(u >= 0.0 && v >= 0.0 && u < static_cast<double>(columns_) && v < static_cast<double>(rows_)))
            return false;
        return isTraversable(static_cast<std::size_t>(u), static_cast<std::size_t>(v));
    }

    void ObstacleMatrix::fill()
    {
        const Clock::time_point begin = Clock::now();
        for (std::size_t row = 0; row < rows_; ++row)
            for (std::size_t column = 0; column < columns_; ++column)
                if (known(column, row) == Traversability::Unknown)
                    evaluate(column, row);
        fillingTime_ += secondsSince(begin);
    }

    void ObstacleMatrix::clear()
    {
        cells_.assign(columns_ * rows_, static_cast<std::int8_t>(Traversability::Unknown));
        evaluations_ = 0;
        fillingTime_ = 0.0;
    }
}  // namespace parking

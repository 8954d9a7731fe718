#include "parking_geometry/referee/FreeSpace.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace parking
{
    namespace
    {
        constexpr double TOUCH = 1e-6;        // metres of overlap that count as none
        constexpr double BUCKET = 2.0;        // metres, the side of buckets in worlds of usual size
        constexpr double BUCKETS = 262144.0;  // no more than about these

        /** Does the segment pass through the box? Liang and Barsky's clipping. */
        bool meetsBox(const Eigen::Vector2d &from, const Eigen::Vector2d &to, const Eigen::Vector2d &min,
                      const Eigen::Vector2d &max)
        {
            double enter = 0.0, leave = 1.0;
            for (int axis = 0; axis < 2; ++axis)
            {
                const double direction = to[axis] - from[axis];
                if (direction == 0.0)
                {
                    if (from[axis] <= min[axis] || from[axis] >= max[axis])
                        return false;
                    continue;
                }
                double first = (min[axis] - from[axis]) / direction, second = (max[axis] - from[axis]) / direction;
                if (first > second)
                    std::swap(first, second);
                enter = std::max(enter, first);
                leave = std::min(leave, second);
            }
            return enter < leave;
        }

        double distanceToSegment(const Eigen::Vector2d &point, const Eigen::Vector2d &from, const Eigen::Vector2d &to)
        {
            const Eigen::Vector2d along = to - from;
            const double square = along.squaredNorm();
            const double share = square > 0.0 ? std::clamp((point - from).dot(along) / square, 0.0, 1.0) : 0.0;
            return (point - from - share * along).norm();
        }

        std::size_t clampIndex(double value, std::size_t count)
        {
            return static_cast<std::size_t>(std::clamp(std::floor(value), 0.0, static_cast<double>(count - 1)));
        }
    }  // namespace

    FreeSpace::FreeSpace(const Scenario &scenario, double circleRadius)
      : vehicle_(scenario.vehicle),
        radius_(circleRadius),
        farthest_(circleRadius > 0.0
                      ? 0.0
                      : std::hypot(std::max(vehicle_.wheelbase + vehicle_.frontOverhang, vehicle_.rearOverhang),
                                   0.5 * vehicle_.width)),
        bounds_(scenario.bounds)
    {
        if (scenario.grid)
        {
            const OccupancyGrid &grid = *scenario.grid;
            isGrid_ = true;
            origin_ = grid.origin();
            cellSize_ = grid.resolution();
            columns_ = grid.width();
            rows_ = grid.height();
            occupied_.assign(rows_ * (columns_ + 1), 0);
            for (std::size_t row = 0; row < rows_; ++row)
                for (std::size_t column = 0; column < columns_; ++column)
                {
                    const Cell cell = grid.at(column, row);
                    const bool blocked =
                        cell == Cell::Occupied || (cell == Cell::Unknown && scenario.unknownIsOccupied);
                    occupied_[row * (columns_ + 1) + column + 1] =
                        occupied_[row * (columns_ + 1) + column] + (blocked ? 1U : 0U);
                }
            return;
        }
        polygons_ = scenario.polygons;
        const Eigen::Vector2d size = bounds_.size();
        bucket_ = std::max({BUCKET, std::sqrt(size.x() * size.y() / BUCKETS), size.maxCoeff() / BUCKETS});
        bucketColumns_ = static_cast<std::size_t>(std::max(std::ceil(size.x() / bucket_), 1.0));
        bucketRows_ = static_cast<std::size_t>(std::max(std::ceil(size.y() / bucket_), 1.0));
        buckets_.resize(bucketColumns_ * bucketRows_);
        for (const Polygon &polygon : polygons_)
        {
            Box box{polygon.front(), polygon.front()};
            for (std::size_t i = 0; i < polygon.size(); ++i)
            {
                const Edge edge{polygon[i], polygon[(i + 1) % polygon.size()]};
                box.include(edge.from);
                edges_.push_back(edge);
                enterEdge(edges_.size() - 1);
            }
            boxes_.push_back(box);
        }
    }

    void FreeSpace::enterEdge(std::size_t index)
    {
        const Edge &edge = edges_[index];
        const Eigen::Vector2d low = edge.from.cwiseMin(edge.to), high = edge.from.cwiseMax(edge.to);
        const std::size_t firstRow = clampIndex((low.y() - bounds_.min.y()) / bucket_, bucketRows_);
        const std::size_t lastRow = clampIndex((high.y() - bounds_.min.y()) / bucket_, bucketRows_);
        for (std::size_t row = firstRow; row <= lastRow; ++row)
        {
            // The part of the edge in this row, a little more for rounding; a long slanting edge is in few buckets of
            // its box.
            double left = low.x(), right = high.x();
            if (firstRow < lastRow)
            {
                const double bottom = bounds_.min.y() + bucket_ * (static_cast<double>(row) - 0.01);
                const double slope = (edge.to.x() - edge.from.x()) / (edge.to.y() - edge.from.y());
                const double atBottom = edge.from.x() + slope * (std::clamp(bottom, low.y(), high.y()) - edge.from.y());
                const double atTop =
                    edge.from.x() + slope * (std::clamp(bottom + 1.02 * bucket_, low.y(), high.y()) - edge.from.y());
                left = std::max(left, std::min(atBottom, atTop) - 0.01 * bucket_);
                right = std::min(right, std::max(atBottom, atTop) + 0.01 * bucket_);
            }
            // Whatever lies outside of the bounds is entered at their rim.
            for (std::size_t column = clampIndex((left - bounds_.min.x()) / bucket_, bucketColumns_);
                 column <= clampIndex((right - bounds_.min.x()) / bucket_, bucketColumns_); ++column)
                buckets_[row * bucketColumns_ + column].push_back(index);
        }
    }

    bool FreeSpace::isFree(const Pose &pose) const
    {
        if (!isFinite(pose))
            return false;
        const Pose local = isGrid_ ? relativeTo(origin_, pose) : pose;
        return radius_ > 0.0 ? isDiscFree({local.x, local.y}) : isBodyFree(local);
    }

    template <class Visit>
    bool FreeSpace::visitEdges(const Eigen::Vector2d &min, const Eigen::Vector2d &max, const Visit &visit) const
    {
        for (std::size_t row = clampIndex((min.y() - bounds_.min.y()) / bucket_, bucketRows_);
             row <= clampIndex((max.y() - bounds_.min.y()) / bucket_, bucketRows_); ++row)
            for (std::size_t column = clampIndex((min.x() - bounds_.min.x()) / bucket_, bucketColumns_);
                 column <= clampIndex((max.x() - bounds_.min.x()) / bucket_, bucketColumns_); ++column)
                for (const std::size_t index : buckets_[row * bucketColumns_ + column])
                    if (!visit(edges_[index]))
                        return false;
        return true;
    }

    bool FreeSpace::insideObstacle(const Eigen::Vector2d &point) const
    {
        for (std::size_t i = 0; i < polygons_.size(); ++i)
            if ((point.array() > boxes_[i].min.array()).all() && (point.array() < boxes_[i].max.array()).all() &&
                contains(polygons_[i], point))
                return true;
        return false;
    }

    std::size_t FreeSpace::occupiedIn(std::size_t row, std::size_t first, std::size_t last) const
    {
        const std::size_t begin = row * (columns_ + 1);
        return occupied_[begin + last + 1] - occupied_[begin + first];
    }

    bool FreeSpace::isBodyFree(const Pose &local) const
    {
        Eigen::Vector2d min(INFINITY, INFINITY), max(-INFINITY, -INFINITY);
        for (const Eigen::Vector2d &corner : vehicle_.footprint(local))
        {
            min = min.cwiseMin(corner);
            max = max.cwiseMax(corner);
        }
        if (isGrid_)
            return cellsFree(min, max, local);
        if ((min.array() < bounds_.min.array() - TOUCH).any() || (max.array() > bounds_.max.array() + TOUCH).any())
            return false;
        const double c = std::cos(local.yaw), s = std::sin(local.yaw);
        const Eigen::Vector2d low(-vehicle_.rearOverhang + TOUCH, -0.5 * vehicle_.width + TOUCH);
        const Eigen::Vector2d high(vehicle_.wheelbase + vehicle_.frontOverhang - TOUCH, 0.5 * vehicle_.width - TOUCH);
        const auto inBody = [&](const Eigen::Vector2d &point)
        {
            const double dx = point.x() - local.x, dy = point.y() - local.y;
            return Eigen::Vector2d(c * dx + s * dy, -s * dx + c * dy);
        };
        if (!visitEdges(min, max,
                        [&](const Edge &edge) { return !meetsBox(inBody(edge.from), inBody(edge.to), low, high); }))
            return false;
        const Eigen::Vector2d middle = 0.5 * (low + high);
        return !insideObstacle({local.x + c * middle.x() - s * middle.y(), local.y + s * middle.x() + c * middle.y()});
    }

    bool FreeSpace::cellsFree(const Eigen::Vector2d &min, const Eigen::Vector2d &max, const Pose &local) const
    {
        const Eigen::Vector2d size(static_cast<double>(columns_) * cellSize_, static_cast<double>(rows_) * cellSize_);
        if ((min.array() < -TOUCH).any() || (max.array() > size.array() + TOUCH).any())
            return false;
        const double c = std::cos(local.yaw), s = std::sin(local.yaw);
        const double front = vehicle_.wheelbase + vehicle_.frontOverhang - TOUCH;
        const double rear = -vehicle_.rearOverhang + TOUCH, half = 0.5 * vehicle_.width - TOUCH;
        // Half of a cell's extent along either axis of the body.
        const double reach = 0.5 * cellSize_ * (std::abs(c) + std::abs(s));
        const std::size_t firstColumn = clampIndex(min.x() / cellSize_, columns_);
        const std::size_t lastColumn = clampIndex(max.x() / cellSize_, columns_);
        for (std::size_t row = clampIndex(min.y() / cellSize_, rows_); row <= clampIndex(max.y() / cellSize_, rows_);
             ++row)
        {
            if (occupiedIn(row, firstColumn, lastColumn) == 0)
                continue;
            for (std::size_t column = firstColumn; column <= lastColumn; ++column)
            {
                if (occupiedIn(row, column, column) == 0)
                    continue;
                // The body's box and the cell overlap along the map's axes up to the outermost cells; TOUCH is kept
                // along both axes of the body.
                const Eigen::Vector2d low(static_cast<double>(column) * cellSize_,
                                          static_cast<double>(row) * cellSize_);
                if (low.x() >= max.x() - TOUCH || low.y() >= max.y() - TOUCH ||
                    low.x() + cellSize_ <= min.x() + TOUCH || low.y() + cellSize_ <= min.y() + TOUCH)
                    continue;
                const double dx = low.x() + 0.5 * cellSize_ - local.x, dy = low.y() + 0.5 * cellSize_ - local.y;
                const double along = c * dx + s * dy, across = -s * dx + c * dy;
                if (along + reach > rear && along - reach < front && across + reach > -half && across - reach < half)
                    return false;
            }
        }
        return true;
    }

    bool FreeSpace::isDiscFree(const Eigen::Vector2d &centre) const
    {
        const double radius = radius_ - TOUCH;
        const Eigen::Vector2d reach(radius, radius);
        const Eigen::Vector2d min = centre - reach, max = centre + reach;
        if (!isGrid_)
        {
            if ((min.array() < bounds_.min.array()).any() || (max.array() > bounds_.max.array()).any())
                return false;
            return visitEdges(min, max,
                              [&](const Edge &edge)
                              { return distanceToSegment(centre, edge.from, edge.to) >= radius; }) &&
                   !insideObstacle(centre);
        }
        const Eigen::Vector2d size(static_cast<double>(columns_) * cellSize_, static_cast<double>(rows_) * cellSize_);
        if ((min.array() < 0.0).any() || (max.array() > size.array()).any())
            return false;
        for (std::size_t row = clampIndex(min.y() / cellSize_, rows_); row <= clampIndex(max.y() / cellSize_, rows_);
             ++row)
            for (std::size_t column = clampIndex(min.x() / cellSize_, columns_);
                 column <= clampIndex(max.x() / cellSize_, columns_); ++column)
            {
                if (occupiedIn(row, column, column) == 0)
                    continue;
                const Eigen::Vector2d low(static_cast<double>(column) * cellSize_,
                                          static_cast<double>(row) * cellSize_);
                const Eigen::Vector2d nearest =
                    centre.cwiseMax(low).cwiseMin(low + Eigen::Vector2d(cellSize_, cellSize_));
                if ((centre - nearest).norm() < radius)
                    return false;
            }
        return true;
    }
}  // namespace parking

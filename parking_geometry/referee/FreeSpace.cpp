#include "parking_geometry/referee/FreeSpace.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace parking
{
    namespace
    {
        constexpr double TOUCH = 1e-6;  // metres of overlap that count as none

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
            bounds_ = {{0.0, 0.0}, {static_cast<double>(columns_) * cellSize_, static_cast<double>(rows_) * cellSize_}};
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
            addOutlinesOfCells();
            return;
        }
        outlines_ = Outlines(bounds_);
        for (const Polygon &polygon : scenario.polygons)
            outlines_.add(polygon);
    }

    /** Between free cells and others, from corner to corner. The end of the world is no outline: distance() knows it.
     */
    void FreeSpace::addOutlinesOfCells()
    {
        outlines_ = Outlines(bounds_);
        const auto isOccupied = [this](std::size_t column, std::size_t row)
        {
            return occupiedIn(row, column, column) > 0;
        };
        const auto at = [this](std::size_t column, std::size_t row)
        {
            return Eigen::Vector2d(static_cast<double>(column) * cellSize_, static_cast<double>(row) * cellSize_);
        };
        // Runs of cells that differ from their neighbours below, and from those to the left; all in the order of
        // memory.
        std::vector<std::size_t> begins(columns_, 0);
        for (std::size_t row = 0; row <= rows_; ++row)
        {
            for (std::size_t column = 0, begin = 0; row > 0 && row < rows_ && column <= columns_; ++column)
                if (column == columns_ || isOccupied(column, row) == isOccupied(column, row - 1))
                {
                    if (column > begin)
                        outlines_.add(Outlines::Edge{at(begin, row), at(column, row)});
                    begin = column + 1;
                }
            for (std::size_t column = 1; column < columns_; ++column)
                if (row == rows_ || isOccupied(column, row) == isOccupied(column - 1, row))
                {
                    if (row > begins[column])
                        outlines_.add(Outlines::Edge{at(column, begins[column]), at(column, row)});
                    begins[column] = row + 1;
                }
        }
    }

    Pose FreeSpace::toLocal(const Pose &pose) const
    {
        return isGrid_ ? relativeTo(origin_, pose) : pose;
    }

    Rectangle FreeSpace::shapeAt(const Pose &local) const
    {
        Rectangle shape;
        shape.place = {local.x, local.y};
        shape.cosine = std::cos(local.yaw);
        shape.sine = std::sin(local.yaw);
        if (radius_ > 0.0)
            return shape;
        shape.rear = -vehicle_.rearOverhang;
        shape.front = vehicle_.wheelbase + vehicle_.frontOverhang;
        shape.half = 0.5 * vehicle_.width;
        return shape;
    }

    double FreeSpace::distance(const Rectangle &shape, double enough) const
    {
        // A disc is its middle, which has to be farther away.
        const Box box = shape.box();
        const double toEnd = std::min((box.min - bounds_.min).minCoeff(), (bounds_.max - box.max).minCoeff());
        return std::max(0.0, outlines_.distance(shape, std::min(toEnd, enough + radius_)) - radius_);
    }

    double FreeSpace::clearance(const Pose &pose, double enough) const
    {
        return isFree(pose) ? distance(shapeAt(toLocal(pose)), enough) : 0.0;
    }

    double FreeSpace::clearanceAlong(const Pose &from, double length, double enough) const
    {
        if (!isFinite(from) || !std::isfinite(length))
            return 0.0;
        Rectangle covered = shapeAt(toLocal(from));
        covered.rear += std::min(0.0, length);
        covered.front += std::max(0.0, length);
        return distance(covered, enough);
    }

    bool FreeSpace::isFree(const Pose &pose) const
    {
        if (!isFinite(pose))
            return false;
        const Pose local = toLocal(pose);
        return radius_ > 0.0 ? isDiscFree({local.x, local.y}) : isBodyFree(local);
    }

    std::size_t FreeSpace::occupiedIn(std::size_t row, std::size_t first, std::size_t last) const
    {
        const std::size_t begin = row * (columns_ + 1);
        return occupied_[begin + last + 1] - occupied_[begin + first];
    }

    bool FreeSpace::isBodyFree(const Pose &local) const
    {
        const Rectangle body = shapeAt(local);
        const Box box = body.box();
        if ((box.min.array() < bounds_.min.array() - TOUCH).any() ||
            (box.max.array() > bounds_.max.array() + TOUCH).any())
            return false;
        if (isGrid_)
            return cellsFree(box, local);
        const Eigen::Vector2d low(body.rear + TOUCH, -body.half + TOUCH);
        const Eigen::Vector2d high(body.front - TOUCH, body.half - TOUCH);
        const auto isOutside = [&](const Outlines::Edge &edge)
        {
            return !meetsBox(body.toFrame(edge.from), body.toFrame(edge.to), low, high);
        };
        return outlines_.visit(box, isOutside) && !outlines_.isInside(body.middle());
    }

    bool FreeSpace::cellsFree(const Box &box, const Pose &local) const
    {
        const Eigen::Vector2d &min = box.min, &max = box.max;
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
        if ((min.array() < bounds_.min.array()).any() || (max.array() > bounds_.max.array()).any())
            return false;
        if (!isGrid_)
        {
            const auto isOutside = [&](const Outlines::Edge &edge)
            {
                return distanceToSegment(centre, edge.from, edge.to) >= radius;
            };
            return outlines_.visit({min, max}, isOutside) && !outlines_.isInside(centre);
        }
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

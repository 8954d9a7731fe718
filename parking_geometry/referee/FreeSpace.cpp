#include "parking_geometry/referee/FreeSpace.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace parking
{
    namespace
    {
        constexpr double TOUCH = 1e-6;  // metres of overlap that count as none

        std::size_t clampIndex(double value, std::size_t count)
        {
            return static_cast<std::size_t>(std::clamp(std::floor(value), 0.0, static_cast<double>(count - 1)));
        }

        /** The counter-clockwise outline with all sides moved inwards by \e distance metres. */
        Polygon movedInwards(const Polygon &outline, double distance)
        {
            Polygon result;
            const std::size_t count = outline.size();
            for (std::size_t i = 0; i < count; ++i)
            {
                const Eigen::Vector2d in = (outline[i] - outline[(i + count - 1) % count]).normalized();
                const Eigen::Vector2d out = (outline[(i + 1) % count] - outline[i]).normalized();
                // The sum of the normals over 1 + cosine is the displacement that keeps both distances.
                const Eigen::Vector2d normals(-in.y() - out.y(), in.x() + out.x());
                result.emplace_back(outline[i] + distance / (1.0 + in.dot(out)) * normals);
            }
            return result;
        }

        /** A shape given in the frame of a pose. */
        Polygon placed(const Polygon &shape, const Pose &pose)
        {
            const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
            Polygon result;
            for (const Eigen::Vector2d &corner : shape)
                result.emplace_back(pose.x + c * corner.x() - s * corner.y(), pose.y + s * corner.x() + c * corner.y());
            return result;
        }

        Box boundsOf(const Polygon &shape)
        {
            Box box{shape.front(), shape.front()};
            for (const Eigen::Vector2d &corner : shape)
                box.include(corner);
            return box;
        }
    }  // namespace

    FreeSpace::FreeSpace(const Scenario &scenario, double circleRadius)
      : radius_(circleRadius),
        bounds_(scenario.bounds),
        grid_(scenario.grid),
        unknownIsOccupied_(scenario.unknownIsOccupied)
    {
        if (radius_ <= 0.0)
        {
            const Vehicle &car = scenario.vehicle;
            centreOffset_ = car.centreOffset();
            halfLength_ = 0.5 * car.length();
            halfWidth_ = 0.5 * car.width;
            farthest_ = std::hypot(std::abs(centreOffset_) + halfLength_, halfWidth_);
            outline_ = car.outline;
            smaller_ = movedInwards(outline_, TOUCH);
        }
        if (grid_)
            bounds_ = {{0.0, 0.0},
                       {static_cast<double>(grid_->width()) * grid_->resolution(),
                        static_cast<double>(grid_->height()) * grid_->resolution()}};
        outlines_ = Outlines(bounds_);
        if (grid_)
            addOutlinesOfCells();
        for (const Polygon &polygon : scenario.polygons)
            outlines_.add(polygon);
    }

    bool FreeSpace::isOccupied(std::size_t column, std::size_t row) const
    {
        const Cell cell = grid_->at(column, row);
        return cell == Cell::Occupied || (cell == Cell::Unknown && unknownIsOccupied_);
    }

    /** Adds the outlines between free and occupied cells, from corner to corner. distance() handles the end of the
        world. */
    void FreeSpace::addOutlinesOfCells()
    {
        const std::size_t columns = grid_->width(), rows = grid_->height();
        const auto at = [size = grid_->resolution()](std::size_t column, std::size_t row)
        {
            return Eigen::Vector2d(static_cast<double>(column) * size, static_cast<double>(row) * size);
        };
        // Runs of cells that differ from their neighbours below or to the left, in memory order.
        std::vector<std::size_t> begins(columns, 0);
        for (std::size_t row = 0; row <= rows; ++row)
        {
            for (std::size_t column = 0, begin = 0; row > 0 && row < rows && column <= columns; ++column)
                if (column == columns || isOccupied(column, row) == isOccupied(column, row - 1))
                {
                    if (column > begin)
                        outlines_.add(Edge{at(begin, row), at(column, row)});
                    begin = column + 1;
                }
            for (std::size_t column = 1; column < columns; ++column)
                if (row == rows || isOccupied(column, row) == isOccupied(column - 1, row))
                {
                    if (row > begins[column])
                        outlines_.add(Edge{at(column, begins[column]), at(column, row)});
                    begins[column] = row + 1;
                }
        }
    }

    Pose FreeSpace::toLocal(const Pose &pose) const
    {
        return grid_ ? relativeTo(grid_->origin(), pose) : pose;
    }

    OrientedBox FreeSpace::shapeAt(const Pose &local) const
    {
        return bodyAt(local, centreOffset_, halfLength_, halfWidth_);
    }

    double FreeSpace::distance(const OrientedBox &shape, double enough) const
    {
        // A disc is its centre with a distance reduced by the radius.
        const Box box = shape.bounds();
        const double toEnd = std::min((box.min - bounds_.min).minCoeff(), (bounds_.max - box.max).minCoeff());
        return std::max(0.0, outlines_.distance(shape, std::min(toEnd, enough + radius_)) - radius_);
    }

    double FreeSpace::distance(const Polygon &shape, double enough) const
    {
        const Box box = boundsOf(shape);
        const double toEnd = std::min((box.min - bounds_.min).minCoeff(), (bounds_.max - box.max).minCoeff());
        return std::max(0.0, outlines_.distance(shape, std::min(toEnd, enough)));
    }

    double FreeSpace::clearance(const Pose &pose, double enough) const
    {
        if (!isFinite(pose))
            return 0.0;
        if (hasOutline())
        {
            const Polygon body = placed(outline_, toLocal(pose));
            const double free = distance(body, enough);
            return free > 0.0 && !isInside(body.front()) ? free : 0.0;
        }
        // At a positive distance no outline crosses the shape.
        const OrientedBox shape = shapeAt(toLocal(pose));
        const double free = distance(shape, enough);
        return free > 0.0 && !isInside({shape.x, shape.y}) ? free : 0.0;
    }

    double FreeSpace::clearanceAlong(const Pose &from, double length, double enough) const
    {
        if (!isFinite(from) || !std::isfinite(length))
            return 0.0;
        OrientedBox covered = shapeAt(toLocal(from));
        covered.x += 0.5 * length * covered.cosine;
        covered.y += 0.5 * length * covered.sine;
        covered.halfLength += 0.5 * std::abs(length);
        return distance(covered, enough);
    }

    bool FreeSpace::isInside(const Eigen::Vector2d &point) const
    {
        if (!grid_)
            return outlines_.isInside(point);
        return isOccupied(clampIndex(point.x() / grid_->resolution(), grid_->width()),
                          clampIndex(point.y() / grid_->resolution(), grid_->height()));
    }

    bool FreeSpace::isFree(const Pose &pose) const
    {
        if (!isFinite(pose))
            return false;
        if (hasOutline())
        {
            const Polygon body = placed(smaller_, toLocal(pose));
            const Box box = boundsOf(body);
            return (box.min.array() >= bounds_.min.array()).all() && (box.max.array() <= bounds_.max.array()).all() &&
                   outlines_.distance(body, TOUCH) > 0.0 && !isInside(body.front());
        }
        OrientedBox shape = shapeAt(toLocal(pose));
        const Eigen::Vector2d reach = Eigen::Vector2d::Constant(radius_ - TOUCH);
        const Box box = shape.bounds();
        if ((box.min.array() - reach.array() < bounds_.min.array()).any() ||
            (box.max.array() + reach.array() > bounds_.max.array()).any())
            return false;
        if (radius_ > 0.0)
            return outlines_.distance(shape, radius_) >= radius_ - TOUCH && !isInside({shape.x, shape.y});
        shape.halfLength -= TOUCH;
        shape.halfWidth -= TOUCH;
        return outlines_.distance(shape, TOUCH) > 0.0 && !isInside({shape.x, shape.y});
    }
}  // namespace parking

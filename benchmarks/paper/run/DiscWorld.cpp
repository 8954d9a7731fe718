#include "benchmarks/paper/run/DiscWorld.h"

#include "benchmarks/system/ProcessorTime.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace parking
{
    namespace
    {
        // A disc ahead of the axle goes along an arc when the car turns; so finely cut, the chords are off by less than
        // the millimetre that is kept from obstacles anyway.
        constexpr double RADIANS_PER_CHORD = 0.05;

        double distanceToBox(const Eigen::Vector2d &point, const Box &box)
        {
            return (point - point.cwiseMax(box.min).cwiseMin(box.max)).norm();
        }

        double distanceToSegment(const Eigen::Vector2d &point, const Eigen::Vector2d &from, const Eigen::Vector2d &to)
        {
            const Eigen::Vector2d along = to - from;
            const double square = along.squaredNorm();
            const double share = square > 0.0 ? std::clamp((point - from).dot(along) / square, 0.0, 1.0) : 0.0;
            return (point - from - share * along).norm();
        }

        bool meets(const Eigen::Vector2d &from, const Eigen::Vector2d &to, const Box &box)
        {
            double enter = 0.0, leave = 1.0;
            for (int axis = 0; axis < 2; ++axis)
            {
                const double direction = to[axis] - from[axis];
                if (direction == 0.0)
                {
                    if (from[axis] < box.min[axis] || from[axis] > box.max[axis])
                        return false;
                    continue;
                }
                const double one = (box.min[axis] - from[axis]) / direction;
                const double other = (box.max[axis] - from[axis]) / direction;
                enter = std::max(enter, std::min(one, other));
                leave = std::min(leave, std::max(one, other));
            }
            return enter <= leave;
        }

        double distanceToBox(const Eigen::Vector2d &from, const Eigen::Vector2d &to, const Box &box)
        {
            double least = std::min(distanceToBox(from, box), distanceToBox(to, box));
            if (from == to || least == 0.0)
                return least;
            if (meets(from, to, box))
                return 0.0;
            for (const double x : {box.min.x(), box.max.x()})
                for (const double y : {box.min.y(), box.max.y()})
                    least = std::min(least, distanceToSegment({x, y}, from, to));
            return least;
        }
    }  // namespace

    DiscWorld::DiscWorld(const ObstacleSet &obstacles, const Box &bounds, double radius, double ahead,
                         DiscLookup lookup)
      : obstacles_(obstacles),
        bounds_(bounds),
        radius_(radius),
        ahead_(ahead)
    {
        if (!(radius > 0.0) || !std::isfinite(radius))
            throw Error("the radius of the disc must be a positive number of metres, not " + formatNumber(radius));
        if (lookup == DiscLookup::Scan && obstacles.cellSize() == 0.0)
            throw Error("a world of polygons has no cells that could be scanned; the lookup must be field");
        if (lookup == DiscLookup::Field)
            field_ = std::make_unique<const CircleChecker>(obstacles, radius);
    }

    Eigen::Vector2d DiscWorld::centre(const Pose &pose) const
    {
        return {pose.x + ahead_ * std::cos(pose.yaw), pose.y + ahead_ * std::sin(pose.yaw)};
    }

    bool DiscWorld::isScanFree(const Eigen::Vector2d &from, const Eigen::Vector2d &to)
    {
        const double size = obstacles_.cellSize();
        const auto columns = static_cast<std::ptrdiff_t>(obstacles_.columns());
        const auto rows = static_cast<std::ptrdiff_t>(obstacles_.rows());
        const Eigen::Vector2d low = from.cwiseMin(to), high = from.cwiseMax(to);
        // A cell that is only touched counts, too.
        const auto first = [size](double at)
        {
            return static_cast<std::ptrdiff_t>(std::ceil(at / size)) - 1;
        };
        const auto last = [size](double at)
        {
            return static_cast<std::ptrdiff_t>(std::floor(at / size));
        };
        for (std::ptrdiff_t row = first(low.y() - radius_); row <= last(high.y() + radius_); ++row)
            for (std::ptrdiff_t column = first(low.x() - radius_); column <= last(high.x() + radius_); ++column)
            {
                const Eigen::Vector2d corner(static_cast<double>(column) * size, static_cast<double>(row) * size);
                if (distanceToBox(from, to, {corner, corner + Eigen::Vector2d(size, size)}) > radius_)
                    continue;
                ++counts_.cells;
                if (row < 0 || column < 0 || row >= rows || column >= columns ||
                    obstacles_.cells()[static_cast<std::size_t>(row * columns + column)] != 0)
                    return false;
            }
        return true;
    }

    bool DiscWorld::isSweepFree(const Eigen::Vector2d &from, const Eigen::Vector2d &to)
    {
        ++counts_.positions;
        if (field_)
            return field_->isFree(to.x(), to.y()) &&
                   (from == to || field_->freeShare({from.x(), from.y(), 0.0}, {to.x(), to.y(), 0.0}) >= 1.0);
        const Pose begin = obstacles_.toLocal({from.x(), from.y(), 0.0});
        const Pose end = obstacles_.toLocal({to.x(), to.y(), 0.0});
        return isScanFree({begin.x, begin.y}, {end.x, end.y});
    }

    bool DiscWorld::isFree(const Pose &pose)
    {
        if (!isFinite(pose) || !bounds_.contains(pose.x, pose.y))
            return false;
        const Eigen::Vector2d at = centre(pose);
        return isSweepFree(at, at);
    }

    void DiscWorld::freeLengths(const Pose &from, const Arc *arcs, std::size_t count, double clearance, double *lengths)
    {
        for (std::size_t i = 0; i < count; ++i)
        {
            const auto &[curvature, length] = arcs[i];
            const double parts = std::max(1.0, std::ceil(std::abs(curvature * length) / RADIANS_PER_CHORD));
            double done = 0.0;
            for (Pose pose = from; done < parts && clearance <= 0.0; done += 1.0)
            {
                const Pose next = advance(from, curvature, length * (done + 1.0) / parts);
                if (!isMotionFree(pose, next))
                    break;
                pose = next;
            }
            lengths[i] = std::abs(length) * done / parts;
        }
    }

    double DiscWorld::roomAt(double /*x*/, double /*y*/)
    {
        return std::numeric_limits<double>::infinity();
    }

    bool DiscWorld::isMotionFree(const Pose &from, const Pose &to)
    {
        if (!counts_.firstMotionAt)
            counts_.firstMotionAt = processorTime();
        if (!isFinite(to) || !bounds_.contains(to.x, to.y))
            return false;
        const double turn = wrapAngle(to.yaw - from.yaw);
        const double parts = ahead_ == 0.0 ? 1.0 : std::max(1.0, std::ceil(std::abs(turn) / RADIANS_PER_CHORD));
        Eigen::Vector2d before = centre(from);
        for (double part = 1.0; part <= parts; part += 1.0)
        {
            const double share = part / parts;
            const Eigen::Vector2d next =
                centre({from.x + share * (to.x - from.x), from.y + share * (to.y - from.y), from.yaw + share * turn});
            if (!isSweepFree(before, next))
                return false;
            before = next;
        }
        return true;
    }
}  // namespace parking

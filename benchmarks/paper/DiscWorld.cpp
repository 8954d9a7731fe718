#include "benchmarks/paper/DiscWorld.h"

#include "benchmarks/system/ProcessorTime.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <Eigen/Core>

namespace parking
{
    DiscWorld::DiscWorld(const ObstacleSet &obstacles, const Box &bounds, double radius, double ahead, bool scan)
      : obstacles_(obstacles),
        bounds_(bounds),
        radius_(radius),
        ahead_(ahead)
    {
        if (!(radius > 0.0) || !std::isfinite(radius))
            throw Error("the radius of the disc must be a positive number of metres, not " + formatNumber(radius));
        if (scan && obstacles.cellSize() == 0.0)
            throw Error("a world of polygons has no cells to scan; the lookup must be field");
        if (!scan)
            field_ = std::make_unique<const CircleChecker>(obstacles, radius);
    }

    bool DiscWorld::isScanFree(double x, double y)
    {
        const Pose local = obstacles_.toLocal({x, y, 0.0});
        const Eigen::Vector2d centre(local.x, local.y);
        const double size = obstacles_.cellSize();
        const auto columns = static_cast<std::ptrdiff_t>(obstacles_.columns());
        const auto rows = static_cast<std::ptrdiff_t>(obstacles_.rows());
        // A cell that is only touched is occupied, too.
        const auto first = [&](double at)
        {
            return static_cast<std::ptrdiff_t>(std::ceil((at - radius_) / size)) - 1;
        };
        const auto last = [&](double at)
        {
            return static_cast<std::ptrdiff_t>(std::floor((at + radius_) / size));
        };
        for (std::ptrdiff_t row = first(centre.y()); row <= last(centre.y()); ++row)
            for (std::ptrdiff_t column = first(centre.x()); column <= last(centre.x()); ++column)
            {
                const Eigen::Vector2d low(static_cast<double>(column) * size, static_cast<double>(row) * size);
                const Eigen::Vector2d high = low + Eigen::Vector2d(size, size);
                if ((centre - centre.cwiseMax(low).cwiseMin(high)).norm() > radius_)
                    continue;
                ++counts_.cells;
                if (row < 0 || column < 0 || row >= rows || column >= columns ||
                    obstacles_.cells()[static_cast<std::size_t>(row * columns + column)] != 0)
                    return false;
            }
        return true;
    }

    bool DiscWorld::isFree(const Pose &pose)
    {
        if (!isFinite(pose) || !bounds_.contains(pose.x, pose.y))
            return false;
        ++counts_.positions;
        const double x = pose.x + ahead_ * std::cos(pose.yaw), y = pose.y + ahead_ * std::sin(pose.yaw);
        return field_ ? field_->isFree(x, y) : isScanFree(x, y);
    }

    bool DiscWorld::isMotionFree(const Pose & /*from*/, const Pose & /*to*/)
    {
        if (!counts_.firstMotionAt)
            counts_.firstMotionAt = processorTime();
        return true;
    }

    void DiscWorld::freeLengths(const Pose & /*from*/, const Arc * /*arcs*/, std::size_t count, double /*clearance*/,
                                double *lengths)
    {
        std::fill_n(lengths, count, 0.0);
    }

    double DiscWorld::roomAt(double /*x*/, double /*y*/)
    {
        return std::numeric_limits<double>::infinity();
    }
}  // namespace parking

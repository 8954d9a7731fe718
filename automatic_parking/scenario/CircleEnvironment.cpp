#include "automatic_parking/scenario/CircleEnvironment.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        constexpr double TOLERANCE = 1e-3;  // metres kept along arcs
    }

    bool CircleEnvironment::isFree(const Pose &pose)
    {
        return bounds_.contains(pose.x, pose.y) && checker_.isFree(pose.x, pose.y);
    }

    double CircleEnvironment::clearance(const Pose &pose)
    {
        return bounds_.contains(pose.x, pose.y) ? checker_.clearance(pose.x, pose.y) : 0.0;
    }

    double CircleEnvironment::freeLength(const Pose &from, double curvature, double length)
    {
        const double whole = std::abs(length);
        for (double driven = 0.0; driven < whole;)
        {
            const Pose pose = advance(from, curvature, std::copysign(driven, length));
            const double kept = clearance(pose);
            if (kept < TOLERANCE)
                return driven;
            driven += kept;
        }
        return isFree(advance(from, curvature, length)) ? whole : 0.0;
    }

    double CircleEnvironment::roomAt(double x, double y)
    {
        return checker_.roomAt(x, y);
    }

    bool CircleEnvironment::isMotionFree(const Pose &from, const Pose &to)
    {
        return isFree(to) && checker_.freeShare(from, to) >= 1.0;
    }
}  // namespace parking

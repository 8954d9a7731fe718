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

    double CircleEnvironment::clearance(const Pose &pose) const
    {
        return bounds_.contains(pose.x, pose.y) ? checker_.clearance(pose.x, pose.y) : 0.0;
    }

    bool CircleEnvironment::keeps(const Pose &pose, double clearance)
    {
        return this->clearance(pose) >= clearance;
    }

    void CircleEnvironment::freeLengths(const Pose &from, const Arc *arcs, std::size_t count, double clearance,
                                        double *lengths)
    {
        for (std::size_t i = 0; i < count; ++i)
        {
            const double whole = std::abs(arcs[i].length);
            double driven = 0.0;
            while (driven < whole)
            {
                const double kept =
                    this->clearance(advance(from, arcs[i].curvature, std::copysign(driven, arcs[i].length)));
                if (kept < clearance + TOLERANCE)
                    break;
                driven += kept - clearance;
            }
            const bool isWhole = driven >= whole && isFree(advance(from, arcs[i].curvature, arcs[i].length));
            lengths[i] = isWhole ? whole : driven < whole ? driven : 0.0;
        }
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

#include "path_tracking/trajectory/MotionCheck.h"

#include <cmath>

namespace parking
{
    namespace
    {
        constexpr double STEP = 0.02;  // seconds
        constexpr double WAY = 0.1;    // metres
    }                                  // namespace

    std::vector<Pose> collisionsOf(const TimedMotion &motion, const FootprintChecker &checker, std::size_t most)
    {
        const Vehicle &vehicle = checker.vehicle();
        std::vector<Pose> hits;
        CheckCounts counts;
        visitParts(motion, vehicle, STEP, WAY,
                   [&](const MotionPart &part)
                   {
                       const double length = 0.5 * (part.from.v + part.to.v) * (part.end - part.begin);
                       const double curvature = vehicle.curvature(0.5 * (part.from.steering + part.to.steering));
                       if (length != 0.0 && checker.freeLength(part.before, curvature, length, MOTION_CHECK_TOLERANCE,
                                                               counts) < std::abs(length))
                           hits.push_back(part.before);
                       return hits.size() < most;
                   });
        return hits;
    }
}  // namespace parking

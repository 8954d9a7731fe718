#include "path_tracking/trajectory/MotionCheck.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        constexpr double STEP = 0.02;  // seconds
        constexpr double WAY = 0.1;    // metres
        /** Metres of a part from which on all of the tolerance is needed. What an arc leaves grows with its length: so
           a car may park within hundredths of a millimetre of an obstacle. */
        constexpr double FULL_TOLERANCE_WAY = 0.02;
        constexpr double LEAST_TOLERANCE = 0.005;  // share of the tolerance, for rounding

        double toleranceOf(double length)
        {
            return MOTION_CHECK_TOLERANCE * std::clamp(std::abs(length) / FULL_TOLERANCE_WAY, LEAST_TOLERANCE, 1.0);
        }
    }  // namespace

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
                       if (length != 0.0 && checker.freeLength(part.before, curvature, length, toleranceOf(length),
                                                               counts) < std::abs(length))
                           hits.push_back(part.before);
                       return hits.size() < most;
                   });
        return hits;
    }
}  // namespace parking

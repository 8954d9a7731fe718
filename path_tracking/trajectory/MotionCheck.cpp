#include "path_tracking/trajectory/MotionCheck.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        constexpr double STEP = 0.02;  // seconds
        constexpr double WAY = 0.1;    // metres
        /** Metres of a part above which the whole tolerance applies. The deviation of an arc grows with its length. A
            car may therefore park within hundredths of a millimetre of an obstacle. */
        constexpr double FULL_TOLERANCE_LENGTH = 0.02;
        constexpr double MIN_TOLERANCE = 0.005;  // share of the tolerance, for rounding

        double toleranceOf(double length)
        {
            return MOTION_CHECK_TOLERANCE * std::clamp(std::abs(length) / FULL_TOLERANCE_LENGTH, MIN_TOLERANCE, 1.0);
        }

        constexpr double COVERED = 0.5;    // share of the enlargement of the body that an arc may deviate from a part
        constexpr int MAX_DIVISIONS = 16;  // of a part, into halves: fifteen suffice within a nanometre of an obstacle

        /** Whether the body is free along a part. The part is swept as an arc. It is halved if obstacles leave too
            little clearance for the deviation of the arc. */
        bool isFree(const MotionPart &part, const FootprintChecker &checker, int divisions)
        {
            const Vehicle &vehicle = checker.vehicle();
            const double length = part.length();
            if (length == 0.0)
                return true;
            CheckCounts counts;
            const double curvature = vehicle.curvature(0.5 * (part.from.steering + part.to.steering));
            const auto start = checker.sweepStart(part.before, toleranceOf(length), counts);
            // The curvature differs nowhere by more than this. The heading therefore differs by at most this times the
            // length, and the position by half of that.
            const double spread = std::max(std::abs(vehicle.curvature(part.from.steering) - curvature),
                                           std::abs(vehicle.curvature(part.to.steering) - curvature));
            const double left = spread * std::abs(length) * (checker.farthestPoint() + 0.5 * std::abs(length));
            if (start.enlargement < 0.0 || left <= COVERED * start.enlargement)
                return checker.freeLength(start, curvature, length, counts) >= std::abs(length);
            return divisions < MAX_DIVISIONS &&
                   visitParts({part.before, {part.from, part.to}}, vehicle, 0.5 * part.duration(), WAY,
                              [&](const MotionPart &half) { return isFree(half, checker, divisions + 1); });
        }
    }  // namespace

    std::vector<Pose> collisionsOf(const TimedMotion &motion, const FootprintChecker &checker, std::size_t most)
    {
        std::vector<Pose> hits;
        visitParts(motion, checker.vehicle(), STEP, WAY,
                   [&](const MotionPart &part)
                   {
                       if (!isFree(part, checker, 0))
                           hits.push_back(part.before);
                       return hits.size() < most;
                   });
        return hits;
    }
}  // namespace parking

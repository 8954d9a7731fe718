#include "state_validity/CircleChecker.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace parking
{
    namespace
    {
        constexpr double CLEARANCE_REACH = 1.0;  // metres beyond the circle within which distances are exact
        constexpr double TOLERANCE = 1e-3;       // metres kept along motions
        constexpr double TOUCHING = 1e-9;        // metres: a motion may not begin nearer to an obstacle
        /** Largest number of steps nearer to an obstacle than the tolerance. Straight away from it each step is twice
            as long as the previous one. Along it the steps would stay short. */
        constexpr int MAX_NEAR_STEPS = 200;

        double checked(double radius)
        {
            if (!(radius > 0.0) || !std::isfinite(radius))
                throw Error("radius of the circle must be a positive number of metres, not " + formatNumber(radius));
            return radius;
        }
    }  // namespace

    CircleChecker::CircleChecker(ObstacleSet obstacles, double radius)
      : obstacles_(std::move(obstacles)),
        radius_(checked(radius)),
        field_(obstacles_),
        edges_(obstacles_, radius + CLEARANCE_REACH)
    {
    }

    double CircleChecker::distance(double x, double y) const
    {
        const Pose local = obstacles_.toLocal({x, y, 0.0});
        const double bound = field_.lowerBound(local.x, local.y);
        if (bound >= radius_ + CLEARANCE_REACH)
            return bound;
        if (field_.upperBound(local.x, local.y) < radius_)
            return 0.0;
        if (!field_.isOutside(local.x, local.y) && obstacles_.covers(local.x, local.y))
            return 0.0;
        return std::max(bound, std::min(edges_.distance(local.x, local.y), edges_.reach()));
    }

    bool CircleChecker::isFree(double x, double y) const
    {
        const Pose local = obstacles_.toLocal({x, y, 0.0});
        return field_.lowerBound(local.x, local.y) > radius_ || distance(x, y) > radius_;
    }

    double CircleChecker::clearance(double x, double y) const
    {
        return std::max(0.0, distance(x, y) - radius_);
    }

    double CircleChecker::freeShare(const Pose &from, const Pose &to) const
    {
        const double length = positionDistance(to, from);
        if (!std::isfinite(length))
            return 0.0;
        double driven = 0.0, minKept = TOUCHING;
        int nearSteps = 0;
        while (driven < length)
        {
            const double share = driven / length;
            const double kept = clearance(from.x + share * (to.x - from.x), from.y + share * (to.y - from.y));
            if (kept < minKept || (kept < TOLERANCE && ++nearSteps > MAX_NEAR_STEPS))
                return share;
            // From the start the circle may move away from an obstacle that it almost touches.
            if (driven == 0.0)
                minKept = std::min(TOLERANCE, kept);
            driven += kept;
        }
        return 1.0;
    }
}  // namespace parking

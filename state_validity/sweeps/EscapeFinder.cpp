#include "state_validity/sweeps/EscapeFinder.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace parking
{
    namespace
    {
        constexpr double STEP = 0.01;                                                       // metres swept at a time
        constexpr double PRECISION = 1e-6;                                                  // metres, of depths
        constexpr double STEERINGS[]{0.0, 0.25, -0.25, 0.5, -0.5, 0.75, -0.75, 1.0, -1.0};  // shares of full lock
        constexpr double MAX_SHRINKAGE = 0.5;  // share of half the body's smaller side
    }                                          // namespace

    EscapeFinder::EscapeFinder(const FootprintChecker &checker)
      : checker_(checker),
        centreOffset_(checker.vehicle().centreOffset()),
        halfLength_(0.5 * checker.vehicle().length() + checker.margin()),
        halfWidth_(0.5 * checker.vehicle().width + checker.margin()),
        edges_(checker.obstacles().edges(), checker.obstacles().bounds(),
               std::hypot(halfLength_, halfWidth_) + 2.0 * STEP)
    {
    }

    OrientedBox EscapeFinder::shrunkBody(const Pose &pose, double by) const
    {
        return bodyAt(checker_.obstacles().toLocal(pose), centreOffset_, halfLength_ - by, halfWidth_ - by);
    }

    /** Whether the body is free with its sides moved inwards by \e depth. */
    bool EscapeFinder::isFree(const Pose &pose, double depth) const
    {
        // Without contact with an outline the body lies wholly inside or outside of each obstacle, as its centre does.
        const OrientedBox body = shrunkBody(pose, depth);
        return edges_.separation(body, FootprintChecker::CONTACT_BAND) > 0.0 &&
               !checker_.obstacles().covers(body.x, body.y);
    }

    double EscapeFinder::depth(const Pose &pose, double maxDepth) const
    {
        if (!isFinite(pose))
            return std::numeric_limits<double>::infinity();
        if (checker_.isFree(pose))
            return 0.0;
        double low = 0.0, high = std::min(maxDepth, MAX_SHRINKAGE * std::min(halfLength_, halfWidth_));
        if (!isFree(pose, high))
            return std::numeric_limits<double>::infinity();
        while (high - low > PRECISION)
        {
            const double middle = 0.5 * (low + high);
            (isFree(pose, middle) ? high : low) = middle;
        }
        return high;
    }

    bool EscapeFinder::isStepFree(const Pose &from, const Arc &step, double depth) const
    {
        const OrientedBox body = shrunkBody(from, depth);
        const double length = std::abs(step.length), half = 0.5 * std::abs(step.curvature) * length;
        const BoxSweep sweep{
            body.halfLength, body.halfWidth, -centreOffset_, step.curvature, step.length < 0.0 ? -1.0 : 1.0, length};
        return isFree(from, depth) && edges_.firstContact(body, sweep, std::cos(half), std::sin(half)) > length &&
               isFree(advance(from, step), depth);
    }

    /** Metres along an arc in the given \e direction, by curvature and sign, until the car is free; infinite if the
        depth rises or the car is not free within the body's length. */
    double EscapeFinder::escapeLength(const Pose &from, const Arc &direction, double depth) const
    {
        double limit = depth + DEPTH_TOLERANCE;
        const auto steps = static_cast<int>(2.0 * halfLength_ / STEP);
        Pose pose = from;
        for (int i = 1; i <= steps; ++i)
        {
            const Arc step{direction.curvature, std::copysign(STEP, direction.length)};
            if (!isStepFree(pose, step, limit))
                break;
            pose = advance(from, direction.curvature, i * step.length);
            if (checker_.isFree(pose))
                return i * STEP;
            limit = std::min(limit, this->depth(pose, limit) + DEPTH_TOLERANCE);
        }
        return std::numeric_limits<double>::infinity();
    }

    std::vector<Escape> EscapeFinder::find(const Pose &pose, double maxDepth, double turningRadius,
                                           bool forwardOnly) const
    {
        std::vector<Escape> escapes;
        const double contact = depth(pose, maxDepth);
        if (contact == 0.0 || std::isinf(contact))
            return escapes;
        for (const double steering : STEERINGS)
            for (const double direction : {1.0, -1.0})
            {
                if (direction < 0.0 && forwardOnly)
                    continue;
                const Arc arc{steering / turningRadius, direction};
                const double length = escapeLength(pose, arc, contact);
                if (std::isfinite(length))
                    escapes.push_back({pose, {arc.curvature, direction * length}, contact});
            }
        std::stable_sort(escapes.begin(), escapes.end(),
                         [](const Escape &a, const Escape &b)
                         { return std::abs(a.arc.length) < std::abs(b.arc.length); });
        return escapes;
    }
}  // namespace parking

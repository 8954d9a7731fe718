#include "state_validity/sweeps/ClearanceProof.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace parking
{
    namespace
    {
        // Smallest clearances that prove a motion free, as shares of the tolerance: along the motion and at its ends.
        constexpr double MIN_CLEARANCE = 0.1, MIN_END_CLEARANCE = 1e-4;
        // Metres of a proven clearance that are not used, so that poses at its end are not in contact.
        constexpr double APART = 1.5 * FootprintChecker::CONTACT_BAND;
        constexpr int MAX_TIGHT_CHECKS = 4096;  // with a clearance below the tolerance, which prove only short parts
    }                                           // namespace

    double ClearanceProof::toleranceBetween(const Pose &from, const Pose &to, CheckCounts &counts) const
    {
        double tolerance = MIN_CLEARANCE * tolerance_;
        for (const Pose &pose : {from, to})
            if (!footprint_.keeps(pose, 2.0 * tolerance, counts))
                tolerance = std::min(tolerance, 0.5 * footprint_.exactClearance(pose));
        return std::max(tolerance, MIN_END_CLEARANCE * tolerance_);
    }

    MotionProof ClearanceProof::proveLine(const Pose &from, const Pose &to, bool exact, CheckCounts &counts) const
    {
        if (!isFinite(from) || !isFinite(to))
            return {false, 0.0, from};
        const double dx = to.x - from.x, dy = to.y - from.y, turn = wrapAngle(to.yaw - from.yaw);
        const auto at = [&](double t)
        {
            return Pose{from.x + t * dx, from.y + t * dy, from.yaw + t * turn};
        };
        return prove(at, std::hypot(dx, dy) + std::abs(turn) * footprint_.farthestPoint(), exact, counts);
    }

    MotionProof ClearanceProof::prove(const std::function<Pose(double)> &at, double moved, bool exact,
                                      CheckCounts &counts) const
    {
        const double length = moved * (1.0 + 1e-9) + 1e-12;
        // Parts still to be proven free, the earliest on top. Everything before its beginning is proven.
        std::array<std::pair<double, double>, 128> open;
        std::size_t count = 0;
        open[count++] = {0.0, 1.0};
        double proven = 0.0, tolerance = tolerance_;
        int tight = 0;
        while (count > 0)
        {
            const auto [begin, end] = open[--count];
            const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin) * length;
            const Pose pose = at(middle);
            double clearance = footprint_.clearance(pose, half + APART, counts) - APART;
            if (clearance < half && clearance < tolerance_)
                clearance = footprint_.exactClearance(pose) * (1.0 - 1e-9) - APART;
            if (clearance >= half)
            {
                proven = end;
                continue;
            }
            proven = begin;
            if (clearance > 0.0 && clearance < tolerance && tolerance == tolerance_)
                tolerance = toleranceBetween(at(0.0), at(1.0), counts);
            if (clearance < tolerance_ && ++tight > MAX_TIGHT_CHECKS)
                break;
            if (clearance < tolerance)
            {
                // This pose is not proven free, so only the part before it still matters.
                if (!exact || half < tolerance)
                    break;
                count = 0;
                open[count++] = {begin, middle};
                continue;
            }
            const double covered = clearance / length;
            if (count + 2 > open.size())
                break;
            open[count++] = {middle + covered, end};
            open[count++] = {begin, middle - covered};
        }
        return proven >= 1.0 ? MotionProof{true, 1.0, at(1.0)} : MotionProof{false, proven, at(proven)};
    }
}  // namespace parking

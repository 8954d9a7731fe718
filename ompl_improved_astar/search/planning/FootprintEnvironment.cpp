#include "ompl_improved_astar/search/planning/FootprintEnvironment.h"

#include "state_validity/FootprintCells.h"
#include "state_validity/sweeps/ClearanceProof.h"
#include "state_validity/sweeps/EscapeFinder.h"
#include "state_validity/sweeps/SweptBox.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        constexpr double RADIANS_AT_A_TIME = 1.0;
        constexpr double A_HAIR = 1e-9;  // metres
    }                                    // namespace

    FootprintEnvironment::FootprintEnvironment(const FootprintChecker &checker, const Box &bounds, double tolerance,
                                               search::MotionEnvironment *judge)
      : checker_(checker),
        bounds_(bounds),
        tolerance_(tolerance),
        judge_(judge)
    {
        // The body stays in the checker's world; where that lies inside of the bounds, so does the rear axle.
        const Box &world = checker.obstacles().bounds();
        const Pose &frame = checker.obstacles().frame();
        boundsMatter_ = frame.yaw != 0.0 || frame.x + world.min.x() < bounds.min.x() ||
                        frame.y + world.min.y() < bounds.min.y() || frame.x + world.max.x() > bounds.max.x() ||
                        frame.y + world.max.y() > bounds.max.y();
    }

    bool FootprintEnvironment::isFree(const Pose &pose)
    {
        return (!boundsMatter_ || bounds_.contains(pose.x, pose.y)) && checker_.isFree(pose, counts_);
    }

    void FootprintEnvironment::freeLengths(const Pose &from, const Arc *arcs, std::size_t count, double clearance,
                                           double *lengths)
    {
        std::fill(lengths, lengths + count, 0.0);
        // A clearance too large to sweep, or too small to prove anything free, is left to sampling.
        if (clearance > FootprintChecker::MAX_TOLERANCE || (clearance > 0.0 && clearance < tolerance_))
            return;
        const FootprintChecker::SweepStart start =
            checker_.sweepStart(from, clearance > 0.0 ? clearance : tolerance_, counts_);
        if (start.enlargement < clearance)
            return;
        for (std::size_t i = 0; i < count; ++i)
        {
            const auto &[curvature, length] = arcs[i];
            const double whole = std::abs(length);
            const double inside = boundsMatter_ ? lengthInside(from, curvature, length) : whole;
            lengths[i] = checker_.freeLength(start, curvature, std::copysign(std::min(inside, whole), length), counts_);
        }
    }

    bool FootprintEnvironment::keeps(const Pose &pose, double clearance)
    {
        return checker_.keeps(pose, clearance, counts_);
    }

    double FootprintEnvironment::lengthInside(const Pose &from, double curvature, double length) const
    {
        // The rear axle as a box of no size, the bounds as four walls in its frame.
        const double whole = std::abs(length), direction = length < 0.0 ? -1.0 : 1.0;
        if (!bounds_.contains(from.x, from.y))
            return 0.0;
        // Far from the walls, as most poses are: on no arc does the axle get farther than the arc is long.
        if (from.x - bounds_.min.x() > whole && bounds_.max.x() - from.x > whole && from.y - bounds_.min.y() > whole &&
            bounds_.max.y() - from.y > whole)
            return whole;
        // The walls stand a hair outside: else who begins on the bounds touches one even when driving away from it.
        const Eigen::Vector2d hair(A_HAIR, A_HAIR), low = bounds_.min - hair, high = bounds_.max + hair;
        double driven = 0.0;
        while (driven < whole)
        {
            const Pose pose = advance(from, curvature, direction * driven);
            const double stride = std::min(whole - driven, RADIANS_AT_A_TIME / (std::abs(curvature) + 1e-9));
            const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
            const Eigen::Vector2d corners[4] = {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
            double contact = stride;
            bool leaves = false;
            for (int i = 0; i < 4; ++i)
            {
                const Eigen::Vector2d a = corners[i] - Eigen::Vector2d(pose.x, pose.y);
                const Eigen::Vector2d b = corners[(i + 1) % 4] - Eigen::Vector2d(pose.x, pose.y);
                const BoxSweep sweep{0.0, 0.0, 0.0, curvature, direction, contact};
                const double at = firstContact(sweep, c * a.x() + s * a.y(), c * a.y() - s * a.x(),
                                               c * b.x() + s * b.y(), c * b.y() - s * b.x());
                if (at <= contact)
                {
                    contact = at;
                    leaves = true;
                }
            }
            if (leaves)
                return std::max(0.0, driven + contact - tolerance_);
            driven += stride;
        }
        const Pose end = advance(from, curvature, length);
        return bounds_.contains(end.x, end.y) ? whole : std::max(0.0, whole - tolerance_);
    }

    double FootprintEnvironment::roomAt(double x, double y)
    {
        const Pose local = checker_.obstacles().toLocal({x, y, 0.0});
        return checker_.field().closeUpperBound(local.x, local.y);
    }

    bool FootprintEnvironment::isMotionFree(const Pose &from, const Pose &to)
    {
        // The bounds are convex: between two positions in them all are.
        return isFree(to) && (!boundsMatter_ || bounds_.contains(from.x, from.y)) &&
               ClearanceProof(checker_, tolerance_).proveLine(from, to, false, counts_).whole;
    }

    search::BlockedHeadings FootprintEnvironment::blockedHeadings(double side, int headings)
    {
        return [cells = FootprintCells(checker_, side, headings)](double x, double y)
        {
            return cells.blocked(x, y);
        };
    }

    std::vector<Escape> FootprintEnvironment::escapes(const Pose &pose, double maxDepth, double turningRadius,
                                                      bool forwardOnly)
    {
        std::vector<Escape> escapes = EscapeFinder(checker_).find(pose, maxDepth, turningRadius, forwardOnly);
        const auto leaves = [&](const Escape &escape)
        {
            const auto &[curvature, length] = escape.arc;
            return boundsMatter_ && lengthInside(pose, curvature, length) < std::abs(length);
        };
        escapes.erase(std::remove_if(escapes.begin(), escapes.end(), leaves), escapes.end());
        return escapes;
    }

    bool FootprintEnvironment::acceptPath(const Path &path)
    {
        return judge_ == nullptr || judge_->acceptPath(path);
    }
}  // namespace parking

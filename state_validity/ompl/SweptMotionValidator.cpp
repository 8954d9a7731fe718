#include "state_validity/ompl/SweptMotionValidator.h"

#include "parking_geometry/Pose.h"
#include "state_validity/ompl/FclFootprintChecker.h"
#include "state_validity/ompl/OmplCompatibility.h"
#include "state_validity/ompl/OmplPose.h"
#include "state_validity/sweeps/ClearanceProof.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/util/Exception.h>

namespace ob = ompl::base;

namespace parking
{
    namespace
    {
        constexpr double MAX_TOLERANCE = 0.1;

        std::shared_ptr<const FootprintChecker> footprintOf(const ob::SpaceInformationPtr &si)
        {
            const auto *checker = dynamic_cast<const FclFootprintChecker *>(si->getStateValidityChecker().get());
            if (checker == nullptr)
                throw ompl::Exception(
                    "state validity checker of the space information must be an FclFootprintChecker "
                    "(set it first), or the footprint must be given");
            return checker->sharedFootprint();
        }

        /** The bounding box of the rear axle's path along an arc. */
        Box extents(const Pose &from, double curvature, double length)
        {
            const Pose to = advance(from, curvature, length);
            Box box{{from.x, from.y}, {from.x, from.y}};
            box.include({to.x, to.y});
            // In between, x and y are extreme where the heading is a multiple of a right angle.
            const double first = std::min(from.yaw, to.yaw), last = std::max(from.yaw, to.yaw);
            for (double quarter = std::ceil(first / (0.5 * PI)); quarter * 0.5 * PI < last; quarter += 1.0)
            {
                const Pose at = advance(from, curvature, (quarter * 0.5 * PI - from.yaw) / curvature);
                box.include({at.x, at.y});
            }
            return box;
        }

        bool isWithin(const Box &box, const ob::RealVectorBounds &bounds)
        {
            // The tolerance of RealVectorStateSpace::satisfiesBounds() and a margin for the rounding of a curve.
            constexpr double SLACK = 1e-9;
            return box.min.x() >= bounds.low[0] - SLACK && box.min.y() >= bounds.low[1] - SLACK &&
                   box.max.x() <= bounds.high[0] + SLACK && box.max.y() <= bounds.high[1] + SLACK;
        }

        /** Length that the rear axle drives along an arc within the bounds, at most |length|. */
        double lengthWithin(const ob::RealVectorBounds &bounds, const Pose &from, double curvature, double length)
        {
            if (isWithin(extents(from, curvature, length), bounds))
                return std::abs(length);
            double inside = 0.0, outside = 1.0;
            while (outside - inside > 1e-9)
            {
                const double middle = 0.5 * (inside + outside);
                (isWithin(extents(from, curvature, middle * length), bounds) ? inside : outside) = middle;
            }
            return inside * std::abs(length);
        }
    }  // namespace

    SweptMotionValidator::SweptMotionValidator(const ob::SpaceInformationPtr &si,
                                               std::shared_ptr<const FootprintChecker> footprint, double tolerance)
      : ob::MotionValidator(si),
        space_(*si->getStateSpace()),
        footprint_(std::move(footprint)),
        tolerance_(tolerance)
    {
        if (!footprint_)
            throw ompl::Exception("footprint checker must not be null");
        if (!(tolerance > 0.0 && tolerance <= MAX_TOLERANCE))
            throw ompl::Exception("tolerance of the motion validator must be above 0 m and at most " +
                                  std::to_string(MAX_TOLERANCE) + " m, not " + std::to_string(tolerance));
    }

    SweptMotionValidator::SweptMotionValidator(const ob::SpaceInformationPtr &si, double tolerance)
      : SweptMotionValidator(si, footprintOf(si), tolerance)
    {
    }

    bool SweptMotionValidator::checkMotion(const ob::State *s1, const ob::State *s2) const
    {
        const bool valid = si_->isValid(s2) && prove(s1, s2, false).whole;
        ompl_compatibility::countUp(valid ? valid_ : invalid_);
        return valid;
    }

    bool SweptMotionValidator::checkMotion(const ob::State *s1, const ob::State *s2,
                                           std::pair<ob::State *, double> &lastValid) const
    {
        const bool endValid = si_->isValid(s2);
        const MotionProof proof = prove(s1, s2, true);
        if (endValid && proof.whole)
        {
            ompl_compatibility::countUp(valid_);
            return true;
        }
        ompl_compatibility::countUp(invalid_);

        // OMPL requires that the returned state is valid by the checker of the space information, which may test more
        // than the footprint. The returned state may share memory with s1 or s2, so a temporary state is used.
        const auto release = [this](ob::State *state)
        {
            si_->freeState(state);
        };
        const std::unique_ptr<ob::State, decltype(release)> last(si_->allocState(), release);
        lastValid.second = proof.fraction;
        if (proof.whole)
        {
            lastValid.second = std::max(0.0, 1.0 - tolerance_ / si_->distance(s1, s2));
            si_->getStateSpace()->interpolate(s1, s2, lastValid.second, last.get());
        }
        else
            setPose(last.get(), proof.pose);
        if (!(lastValid.second > 0.0) || !si_->isValid(last.get()))
        {
            lastValid.second = 0.0;
            si_->copyState(last.get(), s1);
        }
        if (lastValid.first != nullptr)
            si_->copyState(lastValid.first, last.get());
        return false;
    }

    MotionProof SweptMotionValidator::prove(const ob::State *s1, const ob::State *s2, bool exact) const
    {
        CheckCounts counts;
        MotionProof proof;
        const Pose from = poseOf(s1);
        if (space_.kind() == SpaceKind::SE2)
            proof = ClearanceProof(*footprint_, tolerance_).proveLine(from, poseOf(s2), exact, counts);
        else
        {
            ReedsSheppCurve curve;
            space_.curve(s1, s2, curve);
            proof = proveCurve(from, curve, counts);
        }
        counters_.add(counts);
        return proof;
    }

    MotionProof SweptMotionValidator::proveCurve(const Pose &from, const ReedsSheppCurve &curve,
                                                 CheckCounts &counts) const
    {
        if (!std::isfinite(curve.length))
            return {false, 0.0, from};
        const auto &bounds = static_cast<const ob::SE2StateSpace *>(si_->getStateSpace().get())->getBounds();
        Pose pose = from;
        double driven = 0.0;
        for (std::size_t i = 0; i < curve.count; ++i)
        {
            const Arc &arc = curve.pieces[i];
            const double wanted = std::abs(arc.length);
            const Pose end = advance(pose, arc.curvature, arc.length);
            const double inside = lengthWithin(bounds, pose, arc.curvature, arc.length);
            const double free = std::min(
                inside,
                footprint_->freeLength(pose, arc.curvature, std::copysign(inside, arc.length), tolerance_, counts));
            if (free < wanted && (inside < wanted || !(isLeaving(end, {arc.curvature, -arc.length}, counts) ||
                                                       isPassing(pose, arc, free, counts))))
                return {false, (driven + free) / curve.length,
                        advance(pose, arc.curvature, std::copysign(free, arc.length))};
            pose = end;
            driven += wanted;
        }
        return {true, 1.0, pose};
    }

    bool SweptMotionValidator::isLeaving(const Pose &from, const Arc &arc, CheckCounts &counts) const
    {
        const FootprintChecker::SweepStart start = footprint_->sweepStart(from, tolerance_, counts);
        return start.enlargement > 0.0 && start.enlargement < tolerance_ &&
               footprint_->freeLength(start, arc.curvature, arc.length, counts) >= std::abs(arc.length);
    }

    bool SweptMotionValidator::isPassing(const Pose &from, const Arc &arc, double free, CheckCounts &counts) const
    {
        const auto at = [&](double driven)
        {
            return advance(from, arc.curvature, std::copysign(driven, arc.length));
        };
        const double rest = std::abs(arc.length) - free;
        // In most cases the body collides immediately beyond.
        if (!footprint_->isFree(at(free + std::min(rest, 2.0 * tolerance_)), counts))
            return false;
        return ClearanceProof(*footprint_, tolerance_)
            .prove([&](double t) { return at(free + t * rest); }, rest * footprint_->speedFactor(arc.curvature), false,
                   counts)
            .whole;
    }
}  // namespace parking

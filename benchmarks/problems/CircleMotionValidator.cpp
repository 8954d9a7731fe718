#include "benchmarks/problems/CircleMotionValidator.h"

#include "state_validity/ompl/OmplCompatibility.h"
#include "state_validity/ompl/OmplPose.h"

#include <ompl/base/ScopedState.h>

#include <cmath>
#include <utility>

namespace ob = ompl::base;

namespace parking
{
    CircleMotionValidator::CircleMotionValidator(const ob::SpaceInformationPtr &si,
                                                 std::shared_ptr<const CircleValidityChecker> checker)
      : ob::MotionValidator(si),
        checker_(std::move(checker))
    {
    }

    double CircleMotionValidator::freeShare(const ob::State *s1, const ob::State *s2) const
    {
        const Pose from = poseOf(s1), to = poseOf(s2);
        const double length = positionDistance(to, from);
        if (!std::isfinite(length))
            return 0.0;
        ob::ScopedState<> state(si_->getStateSpace());
        double driven = 0.0;
        while (driven < length)
        {
            const double share = driven / length;
            setPose(state.get(), {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y), from.yaw});
            const double clearance = checker_->clearance(state.get());
            // The start is taken to be free; from there the disc may move away from an obstacle that it all but
            // touches.
            if (clearance < (driven == 0.0 ? 1e-9 : TOLERANCE))
                return share;
            driven += clearance;
        }
        return 1.0;
    }

    bool CircleMotionValidator::checkMotion(const ob::State *s1, const ob::State *s2) const
    {
        const bool valid = si_->isValid(s2) && freeShare(s1, s2) >= 1.0;
        ompl_compatibility::countUp(valid ? valid_ : invalid_);
        return valid;
    }

    bool CircleMotionValidator::checkMotion(const ob::State *s1, const ob::State *s2,
                                            std::pair<ob::State *, double> &lastValid) const
    {
        if (checkMotion(s1, s2))
            return true;
        ob::ScopedState<> last(si_->getStateSpace());
        lastValid.second = freeShare(s1, s2);
        if (lastValid.second >= 1.0)  // only the end itself is not valid
        {
            const Pose from = poseOf(s1), to = poseOf(s2);
            const double length = positionDistance(to, from);
            lastValid.second = length > TOLERANCE ? 1.0 - TOLERANCE / length : 0.0;
        }
        si_->getStateSpace()->interpolate(s1, s2, lastValid.second, last.get());
        if (!(lastValid.second > 0.0) || !si_->isValid(last.get()))
        {
            lastValid.second = 0.0;
            si_->copyState(last.get(), s1);
        }
        if (lastValid.first != nullptr)
            si_->copyState(lastValid.first, last.get());
        return false;
    }
}  // namespace parking

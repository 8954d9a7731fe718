#include "state_validity/ompl/CircleValidityChecker.h"

#include "state_validity/ompl/OmplCompatibility.h"
#include "state_validity/ompl/OmplPose.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <ompl/base/ScopedState.h>
#include <ompl/util/Exception.h>

namespace parking
{
    namespace
    {
        constexpr double BEFORE_END = 1e-3;  // metres before an invalid end at which the motion is cut

        double checked(double radius)
        {
            if (!(radius > 0.0) || !std::isfinite(radius))
                throw ompl::Exception("radius of the circle must be a positive number of metres, not " +
                                      std::to_string(radius));
            return radius;
        }
    }  // namespace

    CircleValidityChecker::CircleValidityChecker(const ompl::base::SpaceInformationPtr &si, ObstacleSet obstacles,
                                                 double radius)
      : ompl::base::StateValidityChecker(si),
        circle_(std::move(obstacles), checked(radius))
    {
        requirePlanarSpace(*si->getStateSpace());
        specs_.clearanceComputationType = ompl::base::StateValidityCheckerSpecs::BOUNDED_APPROXIMATE;
    }

    bool CircleValidityChecker::isValid(const ompl::base::State *state) const
    {
        const Pose pose = poseOf(state);
        return si_->satisfiesBounds(state) && circle_.isFree(pose.x, pose.y);
    }

    double CircleValidityChecker::clearance(const ompl::base::State *state) const
    {
        const Pose pose = poseOf(state);
        return si_->satisfiesBounds(state) ? circle_.clearance(pose.x, pose.y) : 0.0;
    }

    CircleMotionValidator::CircleMotionValidator(const ompl::base::SpaceInformationPtr &si,
                                                 std::shared_ptr<const CircleValidityChecker> checker)
      : ompl::base::MotionValidator(si),
        checker_(std::move(checker))
    {
    }

    bool CircleMotionValidator::checkMotion(const ompl::base::State *s1, const ompl::base::State *s2) const
    {
        const bool valid = si_->isValid(s2) && checker_->circle().freeShare(poseOf(s1), poseOf(s2)) >= 1.0;
        ompl_compatibility::countUp(valid ? valid_ : invalid_);
        return valid;
    }

    bool CircleMotionValidator::checkMotion(const ompl::base::State *s1, const ompl::base::State *s2,
                                            std::pair<ompl::base::State *, double> &lastValid) const
    {
        if (checkMotion(s1, s2))
            return true;
        const Pose from = poseOf(s1), to = poseOf(s2);
        const double cut = 1.0 - BEFORE_END / positionDistance(from, to);
        ompl::base::ScopedState<> last(si_->getStateSpace());
        lastValid.second = std::max(0.0, std::min(cut, checker_->circle().freeShare(from, to)));
        si_->getStateSpace()->interpolate(s1, s2, lastValid.second, last.get());
        if (!si_->isValid(last.get()))
        {
            lastValid.second = 0.0;
            si_->copyState(last.get(), s1);
        }
        if (lastValid.first != nullptr)
            si_->copyState(lastValid.first, last.get());
        return false;
    }
}  // namespace parking

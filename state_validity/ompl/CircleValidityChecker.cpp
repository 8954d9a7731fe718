#include "state_validity/ompl/CircleValidityChecker.h"

#include "state_validity/ompl/OmplPose.h"

#include <cmath>
#include <string>
#include <utility>

#include <ompl/util/Exception.h>

namespace parking
{
    namespace
    {
        double checked(double radius)
        {
            if (!(radius > 0.0) || !std::isfinite(radius))
                throw ompl::Exception("radius of the circle must be a positive number of metres, not " +
                                      std::to_string(radius));
            return radius;
        }
    }  // namespace

    double CircleValidityChecker::radiusAround(const Vehicle &vehicle, double doorMargin)
    {
        if (!(doorMargin >= 0.0) || !std::isfinite(doorMargin))
            throw ompl::Exception("door margin must be a number of metres of at least 0, not " +
                                  std::to_string(doorMargin));
        return 0.5 * std::hypot(vehicle.length(), vehicle.width) + doorMargin;
    }

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
        return si_->satisfiesBounds(state) && isFree(pose.x, pose.y);
    }

    double CircleValidityChecker::clearance(const ompl::base::State *state) const
    {
        const Pose pose = poseOf(state);
        return si_->satisfiesBounds(state) ? circle_.clearance(pose.x, pose.y) : 0.0;
    }
}  // namespace parking

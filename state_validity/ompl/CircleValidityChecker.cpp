#include "state_validity/ompl/CircleValidityChecker.h"

#include "state_validity/ompl/OmplPose.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <ompl/util/Exception.h>

namespace parking
{
    namespace
    {
        constexpr double CLEARANCE_REACH = 1.0;  // metres beyond the circle within which distances are exact

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
        obstacles_(std::move(obstacles)),
        radius_(checked(radius)),
        field_(obstacles_),
        edges_(obstacles_.edges(), obstacles_.bounds(), radius + CLEARANCE_REACH)
    {
        requirePlanarSpace(*si->getStateSpace());
        specs_.clearanceComputationType = ompl::base::StateValidityCheckerSpecs::BOUNDED_APPROXIMATE;
    }

    double CircleValidityChecker::distance(double x, double y) const
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

    bool CircleValidityChecker::isFree(double x, double y) const
    {
        const Pose local = obstacles_.toLocal({x, y, 0.0});
        return field_.lowerBound(local.x, local.y) > radius_ || distance(x, y) > radius_;
    }

    bool CircleValidityChecker::isValid(const ompl::base::State *state) const
    {
        const Pose pose = poseOf(state);
        return si_->satisfiesBounds(state) && isFree(pose.x, pose.y);
    }

    double CircleValidityChecker::clearance(const ompl::base::State *state) const
    {
        const Pose pose = poseOf(state);
        return si_->satisfiesBounds(state) ? std::max(0.0, distance(pose.x, pose.y) - radius_) : 0.0;
    }
}  // namespace parking

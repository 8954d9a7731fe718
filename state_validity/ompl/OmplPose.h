#pragma once

#include "parking_geometry/Box.h"
#include "parking_geometry/Pose.h"

#include <ompl/base/State.h>
#include <ompl/base/StateSpace.h>
#include <ompl/base/spaces/RealVectorBounds.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/util/Exception.h>

namespace parking
{
    /** \brief The pose of a state of an SE2, Dubins or Reeds-Shepp space, which share one type of state. */
    inline Pose poseOf(const ompl::base::State *state)
    {
        const auto *se2 = state->as<ompl::base::SE2StateSpace::StateType>();
        return {se2->getX(), se2->getY(), se2->getYaw()};
    }

    /** \brief Sets \e state to \e pose. The yaw is wrapped into [-pi, pi), the range that OMPL allows. */
    inline void setPose(ompl::base::State *state, const Pose &pose)
    {
        auto *se2 = state->as<ompl::base::SE2StateSpace::StateType>();
        se2->setXY(pose.x, pose.y);
        const double yaw = wrapAngle(pose.yaw);
        se2->setYaw(yaw == PI ? -PI : yaw);
    }

    /** \brief A box of positions in metres as bounds of an OMPL space. */
    inline ompl::base::RealVectorBounds positionBounds(const Box &box)
    {
        ompl::base::RealVectorBounds bounds(2);
        for (unsigned int axis = 0; axis < 2; ++axis)
        {
            bounds.setLow(axis, box.min[axis]);
            bounds.setHigh(axis, box.max[axis]);
        }
        return bounds;
    }

    /** \brief Throws ompl::Exception unless \e space is an SE2 space or derived from one. */
    inline void requirePlanarSpace(const ompl::base::StateSpace &space)
    {
        if (dynamic_cast<const ompl::base::SE2StateSpace *>(&space) == nullptr)
            throw ompl::Exception(
                "space '" + space.getName() +
                "' holds no poses of a car: it must be an SE2, a Reeds-Shepp or a Dubins state space");
    }
}  // namespace parking

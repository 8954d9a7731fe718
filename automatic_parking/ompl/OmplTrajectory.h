#pragma once

#include "parking_geometry/Box.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"
#include "path_tracking/trajectory/TimedMotion.h"

#include <ompl/control/PathControl.h>
#include <ompl/control/SpaceInformation.h>
#include <ompl/geometric/PathGeometric.h>

#include <memory>

namespace parking
{
    /** \brief The arcs that OMPL's interpolation follows along \e path, whichever planner found it.

        With TrajectoryOptimizer or quickestTrajectory() behind it, and controlPath() behind that, the solution of any
        geometric planner becomes one that can be driven.

        Throws parking::Error for a path of fewer than two states, and for a space that is neither a Reeds-Shepp nor a
        Dubins space: straight lines between poses are nothing that a car drives. */
    Path pathOf(const ompl::geometric::PathGeometric &path);

    /** \brief A car as OMPL's control planners know it.

        States are those of an SE2 space (pose of the rear axle's midpoint) and of two numbers, speed (m/s, negative in
        reverse) and steering angle (radians), within the limits of \e vehicle; controls are acceleration (m/s^2) and
        steering rate (rad/s), likewise. Propagation integrates the bicycle model. The validity checker is the caller's,
        and everything is valid until there is one.

        \param bounds of the rear axle's positions, metres */
    ompl::control::SpaceInformationPtr carInformation(const Vehicle &vehicle, const Box &bounds);

    /** \brief \e motion as a path of \e si, which carInformation() has made: a state at every knot, and between two of
        them the one control that leads from each to the next, for the seconds between them.

        Speed and steering angle of a TimedMotion are linear between knots, so that nothing is lost.
        Throws parking::Error for a motion without two knots. */
    std::shared_ptr<ompl::control::PathControl> controlPath(const TimedMotion &motion, const Vehicle &vehicle,
                                                            const ompl::control::SpaceInformationPtr &si);
}  // namespace parking

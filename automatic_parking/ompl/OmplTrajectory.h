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
    /** \brief The arcs that OMPL's interpolation follows along \e path, for any planner.

        With TrajectoryOptimizer or quickestTrajectory(), and then controlPath(), the solution of any geometric planner
        becomes drivable.

        Throws parking::Error for a path of fewer than two states, and for a space other than Reeds-Shepp or Dubins. A
        car cannot drive straight lines between arbitrary poses. */
    Path pathOf(const ompl::geometric::PathGeometric &path);

    /** \brief A car for OMPL's control planners.

        A state consists of an SE2 state (pose of the rear axle's midpoint) and two numbers within the limits of \e
        vehicle: speed (m/s, negative in reverse) and steering angle (radians). Controls are acceleration (m/s^2) and
        steering rate (rad/s), within the limits, too. Propagation integrates the bicycle model. The caller sets the
        validity checker; without one all states are valid.

        \param bounds of the rear axle's positions, metres */
    ompl::control::SpaceInformationPtr carInformation(const Vehicle &vehicle, const Box &bounds);

    /** \brief Converts \e motion to a path of \e si, which carInformation() has created. It has a state at every knot,
        and one control between two knots with their time difference.

        Speed and steering angle of a TimedMotion are linear between knots, so that the conversion is exact.
        Throws parking::Error for a motion with fewer than two knots. */
    std::shared_ptr<ompl::control::PathControl> controlPath(const TimedMotion &motion, const Vehicle &vehicle,
                                                            const ompl::control::SpaceInformationPtr &si);
}  // namespace parking

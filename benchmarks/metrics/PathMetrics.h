#pragma once

#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"
#include "path_tracking/trajectory/TimedMotion.h"

#include <cstddef>
#include <functional>

namespace parking
{
    /** \brief How a path is shaped, whatever is around it: the measures of Bench-MR (Heiden and others, IEEE Robotics
        and Automation Letters 6, 2021), computed from the exact path instead of from samples.
       docs/benchmark-reference.md defines each. */
    struct PathShape
    {
        double angleOverLength{0.0};      ///< rad/m: how much the direction of travel turns; half a turn at each cusp
        double maxCurvature{0.0};         ///< 1/m; infinite for a path that turns on the spot
        double normalizedCurvature{0.0};  ///< radians: curvature times length, summed up
        double smoothness{0.0};           ///< 1/m^2; 0 for a straight line, the smaller the better
        double reverseShare{0.0};         ///< of the length, driven in reverse
    };

    /** \brief The shape of \e path; all zero for one that never drives. */
    PathShape shapeOf(const Path &path);

    /** \brief How far the obstacles are along a path. */
    struct ClearanceFigures
    {
        double mean{0.0};    ///< metres
        double median{0.0};  ///< metres
    };

    /** Metres that any larger clearance counts as: how far away the next wall of a large world is says little. */
    constexpr double FARTHEST_CLEARANCE = 5.0;

    /** \brief Mean and median clearance at evenly spaced poses of \e path: at most 0.1 m apart, but no more than a
        thousand of them.

        \param clearance metres between body and obstacles at a pose; it need not be right beyond its second argument */
    ClearanceFigures clearanceAlong(const Path &path,
                                    const std::function<double(const Pose &, double enough)> &clearance);

    /** \brief A path without timing, driven from cusp to cusp as fast as speed and acceleration allow, with steering
        that is there at once: the profile that CommonParking gives paths (its evaluation/README.md, 2026).

        What the steering would take is told apart: a car has to stand still wherever the curvature jumps. */
    struct CuspToCusp
    {
        TpcapCost cost;  ///< of the profile alone; what wheels do where the curvature jumps is not in it
        std::size_t standingSteerings{0};  ///< places where the curvature jumps, at cusps or between them
        double standingSteeringTime{0.0};  ///< seconds in which the wheels turn there; not in the cost's time
        double meanJerk{0.0};              ///< m/s^3, mean of the absolute value over the time
    };

    /** \brief The profile of \e path with the limits of \e vehicle.

        The wheels are at first where the path begins and stay where it ends. Throws parking::Error for a path that
        turns on the spot, is not finite, or never drives. */
    CuspToCusp cuspToCusp(const Path &path, const Vehicle &vehicle);
}  // namespace parking

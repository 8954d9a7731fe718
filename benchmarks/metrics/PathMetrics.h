#pragma once

#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"
#include "path_tracking/trajectory/TimedMotion.h"

#include <cstddef>
#include <functional>

namespace parking
{
    /** \brief Shape metrics of a path, independent of obstacles: those of Bench-MR (Heiden and others, IEEE Robotics
        and Automation Letters 6, 2021).

        They are computed from the exact path instead of samples. docs/benchmark-reference.md defines each. */
    struct PathShape
    {
        double angleOverLength{0.0};      ///< change of the direction of travel in rad/m; half a turn at each cusp
        double maxCurvature{0.0};         ///< 1/m; infinite for a path that turns on the spot
        double normalizedCurvature{0.0};  ///< integral of the curvature over the length in radians
        double smoothness{0.0};           ///< smoothness in 1/m^2; 0 for a straight line, lower is better
        double reverseShare{0.0};         ///< share of the length driven in reverse
    };

    /** \brief The shape metrics of \e path; zero for a path without length. */
    PathShape shapeOf(const Path &path);

    /** \brief Distance of the obstacles along a path. */
    struct ClearanceFigures
    {
        double mean{0.0};    ///< metres
        double median{0.0};  ///< metres
    };

    /** Upper limit of clearances in metres: the distance to far walls of a large world has little meaning. */
    constexpr double FARTHEST_CLEARANCE = 5.0;

    /** \brief Mean and median clearance at evenly spaced poses of \e path: at most 0.1 m apart, but at most a thousand
        poses.

        \param clearance metres between body and obstacles at a pose; need not be exact beyond its second argument */
    ClearanceFigures clearanceAlong(const Path &path,
                                    const std::function<double(const Pose &, double enough)> &clearance);

    /** \brief Profile of a path without timing, as CommonParking defines it (its evaluation/README.md, 2026).

        The path is driven from cusp to cusp as fast as speed and acceleration allow, with immediate steering. The time
        of steering is reported separately: a car must stop where the curvature jumps. */
    struct CuspToCusp
    {
        TpcapCost cost;                    ///< cost of the profile alone, without steering at standstill
        std::size_t standingSteerings{0};  ///< number of places where the curvature jumps, at cusps or between them
        double standingSteeringTime{0.0};  ///< seconds of steering at these places; not included in the cost's time
        double meanJerk{0.0};              ///< mean over time of the absolute jerk in m/s^3
    };

    /** \brief The profile of \e path with the limits of \e vehicle.

        The steering starts at the path's first curvature and stays at its last. Throws parking::Error for a path that
        turns on the spot, is not finite, or has no length. */
    CuspToCusp cuspToCusp(const Path &path, const Vehicle &vehicle);
}  // namespace parking

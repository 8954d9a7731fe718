#pragma once

#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/StopFunction.h"
#include "parking_geometry/curves/Path.h"

namespace parking::search
{
    /** \brief The paper's B-spline through a path of a grid model, with the same first and last pose.

        The spline is checked pose by pose, then motion by motion. If it collides or turns more sharply than \e
        turningRadius, it follows the corners of the path there.

        \return whether \e path was replaced; false if it has no corner, \e stop returned true, or a motion collides */
    bool smoothGridPath(Path &path, MotionEnvironment &environment, double turningRadius, const StopFunction &stop);

    /** \brief Metres between states of a smoothed grid path that are joined by straight motions. */
    constexpr double SMOOTH_STATE_SPACING = 0.1;
}  // namespace parking::search

#pragma once

#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/SearchParameters.h"
#include "parking_geometry/curves/Path.h"

#include <vector>

namespace parking::search
{
    /** \brief The paper's B-spline through a path of a grid model, as poses between which the car moves straight, the
        heading turning evenly.

        The curve is checked state by state, and then motion by motion. Where it collides or turns more sharply than at
        \e turningRadius it follows the corners of the path; where that does not help either, or \e stop says so, the
        result is empty and the path stays as it is. */
    std::vector<Pose> smoothGridPath(const Path &path, MotionEnvironment &environment, double turningRadius,
                                     const StopFunction &stop);
}  // namespace parking::search

#pragma once

#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/StopFunction.h"
#include "parking_geometry/curves/Path.h"

#include <vector>

namespace parking::search
{
    /** \brief Metres along a path: close parts nearer to each other than this are one. */
    constexpr double PARTS_APART = 0.5;

    /** \brief A part of a path that is driven nearer to obstacles than preferred; metres along the path. */
    struct ClosePart
    {
        double begin;      ///< where it begins
        double end;        ///< and ends
        double nearest;    ///< where the car is nearest to an obstacle
        double clearance;  ///< metres to that obstacle
    };

    /** \brief The parts of a path that come nearer to obstacles than preferred, by more than a fiftieth, in the order
        in which they are driven.

        What the environment does not know to be clear is looked at every 5 cm, or farther apart where there is room.

        \param from metres along the path from which on it is looked at
        \param clearance metres that are preferred
        \param turningRadius metres; no piece turns more sharply than about that
        \return those found before it was time to stop */
    std::vector<ClosePart> closeParts(MotionEnvironment &environment, const Path &path, double from, double clearance,
                                      double turningRadius, const StopFunction &stop);
}  // namespace parking::search

#pragma once

#include "benchmarks/plan/PlannedPath.h"
#include "benchmarks/plan/Problem.h"
#include "path_tracking/simulation/ClosedLoop.h"

namespace parking
{
    /** \brief Drives a planned path with the car of \e problem among its obstacles, collisions checked.

        The one way from a planner's path to a drive: the same drive follows in both programs. Throws parking::Error for
        a path that the car cannot drive. */
    DriveResult drivePath(const Problem &problem, const PlannedPath &path);

    /** \brief Drives a motion likewise, as it is timed. */
    DriveResult driveMotion(const Problem &problem, const TimedMotion &motion);
}  // namespace parking

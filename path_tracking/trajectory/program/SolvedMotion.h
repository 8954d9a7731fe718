#pragma once

#include "path_tracking/trajectory/TimedMotion.h"
#include "path_tracking/trajectory/program/MotionProblem.h"

namespace parking
{
    /** \brief The motion whose speeds and steering angles the nodes of a problem have.
        \param start its first pose, which may be in other coordinates than those of the problem */
    TimedMotion motionOf(const MotionProblem &problem, const Pose &start);

    /** \brief Ends phases beside intervals in which the solution changes from one limit to another: of acceleration, or
        of the steering rate. Solved once more, a node can then be where that change is. Phases that end already go on
        doing so.

        Between two nodes neither changes, so that a change between nodes costs time. Phases that end everywhere would
        do, too, but leave it undecided how nodes are spread where nothing changes, and take thrice as many
        iterations. */
    void endPhasesAtChanges(MotionProblem &problem);

    /** \brief Writes MotionProblem::corrections: where the intervals lead when they are integrated, less what
        collocation says. Solved once more, the nodes are then where the car is. Along hundreds of metres the errors of
        collocation, some hundredths of a millimetre each, add up to a centimetre. */
    void correctIntervals(MotionProblem &problem);
}  // namespace parking

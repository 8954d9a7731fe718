#pragma once

#include "path_tracking/trajectory/TimedMotion.h"
#include "path_tracking/trajectory/program/MotionProblem.h"

namespace parking
{
    /** \brief The motion whose speeds and steering angles the nodes of a problem have.
        \param start its first pose, which may be in other coordinates than those of the problem */
    TimedMotion motionOf(const MotionProblem &problem, const Pose &start);

    /** \brief Writes MotionProblem::corrections: where the intervals lead when they are integrated, less what
        collocation says. Solved once more, the nodes are then where the car is. Along hundreds of metres the errors of
        collocation, some hundredths of a millimetre each, add up to a centimetre. */
    void correctIntervals(MotionProblem &problem);
}  // namespace parking

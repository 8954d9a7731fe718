#pragma once

#include "path_tracking/trajectory/TimedMotion.h"
#include "state_validity/FootprintChecker.h"

#include <vector>

namespace parking
{
    /** \brief Metres by which the body is enlarged when motions are checked, at most; covers what arcs leave of a
        motion. Arcs of less than 2 cm leave less in proportion. */
    constexpr double MOTION_CHECK_TOLERANCE = 2e-4;

    /** \brief Where the body of a car that drives \e motion meets an obstacle: all of it swept, not sampled.

        The motion is integrated in parts of 20 ms, each swept as the arc of its mean curvature, from which no point of
        the body deviates by more than MOTION_CHECK_TOLERANCE. Near obstacles the parts are shorter, so that what the
        arcs leave is less than the room. Nothing here is shared with the optimisation.

        \param most places after which it stops looking
        \return the poses at which the parts begin that are not free, in the checker's coordinates; empty when the
        motion is free */
    std::vector<Pose> collisionsOf(const TimedMotion &motion, const FootprintChecker &checker, std::size_t most);
}  // namespace parking

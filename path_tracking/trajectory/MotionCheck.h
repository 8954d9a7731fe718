#pragma once

#include "path_tracking/trajectory/TimedMotion.h"
#include "state_validity/FootprintChecker.h"

#include <vector>

namespace parking
{
    /** \brief Maximum enlargement of the body in motion checks, in metres. It covers the deviation of arcs from the
        motion, and decreases in proportion for arcs shorter than 2 cm. */
    constexpr double MOTION_CHECK_TOLERANCE = 2e-4;

    /** \brief The poses at which the body of a car that drives \e motion touches obstacles. The body is swept, not
        sampled.

        The motion is integrated in parts of 20 ms. Each part is swept as the arc of its mean curvature; no point of the
        body deviates from that arc by more than MOTION_CHECK_TOLERANCE. Near obstacles the parts are shorter, so that
        the deviation stays below the clearance. The check shares no code with the optimisation.

        \param most number of collisions after which the check stops
        \return the first pose of each colliding part, in the checker's coordinates; empty for a free motion */
    std::vector<Pose> collisionsOf(const TimedMotion &motion, const FootprintChecker &checker, std::size_t most);
}  // namespace parking

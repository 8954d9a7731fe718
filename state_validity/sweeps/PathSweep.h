#pragma once

#include "parking_geometry/FootprintQueries.h"
#include "parking_geometry/curves/Path.h"
#include "state_validity/FootprintChecker.h"

namespace parking
{
    /** \brief Is every motion along \e path free? Swept, not sampled: see FootprintChecker::freeLength(), which keeps a
        millimetre from the obstacles.

        Clothoids are swept as arcs from which no point of the body deviates by more than 0.1 mm.
        Turns on the spot, which no car can make, are covered by poses. */
    bool isPathFree(const FootprintChecker &checker, const Path &path);

    /** \brief As isPathFree(), but content with a path that passes an obstacle within that millimetre, as long as it
        keeps 0.015 mm: for paths of any origin, which have to touch nothing and need not keep anything. */
    bool touchesNothing(const FootprintChecker &checker, const Path &path);

    /** \brief The world as manoeuvres and smoothing ask about it; whole paths are swept.

        \param checker is referred to, and must live as long as what is returned */
    FootprintQueries queriesOf(const FootprintChecker &checker);
}  // namespace parking

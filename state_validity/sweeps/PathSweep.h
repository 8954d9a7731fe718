#pragma once

#include "parking_geometry/FootprintQueries.h"
#include "parking_geometry/curves/Path.h"
#include "state_validity/FootprintChecker.h"

namespace parking
{
    /** \brief Whether every motion along \e path is free with a millimetre of clearance, by sweeps instead of samples.

        See FootprintChecker::freeLength() for the sweeps. The function sweeps clothoids as arcs from which no point of
        the body deviates by more than 0.1 mm. It covers turns on the spot by poses. */
    bool isPathFree(const FootprintChecker &checker, const Path &path);

    /** \brief Whether every motion along \e path is free with only 0.015 mm of clearance, by sweeps instead of samples.

        This test is for paths that must touch no obstacle but need not keep a clearance. */
    bool touchesNothing(const FootprintChecker &checker, const Path &path);

    /** \brief Collision queries of manoeuvres and smoothing; whole paths are swept.

        \param checker must outlive the result */
    FootprintQueries queriesOf(const FootprintChecker &checker);
}  // namespace parking

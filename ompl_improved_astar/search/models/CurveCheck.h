#pragma once

#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "parking_geometry/curves/ReedsShepp.h"

namespace parking::search
{
    /** \brief From which end the pieces of a curve are swept. */
    enum class CurveEnd
    {
        Start,
        Goal
    };

    /** \brief Is the whole curve from \e from to \e to free? Both ends must be.

        Most curves that are tried are not, and most of these collide where a piece ends, above all at their cusps: the
        car is put there before anything is swept. The answer does not depend on that, nor on \e first.

        \param first the end from which the pieces are swept: the one near which a collision is more likely */
    bool isCurveFree(MotionEnvironment &environment, const Pose &from, const ReedsSheppCurve &curve, const Pose &to,
                     CurveEnd first);
}  // namespace parking::search

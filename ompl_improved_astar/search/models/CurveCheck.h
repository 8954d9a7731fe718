#pragma once

#include "ompl_improved_astar/search/CostModel.h"
#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/ReedsShepp.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace parking::search
{
    /** \brief No curve between two poses is shorter than this, in metres: the car drives so far, and turns so much at
        full lock. */
    inline double leastCurveLength(const Pose &from, const Pose &to, double turningRadius)
    {
        return std::max(positionDistance(from, to), std::abs(wrapAngle(from.yaw - to.yaw)) * turningRadius);
    }

    /** \brief From which end the pieces of a curve are swept. */
    enum class CurveEnd
    {
        Start,  ///< the end where the curve begins
        Goal    ///< the end where it ends
    };

    /** \brief Is the car free where pieces of the curve end, and in the middle of long ones? Both ends must be.

        A look that soon finds most of the curves that are not free. */
    bool hasFreePoses(MotionEnvironment &environment, const Pose &from, const ReedsSheppCurve &curve, const Pose &to);

    /** \brief Is the whole curve from \e from to \e to free? Both ends must be.

        Most curves that are tried are not, and most of these collide where a piece ends, above all at their cusps: the
        car is put there before anything is swept. The answer does not depend on that, nor on \e first.

        \param first the end from which the pieces are swept: the one near which a collision is more likely */
    bool isCurveFree(MotionEnvironment &environment, const Pose &from, const ReedsSheppCurve &curve, const Pose &to,
                     CurveEnd first);

    /** \brief A curve among others, and what it costs but for the obstacles nearby. */
    using PricedCurve = std::pair<double, const ReedsSheppCurve *>;

    /** \brief Told of a free curve and of what it costs, closeness included. Says whether it is taken. */
    using CurveOffer = std::function<bool(const ReedsSheppCurve &, double)>;

    /** \brief Offers the free ones of some curves from \e from to \e to, the cheapest first, until one is taken.

        Whether a curve is free, and how close it comes, is found out only when its turn comes.

        \param curves are sorted
        \param bound curves that cost as much are not offered
        \return whether one was taken */
    bool offerFreeCurves(MotionEnvironment &environment, const CostModel &cost, const Pose &from, const Pose &to,
                         std::vector<PricedCurve> &curves, CurveEnd first, double bound, const CurveOffer &offer);
}  // namespace parking::search

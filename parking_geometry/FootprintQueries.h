#pragma once

#include "parking_geometry/Pose.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"

#include <functional>

namespace parking
{
    /** \brief Collision queries of manoeuvres and smoothing. Each callable may be empty; if all are, the world has no
        obstacles.

        The callables must agree with each other, accept every finite pose and return the same result at every call. */
    struct FootprintQueries
    {
        /** \brief Whether the body at this pose touches no obstacle. The result must be exact. */
        std::function<bool(const Pose &)> isFree;

        /** \brief A lower bound, in metres, of the distance between the body at this pose and the nearest obstacle.

            A pose is free if no point of the body has moved as far as this bound. With 0 the bound is no evidence:
            isFree decides, and without isFree the pose counts as colliding. */
        std::function<double(const Pose &)> clearance;

        /** \brief Whether the whole motion is free. Checks of whole paths use only this callable if it is set. */
        std::function<bool(const Path &)> isPathFree;
    };

    /** \brief Whether every motion along \e path is free, including turns on the spot.

        Calls isPathFree if it is set. Otherwise the function checks poses along each piece:
        - With clearance, it halves the piece until the free regions of neighbouring poses overlap. Motions of the body
          below 5 mm are decided by their ends.
        - With isFree alone, it checks the ends and poses at most 10 cm apart. */
    bool isPathFree(const FootprintQueries &queries, const Vehicle &vehicle, const Path &path);

    /** \brief Whether every motion of a body along \e path is free.

        \param reach distance in metres of the farthest point of the body from the rear axle's midpoint */
    bool isPathFree(const FootprintQueries &queries, double reach, const Path &path);
}  // namespace parking

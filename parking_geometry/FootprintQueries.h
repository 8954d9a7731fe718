#pragma once

#include "parking_geometry/Pose.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"

#include <functional>

namespace parking
{
    /** \brief All that manoeuvres and smoothing ask about the world. Any of the callables may be left empty; with all
        of them empty the world is free.

        They must agree with each other, be safe to call at any finite pose and give the same answer every time. */
    struct FootprintQueries
    {
        /** \brief Does the body at this pose keep clear of every obstacle? Exact. */
        std::function<bool(const Pose &)> isFree;

        /** \brief A lower bound, in metres, of the distance between the body at this pose and the nearest obstacle.

            Every pose at which no point of the body has moved as far as this is free. 0 promises nothing: the body may
            collide there or be too near to tell, and isFree decides (without isFree it counts as colliding). */
        std::function<double(const Pose &)> clearance;

        /** \brief Is the whole motion free? Takes precedence over the other two where whole paths are checked. */
        std::function<bool(const Path &)> isPathFree;
    };

    /** \brief Is every motion along \e path free, turns on the spot included?

        Asks isPathFree when there is one. Otherwise each piece is covered by poses on it: with clearance, until what
        they promise to be free overlaps, down to motions of the body of 5 mm, below which the ends decide; with isFree
        alone, by its ends and poses at most 10 cm apart. */
    bool isPathFree(const FootprintQueries &queries, const Vehicle &vehicle, const Path &path);
}  // namespace parking

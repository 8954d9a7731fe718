#pragma once

#include "parking_geometry/Vehicle.h"
#include "state_validity/ContactTest.h"

namespace parking
{
    /** \brief A contact test by FCL for FootprintChecker, which decides poses so near to contact that rounding
        matters. */
    ContactTestMaker fclContactTest();

    /** \brief Collision test by FCL for every pose, a baseline for results and times of FootprintChecker.

        Const calls from several threads are safe. */
    class PlainFclChecker
    {
    public:
        /** \brief A checker for a vehicle among obstacles.

            \param margin metres by which the body is enlarged on each side
            Throws parking::Error for an invalid vehicle and if a polygon is not simple. */
        PlainFclChecker(ObstacleSet obstacles, const Vehicle &vehicle, double margin = 0.0);

        /** \brief Whether the body at a pose in the coordinates of the obstacle set touches no obstacle. False for
            poses that are not finite. */
        bool isFree(const Pose &pose) const;

    private:
        ObstacleSet obstacles_;
        Body body_;
        ContactTest touches_;
    };
}  // namespace parking

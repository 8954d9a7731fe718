#pragma once

#include "parking_geometry/Vehicle.h"
#include "state_validity/ContactTest.h"

namespace parking
{
    /** \brief FCL's judgement, for FootprintChecker to ask for where a body is so near to contact that rounding
        decides. */
    ContactTestMaker fclContactTest();

    /** \brief What FCL says of every pose, without a shortcut: what FootprintChecker's answers and times are compared
        with. Const calls from several threads are safe. */
    class PlainFclChecker
    {
    public:
        /** \brief \param margin metres by which the body is enlarged on each of its four sides

            Throws parking::Error for an invalid vehicle and when a polygon is not simple. */
        PlainFclChecker(ObstacleSet obstacles, const Vehicle &vehicle, double margin = 0.0);

        /** \brief Is the body, at a pose in the coordinates of the obstacle set, free? False for poses that are not
            finite. */
        bool isFree(const Pose &pose) const;

    private:
        ObstacleSet obstacles_;
        double centreOffset_, halfLength_, halfWidth_;
        ContactTest touches_;
    };
}  // namespace parking

#pragma once

#include "parking_geometry/OrientedBox.h"
#include "state_validity/ObstacleSet.h"

#include <functional>

namespace parking
{
    /** \brief Does a body, in the local frame, touch an obstacle? Asked from several threads at once. */
    using ContactTest = std::function<bool(const OrientedBox &body)>;

    /** \brief Makes the contact test for a world and for bodies of one size, given by its half lengths in metres.

        May throw parking::Error. fclContactTest() is the one that this project brings. */
    using ContactTestMaker =
        std::function<ContactTest(const ObstacleSet &obstacles, double halfLength, double halfWidth)>;
}  // namespace parking

#pragma once

#include "parking_geometry/OrientedBox.h"
#include "state_validity/ObstacleSet.h"

#include <functional>

namespace parking
{
    /** \brief Returns whether a body, given in the local frame, touches an obstacle. It must be safe to call from
        several threads. */
    using ContactTest = std::function<bool(const OrientedBox &body)>;

    /** \brief Makes the contact test for a world and bodies of one size, given by half lengths in metres.

        It may throw parking::Error. This project provides fclContactTest(). */
    using ContactTestMaker =
        std::function<ContactTest(const ObstacleSet &obstacles, double halfLength, double halfWidth)>;
}  // namespace parking

#pragma once

#include "parking_geometry/OrientedBox.h"
#include "state_validity/Body.h"
#include "state_validity/ObstacleSet.h"

#include <functional>

namespace parking
{
    /** \brief Returns whether a body, given by its bounding rectangle in the local frame, touches an obstacle. It must
       be safe to call from several threads. */
    using ContactTest = std::function<bool(const OrientedBox &box)>;

    /** \brief Makes the contact test for a world and one body.

        It may throw parking::Error. This project provides fclContactTest(). */
    using ContactTestMaker = std::function<ContactTest(const ObstacleSet &obstacles, const Body &body)>;
}  // namespace parking

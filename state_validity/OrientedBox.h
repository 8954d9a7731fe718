#pragma once

namespace parking
{
    /** \brief A rectangle at a place in the local frame: centre, heading as cosine and sine, half lengths. */
    struct OrientedBox
    {
        double x, y;
        double cosine, sine;
        double halfLength, halfWidth;
    };
}  // namespace parking

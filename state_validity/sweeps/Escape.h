#pragma once

#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/Path.h"

namespace parking
{
    /** \brief A motion that leads a car out of contact with obstacles. */
    struct Escape
    {
        Pose start;         ///< pose in contact
        Arc arc;            ///< motion from \e start
        double depth{0.0};  ///< metres, depth of the contact at \e start

        /** \brief The free pose at the end of the motion. */
        Pose end() const
        {
            return advance(start, arc.curvature, arc.length);
        }
    };
}  // namespace parking

#pragma once

#include "parking_geometry/curves/Path.h"

namespace parking
{
    /** \brief Do two paths change their direction equally often, and are they nowhere farther apart?

        Compared stretch by stretch at equal shares of their lengths, two metres apart or less.

        \param distance metres between the rear axles */
    bool areAlike(const Path &a, const Path &b, double distance);
}  // namespace parking

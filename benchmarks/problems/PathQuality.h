#pragma once

#include "benchmarks/problems/PlannedPath.h"
#include "parking_geometry/Vehicle.h"

namespace parking
{
    /** \brief A planned path as the controller is to drive it.

        Arcs stay as they are. Of straight lines between the states of a plain SE2 space, those along which the heading
        changes no faster than the car can turn become arcs; each stretch of faster changes becomes a corner: the place
        where the straight lines before and behind it meet, or the chord between its ends where they do not meet on the
        way. Corners are marked by their headings, as splitPath() understands them. */
    SampledPath pathToDrive(const PlannedPath &path, const Vehicle &vehicle);
}  // namespace parking

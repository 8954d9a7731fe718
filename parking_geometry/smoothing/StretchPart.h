#pragma once

#include "parking_geometry/curves/Path.h"

#include <cstddef>
#include <vector>

namespace parking
{
    /** \brief What is smoothed at a time: neighbouring arcs of one stretch, and whether the car stands at their
        ends. */
    struct StretchPart
    {
        Path arcs;                ///< all in one direction; neighbours differ in curvature
        bool movingStart{false};  ///< begins in motion, on its first arc, because it was cut out of a longer one
        bool movingEnd{false};    ///< ends in motion, on its last arc

        /** \brief 1 forwards, -1 in reverse. */
        int direction() const
        {
            return arcs.pieces.front().direction();
        }

        /** \brief The arcs \e first to before \e last. Where they are not all, the car stands there. */
        StretchPart part(std::size_t first, std::size_t last) const;

        /** \brief The parts that can be smoothed on their own: cut in the middle of all arcs of at least \e shortest
            metres that lie between two others and bend less than \e maxCurvature. */
        std::vector<StretchPart> cutAtLongArcs(double shortest, double maxCurvature) const;
    };
}  // namespace parking

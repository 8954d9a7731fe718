#pragma once

#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/Path.h"

#include <cstddef>
#include <vector>

namespace parking
{
    /** \brief A stretch of a path between two changes of direction. */
    struct GearSegment
    {
        Pose start;
        Pose end;               ///< where the next one starts: exact, whatever the arcs integrate to
        int direction{1};       ///< 1 forwards, -1 in reverse
        std::vector<Arc> arcs;  ///< lengths positive; neighbours differ in curvature

        bool movingStart{false};  ///< begins in motion, on its first arc, because it was cut out of a longer one
        bool movingEnd{false};    ///< ends in motion, on its last arc

        double length() const;

        /** \brief The arcs \e first to \e last (exclusive). Where they are not all, the car stands there. */
        GearSegment part(std::size_t first, std::size_t last) const;

        /** \brief The stretch in pieces that can be smoothed on their own: cut in the middle of all arcs of at least
            \e shortest metres that lie between two others and bend less than \e maxCurvature. */
        std::vector<GearSegment> cutAtLongArcs(double shortest, double maxCurvature) const;
    };

    /** \brief The stretches of \e path, pieces of no length dropped. */
    std::vector<GearSegment> gearSegments(const Path &path);

    /** \brief The stretches of a sampled path; between its states lie the circular arcs that their poses imply.

        States that coincide are skipped; arcs whose curvatures agree to 1e-6 are one. */
    std::vector<GearSegment> gearSegments(const SampledPath &path);
}  // namespace parking

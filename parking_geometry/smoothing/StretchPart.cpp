#include "parking_geometry/smoothing/StretchPart.h"

#include <cmath>

namespace parking
{
    StretchPart StretchPart::part(std::size_t first, std::size_t last) const
    {
        return {arcs.part(first, last), movingStart && first == 0, movingEnd && last == arcs.pieces.size()};
    }

    std::vector<StretchPart> StretchPart::cutAtLongArcs(double shortest, double maxCurvature) const
    {
        std::vector<StretchPart> parts{{{arcs.start, {}}, movingStart, movingEnd}};
        Pose pose = arcs.start;
        for (std::size_t i = 0; i < arcs.pieces.size(); ++i)
        {
            PathPiece arc = arcs.pieces[i];
            const bool between = i > 0 && i + 1 < arcs.pieces.size();
            if (between && arc.driven() >= shortest && std::abs(arc.curvature) < maxCurvature)
            {
                arc.length *= 0.5;
                pose = advance(pose, arc);
                parts.back().arcs.pieces.push_back(arc);
                parts.back().movingEnd = true;
                parts.push_back({{pose, {}}, true, movingEnd});
            }
            parts.back().arcs.pieces.push_back(arc);
            pose = advance(pose, arc);
        }
        return parts;
    }
}  // namespace parking

#pragma once

#include "parking_geometry/curves/Path.h"

#include <functional>

namespace parking
{
    /** \brief Calls \e visit with the pieces of \e path in order, clothoids replaced by short arcs, until it says no:
        for whoever can treat circles only, such as the swept footprint.

        Arcs, lines and turns on the spot come as they are. A clothoid of sharpness s is divided into parts of equal
        length h; each becomes the arc of its mean curvature, begun at the pose where the part begins on the path, so
        that nothing adds up. On the way the heading differs by at most |s| h^2 / 8 (at the end of the arc it is the
        same) and the position by at most |s| h^3 / 12: no point of a body that reaches \e reach metres from the rear
        axle deviates by more than |s| h^2 (reach / 8 + h / 12), and h is chosen such that this is below \e deviation.

        \param reach metres from the rear axle's midpoint to the farthest point of the body
        \param deviation metres, positive
        \param visit gets the pose at which a piece begins (yaw not wrapped) and the piece
        \return whether all of them were accepted */
    bool visitArcs(const Path &path, double reach, double deviation,
                   const std::function<bool(const Pose &, const PathPiece &)> &visit);
}  // namespace parking

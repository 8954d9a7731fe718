#include "ompl_improved_astar/search/models/CurveCheck.h"

#include "parking_geometry/curves/Path.h"

#include <cmath>

namespace parking::search
{
    bool isCurveFree(MotionEnvironment &environment, const Pose &from, const ReedsSheppCurve &curve, const Pose &to,
                     CurveEnd first)
    {
        Pose pose = from;
        for (std::size_t k = 0; k + 1 < curve.count; ++k)
        {
            pose = advance(pose, curve.pieces[k].curvature, curve.pieces[k].length);
            if (!environment.isPassable(pose))
                return false;
        }
        const bool forwards = first == CurveEnd::Start;
        pose = forwards ? from : to;
        for (std::size_t k = 0; k < curve.count; ++k)
        {
            const Arc &segment = curve.pieces[forwards ? k : curve.count - 1 - k];
            const double length = forwards ? segment.length : -segment.length;
            if (environment.freeLength(pose, segment.curvature, length) < std::abs(length))
                return false;
            pose = advance(pose, segment.curvature, length);
        }
        return true;
    }
}  // namespace parking::search

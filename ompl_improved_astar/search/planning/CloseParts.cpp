#include "ompl_improved_astar/search/planning/CloseParts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace parking::search
{
    namespace
    {
        constexpr double HARDLY_LESS = 0.98;    // of the preferred clearance is as good
        constexpr double LONG_STRIDE = 1.0;     // metres, where the car gets near to nothing in between,
        constexpr double MIDDLE_STRIDE = 0.25;  // or not so far
        constexpr double SHORT_STRIDE = 0.05;   // metres, elsewhere
        constexpr double FARTHEST_POINT = 1.5;  // turning radii from the rear axle to the body's, or not much more
        constexpr std::size_t POSES_BETWEEN_STOPS = 4;
    }  // namespace

    std::vector<ClosePart> closeParts(MotionEnvironment &environment, const Path &path, double from, double clearance,
                                      double turningRadius, const StopFunction &stop)
    {
        std::vector<ClosePart> parts;
        const double enough = HARDLY_LESS * clearance;
        Pose pose = path.start;
        double driven = 0.0;
        std::size_t asked = 0;
        for (const PathPiece &piece : path.pieces)
        {
            const Arc arc{piece.curvature, piece.length};
            const double length = piece.driven();
            double clear = length;
            if (driven + length > from)
                environment.clearLengths(pose, &arc, 1, clearance, &clear);
            // No point of the body moves much farther than this per metre: where there is room, strides are long.
            const double speed = 1.0 + FARTHEST_POINT * std::abs(piece.curvature) * turningRadius;
            for (double at = std::max(clear, from - driven); clear < length;)
            {
                // Some checkers take long to tell clearances.
                if (++asked % POSES_BETWEEN_STOPS == 0 && stop && stop())
                    return parts;
                const Pose there = advance(pose, piece, at);
                double stride = SHORT_STRIDE;
                if (environment.keeps(there, enough + speed * LONG_STRIDE))
                    stride = LONG_STRIDE;
                else if (environment.keeps(there, enough + speed * MIDDLE_STRIDE))
                    stride = MIDDLE_STRIDE;
                else if (!environment.keeps(there, enough))
                {
                    const double place = driven + at, nearest = environment.clearance(there);
                    if (parts.empty() || place - parts.back().end > PARTS_APART)
                        parts.push_back({place, place, place, nearest});
                    ClosePart &part = parts.back();
                    part.end = place;
                    if (nearest < part.clearance)
                    {
                        part.nearest = place;
                        part.clearance = nearest;
                    }
                }
                if (at >= length)
                    break;
                at = std::min(length, at + stride);
            }
            driven += length;
            pose = advance(pose, piece);
        }
        return parts;
    }
}  // namespace parking::search

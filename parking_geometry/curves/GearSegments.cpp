#include "parking_geometry/curves/GearSegments.h"

#include "parking_geometry/curves/Kinematics.h"

#include <cmath>

namespace parking
{
    namespace
    {
        /** Poses nearer than this are one, metres. */
        constexpr double SAME_PLACE = 1e-9;

        /** Curvatures of neighbouring arcs of one sampled circle differ by rounding only, 1/m. */
        constexpr double SAME_CURVATURE = 1e-6;
    }  // namespace

    double GearSegment::length() const
    {
        double sum = 0.0;
        for (const Arc &arc : arcs)
            sum += arc.length;
        return sum;
    }

    GearSegment GearSegment::part(std::size_t first, std::size_t last) const
    {
        GearSegment result = *this;
        Pose pose = start;
        for (std::size_t i = 0; i < last; ++i)
        {
            if (i == first)
                result.start = pose;
            pose = advance(pose, arcs[i].curvature, direction * arcs[i].length);
        }
        if (last < arcs.size())
            result.end = pose;
        result.movingStart = movingStart && first == 0;
        result.movingEnd = movingEnd && last == arcs.size();
        result.arcs.assign(arcs.begin() + static_cast<std::ptrdiff_t>(first),
                           arcs.begin() + static_cast<std::ptrdiff_t>(last));
        return result;
    }

    std::vector<GearSegment> GearSegment::cutAtLongArcs(double shortest, double maxCurvature) const
    {
        std::vector<GearSegment> pieces{{start, end, direction, {}, movingStart, movingEnd}};
        Pose pose = start;
        for (std::size_t i = 0; i < arcs.size(); ++i)
        {
            Arc arc = arcs[i];
            const bool between = i > 0 && i + 1 < arcs.size();
            if (between && arc.length >= shortest && std::abs(arc.curvature) < maxCurvature)
            {
                arc.length *= 0.5;
                pose = advance(pose, arc.curvature, direction * arc.length);
                GearSegment &before = pieces.back();
                before.arcs.push_back(arc);
                before.end = pose;
                before.movingEnd = true;
                pieces.push_back({pose, end, direction, {}, true, movingEnd});
            }
            pieces.back().arcs.push_back(arc);
            pose = advance(pose, arc.curvature, direction * arc.length);
        }
        return pieces;
    }

    std::vector<GearSegment> gearSegments(const Path &path)
    {
        std::vector<GearSegment> gears;
        Pose pose = path.start;
        for (const PathPiece &piece : path.pieces)
        {
            if (piece.length == 0.0)
                continue;
            const int direction = piece.length < 0.0 ? -1 : 1;
            if (gears.empty() || gears.back().direction != direction)
                gears.push_back({pose, pose, direction, {}, false, false});
            GearSegment &gear = gears.back();
            const double length = std::abs(piece.length);
            if (!gear.arcs.empty() && gear.arcs.back().curvature == piece.curvature)
                gear.arcs.back().length += length;
            else
                gear.arcs.push_back({piece.curvature, length});
            pose = advance(pose, piece.curvature, piece.length);
            gear.end = pose;
        }
        return gears;
    }

    std::vector<GearSegment> gearSegments(const SampledPath &path)
    {
        std::vector<GearSegment> gears;
        for (std::size_t i = 1, last = 0; i < path.size(); ++i)
        {
            const Pose &from = path[last].pose, &to = path[i].pose;
            if (std::hypot(to.x - from.x, to.y - from.y) < SAME_PLACE)
                continue;
            last = i;
            const Arc arc = arcBetween(from, to);
            const int direction = arc.length < 0.0 ? -1 : 1;
            if (gears.empty() || gears.back().direction != direction)
                gears.push_back({from, from, direction, {}, false, false});
            GearSegment &gear = gears.back();
            const double length = std::abs(arc.length);
            if (!gear.arcs.empty() && std::abs(gear.arcs.back().curvature - arc.curvature) < SAME_CURVATURE)
            {
                // The mean, weighted by length, keeps the turn of both.
                Arc &whole = gear.arcs.back();
                whole.curvature = (whole.curvature * whole.length + arc.curvature * length) / (whole.length + length);
                whole.length += length;
            }
            else
                gear.arcs.push_back({arc.curvature, length});
            gear.end = to;
        }
        return gears;
    }
}  // namespace parking

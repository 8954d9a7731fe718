#include "parking_geometry/curves/ArcPath.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    double ArcPath::length() const
    {
        double sum = 0.0;
        for (const ArcSegment &segment : segments)
            sum += std::abs(segment.length);
        return sum;
    }

    std::size_t ArcPath::cusps() const
    {
        std::size_t changes = 0;
        double last = 0.0;
        for (const ArcSegment &segment : segments)
        {
            if (segment.length == 0.0)
                continue;
            if (last * segment.length < 0.0)
                ++changes;
            last = segment.length;
        }
        return changes;
    }

    Pose ArcPath::end() const
    {
        Pose pose = start;
        for (const ArcSegment &segment : segments)
            pose = advance(pose, segment.curvature, segment.length);
        pose.yaw = wrapAngle(pose.yaw);
        return pose;
    }

    ArcPath ArcPath::reversed() const
    {
        ArcPath result{end(), {}};
        result.segments.reserve(segments.size());
        for (auto segment = segments.rbegin(); segment != segments.rend(); ++segment)
            result.segments.push_back({segment->curvature, -segment->length});
        return result;
    }

    void ArcPath::append(const ArcSegment &segment)
    {
        if (segment.length == 0.0)
            return;
        if (!segments.empty() && segments.back().curvature == segment.curvature &&
            segments.back().length * segment.length > 0.0)
            segments.back().length += segment.length;
        else
            segments.push_back(segment);
    }

    Path ArcPath::sample(double step) const
    {
        Path path;
        PathState state;
        state.pose = start;
        for (const ArcSegment &segment : segments)
        {
            if (segment.length == 0.0)
                continue;
            state.curvature = segment.curvature;
            state.direction = segment.length < 0.0 ? -1 : 1;
            if (path.empty())
                path.push_back(state);
            const Pose from = path.back().pose;
            const double before = path.back().arcLength;
            const auto pieces = static_cast<std::size_t>(std::max(1.0, std::ceil(std::abs(segment.length) / step)));
            for (std::size_t i = 1; i <= pieces; ++i)
            {
                const double driven = segment.length * static_cast<double>(i) / static_cast<double>(pieces);
                state.pose = advance(from, segment.curvature, driven);
                state.arcLength = before + std::abs(driven);
                path.push_back(state);
            }
        }
        if (path.empty())
            path.push_back(state);
        for (PathState &each : path)
            each.pose.yaw = wrapAngle(each.pose.yaw);
        return path;
    }

    double pathLength(const Path &path)
    {
        return path.empty() ? 0.0 : path.back().arcLength - path.front().arcLength;
    }

    std::size_t countCusps(const Path &path)
    {
        std::size_t changes = 0;
        for (std::size_t i = 2; i < path.size(); ++i)
            if (path[i].direction != path[i - 1].direction)
                ++changes;
        return changes;
    }
}  // namespace parking

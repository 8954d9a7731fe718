#include "parking_geometry/curves/Clothoid.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        // Gauss-Legendre, five points on [-1, 1].
        constexpr double NODES[] = {-0.906179845938663993, -0.538469310105683091, 0.0, 0.538469310105683091,
                                    0.906179845938663993};
        constexpr double WEIGHTS[] = {0.236926885056189088, 0.478628670499366468, 0.568888888888888889,
                                      0.478628670499366468, 0.236926885056189088};

        /** Turning by up to this angle, the quadrature above is exact to about 1e-13 of the length. */
        constexpr double ANGLE_PER_PANEL = 0.5;
    }  // namespace

    Pose advance(const Pose &pose, const ClothoidSegment &segment, double driven)
    {
        const double sign = segment.length < 0.0 ? -1.0 : 1.0;
        if (segment.sharpness == 0.0)
            return advance(pose, segment.curvature, sign * driven);
        const double steepest =
            std::max(std::abs(segment.curvature), std::abs(segment.curvature + segment.sharpness * driven));
        const int panels = 1 + static_cast<int>(steepest * driven / ANGLE_PER_PANEL);
        const double half = 0.5 * driven / panels;
        const auto yawAt = [&](double s)
        {
            return pose.yaw + sign * s * (segment.curvature + 0.5 * segment.sharpness * s);
        };
        double x = 0.0, y = 0.0;
        for (int panel = 0; panel < panels; ++panel)
            for (int i = 0; i < 5; ++i)
            {
                const double yaw = yawAt(half * (2 * panel + 1 + NODES[i]));
                x += WEIGHTS[i] * std::cos(yaw);
                y += WEIGHTS[i] * std::sin(yaw);
            }
        return {pose.x + sign * half * x, pose.y + sign * half * y, yawAt(driven)};
    }

    double ClothoidPath::length() const
    {
        double sum = 0.0;
        for (const ClothoidSegment &segment : pieces)
            sum += std::abs(segment.length);
        return sum;
    }

    Pose ClothoidPath::end() const
    {
        Pose pose = start;
        for (const ClothoidSegment &segment : pieces)
            pose = advance(pose, segment, std::abs(segment.length));
        pose.yaw = wrapAngle(pose.yaw);
        return pose;
    }

    SampledPath ClothoidPath::sample(double step) const
    {
        SampledPath path;
        PathState state;
        state.pose = start;
        for (const ClothoidSegment &segment : pieces)
        {
            const double length = std::abs(segment.length);
            if (length == 0.0)
                continue;
            state.direction = segment.length < 0.0 ? -1 : 1;
            state.curvature = segment.curvature;
            if (path.empty())
                path.push_back(state);
            const Pose from = path.back().pose;
            const double before = path.back().arcLength;
            const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(length / step)));
            for (std::size_t i = 1; i <= count; ++i)
            {
                const double driven = length * static_cast<double>(i) / static_cast<double>(count);
                state.pose = advance(from, segment, driven);
                state.arcLength = before + driven;
                state.curvature = segment.curvature + segment.sharpness * driven;
                path.push_back(state);
            }
        }
        if (path.empty())
            path.push_back(state);
        for (PathState &each : path)
            each.pose.yaw = wrapAngle(each.pose.yaw);
        return path;
    }

    SampledPath ClothoidPath::sampleEvenly(double step) const
    {
        const double total = length();
        const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(total / step)));
        SampledPath path;
        path.reserve(count + 1);
        Pose pose = start;
        double before = 0.0;
        for (const ClothoidSegment &segment : pieces)
        {
            const double length = std::abs(segment.length);
            const auto add = [&](double driven, double arcLength)
            {
                PathState state;
                state.pose = advance(pose, segment, driven);
                state.pose.yaw = wrapAngle(state.pose.yaw);
                state.arcLength = arcLength;
                state.curvature = segment.curvature + segment.sharpness * driven;
                state.direction = segment.length < 0.0 ? -1 : 1;
                path.push_back(state);
            };
            const bool last = &segment == &pieces.back();
            while (path.size() < count)
            {
                const double arcLength = total * static_cast<double>(path.size()) / static_cast<double>(count);
                if (arcLength > before + length)
                    break;
                add(arcLength - before, arcLength);
            }
            if (last)
                add(length, total);
            pose = advance(pose, segment, length);
            before += length;
        }
        if (path.empty())
            path.push_back({start, 0.0, 0.0, 1});
        return path;
    }
}  // namespace parking

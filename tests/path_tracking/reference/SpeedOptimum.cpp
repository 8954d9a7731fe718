#include "tests/path_tracking/reference/SpeedOptimum.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace parking::test
{
    namespace
    {
        constexpr double STEP = 0.01;      // metres
        constexpr int CELLS_PER_STEP = 8;  // of squared speed that full acceleration passes in one step

        /** One stretch without standstill. */
        double legDuration(double length, const std::function<double(double)> &steering, const Vehicle &vehicle,
                           const SpeedLimits &limits)
        {
            const int steps = std::max(2, static_cast<int>(std::lround(length / STEP)));
            const double h = length / steps;
            const double cell = 2.0 * limits.acceleration * h / CELLS_PER_STEP;
            const int cells = static_cast<int>(std::floor(limits.speed * limits.speed / cell)) + 1;
            const auto cap = [&](int i)
            {
                const double s = i * h;
                double speed = limits.speed;
                // Slopes on both sides: a place where a ramp ends belongs to the ramp too.
                for (const double side : {-1.0, 1.0})
                {
                    const double other = std::clamp(s + side * 1e-4, 0.0, length);
                    if (other == s)
                        continue;
                    const double slope = std::abs((steering(other) - steering(s)) / (other - s));
                    if (slope > 0.0)
                        speed = std::min(speed, limits.steeringRate / slope);
                }
                const double curvature = std::abs(vehicle.curvature(steering(s)));
                double squared = speed * speed;
                if (curvature > 0.0)
                    squared = std::min(squared, limits.lateralAcceleration / curvature);
                return squared;
            };
            const double never = std::numeric_limits<double>::infinity();
            std::vector<double> time(cells, never), next(cells);
            time[0] = 0.0;
            for (int i = 1; i <= steps; ++i)
            {
                std::fill(next.begin(), next.end(), never);
                const int highest = i == steps ? 0 : std::min(cells - 1, static_cast<int>(cap(i) / cell));
                for (int to = 0; to <= highest; ++to)
                    for (int from = std::max(0, to - CELLS_PER_STEP); from <= std::min(cells - 1, to + CELLS_PER_STEP);
                         ++from)
                        if (from + to > 0 && time[from] < never)
                            next[to] = std::min(next[to],
                                                time[from] + 2.0 * h / (std::sqrt(from * cell) + std::sqrt(to * cell)));
                time.swap(next);
            }
            return time[0];
        }
    }  // namespace

    double optimalDuration(const Path &path, const Vehicle &vehicle, const SpeedLimits &limits)
    {
        double total = 0.0, wheels = 0.0;
        for (const Stretch &stretch : path.stretches())
        {
            double length = 0.0;
            for (std::size_t i = stretch.first; i < stretch.last; ++i)
                length += path.pieces[i].driven();
            const auto steering = [&](double s)
            {
                std::size_t i = stretch.first;
                while (i + 1 < stretch.last && s > path.pieces[i].driven())
                    s -= path.pieces[i++].driven();
                return vehicle.steeringAngle(path.pieces[i].curvatureAt(std::clamp(s, 0.0, path.pieces[i].driven())));
            };
            total += std::abs(steering(0.0) - wheels) / limits.steeringRate;
            total += legDuration(length, steering, vehicle, limits);
            wheels = steering(length);
        }
        return total;
    }
}  // namespace parking::test

#pragma once

#include "parking_geometry/smoothing/PathSmoother.h"
#include "tests/support/PoseGap.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace parking_test
{
    using namespace parking;

    /** Poses where \e path begins, where its stretches meet, and where it ends. */
    inline std::vector<Pose> posesOfStretches(const Path &path)
    {
        std::vector<Pose> poses;
        for (const Stretch &stretch : path.stretches())
            poses.push_back(path.part(stretch.first, stretch.last).start);
        poses.push_back(path.end());
        return poses;
    }

    /** Stretches that the car drives without stopping to steer. */
    inline std::size_t continuousStretches(const SmoothPath &smooth)
    {
        const std::vector<Stretch> stretches = smooth.path.stretches();
        return static_cast<std::size_t>(std::count_if(
            stretches.begin(), stretches.end(),
            [&smooth](const Stretch &stretch)
            {
                return std::none_of(smooth.stops.begin(), smooth.stops.end(),
                                    [&](std::size_t stop) { return stop >= stretch.first && stop < stretch.last; });
            }));
    }

    /** All that a result promises whatever the path. */
    inline void expectDrivable(const SmoothPath &result, const Path &given, const Vehicle &car,
                               const SmoothingOptions &options)
    {
        const std::vector<PathPiece> &pieces = result.path.pieces;
        const double maxCurvature = 1.0 / car.minTurningRadius();
        // Start, goal and changes of direction are exact.
        const std::vector<Pose> poses = posesOfStretches(given), smooth = posesOfStretches(result.path);
        const std::vector<Stretch> before = given.stretches(), after = result.path.stretches();
        ASSERT_EQ(before.size(), after.size());
        ASSERT_EQ(gap(result.path.start, given.start), 0.0);
        std::size_t jumps = 0;
        for (std::size_t k = 0; k < after.size(); ++k)
        {
            ASSERT_EQ(after[k].direction, before[k].direction);
            const double length = given.part(before[k].first, before[k].last).length();
            ASSERT_NEAR(result.path.part(after[k].first, after[k].last).length(), length, 0.03 * length + 1e-9);
            ASSERT_LT(gap(smooth[k], poses[k]), 1e-8);
            for (std::size_t i = after[k].first; i < after[k].last; ++i)
            {
                // Curvature: it stays within the limit and changes no faster than the wheels turn at the lowest
                // speed, and not at all abruptly but where the car stands.
                const PathPiece &piece = pieces[i];
                ASSERT_GT(piece.driven(), 0.0);
                ASSERT_EQ(piece.turn, 0.0);
                ASSERT_LE(std::abs(piece.curvature), maxCurvature * (1.0 + 1e-9));
                ASSERT_LE(std::abs(piece.endCurvature()), maxCurvature * (1.0 + 1e-9));
                const double turned =
                    std::abs(car.steeringAngle(piece.endCurvature()) - car.steeringAngle(piece.curvature));
                ASSERT_LE(turned * std::min(options.minSpeed, options.speed),
                          car.maxSteeringRate * piece.driven() * (1.0 + 1e-6) + 1e-12);
                const bool stands =
                    i == after[k].first || std::find(result.stops.begin(), result.stops.end(), i) != result.stops.end();
                ASSERT_TRUE(stands || std::abs(pieces[i - 1].endCurvature() - piece.curvature) <= 1e-9);
                jumps += stands && i > after[k].first;
            }
        }
        ASSERT_LT(gap(smooth.back(), poses.back()), 1e-8);
        ASSERT_EQ(jumps, result.stops.size()) << "stops lie within stretches";
    }
}  // namespace parking_test

#pragma once

#include "parking_geometry/curves/Kinematics.h"
#include "parking_geometry/smoothing/PathSmoother.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace parking_test
{
    using namespace parking;

    inline double distance(const Pose &a, const Pose &b)
    {
        return std::hypot(a.x - b.x, a.y - b.y);
    }

    inline double gap(const Pose &a, const Pose &b)
    {
        return distance(a, b) + std::abs(wrapAngle(a.yaw - b.yaw));
    }

    /** Poses where \e path begins, changes its direction and ends. */
    inline std::vector<Pose> cuspPoses(const Path &path)
    {
        std::vector<Pose> poses{path.start};
        Pose pose = path.start;
        double last = 0.0;
        for (const PathPiece &segment : path.pieces)
        {
            if (last * segment.length < 0.0)
                poses.push_back(pose);
            pose = advance(pose, segment.curvature, segment.length);
            last = segment.length;
        }
        poses.push_back(pose);
        return poses;
    }

    inline bool standsAt(const SmoothPath &path, std::size_t state)
    {
        return path.speedLimit[state] == 0.0;
    }

    /** All that a result promises whatever the path. */
    inline void expectDrivable(const SmoothPath &result, const Path &given, const Vehicle &car,
                               const SmoothingOptions &options)
    {
        const SampledPath &path = result.path;
        ASSERT_EQ(path.size(), result.speedLimit.size());
        const double maxCurvature = 1.0 / car.minTurningRadius();
        // Start, goal and changes of direction are exact.
        const std::vector<Pose> poses = cuspPoses(given);
        ASSERT_EQ(result.gears.size() + 1, poses.size());
        std::vector<double> lengths;
        for (std::size_t k = 0; k < given.pieces.size(); ++k)
        {
            if (k == 0 || given.pieces[k].length * given.pieces[k - 1].length < 0.0)
                lengths.push_back(0.0);
            lengths.back() += std::abs(given.pieces[k].length);
        }
        for (std::size_t k = 0; k < result.gears.size(); ++k)
        {
            const double length =
                path[result.gears[k].lastState].arcLength - path[result.gears[k].firstState].arcLength;
            ASSERT_NEAR(length, lengths[k], 0.03 * lengths[k] + 1e-9);
            ASSERT_LT(gap(path[result.gears[k].firstState].pose, poses[k]), 1e-9);
            ASSERT_LT(gap(path[result.gears[k].lastState].pose, poses[k + 1]), 1e-9);
            ASSERT_TRUE(standsAt(result, result.gears[k].firstState) && standsAt(result, result.gears[k].lastState));
        }
        ASSERT_EQ(countCusps(path), given.cusps());
        ASSERT_EQ(result.gears.back().lastState, path.size() - 1);
        ASSERT_LT(gap(result.pieces.end(), poses.back()), 1e-8);
        ASSERT_NEAR(result.lengthBefore, given.length(), 1e-9);
        std::size_t stops = 0;
        for (const GearReport &gear : result.gears)
        {
            stops += gear.stops;
            ASSERT_GE(gear.speed, std::min(options.minSpeed, options.speed));
            ASSERT_LE(gear.speed, options.speed);
        }
        ASSERT_EQ(stops, result.stops.size());

        for (std::size_t i = 0; i < path.size(); ++i)
        {
            ASSERT_LE(std::abs(path[i].curvature), maxCurvature * (1.0 + 1e-9));
            if (i == 0)
                continue;
            const double driven = path[i].arcLength - path[i - 1].arcLength;
            ASSERT_GT(driven, 0.0);
            ASSERT_LE(driven, options.step * (1.0 + 1e-9));
            // Position and heading: the arc between the states is the driven one.
            const Arc arc = arcBetween(path[i - 1].pose, path[i].pose);
            ASSERT_EQ(arc.length < 0.0 ? -1 : 1, path[i].direction);
            ASSERT_NEAR(std::abs(arc.length), driven, 1e-5);
            ASSERT_LE(std::abs(arc.curvature), maxCurvature * (1.0 + 1e-5));
            // Curvature: it changes no faster than the wheels turn at the speed that is allowed, and not at all
            // abruptly. After a stop it may be anything, which the next state must not exceed either.
            if (standsAt(result, i - 1))
                continue;
            const double turned = car.steeringAngle(path[i].curvature) - car.steeringAngle(path[i - 1].curvature);
            for (const double limit : {result.speedLimit[i - 1], result.speedLimit[i]})
                ASSERT_LE(std::abs(turned) * limit, car.maxSteeringRate * driven * (1.0 + 1e-6) + 1e-12);
        }
        // The car stands at the ends of stretches and at stops, and nowhere else.
        std::vector<std::size_t> standing = result.stops;
        standing.push_back(0);
        for (const GearReport &gear : result.gears)
            standing.push_back(gear.lastState);
        std::sort(standing.begin(), standing.end());
        std::vector<std::size_t> zero;
        for (std::size_t i = 0; i < path.size(); ++i)
            if (standsAt(result, i))
                zero.push_back(i);
        ASSERT_EQ(zero, standing);
        // Speeds are never below what the stretch's planned speed says.
        for (const GearReport &gear : result.gears)
            for (std::size_t i = gear.firstState; i <= gear.lastState; ++i)
                ASSERT_TRUE(standsAt(result, i) || result.speedLimit[i] >= gear.speed * (1.0 - 1e-9));
        // The pieces are one curve of bounded curvature, continuous but where the car stands.
        std::size_t jumps = 0;
        for (std::size_t i = 1; i < result.pieces.pieces.size(); ++i)
        {
            const PathPiece &before = result.pieces.pieces[i - 1], &after = result.pieces.pieces[i];
            jumps += before.length * after.length > 0.0 && std::abs(before.endCurvature() - after.curvature) > 1e-9;
        }
        ASSERT_LE(jumps, result.stops.size());
    }
}  // namespace parking_test

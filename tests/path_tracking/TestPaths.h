#pragma once

#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

namespace parking::test
{
    /** A path of arcs, sampled. Curvatures as shares of the car's largest. */
    inline SampledPath arcs(const Pose &start, const std::vector<Arc> &pieces, double step = 0.1,
                            const Vehicle &vehicle = {})
    {
        Path path{start, {}};
        for (const Arc &piece : pieces)
            path.append({piece.curvature / vehicle.minTurningRadius(), piece.length});
        return path.sample(step);
    }

    /** A piece of a path of continuous curvature: curvature as a function of the driven length, one direction. */
    struct SmoothPiece
    {
        double length;
        int direction;
        std::function<double(double)> curvature;
    };

    /** Samples pieces of continuous curvature: exact poses (integrated in steps of 1 mm), curvature of each sample that
        of the arc between its poses. */
    inline SampledPath smooth(const Pose &start, const std::vector<SmoothPiece> &pieces, double step = 0.1)
    {
        SampledPath path;
        PathState state;
        state.pose = start;
        for (const SmoothPiece &piece : pieces)
        {
            state.direction = piece.direction;
            state.curvature = piece.curvature(0.0);
            if (path.empty())
                path.push_back(state);
            const int samples = std::max(1, static_cast<int>(std::ceil(piece.length / step)));
            const double sampleLength = piece.length / samples;
            const int fine = std::max(1, static_cast<int>(std::ceil(sampleLength / 0.001)));
            const double h = sampleLength / fine;
            for (int i = 0; i < samples; ++i)
            {
                const double yaw = state.pose.yaw;
                for (int k = 0; k < fine; ++k)
                    state.pose =
                        advance(state.pose, piece.curvature(i * sampleLength + (k + 0.5) * h), piece.direction * h);
                state.curvature = (state.pose.yaw - yaw) / (piece.direction * sampleLength);
                state.arcLength += sampleLength;
                path.push_back(state);
            }
        }
        for (PathState &each : path)
            each.pose.yaw = wrapAngle(each.pose.yaw);
        return path;
    }

    /** Curvature that rises from 0 at constant rate, is held, and falls to 0 again: clothoid, arc, clothoid. */
    inline SmoothPiece clothoidTurn(int direction, double curvature, double ramp, double arc)
    {
        return {2.0 * ramp + arc, direction,
                [=](double s)
                {
                    return curvature * std::min({1.0, s / ramp, (2.0 * ramp + arc - s) / ramp});
                }};
    }

    inline SmoothPiece straight(int direction, double length)
    {
        return {length, direction,
                [](double)
                {
                    return 0.0;
                }};
    }

    /** Numbers that are the same with every standard library. */
    class Random
    {
    public:
        explicit Random(std::uint64_t seed) : engine_(seed)
        {
        }

        double uniform(double low, double high)
        {
            return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
        }

        int below(int n)
        {
            return static_cast<int>(engine_() % static_cast<std::uint64_t>(n));
        }

    private:
        std::mt19937_64 engine_;
    };

    /** What a Reeds-Shepp planner delivers: full-lock arcs and lines, with cusps. */
    inline SampledPath randomReedsShepp(std::uint64_t seed, double length, double step = 0.1)
    {
        Random random(seed);
        std::vector<Arc> pieces;
        int direction = random.below(2) == 0 ? 1 : -1;
        double left = length;
        while (left > 0.0)
        {
            const double curvature = random.below(3) - 1;
            const double piece = std::min(left, random.uniform(0.3, 5.0));
            pieces.push_back({curvature, direction * piece});
            left -= piece;
            if (random.below(3) == 0)
                direction = -direction;
        }
        return arcs({random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0), random.uniform(-PI, PI)}, pieces, step);
    }

    /** What a lattice planner with five steering angles delivers: arcs of half a metre. */
    inline SampledPath randomLattice(std::uint64_t seed, double length)
    {
        Random random(seed);
        const Vehicle vehicle;
        Path path{{random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0), random.uniform(-PI, PI)}, {}};
        int direction = 1, angle = random.below(5) - 2;
        for (double left = length; left > 0.0; left -= 0.5)
        {
            path.append({vehicle.curvature(0.5 * angle * vehicle.maxSteeringAngle), direction * 0.5});
            if (random.below(3) == 0)
                angle = std::max(-2, std::min(2, angle + random.below(3) - 1));
            if (random.below(8) == 0)
                direction = -direction;
        }
        return path.sample(0.1);
    }

    /** What a smoothing planner delivers: clothoids, arcs and lines of continuous curvature, with cusps. */
    inline SampledPath randomSmooth(std::uint64_t seed, double length, double step = 0.1)
    {
        Random random(seed);
        const double most = 1.0 / Vehicle().minTurningRadius();
        std::vector<SmoothPiece> pieces;
        int direction = random.below(2) == 0 ? 1 : -1;
        double left = length;
        while (left > 0.0)
        {
            if (random.below(3) == 0)
            {
                pieces.push_back(straight(direction, random.uniform(0.5, 4.0)));
            }
            else
            {
                const double curvature = random.uniform(0.3, 1.0) * most * (random.below(2) == 0 ? 1.0 : -1.0);
                pieces.push_back(clothoidTurn(direction, curvature, std::abs(curvature) * random.uniform(3.0, 9.0),
                                              random.uniform(0.1, 3.0)));
            }
            left -= pieces.back().length;
            if (random.below(3) == 0)
                direction = -direction;
        }
        return smooth({random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0), random.uniform(-PI, PI)}, pieces, step);
    }

    /** What a grid planner delivers: straight chords, headings those of the chords, curvature 0.

        \param turns radians of the corner after each chord
        \param headingBefore is the heading at a corner that of the chord before it, or after? */
    inline SampledPath chords(const Pose &start, const std::vector<double> &lengths, const std::vector<double> &turns,
                              bool headingBefore, double step = 0.0)
    {
        SampledPath path;
        PathState state;
        state.pose = start;
        path.push_back(state);
        for (std::size_t i = 0; i < lengths.size(); ++i)
        {
            const int pieces = step > 0.0 ? std::max(1, static_cast<int>(std::ceil(lengths[i] / step))) : 1;
            for (int k = 0; k < pieces; ++k)
            {
                state.pose = advance(state.pose, 0.0, lengths[i] / pieces);
                state.arcLength += lengths[i] / pieces;
                path.push_back(state);
            }
            if (i < turns.size())
            {
                state.pose.yaw = wrapAngle(state.pose.yaw + turns[i]);
                if (!headingBefore)
                    path.back().pose.yaw = state.pose.yaw;
            }
        }
        return path;
    }
}  // namespace parking::test

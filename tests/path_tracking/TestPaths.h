#pragma once

#include "benchmarks/worlds/Random.h"
#include "parking_geometry/Vehicle.h"
#include "parking_geometry/curves/Path.h"
#include "path_tracking/trajectory/TimedMotion.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace parking::test
{
    using parking_test::Random;

    /** A path of arcs. Curvatures as shares of the car's largest. */
    inline Path arcs(const Pose &start, const std::vector<Arc> &pieces, const Vehicle &vehicle = {})
    {
        Path path{start, {}};
        for (const Arc &piece : pieces)
            path.append({piece.curvature / vehicle.minTurningRadius(), piece.length});
        return path;
    }

    /** A part of a path of continuous curvature, in one direction. */
    using SmoothPart = std::vector<PathPiece>;

    inline Path smooth(const Pose &start, const std::vector<SmoothPart> &parts)
    {
        Path path{start, {}};
        for (const SmoothPart &part : parts)
            for (const PathPiece &piece : part)
                path.append(piece);
        return path;
    }

    /** Curvature that rises from 0 at constant rate, is held, and falls to 0 again: clothoid, arc, clothoid. */
    inline SmoothPart clothoidTurn(int direction, double curvature, double ramp, double arc)
    {
        const double sharpness = curvature / ramp;
        return {{0.0, direction * ramp, sharpness},
                {curvature, direction * arc},
                {curvature, direction * ramp, -sharpness}};
    }

    inline SmoothPart straight(int direction, double length)
    {
        return {{0.0, direction * length}};
    }

    /** The same path in arcs no longer than \e step, each turning as far as its part of the path: what is left of a
        clothoid when somebody has sampled it. */
    inline Path inArcs(const Path &path, double step)
    {
        const SampledPath states = path.sample(step);
        Path result{path.start, {}};
        for (std::size_t i = 1; i < states.size(); ++i)
        {
            const double length = states[i].direction * (states[i].arcLength - states[i - 1].arcLength);
            result.append({wrapAngle(states[i].pose.yaw - states[i - 1].pose.yaw) / length, length});
        }
        return result;
    }

    /** What a Reeds-Shepp planner delivers: full-lock arcs and lines, with cusps. */
    inline Path randomReedsShepp(std::uint64_t seed, double length)
    {
        Random random(seed);
        std::vector<Arc> pieces;
        int direction = random.below(2) == 0 ? 1 : -1;
        double left = length;
        while (left > 0.0)
        {
            const double curvature = random.below(3) - 1;
            const double piece = std::min(left, random.between(0.3, 5.0));
            pieces.push_back({curvature, direction * piece});
            left -= piece;
            if (random.below(3) == 0)
                direction = -direction;
        }
        return arcs({random.between(-5.0, 5.0), random.between(-5.0, 5.0), random.between(-PI, PI)}, pieces);
    }

    /** What a lattice planner with five steering angles delivers: arcs of half a metre. */
    inline Path randomLattice(std::uint64_t seed, double length)
    {
        Random random(seed);
        const Vehicle vehicle;
        Path path{{random.between(-5.0, 5.0), random.between(-5.0, 5.0), random.between(-PI, PI)}, {}};
        int direction = 1, angle = random.below(5) - 2;
        for (double left = length; left > 0.0; left -= 0.5)
        {
            path.append({vehicle.curvature(0.5 * angle * vehicle.maxSteeringAngle), direction * 0.5});
            if (random.below(3) == 0)
                angle = std::max(-2, std::min(2, angle + random.below(3) - 1));
            if (random.below(8) == 0)
                direction = -direction;
        }
        return path;
    }

    /** What a smoothing planner delivers: clothoids, arcs and lines of continuous curvature, with cusps. */
    inline Path randomSmooth(std::uint64_t seed, double length)
    {
        Random random(seed);
        const double most = 1.0 / Vehicle().minTurningRadius();
        std::vector<SmoothPart> pieces;
        int direction = random.below(2) == 0 ? 1 : -1;
        double left = length;
        while (left > 0.0)
        {
            if (random.below(3) == 0)
            {
                pieces.push_back(straight(direction, random.between(0.5, 4.0)));
            }
            else
            {
                const double curvature = random.between(0.3, 1.0) * most * (random.below(2) == 0 ? 1.0 : -1.0);
                pieces.push_back(clothoidTurn(direction, curvature, std::abs(curvature) * random.between(3.0, 9.0),
                                              random.between(0.1, 3.0)));
            }
            for (const PathPiece &piece : pieces.back())
                left -= piece.driven();
            if (random.below(3) == 0)
                direction = -direction;
        }
        return smooth({random.between(-5.0, 5.0), random.between(-5.0, 5.0), random.between(-PI, PI)}, pieces);
    }

    /** What a grid planner delivers: straight chords with turns on the spot between them.

        \param turns radians of the corner behind each chord */
    inline Path chords(const Pose &start, const std::vector<double> &lengths, const std::vector<double> &turns)
    {
        Path path{start, {}};
        for (std::size_t i = 0; i < lengths.size(); ++i)
        {
            path.append({0.0, lengths[i]});
            if (i < turns.size())
                path.append(PathPiece::turnOnTheSpot(turns[i]));
        }
        return path;
    }

    /** Chords along the lines of a grid of half a metre and its diagonals, with corners of an eighth of a turn now and
        then: after one chord in \e straight. */
    inline Path randomGridPath(std::uint64_t seed, const Pose &start, int count, int straight)
    {
        Random random(seed);
        std::vector<double> lengths, turns;
        for (int i = 0; i < count; ++i)
        {
            lengths.push_back(random.below(2) == 0 ? 0.5 : std::sqrt(0.5));
            turns.push_back(random.below(straight) == 0 ? (random.below(2) == 0 ? 1 : -1) * PI / 4 : 0.0);
        }
        turns.pop_back();
        return chords(start, lengths, turns);
    }

    /** Rolls while its wheels turn, stands, comes back, and turns its wheels straight at the end. */
    inline TimedMotion exampleMotion()
    {
        return {{1.0, 2.0, 3.0},
                {{0.0, 0.0, 0.0},
                 {0.5, 0.0, 0.2},
                 {2.0, 1.5, 0.7},
                 {4.0, 1.0, -0.2},
                 {5.0, 0.0, -0.1},
                 {5.5, 0.0, 0.1},
                 {7.0, -1.0, 0.5},
                 {8.5, 0.0, 0.4},
                 {9.3, 0.0, 0.0}}};
    }
}  // namespace parking::test

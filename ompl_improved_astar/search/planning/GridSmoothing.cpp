#include "ompl_improved_astar/search/planning/GridSmoothing.h"

#include "parking_geometry/smoothing/BsplineSmoother.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <Eigen/Core>

namespace parking::search
{
    namespace
    {
        constexpr unsigned int STATES_BETWEEN_STOPS = 8;

        std::vector<Eigen::Vector2d> cornersOf(const Path &path)
        {
            std::vector<Eigen::Vector2d> points{{path.start.x, path.start.y}};
            Pose pose = path.start;
            for (const PathPiece &piece : path.pieces)
            {
                pose = advance(pose, piece);
                const Eigen::Vector2d point(pose.x, pose.y);
                if ((point - points.back()).norm() > 1e-9)
                    points.push_back(point);
            }
            return points;
        }
    }  // namespace

    std::vector<Pose> smoothGridPath(const Path &path, MotionEnvironment &environment, double turningRadius,
                                     const StopFunction &stop)
    {
        const std::vector<Eigen::Vector2d> points = cornersOf(path);
        if (points.size() < 3 || (stop && stop()))
            return {};
        FootprintQueries world;
        world.isFree = [&, asked = 0u, stopped = false](const Pose &pose) mutable
        {
            stopped = stopped || (++asked % STATES_BETWEEN_STOPS == 0 && stop && stop());
            return !stopped && environment.isFree(pose);
        };
        BsplineOptions options;
        options.maxCurvature = 1.0 / turningRadius;
        // Between control points so far apart a turn to the next neighbour's direction just keeps the radius.
        const double spacing = path.length() / static_cast<double>(points.size() - 1);
        const std::size_t usual = options.sampling;
        options.sampling = std::max(usual, static_cast<std::size_t>(std::ceil(turningRadius / spacing)));
        BsplinePath smooth = bsplineSmooth(points, options, Vehicle(), world);
        if (smooth.polylinePieces > 0 && options.sampling > usual)
        {
            options.sampling = usual;
            BsplinePath closer = bsplineSmooth(points, options, Vehicle(), world);
            if (closer.polylinePieces * smooth.pieces < smooth.polylinePieces * closer.pieces)
                smooth = std::move(closer);
        }
        std::vector<Pose> result{path.start};
        for (const PathState &state : smooth.path)
            result.push_back(state.pose);
        result.push_back(path.end());
        // The spline was checked at its states; the motions between them have the last word.
        for (std::size_t i = 1; i < result.size(); ++i)
            if ((stop && stop()) || !environment.isMotionFree(result[i - 1], result[i]))
                return {};
        return result;
    }
}  // namespace parking::search

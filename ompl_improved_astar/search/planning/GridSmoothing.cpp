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

    bool smoothGridPath(Path &path, MotionEnvironment &environment, double turningRadius, const StopFunction &stop)
    {
        const std::vector<Eigen::Vector2d> points = cornersOf(path);
        if (points.size() < 3 || (stop && stop()))
            return false;
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
        BsplineResult smooth = bsplineSmooth(points, options, Vehicle(), world);
        if (smooth.polylineSpans > 0 && options.sampling > usual)
        {
            options.sampling = usual;
            BsplineResult closer = bsplineSmooth(points, options, Vehicle(), world);
            if (closer.polylineSpans * smooth.spans < smooth.polylineSpans * closer.spans)
                smooth = std::move(closer);
        }
        // The ends keep their headings: the car turns there.
        Path result{path.start, {}};
        result.append(PathPiece::turnOnTheSpot(wrapAngle(smooth.path.start.yaw - path.start.yaw)));
        result.extend(smooth.path);
        result.append(PathPiece::turnOnTheSpot(wrapAngle(path.end().yaw - smooth.path.end().yaw)));
        // The spline was checked at its poses; the motions between them have the last word.
        const SampledPath states = result.sample(SMOOTH_STATE_SPACING);
        for (std::size_t i = 1; i < states.size(); ++i)
            if ((stop && stop()) || !environment.isMotionFree(states[i - 1].pose, states[i].pose))
                return false;
        path = std::move(result);
        return true;
    }
}  // namespace parking::search

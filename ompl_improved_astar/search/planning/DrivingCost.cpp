#include "ompl_improved_astar/search/planning/DrivingCost.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace parking::search
{
    namespace
    {
        constexpr double FARTHEST = 1e6;  // metres of a motion; clearances along it are sampled

        /** A straight line of a plain SE2 space, along which the heading changes linearly. */
        struct Line
        {
            Pose from;
            double x, y, turn, length;

            Line(const Pose &begin, const Pose &end)
              : from(begin),
                x(end.x - begin.x),
                y(end.y - begin.y),
                turn(wrapAngle(end.yaw - begin.yaw)),
                length(std::hypot(x, y))
            {
            }

            /** The piece of a car that turns as far on the same length. */
            PathPiece piece(double fullLock) const
            {
                const double mean = from.yaw + 0.5 * turn;
                const double driven = std::copysign(length, x * std::cos(mean) + y * std::sin(mean));
                return length > 0.0 ? PathPiece(std::clamp(turn / driven, -fullLock, fullLock), driven) : PathPiece();
            }

            double proximity(const CostModel &cost, MotionEnvironment &environment) const
            {
                const double samples = std::ceil(length / cost.sampleSpacing);
                double nearer = 0.0;
                for (double i = 0.5; i < samples; i += 1.0)
                {
                    const double share = i / samples;
                    if (!environment.keeps({from.x + share * x, from.y + share * y, from.yaw + share * turn},
                                           cost.preferredClearance))
                        nearer += length / samples;
                }
                return cost.clearanceCost * nearer;
            }
        };
    }  // namespace

    DrivingCost::DrivingCost(const PlannerParameters &weights, double turningRadius) : isPlain_(turningRadius == 0.0)
    {
        checkParameters(weights);
        model_ = costModel(weights, isPlain_ ? weights.turningRadius : turningRadius);
    }

    double DrivingCost::along(const std::vector<Pose> &poses, const CurveFunction &curve,
                              MotionEnvironment &environment) const
    {
        CostModel cost = model_;
        if (!environment.knowsClearance())
            cost.clearanceCost = 0.0;
        Path path;
        double proximityOfLines = 0.0;
        if (!poses.empty())
            path.start = poses.front();
        for (std::size_t i = 1; i < poses.size(); ++i)
        {
            const Line line(poses[i - 1], poses[i]);
            if (!(line.length <= FARTHEST && std::isfinite(line.turn)))
                return std::numeric_limits<double>::infinity();
            if (!isPlain_)
            {
                curve(i, path);
                continue;
            }
            path.append(line.piece(cost.fullLockCurvature));
            if (cost.prefersClearance())
                proximityOfLines += line.proximity(cost, environment);
        }
        if (isPlain_)
            cost.clearanceCost = 0.0;
        return price(cost, std::move(path), environment).cost + proximityOfLines;
    }
}  // namespace parking::search

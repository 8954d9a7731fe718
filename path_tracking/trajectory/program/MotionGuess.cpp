#include "path_tracking/trajectory/program/MotionGuess.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace parking
{
    namespace
    {
        constexpr double GRID = 0.02;       // metres between two points
        constexpr double LEAST_WAY = 1e-3;  // metres between two points, so that a drive takes time

        /** Means of \e values over \e reach neighbours to either side, as far as there are any. */
        std::vector<double> averaged(const std::vector<double> &values, std::size_t reach)
        {
            std::vector<double> sums(values.size() + 1, 0.0), means(values.size());
            for (std::size_t i = 0; i < values.size(); ++i)
                sums[i + 1] = sums[i] + values[i];
            for (std::size_t i = 0; i < values.size(); ++i)
            {
                const std::size_t first = i > reach ? i - reach : 0, last = std::min(values.size(), i + reach + 1);
                means[i] = (sums[last] - sums[first]) / static_cast<double>(last - first);
            }
            return means;
        }
    }  // namespace

    StretchGuess::StretchGuess(const Path &path, const Vehicle &vehicle, double window) : direction_(1)
    {
        const double length = path.length();
        const auto parts = static_cast<std::size_t>(std::max(20.0, std::ceil(length / GRID)));
        const double grid = length / static_cast<double>(parts);
        std::vector<double> angles;
        Pose pose = path.start;
        double behind = 0.0;  // metres of the pieces that are passed
        std::size_t piece = 0;
        for (std::size_t i = 0; i <= parts; ++i)
        {
            const double s = grid * static_cast<double>(i);
            while (piece + 1 < path.pieces.size() && s > behind + path.pieces[piece].driven())
            {
                behind += path.pieces[piece].driven();
                pose = advance(pose, path.pieces[piece++]);
            }
            const PathPiece &on = path.pieces[piece];
            const double driven = std::clamp(s - behind, 0.0, on.driven());
            points_.push_back({0.0, advance(pose, on, driven), vehicle.maxSpeed, 0.0});
            angles.push_back(vehicle.steeringAngle(on.curvatureAt(driven)));
            direction_ = on.direction() != 0 ? on.direction() : direction_;
        }
        const std::vector<double> steering = averaged(angles, static_cast<std::size_t>(window / grid));
        for (std::size_t i = 0; i <= parts; ++i)
            points_[i].steering = std::clamp(steering[i], -vehicle.maxSteeringAngle, vehicle.maxSteeringAngle);
        setSpeeds(std::vector<double>(parts, grid), vehicle);
    }

    StretchGuess::StretchGuess(int direction, std::vector<GuessPoint> points, const Vehicle &vehicle)
      : direction_(direction),
        points_(std::move(points))
    {
        std::vector<double> ways;
        for (std::size_t i = 1; i < points_.size(); ++i)
            ways.push_back(std::max(LEAST_WAY, positionDistance(points_[i - 1].pose, points_[i].pose)));
        setSpeeds(ways, vehicle);
    }

    void StretchGuess::setSpeeds(const std::vector<double> &ways, const Vehicle &vehicle)
    {
        const double doubled = 2.0 * vehicle.maxAcceleration;
        const auto reachable = [doubled](const GuessPoint &from, double way)
        {
            return std::sqrt(from.speed * from.speed + doubled * way);
        };
        for (GuessPoint &point : points_)
            point.speed = vehicle.maxSpeed;
        points_.front().speed = points_.back().speed = 0.0;
        for (std::size_t i = 0; i < ways.size(); ++i)
            points_[i + 1].speed = std::min(points_[i + 1].speed, reachable(points_[i], ways[i]));
        for (std::size_t i = ways.size(); i-- > 0;)
            points_[i].speed = std::min(points_[i].speed, reachable(points_[i + 1], ways[i]));
        points_.front().t = 0.0;
        for (std::size_t i = 0; i < ways.size(); ++i)
            points_[i + 1].t = points_[i].t + 2.0 * ways[i] / (points_[i].speed + points_[i + 1].speed);
    }

    std::pair<double, double> StretchGuess::fastest() const
    {
        const auto slower = [](const GuessPoint &a, const GuessPoint &b)
        {
            return a.speed < b.speed;
        };
        const auto first = std::max_element(points_.begin(), points_.end(), slower);
        const auto last = std::max_element(points_.rbegin(), points_.rend(), slower);
        return {first->t, last->t};
    }

    GuessPoint StretchGuess::at(double t) const
    {
        const auto next = std::upper_bound(points_.begin() + 1, points_.end() - 1, t,
                                           [](double value, const GuessPoint &point) { return value < point.t; });
        const GuessPoint &a = *(next - 1), &b = *next;
        const double part = std::clamp((t - a.t) / (b.t - a.t), 0.0, 1.0);
        // Speed is linear in time, and the way therefore quadratic.
        const double mean = 0.5 * (a.speed + b.speed);
        const double way = part * (a.speed + 0.5 * part * (b.speed - a.speed)) / mean;
        return {t,
                {a.pose.x + way * (b.pose.x - a.pose.x), a.pose.y + way * (b.pose.y - a.pose.y),
                 a.pose.yaw + way * (b.pose.yaw - a.pose.yaw)},
                a.speed + part * (b.speed - a.speed),
                a.steering + part * (b.steering - a.steering)};
    }
}  // namespace parking

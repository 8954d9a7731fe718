#include "path_tracking/trajectory/program/MotionGuess.h"

#include "path_tracking/trajectory/SpeedProfile.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace parking
{
    namespace
    {
        using Points = std::vector<GuessPoint>;

        constexpr double GRID = 0.02;            // metres between two points along a path
        constexpr double NODE_GRID = 0.05;       // metres between two points along nodes, approximately
        constexpr double STEERING_WINDOW = 0.5;  // metres before and after a jump over which a guess steers
        constexpr double MIN_DISTANCE =
            1e-3;                      // metres, minimum distance of two points, so that the duration is positive
        constexpr double BEND = 6.0;   // metres over which a stretch is bent to another end
        constexpr double LEVER = 1.5;  // metres per radian when poses are compared
        constexpr std::size_t FEWEST_POINTS = 3;

        /** Means of \e values over up to \e reach neighbours on either side. */
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

        double distance(const Pose &a, const Pose &b)
        {
            return positionDistance(a, b) + LEVER * std::abs(a.yaw - b.yaw);
        }

        double lengthOf(const Points &points)
        {
            double length = 0.0;
            for (std::size_t i = 1; i < points.size(); ++i)
                length += positionDistance(points[i - 1].pose, points[i].pose);
            return length;
        }

        Pose mean(const Pose &a, const Pose &b)
        {
            return {0.5 * (a.x + b.x), 0.5 * (a.y + b.y), 0.5 * (a.yaw + b.yaw)};
        }

        /** The point nearest to \e pose among those that leave a stretch between \e first and \e last. */
        std::size_t nearest(const Points &points, std::size_t first, std::size_t last, const Pose &pose)
        {
            const auto least = std::min_element(points.begin() + static_cast<std::ptrdiff_t>(first),
                                                points.begin() + static_cast<std::ptrdiff_t>(last),
                                                [&pose](const GuessPoint &a, const GuessPoint &b)
                                                { return distance(a.pose, pose) < distance(b.pose, pose); });
            return static_cast<std::size_t>(least - points.begin());
        }

        /** Cuts the end off at the point nearest to \e pose. */
        void cutTowards(Points &points, const Pose &pose)
        {
            if (points.size() > FEWEST_POINTS)
                points.resize(nearest(points, FEWEST_POINTS - 1, points.size(), pose) + 1);
        }

        /** Shifts the last metres so that they end at \e pose. */
        void bendTowards(Points &points, const Pose &pose)
        {
            const Pose end = points.back().pose;
            const double bend = std::min(BEND, lengthOf(points));
            double left = 0.0;
            for (std::size_t i = points.size(); i-- > 0;)
            {
                Pose &at = points[i].pose;
                const double u = bend > 0.0 ? std::max(0.0, 1.0 - left / bend) : 1.0;
                const double part = i + 1 == points.size() ? 1.0 : u * u * (3.0 - 2.0 * u);
                if (i > 0)
                    left += positionDistance(points[i - 1].pose, at);
                at = {at.x + part * (pose.x - end.x), at.y + part * (pose.y - end.y),
                      at.yaw + part * (pose.yaw - end.yaw)};
            }
        }

        Points reversed(Points points)
        {
            std::reverse(points.begin(), points.end());
            return points;
        }
    }  // namespace

    StretchGuess::StretchGuess(const Path &path, const Vehicle &vehicle, double initialSpeed) : direction_(1)
    {
        const double length = path.length();
        const auto parts = static_cast<std::size_t>(std::max(20.0, std::ceil(length / GRID)));
        const double grid = length / static_cast<double>(parts);
        std::vector<double> angles;
        Pose pose = path.start;
        double behind = 0.0;  // metres of the completed pieces
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
        const std::vector<double> steering = averaged(angles, static_cast<std::size_t>(STEERING_WINDOW / grid));
        for (std::size_t i = 0; i <= parts; ++i)
            points_[i].steering = std::clamp(steering[i], -vehicle.maxSteeringAngle, vehicle.maxSteeringAngle);
        setSpeeds(std::vector<double>(parts, grid), vehicle, initialSpeed);
    }

    StretchGuess::StretchGuess(int direction, std::vector<GuessPoint> points, const Vehicle &vehicle)
      : direction_(direction),
        points_(std::move(points))
    {
        std::vector<double> distances;
        for (std::size_t i = 1; i < points_.size(); ++i)
            distances.push_back(std::max(MIN_DISTANCE, positionDistance(points_[i - 1].pose, points_[i].pose)));
        setSpeeds(distances, vehicle, 0.0);
    }

    void StretchGuess::setSpeeds(const std::vector<double> &distances, const Vehicle &vehicle, double initialSpeed)
    {
        const double cap = vehicle.maxSpeed * vehicle.maxSpeed;
        const std::vector<double> squared = squaredSpeeds(distances, std::vector<double>(distances.size(), cap),
                                                          vehicle.maxAcceleration, initialSpeed * initialSpeed);
        for (std::size_t i = 0; i < points_.size(); ++i)
            points_[i].speed = std::sqrt(squared[i]);
        points_.front().speed = initialSpeed;  // too fast for a short stretch, whose program then has no solution
        points_.front().t = 0.0;
        for (std::size_t i = 0; i < distances.size(); ++i)
            points_[i + 1].t = points_[i].t + 2.0 * distances[i] / (points_[i].speed + points_[i + 1].speed);
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
        // Speed is linear in time, and the distance therefore quadratic.
        const double mean = 0.5 * (a.speed + b.speed);
        const double share = part * (a.speed + 0.5 * part * (b.speed - a.speed)) / mean;
        return {t,
                {a.pose.x + share * (b.pose.x - a.pose.x), a.pose.y + share * (b.pose.y - a.pose.y),
                 a.pose.yaw + share * (b.pose.yaw - a.pose.yaw)},
                a.speed + part * (b.speed - a.speed),
                a.steering + part * (b.steering - a.steering)};
    }

    double StretchGuess::length() const
    {
        return lengthOf(points_);
    }

    std::vector<StretchGuess> guessesAlong(const Path &path, const Vehicle &vehicle, double initialSpeed)
    {
        std::vector<StretchGuess> guesses;
        double yaw = path.start.yaw;
        for (const Stretch &stretch : path.stretches())
        {
            Path part = path.part(stretch.first, stretch.last);
            part.start.yaw += 2.0 * PI * std::round((yaw - part.start.yaw) / (2.0 * PI));
            guesses.emplace_back(part, vehicle, guesses.empty() ? initialSpeed : 0.0);
            yaw = guesses.back().at(guesses.back().duration()).pose.yaw;
        }
        return guesses;
    }

    std::vector<StretchGuess> stretchesOf(const MotionProblem &problem, const Vehicle &vehicle)
    {
        std::vector<StretchGuess> stretches;
        Points points;
        for (std::size_t k = 0; k < problem.directions.size(); ++k)
        {
            if (problem.directions[k] == 0)
                continue;
            const NodeVector &from = problem.nodes[k], &to = problem.nodes[k + 1];
            const auto at = [&](double part)
            {
                return GuessPoint{0.0, problem.poseAt(k, part), 0.0,
                                  from[NODE_STEERING] + part * (to[NODE_STEERING] - from[NODE_STEERING])};
            };
            if (points.empty())
                points.push_back(at(0.0));
            const double distance = from[NODE_DURATION] * 0.5 * (from[NODE_SPEED] + to[NODE_SPEED]);
            const double parts = std::max(1.0, std::ceil(distance / NODE_GRID));
            for (double p = 1.0; p <= parts; p += 1.0)
                points.push_back(at(p / parts));
            if (k + 1 == problem.directions.size() || problem.directions[k + 1] == 0)
                stretches.emplace_back(problem.directions[k], std::exchange(points, {}), vehicle);
        }
        return stretches;
    }

    std::vector<StretchGuess> withoutStretch(const std::vector<StretchGuess> &stretches, std::size_t index,
                                             const Vehicle &vehicle)
    {
        if (stretches.size() < 2)
            return {};
        std::vector<StretchGuess> rest = stretches;
        const auto removed = rest.begin() + static_cast<std::ptrdiff_t>(index);
        const auto replace = [&vehicle](StretchGuess &stretch, Points points)
        {
            stretch = StretchGuess(stretch.direction(), std::move(points), vehicle);
        };
        const Points &points = stretches[index].points();
        if (index == 0)
        {
            Points behind = reversed(std::next(removed)->points());
            cutTowards(behind, points.front().pose);
            bendTowards(behind, points.front().pose);
            replace(*std::next(removed), reversed(std::move(behind)));
            rest.erase(removed);
            return rest;
        }
        Points before = std::prev(removed)->points();
        if (index + 1 == stretches.size())
        {
            cutTowards(before, points.back().pose);
            bendTowards(before, points.back().pose);
            replace(*std::prev(removed), std::move(before));
            rest.pop_back();
            return rest;
        }
        const Pose middle = points[points.size() / 2].pose;
        Points behind = reversed(std::next(removed)->points());
        cutTowards(before, middle);
        cutTowards(behind, middle);
        const Pose meeting = mean(before.back().pose, behind.back().pose);
        bendTowards(before, meeting);
        bendTowards(behind, meeting);
        before.insert(before.end(), behind.rbegin() + 1, behind.rend());
        replace(*std::prev(removed), std::move(before));
        rest.erase(removed, removed + 2);
        return rest;
    }
}  // namespace parking

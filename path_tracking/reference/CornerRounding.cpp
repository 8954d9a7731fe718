#include "path_tracking/reference/CornerRounding.h"

#include "parking_geometry/curves/Biarc.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    namespace
    {
        constexpr double STEP = 0.05;               ///< metres that the simulated car drives at a time
        constexpr double BACK_ON_PATH = 0.005;      ///< metres beside the stretch that count as being on it
        constexpr double BACK_IN_YAW = 0.005;       ///< radians likewise
        constexpr double BACK_IN_CURVATURE = 0.02;  ///< 1/m likewise
        constexpr double SEARCH_AHEAD = 2.0;        ///< metres of the stretch searched for the nearest place
        constexpr double JOIN_LENGTH = 1.0;         ///< metres over which a car returns exactly
        constexpr double LEAST_JOIN = 0.3;          ///< metres; in less, even millimetres ask for much steering

        /** The stretch as a polyline of places with distances from its begin. */
        class Guide
        {
        public:
            explicit Guide(const Path &stretch)
            {
                Pose pose = stretch.start;
                points_.emplace_back(pose.x, pose.y);
                distances_.push_back(0.0);
                driven_.push_back(0.0);
                double before = 0.0;
                for (const PathPiece &piece : stretch.pieces)
                {
                    if (piece.turn != 0.0)
                        lastCorner_ = distances_.back();
                    // Bent pieces are resampled so that the polyline is the stretch.
                    const bool bent = piece.curvature != 0.0 || piece.sharpness != 0.0;
                    const int parts = bent ? std::max(1, static_cast<int>(std::ceil(piece.driven() / STEP))) : 1;
                    for (int k = 1; k <= parts && piece.length != 0.0; ++k)
                    {
                        const double along = piece.driven() * k / parts;
                        const Pose place = advance(pose, piece, along);
                        append({place.x, place.y}, before + along);
                    }
                    pose = advance(pose, piece);
                    before += piece.driven();
                }
            }

            double length() const
            {
                return distances_.back();
            }

            /** Distance of the last corner from the begin. */
            double lastCorner() const
            {
                return lastCorner_;
            }

            Eigen::Vector2d endDirection() const
            {
                const std::size_t n = points_.size();
                return (points_[n - 1] - points_[n - 2]).normalized();
            }

            const Eigen::Vector2d &end() const
            {
                return points_.back();
            }

            /** The place at \e distance; beyond the end straight on. */
            Eigen::Vector2d at(double distance) const
            {
                if (distance >= length())
                    return points_.back() + endDirection() * (distance - length());
                const std::size_t i = indexAfter(distance);
                return points_[i - 1] + shareOf(i, distance) * (points_[i] - points_[i - 1]);
            }

            /** Metres driven along the stretch itself at \e distance. */
            double drivenAt(double distance) const
            {
                const std::size_t i = indexAfter(distance);
                return driven_[i - 1] + shareOf(i, distance) * (driven_[i] - driven_[i - 1]);
            }

            /** Distance from the begin to the place nearest to \e point, at most SEARCH_AHEAD beyond \e from. */
            double nearest(const Eigen::Vector2d &point, double from, double &deviation) const
            {
                double best = std::numeric_limits<double>::infinity();
                double result = from;
                for (std::size_t i = indexAfter(from); i < points_.size(); ++i)
                {
                    const Eigen::Vector2d edge = points_[i] - points_[i - 1];
                    const double span = distances_[i] - distances_[i - 1];
                    const double lowest = std::max(0.0, (from - distances_[i - 1]) / span);
                    const double share =
                        std::clamp((point - points_[i - 1]).dot(edge) / edge.squaredNorm(), lowest, 1.0);
                    const double apart = (points_[i - 1] + share * edge - point).norm();
                    if (apart < best)
                    {
                        best = apart;
                        result = distances_[i - 1] + share * span;
                    }
                    if (distances_[i] > from + SEARCH_AHEAD)
                        break;
                }
                deviation = best;
                return result;
            }

        private:
            std::size_t indexAfter(double distance) const
            {
                const auto next = std::upper_bound(distances_.begin() + 1, distances_.end() - 1, distance);
                return static_cast<std::size_t>(next - distances_.begin());
            }

            double shareOf(std::size_t i, double distance) const
            {
                return std::min(1.0, (distance - distances_[i - 1]) / (distances_[i] - distances_[i - 1]));
            }

            void append(const Eigen::Vector2d &point, double driven)
            {
                if ((point - points_.back()).norm() < 1e-9)
                    return;
                distances_.push_back(distances_.back() + (point - points_.back()).norm());
                points_.push_back(point);
                driven_.push_back(driven);
            }

            std::vector<Eigen::Vector2d> points_;
            std::vector<double> distances_;
            std::vector<double> driven_;
            double lastCorner_{0.0};
        };

        /** The way onto the stretch from \e driven metres on, when the car is on it as good as exactly. */
        std::optional<Path> joinHere(const Path &stretch, double driven, const Pose &car, double curvature,
                                     const Vehicle &vehicle)
        {
            const Path left = stretch.rest(driven);
            if (left.pieces.empty())
                return std::nullopt;
            const Pose offset = relativeTo(left.start, car);
            if (std::abs(offset.x) > STEP || std::abs(offset.y) > BACK_ON_PATH || std::abs(offset.yaw) > BACK_IN_YAW ||
                std::abs(left.pieces.front().curvature - curvature) > BACK_IN_CURVATURE)
                return std::nullopt;
            return joinStretch(stretch, driven, car, vehicle);
        }

        /** One simulated drive, aiming \e ahead metres in front. Directions of travel are headings here: a car in
            reverse is a car driving forwards with its heading turned by half a turn and its curvature negated. */
        RoundedCorners pursue(const Path &stretch, const Guide &guide, const Pose &start, const Vehicle &vehicle,
                              double steeringSlope, double ahead)
        {
            const double sign = stretch.stretches().front().direction;
            const double turned = sign > 0.0 ? 0.0 : PI;
            Pose car{start.x, start.y, start.yaw + turned};
            RoundedCorners result;
            result.path.start = start;
            double along = 0.0, steering = 0.0;
            const auto most = static_cast<std::size_t>((2.0 * guide.length() + 10.0) / STEP);
            const auto locate = [&]
            {
                double deviation = 0.0;
                along = guide.nearest({car.x, car.y}, along, deviation);
                if (deviation > result.deviation)
                {
                    result.deviation = deviation;
                    result.worstPlace = guide.drivenAt(along);
                }
            };
            for (std::size_t count = 0; count < most; ++count)
            {
                locate();
                if (along > guide.lastCorner())
                    if (const auto rest = joinHere(stretch, guide.drivenAt(along), {car.x, car.y, car.yaw - turned},
                                                   sign * vehicle.curvature(steering), vehicle))
                    {
                        result.path.extend(*rest);
                        result.following = true;
                        return result;
                    }
                const Eigen::Vector2d target = guide.at(along + ahead);
                const Pose aim = relativeTo(car, {target.x(), target.y(), 0.0});
                const double squared = aim.x * aim.x + aim.y * aim.y;
                // A target behind the car asks for full lock, not for a gentle curve round it.
                double wanted = aim.x <= 0.0 ? std::copysign(vehicle.maxSteeringAngle, aim.y)
                                             : vehicle.steeringAngle(2.0 * aim.y / squared);
                wanted = std::clamp(wanted, -vehicle.maxSteeringAngle, vehicle.maxSteeringAngle);
                // The car stands at the begin of a stretch and may turn its wheels there.
                const double change = count == 0 ? 2.0 * PI : steeringSlope * STEP;
                const double before = vehicle.curvature(steering);
                steering = std::clamp(wanted, steering - change, steering + change);
                const double after = vehicle.curvature(steering);
                PathPiece piece =
                    count == 0 ? PathPiece(after, STEP) : PathPiece(before, STEP, (after - before) / STEP);
                Pose next = advance(car, piece);
                const double left = (guide.end() - Eigen::Vector2d(car.x, car.y)).dot(guide.endDirection());
                const double gain = left - (guide.end() - Eigen::Vector2d(next.x, next.y)).dot(guide.endDirection());
                const bool ends = along >= guide.length() - 2.0 * STEP && gain > 1e-6 && left <= gain;
                if (ends)
                {
                    piece.length = STEP * std::max(0.0, left) / gain;
                    next = advance(car, piece);
                }
                car = next;
                if (piece.length > 1e-6)
                    result.path.append({sign * piece.curvature, sign * piece.length, sign * piece.sharpness});
                if (ends)
                {
                    locate();
                    result.following = !result.path.pieces.empty();
                    return result;
                }
            }
            return result;
        }
    }  // namespace

    std::optional<Path> joinStretch(const Path &stretch, double from, const Pose &car, const Vehicle &vehicle)
    {
        // The joint keeps to one piece where that is long enough: two arcs cannot imitate more.
        const Path left = stretch.rest(from);
        if (left.pieces.empty() || left.pieces.front().driven() < LEAST_JOIN)
            return std::nullopt;
        const Path behind = left.rest(std::min(left.pieces.front().driven(), JOIN_LENGTH));
        std::optional<Path> path = biarc(car, behind.start, left.pieces.front().direction());
        if (!path)
            return std::nullopt;
        for (const PathPiece &piece : path->pieces)
            if (std::abs(piece.curvature) > 1.0 / vehicle.minTurningRadius())
                return std::nullopt;
        path->extend(behind);
        return path;
    }

    RoundedCorners roundCorners(const Path &stretch, const Pose &start, const Vehicle &vehicle, double steeringSlope)
    {
        const Guide guide(stretch);
        constexpr std::array<double, 6> DISTANCES{0.25, 0.375, 0.5, 0.75, 1.0, 2.0};
        RoundedCorners best;
        for (const double share : DISTANCES)
        {
            RoundedCorners candidate =
                pursue(stretch, guide, start, vehicle, steeringSlope, share * vehicle.minTurningRadius());
            if (candidate.following && (!best.following || candidate.deviation < best.deviation))
                best = std::move(candidate);
        }
        return best;
    }
}  // namespace parking

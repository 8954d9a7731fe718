#include "path_tracking/reference/MakeDrivable.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/curves/Biarc.h"
#include "parking_geometry/curves/ReedsShepp.h"
#include "parking_geometry/text/Require.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace parking
{
    namespace
    {
        constexpr double SHUNT_STEP = 0.1;       // metres between checks of a shunt's deviation
        constexpr double SHORTEST_PIECE = 1e-7;  // metres; less is rounding
        constexpr double MAX_CURVATURE = 1.01;  // maximum curvature of a path over the car's: rounding of turning radii
        constexpr double ROUNDING_TURN = 1e-9;  // radians; less is rounding of headings and not a corner
        constexpr double EXACT = 1e-5;          // metres from a place within which the car stands there
        constexpr double EXACT_YAW = 1e-6;      // radians, for the same purpose
        constexpr double BESIDE = 0.01;         // metres from a place that two gentle arcs correct
        constexpr double BESIDE_YAW = 0.03;     // radians, for the same purpose
        constexpr double END = 0.02;            // metres beside the end of the path above which the car shunts to it
        constexpr double END_YAW = 0.03;        // radians, for the same purpose

        constexpr double STEP = 0.05;               // metres that the simulated car drives at a time
        constexpr double BACK_ON_PATH = 0.005;      // metres beside the stretch within which the car is on it
        constexpr double BACK_IN_YAW = 0.005;       // radians, for the same purpose
        constexpr double BACK_IN_CURVATURE = 0.02;  // 1/m, for the same purpose
        constexpr double SEARCH_AHEAD = 2.0;        // metres of the stretch searched for the nearest place
        constexpr double JOIN_LENGTH = 1.0;         // metres over which a car returns to the path
        constexpr double MIN_JOIN = 0.3;            // metres; in less, even millimetres require much steering

        bool apart(const Pose &a, const Pose &b, double most, double maxYaw)
        {
            return positionDistance(a, b) > most || std::abs(wrapAngle(a.yaw - b.yaw)) > maxYaw;
        }

        bool isCorner(const PathPiece &piece)
        {
            return std::abs(piece.turn) > ROUNDING_TURN;
        }

        void check(const Path &path, const Vehicle &vehicle)
        {
            if (!isFinite(path.start))
                throw Error("path: its start must be finite numbers");
            const double most = MAX_CURVATURE / vehicle.minTurningRadius();
            for (std::size_t i = 0; i < path.pieces.size(); ++i)
            {
                const PathPiece &piece = path.pieces[i];
                const auto fail = [i](const std::string &what)
                {
                    throw Error("path piece " + std::to_string(i) + ": " + what);
                };
                for (const double value : {piece.curvature, piece.length, piece.sharpness, piece.turn})
                    if (!std::isfinite(value))
                        fail("curvature, length, sharpness and turn must be finite numbers");
                if (piece.turn != 0.0 && piece.length != 0.0)
                    fail("it both drives and turns on the spot");
                for (const double curvature : {piece.curvature, piece.endCurvature()})
                    if (std::abs(curvature) > most)
                        fail("curvature " + formatNumber(curvature) + " 1/m is beyond the car's " +
                             formatNumber(1.0 / vehicle.minTurningRadius()) + " 1/m");
            }
            // Shorter pieces are dropped, independent of their number.
            if (std::none_of(path.pieces.begin(), path.pieces.end(),
                             [](const PathPiece &piece) { return piece.driven() >= SHORTEST_PIECE; }))
                throw Error("path: it must have a length");
        }

        /** The same path with at most one turn at a place. */
        Path withTurnsMerged(const Path &path)
        {
            Path merged{path.start, {}};
            for (const PathPiece &piece : path.pieces)
                if (piece.turn != 0.0 && !merged.pieces.empty() && merged.pieces.back().turn != 0.0)
                    merged.pieces.back().turn += piece.turn;
                else if (piece.turn != 0.0 || piece.driven() >= SHORTEST_PIECE)
                    merged.append(piece);
            return merged;
        }

        /** The stretch as a polyline of places with distances from its start. */
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
                    // Curved pieces are resampled so that the polyline follows the stretch.
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

            /** Distance of the last corner from the start. */
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

            /** The place at \e distance; beyond the end it continues straight. */
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

            /** Distance from the start to the place nearest to \e point, at most SEARCH_AHEAD beyond \e from. */
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

        /** Result of roundCorners(). */
        struct RoundedCorners
        {
            Path path;               // drivable, in one direction
            double deviation{0.0};   // metres, maximum deviation of the rear axle from the stretch
            double worstPlace{0.0};  // metres along the stretch to the place of that deviation
            bool following{false};   // whether the car could follow at all
        };

        /** The path of a car near \e stretch onto it, and the rest of it: two arcs within a metre after \e from, then
            the pieces of the stretch. \return nothing if there is no such path within the steering limit, because the
            stretch is too short or full lock leaves no reserve for corrections */
        std::optional<Path> joinStretch(const Path &stretch, double from, const Pose &car, const Vehicle &vehicle)
        {
            // The joint stays within one piece if that is long enough: two arcs cannot follow more.
            const Path left = stretch.rest(from);
            if (left.pieces.empty() || left.pieces.front().driven() < MIN_JOIN)
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

        /** The path onto the stretch after \e driven metres, if the car is almost exactly on it. */
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

        /** One simulated drive with a target \e ahead metres in front. Headings are directions of travel here: in
            reverse, the heading is turned by half a turn and the curvature negated. */
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
                // A target behind the car requires full lock, not a gentle curve round it.
                double wanted = aim.x <= 0.0 ? std::copysign(vehicle.maxSteeringAngle, aim.y)
                                             : vehicle.steeringAngle(2.0 * aim.y / squared);
                wanted = std::clamp(wanted, -vehicle.maxSteeringAngle, vehicle.maxSteeringAngle);
                // The car stands at the start of a stretch and may steer there.
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
        /** Cuts the corners of \e stretch: pieces of one direction with turns on the spot between them, but not at its
            ends.

            A simulated car drives it from \e start and aims at a point ahead (pure pursuit; R. C. Coulter,
            "Implementation of the pure pursuit path tracking algorithm", CMU-RI-TR-92-01). It respects the steering
            limit and \e steeringSlope radians of steering per metre. Among several distances to the point ahead, the
            one with the smallest deviation is used.

            After the last corner the car returns to the stretch. Within 5 mm and 0.3 degrees, two gentle arcs lead onto
            it exactly, and the rest is driven unchanged. If there is not enough length for that, the path ends beside
            the end of the stretch. */
        RoundedCorners roundCorners(const Path &stretch, const Pose &start, const Vehicle &vehicle,
                                    double steeringSlope)
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

        class Builder
        {
        public:
            Builder(const Vehicle &vehicle, const ReferenceParameters &parameters, const Pose &start)
              : vehicle_(vehicle),
                parameters_(parameters),
                curves_(vehicle.minTurningRadius()),
                car_(start)
            {
                result_.path.start = start;
            }

            /** Adds a stretch that starts with its first piece, for any heading of the car. */
            void add(const Path &stretch)
            {
                if (corners(stretch) > 0)
                {
                    follow(stretch);
                    return;
                }
                if (!apart(car_, stretch.start, EXACT, EXACT_YAW))
                {
                    append(stretch);
                    return;
                }
                if (!apart(car_, stretch.start, BESIDE, BESIDE_YAW))
                    if (const auto joined = joinStretch(stretch, 0.0, car_, vehicle_))
                    {
                        append(*joined);
                        return;
                    }
                shuntTo(stretch.start);
                append(stretch);
            }

            DrivablePath finish(const Pose &goal)
            {
                const double most = parameters_.maxCornerRadii * vehicle_.minTurningRadius();
                if (apart(car_, goal, END, END_YAW))
                    shuntTo(goal);
                if (!(result_.deviation <= most))
                    throw Error("path: the car would leave it by " +
                                formatNumber(std::round(100.0 * result_.deviation) / 100.0) +
                                " m at its corners; at most " + formatNumber(most) + " m are allowed");
                return std::move(result_);
            }

        private:
            static std::size_t corners(const Path &stretch)
            {
                return static_cast<std::size_t>(std::count_if(stretch.pieces.begin(), stretch.pieces.end(), isCorner));
            }

            void append(const Path &path)
            {
                for (const PathPiece &piece : path.pieces)
                {
                    if (piece.turn != 0.0)
                        continue;
                    result_.path.append(piece);
                    car_ = advance(car_, piece);
                }
            }

            /** Cuts the corners of \e stretch, or turns at the worst corner and handles both sides of it separately. */
            void follow(const Path &stretch)
            {
                const RoundedCorners rounded =
                    roundCorners(stretch, car_, vehicle_, vehicle_.maxSteeringRate / parameters_.cornerSpeed);
                if (rounded.following && rounded.deviation <= parameters_.maxCornerCut)
                {
                    result_.deviation = std::max(result_.deviation, rounded.deviation);
                    append(rounded.path);
                    return;
                }
                const std::size_t corner = worstCorner(stretch, rounded.worstPlace);
                Path before{stretch.start, {}}, rest{stretch.start, {}};
                for (std::size_t i = 0; i < stretch.pieces.size(); ++i)
                {
                    if (i <= corner && isCorner(stretch.pieces[corner]))
                        rest.start = advance(rest.start, stretch.pieces[i]);
                    else
                        rest.append(stretch.pieces[i]);
                    if (i < corner)
                        before.append(stretch.pieces[i]);
                }
                if (corners(before) == 0 && !apart(car_, before.start, EXACT, EXACT_YAW))
                    append(before);
                else if (!before.pieces.empty())
                    follow(before);
                shuntTo(rest.start);
                add(rest);
            }

            /** The corner nearest to \e place metres from the start. 0, which is no corner, stands for the start itself
                if the car is not there. */
            std::size_t worstCorner(const Path &stretch, double place) const
            {
                std::size_t best = 0;
                double least = std::numeric_limits<double>::infinity();
                if (apart(car_, stretch.start, BESIDE, BESIDE_YAW))
                    least = place;
                double along = 0.0;
                for (std::size_t i = 0; i < stretch.pieces.size(); ++i)
                {
                    along += stretch.pieces[i].driven();
                    if (!isCorner(stretch.pieces[i]) || std::abs(along - place) >= least)
                        continue;
                    least = std::abs(along - place);
                    best = i;
                }
                return best;
            }

            /** Drives to \e pose by the shortest Reeds-Shepp curve. */
            void shuntTo(const Pose &pose)
            {
                const ReedsSheppCurve curve = curves_.shortest(car_, pose);
                Path path{car_, {}};
                for (std::size_t i = 0; i < curve.count; ++i)
                    if (std::abs(curve.pieces[i].length) > SHORTEST_PIECE)
                        path.append(curve.pieces[i]);
                for (const PathState &state : path.sample(SHUNT_STEP))
                    result_.deviation = std::max(result_.deviation, std::min(positionDistance(state.pose, car_),
                                                                             positionDistance(state.pose, pose)));
                ++result_.shunts;
                append(path);
            }

            const Vehicle &vehicle_;
            const ReferenceParameters &parameters_;
            ReedsShepp curves_;
            Pose car_;
            DrivablePath result_;
        };
    }  // namespace

    void ReferenceParameters::validate() const
    {
        const Require require("reference");
        require.positive("bodyTolerance", bodyTolerance, "metres");
        require.positive("minBlendSpeed", minBlendSpeed, "m/s");
        require.positive("maxBlendLength", maxBlendLength, "metres");
        require.positive("maxCornerCut", maxCornerCut, "metres");
        require.positive("maxCornerRadii", maxCornerRadii, "turning radii");
        require.positive("cornerSpeed", cornerSpeed, "m/s");
    }

    DrivablePath makeDrivable(const Path &path, const Vehicle &vehicle, const ReferenceParameters &parameters)
    {
        check(path, vehicle);
        if (std::none_of(path.pieces.begin(), path.pieces.end(), isCorner))
        {
            DrivablePath same{{path.start, {}}};
            for (const PathPiece &piece : path.pieces)
                if (piece.driven() >= SHORTEST_PIECE)
                    same.path.append(piece);
            return same;
        }
        const Path merged = withTurnsMerged(path);
        Builder builder(vehicle, parameters, path.start);
        Pose pose = path.start;
        for (const Stretch &stretch : merged.stretches())
        {
            // Turns before the stretch define its heading; those after the last stretch define that of the goal.
            Path part;
            bool driving = false;
            for (std::size_t i = stretch.first; i < stretch.last; ++i)
            {
                driving = driving || merged.pieces[i].length != 0.0;
                if (!driving)
                    pose = advance(pose, merged.pieces[i]);
                else
                    part.pieces.push_back(merged.pieces[i]);
            }
            part.start = pose;
            for (const PathPiece &piece : part.pieces)
                pose = advance(pose, piece);
            while (part.pieces.back().turn != 0.0)
                part.pieces.pop_back();
            builder.add(part);
        }
        DrivablePath drivable = builder.finish(pose);
        drivable.corners = static_cast<std::size_t>(std::count_if(path.pieces.begin(), path.pieces.end(), isCorner));
        return drivable;
    }
}  // namespace parking

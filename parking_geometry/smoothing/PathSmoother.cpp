#include "parking_geometry/smoothing/PathSmoother.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/curves/Kinematics.h"
#include "parking_geometry/smoothing/CurvatureProgram.h"
#include "parking_geometry/text/Require.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

namespace parking
{
    namespace
    {
        /** \brief A unit of smoothing: neighbouring arcs of one stretch, and whether the car stands at their ends. */
        struct StretchPart
        {
            Path arcs;                ///< arcs in one direction whose neighbours differ in curvature
            bool movingStart{false};  ///< whether it begins in motion, cut out within an arc
            bool movingEnd{false};    ///< whether it ends in motion, cut out within an arc

            /** \brief 1 forwards, -1 in reverse. */
            int direction() const
            {
                return arcs.pieces.front().direction();
            }

            /** \brief The arcs from \e first up to but excluding \e last. The car stands at new ends. */
            StretchPart part(std::size_t first, std::size_t last) const
            {
                return {arcs.part(first, last), movingStart && first == 0, movingEnd && last == arcs.pieces.size()};
            }

            /** \brief Parts that can be smoothed independently. Cuts lie in the middle of inner arcs of at least \e
                shortest metres with a curvature below \e maxCurvature. */
            std::vector<StretchPart> cutAtLongArcs(double shortest, double maxCurvature) const
            {
                std::vector<StretchPart> parts{{{arcs.start, {}}, movingStart, movingEnd}};
                Pose pose = arcs.start;
                for (std::size_t i = 0; i < arcs.pieces.size(); ++i)
                {
                    PathPiece arc = arcs.pieces[i];
                    const bool between = i > 0 && i + 1 < arcs.pieces.size();
                    if (between && arc.driven() >= shortest && std::abs(arc.curvature) < maxCurvature)
                    {
                        arc.length *= 0.5;
                        pose = advance(pose, arc);
                        parts.back().arcs.pieces.push_back(arc);
                        parts.back().movingEnd = true;
                        parts.push_back({{pose, {}}, true, movingEnd});
                    }
                    parts.back().arcs.pieces.push_back(arc);
                    pose = advance(pose, arc);
                }
                return parts;
            }
        };

        // Share of the limits that the program reserves for the correction at the end.
        constexpr double CURVATURE_MARGIN = 1e-3;
        constexpr double RATE_MARGIN = 5e-3;

        /** Largest error at the end that the correction reduces to CLOSED. Larger ones require another solution of the
            program. */
        constexpr double CORRECTABLE = 1e-3;
        constexpr double CLOSED = 1e-11;
        constexpr int MAX_PROGRAMS = 4;
        constexpr int MAX_CORRECTIONS = 6;

        // Distances between nodes in metres: near a joint a share of the transition's length, increasing away from it.
        constexpr double TRANSITION_SHARE = 1.0 / 10.0;
        constexpr double MIN_SPACING = 0.02;
        constexpr double MAX_SPACING_AT_JOINT = 0.12;
        constexpr double MAX_SPACING = 0.3;
        constexpr double GROWTH = 0.25;

        /** Share of the clearance that deviations may use, and half width in metres of the narrowest corridor to
            attempt. */
        constexpr double CLEARANCE_SHARE = 0.95;
        constexpr double MIN_CORRIDOR = 1e-3;

        /** Lateral distances in metres of additional queries, for poses with a clearance below the first. Next to a
            wall the other side may be free. */
        constexpr double SIDE_STEPS[] = {0.25, 0.08, 0.025};

        /** Largest deviation from the arcs in metres. */
        constexpr double MAX_DEVIATION = 0.6;

        /** Displacement along a piece of linear curvature in the frame of its start. Three Gauss points and short
            series are exact to 1e-13 of the length for turns up to 0.15 rad. */
        inline Pose displacement(double k0, double k1, double length)
        {
            constexpr double T[] = {0.112701665379258311, 0.5, 0.887298334620741689};
            constexpr double W[] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
            const double turn = 0.5 * (k0 + k1) * length;
            if (std::max(std::abs(k0), std::abs(k1)) * length > 0.15)
                return advance({}, PathPiece(k0, length, (k1 - k0) / length), length);
            double x = 0.0, y = 0.0;
            for (int i = 0; i < 3; ++i)
            {
                const double a = length * T[i] * (k0 + 0.5 * (k1 - k0) * T[i]), s = a * a;
                x += W[i] * (1.0 - s * (1.0 / 2.0 - s * (1.0 / 24.0 - s / 720.0)));
                y += W[i] * a * (1.0 - s * (1.0 / 6.0 - s * (1.0 / 120.0 - s / 5040.0)));
            }
            return {x * length, y * length, turn};
        }

        /** \brief Finds, for a part of a stretch of arcs, a path of continuous curvature with the same end poses.

            The part is divided into nodes, which are denser near its joints. CurvatureProgram computes the curvatures
            at the nodes, with linear curvature between them. The path is integrated exactly, each piece up to the
            normal of the reference at the next node. This leaves only a lateral and an angular error at the end. A
            second program and then a small correction within the bounds remove them.

            A reverse stretch is treated as a forward one of a car turned round. Objects reuse their memory and must not
            be shared between threads. */
        class StretchSmoother
        {
        public:
            /** \brief A smoother for \e vehicle, which must be valid. */
            explicit StretchSmoother(const Vehicle &vehicle);

            /** \brief Returns the clearance in metres at a pose of the car, see FootprintQueries. */
            using Clearance = std::function<double(const Pose &)>;

            /** \brief Limits of a transition. */
            struct Limits
            {
                double sharpness{0.2};      ///< largest change of curvature per metre, 1/m^2
                double softSharpness{0.2};  ///< preferred change of curvature per metre, 1/m^2
                double tolerance{0.05};     ///< deviation that costs as much as steering at softSharpness, metres
            };

            /** \brief Smooths \e part within \e limits.

                \param clearance if set, the body stays within the clearance of the poses of the arcs and of poses
                beside them
                \param result the pieces, from where the arcs begin to where they end within 1e-9 m
                \return whether the function finds such a path */
            bool smooth(const StretchPart &part, const Limits &limits, const Clearance &clearance,
                        std::vector<PathPiece> &result);

        private:
            struct Node
            {
                Pose pose;  ///< pose of the reference, in the direction of travel
                double cosine, sine;
            };

            void placeNodes(const StretchPart &part, double sharpness);
            void placeCorridors(bool reverse, const Clearance &clearance);
            bool simulate();
            bool close(double sharpness);
            bool keepsLimits(double sharpness) const;

            Vehicle vehicle_;
            double maxCurvature_;
            CurvatureProgram program_;
            CurvatureProgram::Settings settings_;
            std::vector<CurvatureProgram::Interval> intervals_;
            std::vector<Node> nodes_;
            std::vector<CurvatureProgram::Corridor> corridors_;
            std::vector<double> curvatures_, lengths_, slacks_;
            std::vector<CurvatureProgram::State> states_;
            std::vector<Eigen::Vector2d> sensitivity_;
        };

        StretchSmoother::StretchSmoother(const Vehicle &vehicle)
          : vehicle_(vehicle),
            maxCurvature_(1.0 / vehicle.minTurningRadius())
        {
            settings_.maxCurvature = maxCurvature_ * (1.0 - CURVATURE_MARGIN);
            settings_.lever = 0.5 * vehicle.length();
        }

        void StretchSmoother::placeNodes(const StretchPart &part, double sharpness)
        {
            intervals_.clear();
            const std::vector<PathPiece> &arcs = part.arcs.pieces;
            const double direction = part.direction();
            const auto joint = [&](std::size_t i)
            {
                return std::abs(arcs[i].curvature - arcs[i - 1].curvature);
            };
            // Appends the lengths of the intervals from one end of an arc to its middle to intervals_.
            const auto half = [&](double length, double jump, bool towardsJoint, double curvature)
            {
                const double transition = jump / sharpness;
                const double spacing =
                    jump == 0.0 ? MAX_SPACING
                                : std::clamp(transition * TRANSITION_SHARE, MIN_SPACING, MAX_SPACING_AT_JOINT);
                const std::size_t first = intervals_.size();
                double sum = 0.0;
                while (sum < length * (1.0 - 1e-9))
                {
                    const double h = std::min(MAX_SPACING, spacing + GROWTH * std::max(0.0, sum - transition));
                    intervals_.push_back({h, curvature, sharpness * (1.0 - RATE_MARGIN)});
                    sum += h;
                }
                for (std::size_t i = first; i < intervals_.size(); ++i)
                    intervals_[i].length *= length / sum;
                if (towardsJoint)
                    std::reverse(intervals_.begin() + static_cast<std::ptrdiff_t>(first), intervals_.end());
            };
            for (std::size_t i = 0; i < arcs.size(); ++i)
            {
                const double length = 0.5 * arcs[i].driven(), curvature = direction * arcs[i].curvature;
                half(length, i > 0 ? joint(i) : 0.0, false, curvature);
                half(length, i + 1 < arcs.size() ? joint(i + 1) : 0.0, true, curvature);
            }
            nodes_.resize(intervals_.size() + 1);
            const double turnedRound = direction < 0.0 ? PI : 0.0;
            Pose pose = part.arcs.start;
            pose.yaw += turnedRound;
            for (std::size_t i = 0; i < nodes_.size(); ++i)
            {
                nodes_[i] = {pose, std::cos(pose.yaw), std::sin(pose.yaw)};
                if (i < intervals_.size())
                    pose = advance(pose, intervals_[i].curvature, intervals_[i].length);
            }
            // The required end with the number of turns of the integration.
            Node &last = nodes_.back();
            const Pose end = part.arcs.end();
            last.pose = {end.x, end.y, last.pose.yaw + wrapAngle(end.yaw + turnedRound - last.pose.yaw)};
            last.cosine = std::cos(last.pose.yaw);
            last.sine = std::sin(last.pose.yaw);
        }

        void StretchSmoother::placeCorridors(bool reverse, const Clearance &clearance)
        {
            corridors_.clear();
            if (!clearance)
                return;
            for (const Node &node : nodes_)
            {
                const auto clearanceAt = [&](double left)
                {
                    return clearance({node.pose.x - left * node.sine, node.pose.y + left * node.cosine,
                                      reverse ? node.pose.yaw - PI : node.pose.yaw});
                };
                const double here = clearanceAt(0.0);
                // The free intervals about the pose and about one beside it form one interval if they overlap.
                const auto reach = [&](double side)
                {
                    if (here >= SIDE_STEPS[0])
                        return here;
                    for (const double step : SIDE_STEPS)
                        if (const double there = clearanceAt(side * step); there + here > step)
                            return step + there;
                    return here;
                };
                corridors_.push_back({-std::max(MIN_CORRIDOR, CLEARANCE_SHARE * reach(-1.0)),
                                      std::max(MIN_CORRIDOR, CLEARANCE_SHARE * reach(1.0))});
            }
        }

        bool StretchSmoother::simulate()
        {
            const std::size_t n = intervals_.size();
            lengths_.resize(n);
            states_.resize(n + 1);
            Pose pose = nodes_.front().pose;
            double c = nodes_.front().cosine, s = nodes_.front().sine;
            states_[0] << 0.0, 0.0, curvatures_[0];
            for (std::size_t i = 0; i < n; ++i)
            {
                const Node &target = nodes_[i + 1];
                const double k0 = curvatures_[i], k1 = curvatures_[i + 1];
                double length = intervals_[i].length * (1.0 - intervals_[i].curvature * states_[i][0]);
                double x = 0.0, y = 0.0;
                const double across = std::cos(states_[i][1]);
                for (int iteration = 0; iteration < 6; ++iteration)
                {
                    const Pose moved = displacement(k0, k1, length);
                    x = pose.x + c * moved.x - s * moved.y;
                    y = pose.y + s * moved.x + c * moved.y;
                    const double ahead = (x - target.pose.x) * target.cosine + (y - target.pose.y) * target.sine;
                    if (std::abs(ahead) < 1e-13)
                        break;
                    length -= ahead / across;
                    if (!(length > 0.0) || !(across > 0.1))
                        return false;
                }
                pose = {x, y, pose.yaw + 0.5 * (k0 + k1) * length};
                c = std::cos(pose.yaw);
                s = std::sin(pose.yaw);
                lengths_[i] = length;
                const double lateral = (y - target.pose.y) * target.cosine - (x - target.pose.x) * target.sine;
                states_[i + 1] << lateral, pose.yaw - target.pose.yaw, k1;
                if (!(std::abs(lateral) < MAX_DEVIATION))
                    return false;
            }
            return true;
        }

        bool StretchSmoother::close(double sharpness)
        {
            program_.endSensitivity(sensitivity_);
            const std::size_t n = intervals_.size();
            slacks_.resize(n + 1);
            for (int iteration = 0; iteration < MAX_CORRECTIONS; ++iteration)
            {
                const Eigen::Vector2d error = states_.back().head<2>();
                if (error.cwiseAbs().maxCoeff() < CLOSED)
                    return true;
                const auto rateSlack = [&](std::size_t i)
                {
                    const double change = std::abs(curvatures_[i + 1] - curvatures_[i]);
                    return 0.5 * std::max(0.0, sharpness * lengths_[i] - change);
                };
                Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
                for (std::size_t i = 0; i <= n; ++i)
                {
                    const bool given = (i == 0 && settings_.startCurvature) || (i == n && settings_.endCurvature);
                    double slack = given ? 0.0 : std::max(0.0, maxCurvature_ - std::abs(curvatures_[i]));
                    if (i > 0)
                        slack = std::min(slack, rateSlack(i - 1));
                    if (i < n)
                        slack = std::min(slack, rateSlack(i));
                    slacks_[i] = slack;
                    normal += slack * sensitivity_[i] * sensitivity_[i].transpose();
                }
                const Eigen::Vector2d multiplier = normal.inverse() * error;
                for (std::size_t i = 0; i <= n; ++i)
                {
                    const double share = sensitivity_[i].dot(multiplier);
                    if (!(std::abs(share) <= 0.9))
                        return false;
                    curvatures_[i] -= slacks_[i] * share;
                }
                if (!simulate())
                    return false;
            }
            return false;
        }

        bool StretchSmoother::keepsLimits(double sharpness) const
        {
            constexpr double ROUNDING = 1.0 + 1e-9;
            for (const double curvature : curvatures_)
                if (!(std::abs(curvature) <= maxCurvature_ * ROUNDING))
                    return false;
            for (std::size_t i = 0; i < lengths_.size(); ++i)
                if (!(std::abs(curvatures_[i + 1] - curvatures_[i]) <= sharpness * lengths_[i] * ROUNDING))
                    return false;
            return true;
        }

        bool StretchSmoother::smooth(const StretchPart &part, const Limits &limits, const Clearance &clearance,
                                     std::vector<PathPiece> &result)
        {
            result.clear();
            if (part.arcs.pieces.empty())
                return true;
            const double direction = part.direction();
            const bool reverse = direction < 0.0;
            const double sharpness = limits.sharpness;
            settings_.tolerance = limits.tolerance;
            settings_.softRate = limits.softSharpness;
            settings_.front = reverse ? vehicle_.rearOverhang : vehicle_.wheelbase + vehicle_.frontOverhang;
            settings_.rear = reverse ? vehicle_.wheelbase + vehicle_.frontOverhang : vehicle_.rearOverhang;
            settings_.startCurvature = settings_.endCurvature = std::nullopt;
            if (part.movingStart)
                settings_.startCurvature = direction * part.arcs.pieces.front().curvature;
            if (part.movingEnd)
                settings_.endCurvature = direction * part.arcs.pieces.back().curvature;
            placeNodes(part, sharpness);
            placeCorridors(reverse, clearance);
            program_.reset(settings_, intervals_, corridors_);
            bool found = false;
            for (int round = 0; round < MAX_PROGRAMS && !found; ++round)
            {
                if (round > 0)
                    program_.relinearise(states_, lengths_);
                if (!program_.solve())
                    return false;
                curvatures_.clear();
                for (const CurvatureProgram::State &state : program_.states())
                    curvatures_.push_back(state[2]);
                curvatures_.back() = settings_.endCurvature.value_or(curvatures_.back());
                if (!simulate())
                    return false;
                found = states_.back().head<2>().cwiseAbs().maxCoeff() < CORRECTABLE && close(sharpness) &&
                        keepsLimits(sharpness);
            }
            if (!found)
                return false;
            for (std::size_t i = 0; i < lengths_.size(); ++i)
                result.emplace_back(direction * curvatures_[i], direction * lengths_[i],
                                    (curvatures_[i + 1] - curvatures_[i]) * direction / lengths_[i]);
            return true;
        }

        /** Largest change of the length of a stretch by smoothing, as a share of it. */
        constexpr double MAX_LENGTH_CHANGE = 0.03;

        /** Tolerance in metres for a curve that follows the arcs as closely as its limits allow. */
        constexpr double NEAR = 0.005;

        /** Length from which the middle of an arc is followed exactly, in transitions from lock to lock at the planned
            speed. */
        constexpr double LONG_ARC_IN_TRANSITIONS = 2.0;

        /** Only arcs with a curvature below this share of the limit are followed exactly. */
        constexpr double BEND_OF_CUT = 0.99;

        /** Highest speed at which the steering follows all of \e piece. */
        double steeringLimit(const Vehicle &vehicle, const PathPiece &piece)
        {
            const double from = piece.curvature, to = piece.endCurvature();
            const double curvature = from * to <= 0.0 ? 0.0 : std::min(std::abs(from), std::abs(to));
            return maxSpeedForSharpness(vehicle, piece.sharpness, curvature);
        }

        /** A part of a stretch between two stops. */
        struct SmoothPart
        {
            Path path;
            bool free{true};
            bool movingEnd{false};
        };

        /** Smooths parts of one path. */
        class PartSmoother
        {
        public:
            PartSmoother(const Vehicle &vehicle, const SmoothingOptions &options, const FootprintQueries &world)
              : vehicle_(vehicle),
                options_(options),
                world_(world),
                smoother_(vehicle)
            {
                planned_ = std::min(options.speed, vehicle.maxSpeed);
            }

            double plannedSpeed() const
            {
                return planned_;
            }

            /** Keeps one arc unchanged. */
            SmoothPart keep(const StretchPart &part) const
            {
                return {part.arcs, isPathFree(world_, vehicle_, part.arcs), part.movingEnd};
            }

            /** Smooths \e whole in few parts, divided by stops. */
            std::vector<SmoothPart> smooth(const StretchPart &whole)
            {
                std::vector<SmoothPart> parts;
                SmoothPart found, attempt;
                for (std::size_t first = 0, arcs = whole.arcs.pieces.size(); first < arcs;)
                {
                    // Finds the largest number of the next arcs that can be joined, by bisection. A single arc is
                    // always possible.
                    std::size_t last = arcs;
                    if (!smoothAsOne(whole.part(first, last), found))
                    {
                        std::size_t fails = last;
                        last = first + 1;
                        found = keep(whole.part(first, last));
                        while (fails - last > 1)
                        {
                            const std::size_t middle = last + (fails - last) / 2;
                            if (smoothAsOne(whole.part(first, middle), attempt))
                            {
                                last = middle;
                                std::swap(found, attempt);
                            }
                            else
                                fails = middle;
                        }
                    }
                    parts.push_back(std::move(found));
                    first = last;
                }
                return parts;
            }

        private:
            bool smoothAsOne(const StretchPart &part, SmoothPart &result)
            {
                if (part.arcs.pieces.size() < 2)
                {
                    result = keep(part);
                    return true;
                }
                // The planned speed first, confined to the clearance only if the free curve collides.
                if (smoothAt(planned_, {false, false}, part, result) &&
                    (isFree(result) ||
                     (world_.clearance && smoothAt(planned_, {false, true}, part, result) && isFree(result))))
                    return true;
                return slowest() < planned_ && smoothSlower(part, result);
            }

            double slowest() const
            {
                return std::min(planned_, options_.minSpeed);
            }

            /** Variant of the search for a curve at a speed. */
            struct Approach
            {
                bool near;      ///< whether it minimises deviation instead of steering
                bool confined;  ///< whether the body stays within the clearance
            };

            /** Smooths below the planned speed. The lowest speed, which allows the smallest deviations, determines the
                variant to attempt at higher speeds. */
            bool smoothSlower(const StretchPart &part, SmoothPart &result)
            {
                for (const Approach approach : {Approach{false, false}, {false, true}, {true, true}, {true, false}})
                {
                    if (approach.confined && !world_.clearance)
                        continue;
                    if (!smoothAt(slowest(), approach, part, result))
                    {
                        if (approach.confined)
                            continue;
                        return false;
                    }
                    if (!isFree(result))
                        continue;
                    // A soft curve steers fast only where necessary. The speed that it actually allows is the next to
                    // attempt.
                    const double allowed = std::min(planned_, steeringSpeed(result.path));
                    SmoothPart faster;
                    for (double speed = 0.5 * planned_; speed > allowed; speed *= 0.5)
                        if ((approach.near || speed < 1.5 * allowed) && smoothAt(speed, approach, part, faster) &&
                            isFree(faster))
                        {
                            result = std::move(faster);
                            break;
                        }
                    return true;
                }
                return false;
            }

            double steeringSpeed(const Path &path) const
            {
                double speed = vehicle_.maxSpeed;
                for (const PathPiece &piece : path.pieces)
                    speed = std::min(speed, steeringLimit(vehicle_, piece));
                return speed;
            }

            bool smoothAt(double speed, const Approach &approach, const StretchPart &part, SmoothPart &result)
            {
                const StretchSmoother::Limits limits{maxSharpness(vehicle_, speed),
                                                     maxSharpness(vehicle_, approach.near ? speed : planned_),
                                                     approach.near ? NEAR : options_.tolerance};
                result.path.start = part.arcs.start;
                result.free = true;
                result.movingEnd = part.movingEnd;
                const double length = part.arcs.length();
                return smoother_.smooth(part, limits, approach.confined ? world_.clearance : nullptr,
                                        result.path.pieces) &&
                       std::abs(result.path.length() - length) <= MAX_LENGTH_CHANGE * length;
            }

            bool isFree(const SmoothPart &part) const
            {
                return isPathFree(world_, vehicle_, part.path);
            }

            const Vehicle &vehicle_;
            const SmoothingOptions &options_;
            const FootprintQueries &world_;
            StretchSmoother smoother_;
            double planned_{1.0};
        };

        /** Appends the parts of a stretch. */
        void append(SmoothPath &result, const std::vector<SmoothPart> &parts)
        {
            const std::size_t first = result.path.pieces.size();
            bool standing = true;
            for (const SmoothPart &part : parts)
            {
                if (standing && first < result.path.pieces.size())
                    result.stops.push_back(result.path.pieces.size());
                // A new piece begins after a stop. Otherwise the halves of a cut arc are merged.
                if (standing)
                    result.path.pieces.push_back(part.path.pieces.front());
                result.path.extend(part.path.part(standing ? 1 : 0, part.path.pieces.size()));
                result.free = result.free && part.free;
                standing = !part.movingEnd;
            }
        }

        /** The arcs of a stretch, equal neighbours merged. */
        StretchPart arcsOf(const Path &path, const Stretch &stretch)
        {
            const Path part = path.part(stretch.first, stretch.last);
            StretchPart result{{part.start, {}}, false, false};
            result.arcs.extend(part);
            return result;
        }
    }  // namespace

    PathSmoother::PathSmoother(const Vehicle &vehicle, const SmoothingOptions &options)
      : vehicle_(vehicle),
        options_(options)
    {
        vehicle.validate();
        const Require require("smoothing");
        require.positive("speed", options.speed, "m/s");
        require.positive("min speed", options.minSpeed, "m/s");
        require.positive("tolerance", options.tolerance, "metres");
    }

    SmoothPath PathSmoother::smooth(const Path &path, const FootprintQueries &world) const
    {
        for (const PathPiece &piece : path.pieces)
            if (piece.turn != 0.0 || piece.sharpness != 0.0)
                throw Error("smoothing: piece " + std::to_string(&piece - path.pieces.data()) +
                            (piece.turn != 0.0 ? " turns on the spot" : " is a clothoid") +
                            "; only arcs and lines can be smoothed");
        SmoothPath result;
        result.path.start = path.start;
        PartSmoother smoother(vehicle_, options_, world);
        const double maxCurvature = 1.0 / vehicle_.minTurningRadius();
        const double transition = 2.0 * maxCurvature / maxSharpness(vehicle_, smoother.plannedSpeed());
        for (const Stretch &stretch : path.stretches())
        {
            std::vector<SmoothPart> parts;
            for (const StretchPart &part :
                 arcsOf(path, stretch).cutAtLongArcs(LONG_ARC_IN_TRANSITIONS * transition, BEND_OF_CUT * maxCurvature))
                for (SmoothPart &each : smoother.smooth(part))
                    parts.push_back(std::move(each));
            append(result, parts);
        }
        return result;
    }
}  // namespace parking

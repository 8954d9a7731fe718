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
        /** \brief What is smoothed at a time: neighbouring arcs of one stretch, and whether the car stands at their
            ends. */
        struct StretchPart
        {
            Path arcs;                ///< all in one direction; neighbours differ in curvature
            bool movingStart{false};  ///< begins in motion, on its first arc, because it was cut out of a longer one
            bool movingEnd{false};    ///< ends in motion, on its last arc

            /** \brief 1 forwards, -1 in reverse. */
            int direction() const
            {
                return arcs.pieces.front().direction();
            }

            /** \brief The arcs \e first to before \e last. Where they are not all, the car stands there. */
            StretchPart part(std::size_t first, std::size_t last) const
            {
                return {arcs.part(first, last), movingStart && first == 0, movingEnd && last == arcs.pieces.size()};
            }

            /** \brief The parts that can be smoothed on their own: cut in the middle of all arcs of at least \e
               shortest metres that lie between two others and bend less than \e maxCurvature. */
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

        // The program works a little inside of the limits; what remains is for the correction at the end.
        constexpr double CURVATURE_MARGIN = 1e-3;
        constexpr double RATE_MARGIN = 5e-3;

        /** Error at the end that the correction brings down to CLOSED; larger ones go through the program again. */
        constexpr double CORRECTABLE = 1e-3;
        constexpr double CLOSED = 1e-11;
        constexpr int MAX_PROGRAMS = 4;
        constexpr int MAX_CORRECTIONS = 6;

        // Distances between nodes, metres: a share of the length of the transition near a joint, growing away from it.
        constexpr double TRANSITION_SHARE = 1.0 / 10.0;
        constexpr double FINEST = 0.02;
        constexpr double COARSEST_AT_JOINT = 0.12;
        constexpr double COARSEST = 0.3;
        constexpr double GROWTH = 0.25;

        /** The part of the clearance that deviations may use up, and the least corridor worth trying, metres. */
        constexpr double CLEARANCE_SHARE = 0.95;
        constexpr double NARROWEST_CORRIDOR = 1e-3;

        /** Poses are looked at this far to either side, metres, where they themselves have less clearance than the
            first: next to a wall there may be much room on the other side. */
        constexpr double SIDE_STEPS[] = {0.25, 0.08, 0.025};

        /** Deviations beyond this are not a smoothed version of the path any more, metres. */
        constexpr double LARGEST_DEVIATION = 0.6;

        /** Displacement of a piece of linear curvature in the frame of its start. Three Gauss points and short series
            are exact to 1e-13 of the length for turns of up to 0.15 rad. */
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

            The part is cut into nodes, closer together near its joints. CurvatureProgram proposes the curvatures at the
            nodes, linear between them; the path they give is integrated exactly, each piece up to the normal of the
            reference at the next node, which leaves only a lateral and an angular error at the end. Those are removed
           by a second program and then by a small correction within what the bounds leave. A reverse stretch is handled
           as a forward one of a car turned round. Objects keep their memory between calls and are not for several
           threads. */
        class StretchSmoother
        {
        public:
            /** \brief For this car, whose parameters have to be valid. */
            explicit StretchSmoother(const Vehicle &vehicle);

            /** \brief Clearance in metres at a pose of the car, see FootprintQueries. */
            using Clearance = std::function<double(const Pose &)>;

            /** \brief What a transition may be like. */
            struct Limits
            {
                double sharpness{0.2};      ///< 1/m^2, change of curvature per metre that must not be exceeded
                double softSharpness{0.2};  ///< 1/m^2, change that is preferred
                double tolerance{0.05};     ///< metres, deviation that is worth steering at softSharpness
            };

            /** \brief Smooths \e part within \e limits.

                \param clearance when set, the body stays where the clearance of the poses of the arcs, and of the same
                poses moved to either side, promises that it is free
                \param result the pieces, from where the arcs begin to where they end within 1e-9 m
                \return whether there is such a path */
            bool smooth(const StretchPart &part, const Limits &limits, const Clearance &clearance,
                        std::vector<PathPiece> &result);

        private:
            struct Node
            {
                Pose pose;  ///< of the reference, in the direction of travel
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
            // Lengths of the intervals from one end of half an arc to its middle, appended to intervals_.
            const auto half = [&](double length, double jump, bool towardsJoint, double curvature)
            {
                const double transition = jump / sharpness;
                const double least =
                    jump == 0.0 ? COARSEST : std::clamp(transition * TRANSITION_SHARE, FINEST, COARSEST_AT_JOINT);
                const std::size_t first = intervals_.size();
                double sum = 0.0;
                while (sum < length * (1.0 - 1e-9))
                {
                    const double h = std::min(COARSEST, least + GROWTH * std::max(0.0, sum - transition));
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
            // The required end, in the turn count of the integration.
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
                // The free intervals round the pose and round one beside it are one when they overlap.
                const auto reach = [&](double side)
                {
                    if (here >= SIDE_STEPS[0])
                        return here;
                    for (const double step : SIDE_STEPS)
                        if (const double there = clearanceAt(side * step); there + here > step)
                            return step + there;
                    return here;
                };
                corridors_.push_back({-std::max(NARROWEST_CORRIDOR, CLEARANCE_SHARE * reach(-1.0)),
                                      std::max(NARROWEST_CORRIDOR, CLEARANCE_SHARE * reach(1.0))});
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
                if (!(std::abs(lateral) < LARGEST_DEVIATION))
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

        /** Share of its length by which smoothing may lengthen or shorten a stretch. */
        constexpr double LARGEST_CHANGE_OF_LENGTH = 0.03;

        /** Tolerance, metres, that makes a curve keep to the arcs as closely as its limits allow. */
        constexpr double NEAR = 0.005;

        /** Arcs are long enough to be followed exactly in their middle when they have room for this many transitions
            from lock to lock at the planned speed. */
        constexpr double LONG_ARC_IN_TRANSITIONS = 2.0;

        /** Only arcs that bend less than this part of the limit are followed exactly. */
        constexpr double BEND_OF_CUT = 0.99;

        /** The speed up to which the steering keeps up along all of \e piece. */
        double steeringLimit(const Vehicle &vehicle, const PathPiece &piece)
        {
            const double from = piece.curvature, to = piece.endCurvature();
            const double least = from * to <= 0.0 ? 0.0 : std::min(std::abs(from), std::abs(to));
            return maxSpeedForSharpness(vehicle, piece.sharpness, least);
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

            /** One arc as it is. */
            SmoothPart keep(const StretchPart &part) const
            {
                return {part.arcs, isPathFree(world_, vehicle_, part.arcs), part.movingEnd};
            }

            /** \e whole in as few parts, divided by stops, as can be found. */
            std::vector<SmoothPart> smooth(const StretchPart &whole)
            {
                std::vector<SmoothPart> parts;
                SmoothPart found, attempt;
                for (std::size_t first = 0, arcs = whole.arcs.pieces.size(); first < arcs;)
                {
                    // The most arcs from here on that can be joined, by bisection when not all: one always can.
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
                // At the planned speed first, confined to the clearance only when it collides without.
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

            /** How to look for a curve at some speed. */
            struct Approach
            {
                bool
                    near;  ///< deviate as little as the speed allows, rather than steer as softly as at the planned one
                bool confined;  ///< to the clearance
            };

            /** Below the planned speed. What works is found out at the lowest one, where there is the most room, and
                then tried at higher ones. */
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
                    // A soft one steers fast only where it must: the speed it really allows says which one to try.
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
                double least = vehicle_.maxSpeed;
                for (const PathPiece &piece : path.pieces)
                    least = std::min(least, steeringLimit(vehicle_, piece));
                return least;
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
                       std::abs(result.path.length() - length) <= LARGEST_CHANGE_OF_LENGTH * length;
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

        /** Appends what became of a stretch. */
        void append(SmoothPath &result, const std::vector<SmoothPart> &parts)
        {
            const std::size_t first = result.path.pieces.size();
            bool standing = true;
            for (const SmoothPart &part : parts)
            {
                if (standing && first < result.path.pieces.size())
                    result.stops.push_back(result.path.pieces.size());
                // After a stop a piece begins in any case; halves of an arc that was cut are one again.
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

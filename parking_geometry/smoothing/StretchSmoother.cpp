#include "parking_geometry/smoothing/StretchSmoother.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

namespace parking
{
    namespace
    {
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
    }  // namespace

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
        // The end that was asked for, in the turn count of the integration.
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
}  // namespace parking

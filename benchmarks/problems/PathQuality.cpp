#include "benchmarks/problems/PathQuality.h"

#include "parking_geometry/curves/Kinematics.h"

#include <cmath>
#include <cstddef>
#include <optional>

#include <Eigen/Core>

namespace parking
{
    namespace
    {
        constexpr double SAME_PLACE = 1e-6;  // metres
        constexpr double PARALLEL = 1e-6;    // sine of the angle between two lines

        /** Where the line that leaves \e from meets the one that arrives at \e to, if that is on the way. */
        std::optional<Eigen::Vector2d> meeting(const Pose &from, const Pose &to, int direction)
        {
            const Eigen::Vector2d a(std::cos(from.yaw), std::sin(from.yaw)), b(std::cos(to.yaw), std::sin(to.yaw));
            const double cross = a.x() * b.y() - a.y() * b.x();
            if (std::abs(cross) < PARALLEL)
                return std::nullopt;
            const Eigen::Vector2d between(to.x - from.x, to.y - from.y);
            const double along = (between.x() * b.y() - between.y() * b.x()) / cross;
            const double behind = (between.x() * a.y() - between.y() * a.x()) / cross;
            // `behind` is minus the way from the meeting place to the end.
            if (direction * along < 0.0 || direction * behind > 0.0)
                return std::nullopt;
            return Eigen::Vector2d(from.x, from.y) + along * a;
        }

        /** A straight piece to a place, with the heading of that piece. */
        void goStraight(SampledPath &path, const Eigen::Vector2d &place, int direction)
        {
            PathState state = path.back();
            const Eigen::Vector2d way(place.x() - state.pose.x, place.y() - state.pose.y);
            if (way.norm() < SAME_PLACE)
                return;
            state.pose = {place.x(), place.y(), wrapAngle(std::atan2(way.y(), way.x()) + (direction < 0 ? PI : 0.0))};
            state.curvature = 0.0;
            state.direction = direction;
            state.arcLength += way.norm();
            path.push_back(state);
        }
    }  // namespace

    SampledPath pathToDrive(const PlannedPath &path, const Vehicle &vehicle)
    {
        if (!path.straight || path.states.size() < 2)
            return path.states;
        const double limit = 1.0 / vehicle.minTurningRadius();
        const auto gentle = [&path, limit](std::size_t i)
        {
            const Pose &from = path.states[i - 1].pose, &to = path.states[i].pose;
            const double length = path.states[i].arcLength - path.states[i - 1].arcLength;
            return length > SAME_PLACE && std::abs(wrapAngle(to.yaw - from.yaw)) <= limit * length;
        };
        SampledPath result{path.states.front()};
        for (std::size_t i = 1; i < path.states.size(); ++i)
        {
            const std::size_t begin = i - 1;
            while (i < path.states.size() && !gentle(i) && path.states[i].direction == path.states[begin + 1].direction)
                ++i;
            if (i == begin + 1)
            {
                const double before = result.back().arcLength;
                const double length = path.states[i].arcLength - path.states[i - 1].arcLength;
                result.push_back(path.states[i]);
                result.back().arcLength = before + length;
                continue;
            }
            // States from begin to i - 1 turn too fast.
            const PathState &last = path.states[--i];
            if (const auto corner = meeting(path.states[begin].pose, last.pose, last.direction))
                goStraight(result, *corner, last.direction);
            goStraight(result, {last.pose.x, last.pose.y}, last.direction);
        }
        result.back().pose.yaw = path.states.back().pose.yaw;
        result.front().curvature = result.size() > 1 ? result[1].curvature : 0.0;
        result.front().direction = result.size() > 1 ? result[1].direction : 1;
        return result;
    }
}  // namespace parking

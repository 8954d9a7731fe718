#include "parking_geometry/curves/Biarc.h"

#include <cmath>

#include <Eigen/Core>

namespace parking
{
    namespace
    {
        /** Angle in radians below which an arc is a straight line up to rounding. */
        constexpr double STRAIGHT = 1e-11;

        /** The arc that leaves \e from and passes the place \e to. */
        Arc arcThrough(const Pose &from, const Eigen::Vector2d &to, int direction)
        {
            const Pose offset = relativeTo(from, {to.x(), to.y(), 0.0});
            const double chord = std::hypot(offset.x, offset.y);
            const double half = std::atan2(direction * offset.y, direction * offset.x);
            if (std::abs(half) < STRAIGHT)
                return {0.0, direction * chord};
            return {2.0 * offset.y / (chord * chord), direction * chord * half / std::sin(half)};
        }
    }  // namespace

    std::optional<Path> biarc(const Pose &from, const Pose &to, int direction)
    {
        const Eigen::Vector2d between(to.x - from.x, to.y - from.y);
        const Eigen::Vector2d leaving = direction * Eigen::Vector2d(std::cos(from.yaw), std::sin(from.yaw));
        const Eigen::Vector2d arriving = direction * Eigen::Vector2d(std::cos(to.yaw), std::sin(to.yaw));
        const double ahead = between.dot(leaving + arriving);
        if (!(ahead > 0.0))
            return std::nullopt;
        // The length of the tangents is the root of a quadratic equation, in a form without cancellation for parallel
        // tangents.
        const double square = between.squaredNorm();
        const double bend = 2.0 * (1.0 - leaving.dot(arriving));
        const double reach = square / (ahead + std::sqrt(ahead * ahead + bend * square));
        const Eigen::Vector2d middle =
            Eigen::Vector2d(0.5 * (from.x + to.x), 0.5 * (from.y + to.y)) + 0.5 * reach * (leaving - arriving);
        Path path{from, {}};
        const Arc first = arcThrough(from, middle, direction);
        path.append(first);
        path.append(arcThrough(advance(from, PathPiece(first)), {to.x, to.y}, direction));
        return path;
    }
}  // namespace parking

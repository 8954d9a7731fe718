#include "ompl_improved_astar/search/planning/PathStates.h"

#include "ompl_improved_astar/search/planning/GridSmoothing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace parking
{
    namespace
    {
        // A single arc is the shortest curve between its ends as long as it turns by much less than half a circle.
        constexpr double RADIANS_PER_STATE = 0.8;
        // Between states of a path where OMPL does not interpolate along the path's own arcs, in turning radii: on a
        // plain SE2 space it keeps the chord within a hundred-thousandth of the radius of the arc.
        constexpr double DENSE_SPACING = 0.01;
        constexpr double AT_GOAL = 1e-3;  // turning radii within which a pose counts as the goal
        // Lines that straightened() examines.
        constexpr double SHORT = 0.25;     // upper limit of their length, turning radii
        constexpr double STRAIGHT = 1e-9;  // metres and radians by which they may deviate
        constexpr double FRACTIONS[] = {0.5, 0.37, 0.63, 0.29, 0.71, 0.43, 0.57, 0.23, 0.77, 0.17, 0.83, 0.11, 0.89};

        bool isShortLine(const Pose &from, const Pose &to, double turningRadius)
        {
            if (positionDistance(from, to) >= SHORT * turningRadius)
                return false;
            const Pose seen = relativeTo(from, to);
            return std::abs(seen.y) <= STRAIGHT && std::abs(seen.yaw) <= STRAIGHT;
        }

        bool swerves(const Pose &from, const Pose &to, const StateSpacing &spacing)
        {
            return spacing.curveLength(from, to) > positionDistance(from, to) + STRAIGHT;
        }

        /** Metres and radians in one sum. */
        double deviation(const Pose &a, const Pose &b)
        {
            return positionDistance(a, b) + std::abs(wrapAngle(a.yaw - b.yaw));
        }
    }  // namespace

    StateSpacing stateSpacing(bool isPlain, double turningRadius, bool turnsOnTheSpot)
    {
        if (turnsOnTheSpot)
            return {search::SMOOTH_STATE_SPACING, search::SMOOTH_STATE_SPACING, turningRadius, {}};
        return {isPlain ? DENSE_SPACING * turningRadius : 0.0, DENSE_SPACING * turningRadius, turningRadius, {}};
    }

    std::vector<Pose> pathStates(const Path &path, const StateSpacing &spacing)
    {
        std::vector<Pose> poses{path.start};
        Pose pose = path.start;
        for (const PathPiece &piece : path.pieces)
        {
            const double sharpest = std::max(std::abs(piece.curvature), std::abs(piece.endCurvature()));
            double states = std::ceil(piece.driven() * sharpest / RADIANS_PER_STATE);
            const bool gentle =
                sharpest > 0.0 && (sharpest < (1.0 - 1e-9) * (1.0 / spacing.turningRadius) || piece.sharpness != 0.0);
            const double dense = gentle ? spacing.onGentleArcs : sharpest > 0.0 ? spacing.onArcs : 0.0;
            if (dense > 0.0)
                states = std::max(states, std::ceil(piece.driven() / dense));
            states = std::max(states, 1.0);
            states = std::max(states, std::ceil(std::abs(piece.turn) / PathPiece::MAX_TURN));
            for (double i = 1.0; i <= states; i += 1.0)
            {
                Pose next = piece.turn != 0.0 ? Pose{pose.x, pose.y, pose.yaw + piece.turn * i / states}
                                              : advance(pose, piece, piece.driven() * i / states);
                next.yaw = wrapAngle(next.yaw);
                poses.push_back(next);
            }
            pose = advance(pose, piece);
        }
        return straightened(std::move(poses), spacing);
    }

    std::vector<Pose> straightened(std::vector<Pose> poses, const StateSpacing &spacing)
    {
        if (!spacing.curveLength)
            return poses;
        for (std::size_t i = 1; i < poses.size(); ++i)
        {
            const Pose from = poses[i - 1], to = poses[i];
            if (!isShortLine(from, to, spacing.turningRadius) || !swerves(from, to, spacing))
                continue;
            for (const double fraction : FRACTIONS)
            {
                const Pose between{from.x + fraction * (to.x - from.x), from.y + fraction * (to.y - from.y), from.yaw};
                if (swerves(from, between, spacing) || swerves(between, to, spacing))
                    continue;
                poses.insert(poses.begin() + static_cast<std::ptrdiff_t>(i++), between);
                break;
            }
        }
        return poses;
    }

    bool isAtGoal(const Pose &pose, const std::vector<Pose> &goals, double turningRadius)
    {
        return std::any_of(goals.begin(), goals.end(),
                           [&](const Pose &goal) { return deviation(goal, pose) < AT_GOAL * turningRadius; });
    }

    void endAtGoal(std::vector<Pose> &poses, const std::vector<Pose> &goals, const StateSpacing &spacing,
                   bool turnsOnTheSpot)
    {
        const Pose end = poses.back();
        const Pose goal =
            *std::min_element(goals.begin(), goals.end(),
                              [&end](const Pose &a, const Pose &b) { return deviation(a, end) < deviation(b, end); });
        if (poses.size() == 1)
            poses.push_back(end);
        // Turns on the spot there begin at the same place. (Of a car's path the last piece may be as short, but OMPL
        // must not take it for a turn on the spot.)
        for (std::size_t i = poses.size(); i-- > 1 && turnsOnTheSpot && positionDistance(poses[i], goal) <= 1e-6;)
            poses[i] = {goal.x, goal.y, poses[i].yaw};
        poses.back() = goal;
        // The new end may make other lines swerve.
        poses = straightened(std::move(poses), spacing);
    }
}  // namespace parking

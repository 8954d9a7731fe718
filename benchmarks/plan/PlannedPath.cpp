#include "benchmarks/plan/PlannedPath.h"

#include "parking_geometry/curves/Biarc.h"
#include "parking_geometry/curves/Kinematics.h"
#include "state_validity/ompl/OmplPose.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace og = ompl::geometric;

namespace parking
{
    namespace
    {
        constexpr double MOST_ASKEW = 0.03;     // radians between mean heading and direction of travel on smooth curves
        constexpr double ROUNDING_TURN = 1e-9;  // radians; a smaller difference is rounding of headings
        constexpr double SHORTEST_LINE = 1e-7;  // metres; a shorter line is rounding
        constexpr double STAYS = 1e-5;          // metres and radians between two states of a car that stays where it is
        constexpr double SAME = 1e-6;           // metres and radians between a pose and the goal that it equals

        std::vector<const ompl::base::State *> statesOf(const og::PathGeometric &path)
        {
            std::vector<const ompl::base::State *> states(path.getStateCount());
            for (std::size_t i = 0; i < states.size(); ++i)
                states[i] = path.getState(static_cast<unsigned int>(i));
            return states;
        }

        Path curvePath(const Problem &problem, const og::PathGeometric &path)
        {
            Path arcs;
            const std::vector<const ompl::base::State *> states = statesOf(path);
            arcs.start = poseOf(states.front());
            for (std::size_t i = 1; i < states.size(); ++i)
                problem.curveSpace().append(states[i - 1], states[i], arcs);
            return arcs;
        }

        /** The two arcs that replace a straight line with a turning heading. Returned only if the car can drive them
            and they approximate the line as well as arcs can. */
        std::optional<Path> gentleTurn(const Pose &from, const Pose &to, double askew, int direction,
                                       const Vehicle &vehicle)
        {
            if (std::abs(askew) > MOST_ASKEW)
                return std::nullopt;
            std::optional<Path> arcs = biarc(from, to, direction);
            if (arcs)
                for (const PathPiece &piece : arcs->pieces)
                    if (std::abs(piece.curvature) > 1.0 / vehicle.minTurningRadius())
                        return std::nullopt;
            return arcs;
        }

        /** The motions of a plain SE2 space as arcs and turns of a car. */
        Path linePath(const og::PathGeometric &path, const Vehicle &vehicle)
        {
            const std::vector<const ompl::base::State *> states = statesOf(path);
            Path result{poseOf(states.front()), {}};
            const auto turnTo = [&result](double from, double to)
            {
                double turn = wrapAngle(to - from);
                if (!result.pieces.empty() && result.pieces.back().turn != 0.0)
                {
                    turn = wrapAngle(turn + result.pieces.back().turn);
                    result.pieces.pop_back();
                }
                if (std::abs(turn) > ROUNDING_TURN)
                    result.append(PathPiece::turnOnTheSpot(turn));
            };
            for (std::size_t i = 1; i < states.size(); ++i)
            {
                const Pose from = poseOf(states[i - 1]), to = poseOf(states[i]);
                const double length = positionDistance(to, from);
                if (length < SHORTEST_LINE)
                {
                    turnTo(from.yaw, to.yaw);
                    continue;
                }
                const double mean = from.yaw + 0.5 * wrapAngle(to.yaw - from.yaw);
                double askew = wrapAngle(std::atan2(to.y - from.y, to.x - from.x) - mean);
                const int direction = std::abs(askew) <= 0.5 * PI ? 1 : -1;
                if (direction < 0)
                    askew = wrapAngle(askew + PI);
                if (const auto arcs = gentleTurn(from, to, askew, direction, vehicle))
                {
                    result.extend(*arcs);
                    continue;
                }
                turnTo(from.yaw, mean + askew);
                result.append({0.0, direction * length});
                turnTo(mean + askew, to.yaw);
            }
            return result;
        }
    }  // namespace

    double samplingOf(double length, bool valid)
    {
        constexpr double MOST_STATES = 1e4;
        return valid ? PlannedPath::SAMPLING : std::max(PlannedPath::SAMPLING, length / MOST_STATES);
    }

    SampledPath PlannedPath::states() const
    {
        SampledPath states = path.sample(samplingOf(path.length(), recheck.valid));
        states.back().pose = end;
        return states;
    }

    PlannedPath readPath(const Problem &problem, const og::PathGeometric &path, bool exact)
    {
        PlannedPath result;
        if (path.getStateCount() == 0)
            return result;
        const Scenario &scenario = problem.scenario();
        const Referee &referee = problem.referee();
        std::vector<Pose> poses;
        for (const ompl::base::State *state : statesOf(path))
            poses.push_back(poseOf(state));
        if (!std::all_of(poses.begin(), poses.end(), [&](const Pose &pose) { return referee.isPlace(pose); }))
        {
            result.recheck = referee.checkLines(poses, exact);
            result.path.start = result.end = scenario.start;
            return result;
        }
        // The curve between two poses so near to each other is much longer than their distance; no car drives it.
        const bool stays = exact && poses.size() <= 2 && isSamePose(poses.front(), poses.back(), STAYS);
        const bool straight = stays || problem.curveSpace().kind() == SpaceKind::SE2;
        result.path = stays      ? Path{poses.front(), {}}
                      : straight ? linePath(path, scenario.vehicle)
                                 : curvePath(problem, path);
        // Before start and end are rounded to the requested poses.
        result.recheck = straight ? referee.checkLines(poses, exact) : referee.check(result.path, exact);
        result.path.start = {scenario.start.x, scenario.start.y, wrapAngle(scenario.start.yaw)};
        result.end = result.path.end();
        if (exact)
            for (const Pose &goal : scenario.goals)
                if (isSamePose(goal, result.end, stays ? STAYS : SAME))
                    result.end = {goal.x, goal.y, wrapAngle(goal.yaw)};
        result.cusps = result.path.cusps();
        // Interpolation of the planner, which on a plain SE2 space is not a motion of a car.
        if (straight)
        {
            for (std::size_t i = 1; i < poses.size() && !stays; ++i)
                result.length += positionDistance(poses[i], poses[i - 1]);
            poses.front() = result.path.start;
            poses.back() = result.end;
        }
        else
            result.length = result.path.length();
        result.clearance = straight ? referee.minClearance(poses) : referee.minClearance(result.path);
        return result;
    }
}  // namespace parking

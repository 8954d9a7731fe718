#include "path_tracking/reference/PathSections.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace parking
{
    namespace
    {
        /** States nearer than this are one place. */
        constexpr double SAME_PLACE = 1e-7;

        [[noreturn]] void fail(std::size_t index, const std::string &what)
        {
            throw Error("path state " + std::to_string(index) + ": " + what);
        }

        void checkState(const PathState &state, std::size_t index, double maxCurvature)
        {
            if (!isFinite(state.pose) || !std::isfinite(state.curvature) || !std::isfinite(state.arcLength))
                fail(index, "pose, curvature and arc length must be finite numbers");
            if (state.direction != 1 && state.direction != -1)
                fail(index, "direction is " + std::to_string(state.direction) + "; it must be 1 or -1");
            if (std::abs(state.curvature) > 1.01 * maxCurvature)
                fail(index, "curvature " + formatNumber(state.curvature) + " 1/m is beyond the car's " +
                                formatNumber(maxCurvature) + " 1/m");
        }

        /** One piece between two places with the headings it leaves and arrives with. */
        struct Piece
        {
            double curvature;
            double length;
            double leaveYaw;
            double arriveYaw;
        };

        double distance(const Pose &a, const Pose &b)
        {
            return std::hypot(a.x - b.x, a.y - b.y);
        }

        /** Length of the arc over a chord; the straight chord when no arc of this curvature spans it. */
        double arcLength(double chord, double curvature)
        {
            const double half = 0.5 * std::abs(curvature) * chord;
            return half < 1e-6 || half >= 1.0 ? chord : 2.0 * std::asin(half) / std::abs(curvature);
        }

        /** The arc from \e from to \e to that agrees with the heading at both ends, else at one of them, else the
            straight chord. */
        Piece makePiece(const Pose &from, const Pose &to, const PathState &state, double statedLength,
                        double maxCurvature)
        {
            const double curvature = std::clamp(state.curvature, -maxCurvature, maxCurvature);
            const double chord = distance(from, to);
            // A car moves along its heading: 5 % sideways is rounding of poses, more is another heading.
            const double tolerance = 1e-3 + 0.05 * chord;
            for (const double length : {arcLength(chord, curvature), statedLength})
            {
                if (!(length > 0.0))
                    continue;
                const double signedLength = state.direction * length;
                const double turn = curvature * signedLength;
                const bool forwards = distance(advance(from, curvature, signedLength), to) <= tolerance;
                const bool backwards = distance(advance(to, curvature, -signedLength), from) <= tolerance;
                const bool yaw = std::abs(wrapAngle(from.yaw + turn - to.yaw)) <= CORNER_ANGLE;
                if ((forwards || backwards) && yaw)
                    return {curvature, length, from.yaw, to.yaw};
                if (backwards)
                    return {curvature, length, to.yaw - turn, to.yaw};
                if (forwards)
                    return {curvature, length, from.yaw, from.yaw + turn};
            }
            const double travel = std::atan2(to.y - from.y, to.x - from.x);
            const double yaw = state.direction > 0 ? travel : wrapAngle(travel + PI);
            return {0.0, chord, yaw, yaw};
        }
    }  // namespace

    std::vector<PathSection> splitPath(const SampledPath &path, const Vehicle &vehicle)
    {
        if (path.size() < 2)
            throw Error("path: it has " + std::to_string(path.size()) + " states; at least 2 are needed");
        const double maxCurvature = vehicle.curvature(vehicle.maxSteeringAngle);
        for (std::size_t i = 0; i < path.size(); ++i)
            checkState(path[i], i, maxCurvature);

        std::vector<PathSection> sections;
        Pose place = path.front().pose;  // where the last piece ended, with the heading to leave with
        double arriveYaw = place.yaw;    // and the heading that it was reached with
        double arcLengthBefore = path.front().arcLength;
        for (std::size_t i = 1; i < path.size(); ++i)
        {
            const PathState &state = path[i];
            if (distance(place, state.pose) < SAME_PLACE)
            {
                place.yaw = state.pose.yaw;
                continue;
            }
            const Piece piece = makePiece(place, state.pose, state, state.arcLength - arcLengthBefore, maxCurvature);
            const bool begins = sections.empty() || sections.back().direction != state.direction;
            if (begins)
            {
                sections.emplace_back();
                PathSection &section = sections.back();
                section.direction = state.direction;
                section.startYaw = piece.leaveYaw;
                section.nodes.push_back({{place.x, place.y, arriveYaw}, piece.curvature, 0.0});
                section.corner.push_back(false);
            }
            PathSection &section = sections.back();
            const double jump = std::abs(wrapAngle(piece.leaveYaw - arriveYaw));
            if (jump > CORNER_ANGLE)
            {
                section.corner.back() = true;
                section.largestCorner = std::max(section.largestCorner, jump);
                section.lastCornerNode = section.nodes.size() - 1;
                ++section.cornerCount;
            }
            section.nodes.push_back({{state.pose.x, state.pose.y, piece.arriveYaw}, piece.curvature, piece.length});
            section.corner.push_back(false);
            place = state.pose;
            arriveYaw = piece.arriveYaw;
            arcLengthBefore = state.arcLength;
        }
        if (sections.empty())
            throw Error("path: all of its " + std::to_string(path.size()) +
                        " states are at one place; it must have a length");
        return sections;
    }
}  // namespace parking

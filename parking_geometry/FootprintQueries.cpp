#include "parking_geometry/FootprintQueries.h"

#include "parking_geometry/curves/Kinematics.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        /** Motions of the body shorter than this are decided by their ends. */
        constexpr double FINEST_MOTION = 5e-3;

        class MotionCheck
        {
        public:
            MotionCheck(const FootprintQueries &queries, double reach) : queries_(queries), reach_(reach)
            {
            }

            /** A lower bound of the distance to the obstacles, negative when the pose collides. */
            double distanceAt(const Pose &pose) const
            {
                const double clearance = queries_.clearance(pose);
                if (clearance > 0.0)
                    return clearance;
                return queries_.isFree && queries_.isFree(pose) ? 0.0 : -1.0;
            }

            /** How far any point of the body moves along \e arc at most. */
            double motion(const Arc &arc) const
            {
                return std::abs(arc.length) * (1.0 + std::abs(arc.curvature) * reach_);
            }

            bool isFree(const Pose &from, double distanceFrom, const Arc &arc, double distanceTo) const
            {
                const double moved = motion(arc);
                if (distanceFrom + distanceTo > moved || moved < FINEST_MOTION)
                    return true;
                const Arc half{arc.curvature, 0.5 * arc.length};
                const Pose middle = advance(from, half.curvature, half.length);
                const double distance = distanceAt(middle);
                return distance >= 0.0 && isFree(from, distanceFrom, half, distance) &&
                       isFree(middle, distance, half, distanceTo);
            }

        private:
            const FootprintQueries &queries_;
            double reach_;
        };
    }  // namespace

    double farthestCorner(const Vehicle &vehicle)
    {
        return std::hypot(std::max(vehicle.wheelbase + vehicle.frontOverhang, vehicle.rearOverhang),
                          0.5 * vehicle.width);
    }

    bool isPathFree(const FootprintQueries &queries, const Vehicle &vehicle, const SampledPath &path)
    {
        if (queries.isPathFree)
            return queries.isPathFree(path);
        if (!queries.clearance)
            return !queries.isFree || std::all_of(path.begin(), path.end(),
                                                  [&](const PathState &state) { return queries.isFree(state.pose); });
        if (path.empty())
            return true;
        const MotionCheck check(queries, farthestCorner(vehicle));
        // `known` is the last state asked about; states that its clearance covers are skipped.
        double distance = check.distanceAt(path.front().pose), moved = 0.0;
        if (distance < 0.0)
            return false;
        for (std::size_t i = 1; i < path.size(); ++i)
        {
            const Arc arc = arcBetween(path[i - 1].pose, path[i].pose);
            const double next = moved + check.motion(arc);
            if (next < distance)
            {
                moved = next;
                continue;
            }
            const double there = check.distanceAt(path[i].pose);
            if (there < 0.0 || !check.isFree(path[i - 1].pose, std::max(0.0, distance - moved), arc, there))
                return false;
            distance = there;
            moved = 0.0;
        }
        return true;
    }
}  // namespace parking

#include "benchmarks/metrics/DriveMetrics.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        constexpr double FRAME = 1e-3;          // seconds
        constexpr double SAMPLING = 5e-3;       // seconds
        constexpr double STANDING = 1e-3;       // m/s
        constexpr double GOAL_DISTANCE = 0.01;  // metres
        constexpr double GOAL_ANGLE = PI / 180.0;
        constexpr double ENOUGH = 2.0;     // metres; a larger clearance need not be exact
        constexpr double NO_TIME = 1e-9;   // seconds
        constexpr double ROUNDING = 1e-6;  // metres

        /** Counts the frames in which the body meets an obstacle. If the distance to the nearest obstacle exceeds the
           motion of the body, the frames in between are free. */
        class Frames
        {
        public:
            Frames(const FootprintChecker &checker, DriveFigures &figures) : checker_(checker), figures_(figures)
            {
            }

            void add(const Pose &pose)
            {
                if (figures_.frames > 0)
                    room_ -= positionDistance(last_, pose) +
                             checker_.farthestPoint() * std::abs(wrapAngle(pose.yaw - last_.yaw)) + ROUNDING;
                ++figures_.frames;
                last_ = pose;
                if (room_ > 0.0)
                    return;
                room_ = 0.0;
                if (!checker_.isFree(pose))
                    ++figures_.colliding;
                else
                    room_ = checker_.clearance(pose, ENOUGH, counts_);
            }

        private:
            const FootprintChecker &checker_;
            DriveFigures &figures_;
            CheckCounts counts_;
            Pose last_;
            double room_{0.0};
        };

        Pose between(const TrajectoryPoint &a, const TrajectoryPoint &b, double share)
        {
            return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.yaw + share * wrapAngle(b.yaw - a.yaw)};
        }
    }  // namespace

    bool attainsGoal(const Pose &pose, const std::vector<Pose> &goals)
    {
        return std::any_of(goals.begin(), goals.end(),
                           [&pose](const Pose &goal)
                           {
                               return std::abs(pose.x - goal.x) <= GOAL_DISTANCE &&
                                      std::abs(pose.y - goal.y) <= GOAL_DISTANCE &&
                                      std::abs(wrapAngle(pose.yaw - goal.yaw)) <= GOAL_ANGLE;
                           });
    }

    DriveFigures driveFigures(const Trajectory &trajectory, const std::vector<Pose> &goals,
                              const FootprintChecker &checker)
    {
        DriveFigures figures;
        if (trajectory.empty())
            return figures;
        const double begin = trajectory.front().t;
        const TrajectoryPoint &end = trajectory.back();
        figures.duration = end.t - begin;
        figures.attainsGoal = attainsGoal({end.x, end.y, end.yaw}, goals);

        Frames frames(checker, figures);
        double changes = 0.0, acceleration = 0.0;
        for (std::size_t i = 1; i < trajectory.size(); ++i)
        {
            const TrajectoryPoint &from = trajectory[i - 1], &to = trajectory[i];
            const double step = to.t - from.t;
            if (!(step > 0.0))
                continue;
            changes += std::abs((to.v - from.v) / step - acceleration);
            acceleration = (to.v - from.v) / step;
            if (std::max(std::abs(from.v), std::abs(to.v)) < STANDING)
                figures.standingTime += step;
            for (double t = begin + FRAME * static_cast<double>(figures.frames); t < to.t && t < end.t - NO_TIME;
                 t = begin + FRAME * static_cast<double>(figures.frames))
                frames.add(between(from, to, std::clamp((t - from.t) / step, 0.0, 1.0)));
        }
        frames.add({end.x, end.y, end.yaw});
        if (figures.duration > 0.0)
            figures.meanJerk = (changes + std::abs(acceleration)) / figures.duration;
        return figures;
    }

    DriveFigures driveFigures(const TimedMotion &motion, const std::vector<Pose> &goals,
                              const FootprintChecker &checker)
    {
        return driveFigures(sample(motion, checker.vehicle(), SAMPLING), goals, checker);
    }
}  // namespace parking

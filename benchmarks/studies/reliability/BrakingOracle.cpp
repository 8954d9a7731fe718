#include "benchmarks/studies/reliability/BrakingOracle.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace parking
{
    namespace
    {
        constexpr double STEP = 0.005;    // seconds
        constexpr double NOTHING = 1e-9;  // metres

        TrajectoryPoint at(const Trajectory &drive, double time)
        {
            const auto after = std::upper_bound(drive.begin(), drive.end(), time,
                                                [](double t, const TrajectoryPoint &point) { return t < point.t; });
            if (after == drive.end())
                return drive.back();
            if (after == drive.begin())
                return drive.front();
            const TrajectoryPoint &a = *(after - 1), &b = *after;
            const double share = (time - a.t) / (b.t - a.t);
            TrajectoryPoint point = a;
            point.t = time;
            point.x += share * (b.x - a.x);
            point.y += share * (b.y - a.y);
            point.yaw += share * wrapAngle(b.yaw - a.yaw);
            point.v += share * (b.v - a.v);
            point.steering += share * (b.steering - a.steering);
            return point;
        }
    }  // namespace

    std::vector<Pose> brakingWay(const Trajectory &drive, const Vehicle &car, const Disturbances &odds, double since,
                                 double brakes)
    {
        std::vector<Pose> way;
        for (double t = since; t < brakes; t += STEP)
        {
            const TrajectoryPoint point = at(drive, t);
            way.push_back({point.x, point.y, point.yaw});
        }
        const TrajectoryPoint begin = at(drive, brakes);
        Pose pose{begin.x, begin.y, begin.yaw};
        way.push_back(pose);
        const double brake = (1.0 - odds.brakeLoss) * (1.0 + odds.speedBias) * car.maxAcceleration;
        const double wheelbase = (1.0 + odds.wheelbaseError) * car.wheelbase;
        double speed = begin.v, wheels = begin.steering, t = brakes, place = brakes;
        while (speed != 0.0)
        {
            const double before = speed;
            speed = std::abs(speed) <= brake * STEP ? 0.0 : speed - std::copysign(brake * STEP, speed);
            const double driven = 0.5 * (before + speed) * STEP;
            t += STEP;
            // The place of the drive that is as far along, in the direction in which the car rolls.
            for (double left = std::abs(driven); left > NOTHING && place < drive.back().t;)
            {
                const double v = at(drive, place).v;
                if (v * before <= 0.0)
                    break;
                const double part = std::min(STEP, left / std::abs(v));
                left -= part * std::abs(v);
                place += part;
            }
            const bool sticks = std::any_of(odds.stuck.begin(), odds.stuck.end(),
                                            [t](const TimeSpan &span) { return span.contains(t); });
            const double turn = car.maxSteeringRate * STEP;
            const double wanted = wheels + std::clamp(at(drive, place).steering - wheels, -turn, turn);
            const double angle = sticks ? wheels : 0.5 * (wheels + wanted);
            wheels = sticks ? wheels : wanted;
            const double yaw = pose.yaw + 0.5 * driven * std::tan(angle) / wheelbase;
            pose = {pose.x + driven * std::cos(yaw), pose.y + driven * std::sin(yaw),
                    pose.yaw + driven * std::tan(angle) / wheelbase};
            way.push_back(pose);
        }
        return way;
    }
}  // namespace parking

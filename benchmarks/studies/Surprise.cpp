#include "benchmarks/studies/Surprise.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    using parking_test::PolygonOracle;
    using parking_test::Random;

    namespace
    {
        /** Maximum distance in metres between the ends of a step of the collision check. */
        constexpr double STEP = 0.005;
        /** Overlap of a body in metres that counts as contact: numbers are rounded. */
        constexpr double OVERLAP = 1e-4;
        /** Seconds between two poses of a braking car. */
        constexpr double BRAKING_STEP = 0.005;
        /** Distance in metres that counts as zero: numbers are rounded. */
        constexpr double NOTHING = 1e-9;

        Pose poseOf(const TrajectoryPoint &point)
        {
            return {point.x, point.y, point.yaw};
        }

        Pose between(const Pose &a, const Pose &b, double share)
        {
            return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.yaw + share * wrapAngle(b.yaw - a.yaw)};
        }

        TrajectoryPoint interpolated(const Trajectory &drive, double time)
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

        const TrajectoryPoint &pointAt(const Trajectory &drive, double time)
        {
            const auto after = std::lower_bound(drive.begin(), drive.end(), time,
                                                [](const TrajectoryPoint &point, double t) { return point.t < t; });
            return after == drive.end() ? drive.back() : *after;
        }
    }  // namespace

    std::optional<Touch> firstTouch(const Trajectory &drive, const Vehicle &car, const PolygonOracle &oracle,
                                    double since)
    {
        double driven = 0.0;
        for (std::size_t i = 1; i < drive.size(); ++i)
        {
            const TrajectoryPoint &p = drive[i - 1], &q = drive[i];
            if (q.t < since)
                continue;
            const Pose a = poseOf(p), b = poseOf(q);
            const double distance = positionDistance(a, b);
            const int looks = 1 + static_cast<int>((distance + 4.0 * std::abs(wrapAngle(b.yaw - a.yaw))) / STEP);
            for (int k = 1; k <= looks; ++k)
            {
                const double share = static_cast<double>(k) / looks, time = p.t + share * (q.t - p.t);
                if (time >= since && !oracle.isFree(between(a, b, share), car, -OVERLAP))
                    return Touch{time, std::abs(p.v + share * (q.v - p.v)), driven + share * distance};
            }
            driven += distance;
        }
        return std::nullopt;
    }

    std::vector<Pose> brakingPath(const Trajectory &drive, const Vehicle &car, const Disturbances &odds, double since,
                                  double brakes)
    {
        std::vector<Pose> path;
        for (double t = since; t < brakes; t += BRAKING_STEP)
        {
            const TrajectoryPoint point = interpolated(drive, t);
            path.push_back({point.x, point.y, point.yaw});
        }
        const TrajectoryPoint begin = interpolated(drive, brakes);
        Pose pose{begin.x, begin.y, begin.yaw};
        path.push_back(pose);
        const double brake = (1.0 - odds.brakeLoss) * (1.0 + odds.speedBias) * car.maxAcceleration;
        const double wheelbase = (1.0 + odds.wheelbaseError) * car.wheelbase;
        double speed = begin.v, wheels = begin.steering, t = brakes, place = brakes;
        while (speed != 0.0)
        {
            const double before = speed;
            speed = std::abs(speed) <= brake * BRAKING_STEP ? 0.0 : speed - std::copysign(brake * BRAKING_STEP, speed);
            const double driven = 0.5 * (before + speed) * BRAKING_STEP;
            t += BRAKING_STEP;
            // The place of the drive at the same distance, in the direction of travel.
            for (double left = std::abs(driven); left > NOTHING && place < drive.back().t;)
            {
                const double v = interpolated(drive, place).v;
                if (v * before <= 0.0)
                    break;
                const double part = std::min(BRAKING_STEP, left / std::abs(v));
                left -= part * std::abs(v);
                place += part;
            }
            const bool sticks = std::any_of(odds.stuck.begin(), odds.stuck.end(),
                                            [t](const TimeSpan &span) { return span.contains(t); });
            const double turn = car.maxSteeringRate * BRAKING_STEP;
            const double wanted = wheels + std::clamp(interpolated(drive, place).steering - wheels, -turn, turn);
            const double angle = sticks ? wheels : 0.5 * (wheels + wanted);
            wheels = sticks ? wheels : wanted;
            const double yaw = pose.yaw + 0.5 * driven * std::tan(angle) / wheelbase;
            pose = {pose.x + driven * std::cos(yaw), pose.y + driven * std::sin(yaw),
                    pose.yaw + driven * std::tan(angle) / wheelbase};
            path.push_back(pose);
        }
        return path;
    }

    bool isFree(const std::vector<Pose> &path, const Vehicle &car, const PolygonOracle &oracle, double spare)
    {
        return std::all_of(path.begin(), path.end(), [&](const Pose &pose) { return oracle.isFree(pose, car, spare); });
    }

    PolygonOracle alone(const Polygon &obstacle)
    {
        constexpr double FAR = 1e4;
        return {{obstacle}, {{-FAR, -FAR}, {FAR, FAR}}};
    }

    std::optional<Surprise> surpriseFor(const Scenario &scenario, const Trajectory &drive, Random &random)
    {
        const Vehicle &car = scenario.vehicle;
        for (int attempts = 0; attempts < 40; ++attempts)
        {
            Surprise surprise;
            const TrajectoryPoint &now = pointAt(drive, random.between(0.0, drive.back().t));
            surprise.time = now.t;
            if (std::abs(now.v) < 0.05)
                continue;
            const double wanted = random.between(0.5, 6.0);
            double driven = 0.0;
            std::size_t i = 1;
            for (; i < drive.size() && driven < wanted; ++i)
                if (drive[i].t > now.t)
                    driven += positionDistance(poseOf(drive[i - 1]), poseOf(drive[i]));
            if (driven < wanted)
                continue;
            const TrajectoryPoint &then = drive[i - 1];
            const double length = random.between(0.2, 1.2), width = random.between(0.2, 1.2);
            const double bumper =
                then.v < 0.0 ? -car.rearOverhang - 0.5 * length : car.wheelbase + car.frontOverhang + 0.5 * length;
            const double aside = random.between(-0.4, 0.4) * car.width;
            surprise.obstacle = parking_test::rectangle(length, width, compose(poseOf(then), {bumper, aside, 0.0}));
            const PolygonOracle oracle = alone(surprise.obstacle);
            if (!oracle.isFree(poseOf(now), car, 0.02))
                continue;
            const std::optional<Touch> touch = firstTouch(drive, car, oracle, now.t);
            if (!touch || touch->driven < 0.5 || touch->driven > 6.0)
                continue;
            surprise.ahead = touch->driven;
            return surprise;
        }
        return std::nullopt;
    }
}  // namespace parking

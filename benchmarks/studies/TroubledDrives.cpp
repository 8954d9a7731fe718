#include "benchmarks/studies/TroubledDrives.h"

#include "benchmarks/worlds/PolygonOracle.h"
#include "benchmarks/worlds/RandomWorlds.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace parking
{
    using parking_test::PolygonOracle;
    using parking_test::Random;

    std::string toString(Trouble trouble)
    {
        switch (trouble)
        {
            case Trouble::None:
                return "none";
            case Trouble::Dropout:
                return "no pose for 0.1 to 1.5 s";
            case Trouble::Stuck:
                return "wheels stick for 0.2 to 3 s";
            case Trouble::Wheelbase:
                return "wheelbase wrong by 3 %";
            case Trouble::Brake:
                return "20 % less brake";
            case Trouble::Delay:
                return "commands 0.3 s late";
            case Trouble::Several:
                return "the last three together";
        }
        return "";
    }

    namespace
    {
        /** Maximum distance in metres between the ends of a step of the collision check. */
        constexpr double STEP = 0.005;
        /** Overlap of a body in metres that counts as contact: numbers are rounded. */
        constexpr double OVERLAP = 1e-4;
        /** Minimum distance in metres of an avoidable obstacle from a stop: controllers measure poses to a
            centimetre. */
        constexpr double SPARE = 0.05;
        /** Minimum distance in metres to obstacles of the scenario, beside which cars park. */
        constexpr double SPARE_BESIDE = 0.01;
        /** Seconds between two poses of a braking car. */
        constexpr double BRAKING_STEP = 0.005;
        /** Distance in metres that counts as zero: numbers are rounded. */
        constexpr double NOTHING = 1e-9;
        /** Radians between steering and its command that are detectable. */
        constexpr double SEEN = 0.01;

        std::string rounded(double value)
        {
            return formatNumber(std::round(1e3 * value) / 1e3);
        }

        Disturbances disturbancesOf(Trouble trouble, double duration, Random &random)
        {
            Disturbances result;
            result.seed = random.bits();
            const auto span = [&random, duration](double shortest, double longest)
            {
                const double begin = random.between(0.0, duration);
                return TimeSpan{begin, begin + random.between(shortest, longest)};
            };
            if (trouble == Trouble::Dropout)
                for (std::size_t left = 1 + random.index(2); left > 0; --left)
                    result.blind.push_back(span(0.1, 1.5));
            if (trouble == Trouble::Stuck)
                result.stuck.push_back(span(0.2, 3.0));
            if (trouble == Trouble::Wheelbase || trouble == Trouble::Several)
                result.wheelbaseError = random.chance(0.5) ? 0.03 : -0.03;
            if (trouble == Trouble::Brake || trouble == Trouble::Several)
                result.brakeLoss = 0.2;
            if (trouble == Trouble::Delay || trouble == Trouble::Several)
                result.delay = 0.3;
            return result;
        }

        Pose poseOf(const TrajectoryPoint &point)
        {
            return {point.x, point.y, point.yaw};
        }

        Pose between(const Pose &a, const Pose &b, double share)
        {
            return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.yaw + share * wrapAngle(b.yaw - a.yaw)};
        }

        /** First contact of a drive after \e since; empty without contact. */
        struct Touch
        {
            double time{0.0}, speed{0.0}, driven{0.0};
        };

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

        /** The physically possible stop: a car that brakes with full force from a given time of a drive.

            An independent integration in steps of 5 ms, which shares nothing with controller, supervisor and simulated
            car. It decelerates at this car's limit. The steering is that of the drive at the same place, and stays
            constant while stuck.

            \param drive the simulated drive without braking
            \param odds disturbances of the car
            \param since seconds, begin of the check: an obstacle appears, or a fault begins
            \param brakes seconds when the brake takes effect
            \return the poses from \e since to standstill */
        std::vector<Pose> brakingWay(const Trajectory &drive, const Vehicle &car, const Disturbances &odds,
                                     double since, double brakes)
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
                speed =
                    std::abs(speed) <= brake * BRAKING_STEP ? 0.0 : speed - std::copysign(brake * BRAKING_STEP, speed);
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

        const TrajectoryPoint &pointAt(const Trajectory &drive, double time)
        {
            const auto after = std::lower_bound(drive.begin(), drive.end(), time,
                                                [](const TrajectoryPoint &point, double t) { return point.t < t; });
            return after == drive.end() ? drive.back() : *after;
        }

        PolygonOracle alone(const Polygon &obstacle)
        {
            constexpr double FAR = 1e4;
            return {{obstacle}, {{-FAR, -FAR}, {FAR, FAR}}};
        }

        struct Surprise
        {
            double time{0.0};   ///< time when it appears
            double ahead{0.0};  ///< metres until contact
            Polygon obstacle;
        };

        /** A box in front of a car that continues its drive. Empty when no place is found. */
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

        /** The first command of a drive that exceeds a limit of the car. */
        std::string brokenLimit(const ParkingResult &result, const Vehicle &car, double period)
        {
            constexpr double SLACK = 1e-9;
            for (const ParkingLeg &leg : result.legs)
            {
                const Command *before = nullptr;
                for (const DriveRecord &record : leg.drive.log)
                {
                    const Command &command = record.control.command;
                    const std::string at = " at " + std::to_string(leg.begin + record.t) + " s";
                    if (!(std::abs(command.acceleration) <= car.maxAcceleration + SLACK))
                        return "acceleration" + at;
                    if (!(std::abs(command.steering) <= car.maxSteeringAngle + SLACK))
                        return "steering angle" + at;
                    if (before != nullptr &&
                        !(std::abs(command.steering - before->steering) <= car.maxSteeringRate * period + SLACK))
                        return "steering rate" + at;
                    before = &command;
                }
            }
            return "";
        }
        bool isFree(const std::vector<Pose> &path, const Vehicle &car, const PolygonOracle &oracle, double spare)
        {
            return std::all_of(path.begin(), path.end(),
                               [&](const Pose &pose) { return oracle.isFree(pose, car, spare); });
        }

        /** The drive in progress at \e time. */
        const ParkingLeg &legAt(const ParkingResult &result, double time)
        {
            return *(std::find_if(result.legs.begin() + 1, result.legs.end(),
                                  [time](const ParkingLeg &leg) { return leg.begin > time; }) -
                     1);
        }

        /** The first time at which stuck wheels are detectable, in the drive in progress at \e time; empty if they are
            not stuck. */
        std::optional<double> wheelsSeenToStick(const ParkingResult &result, const Disturbances &odds, double time)
        {
            const ParkingLeg &leg = legAt(result, time);
            for (std::size_t i = 1; i < leg.drive.log.size(); ++i)
            {
                const DriveRecord &before = leg.drive.log[i - 1], &now = leg.drive.log[i];
                const bool sticks =
                    std::any_of(odds.stuck.begin(), odds.stuck.end(),
                                [&](const TimeSpan &span) { return span.contains(leg.begin + before.t); });
                if (sticks && leg.begin + now.t <= time &&
                    std::abs(now.measurement.steering - before.control.command.steering) > SEEN)
                    return leg.begin + now.t;
            }
            return std::nullopt;
        }
    }  // namespace

    TroubledDrive driveInTrouble(const Scenario &scenario, Trouble trouble, std::uint64_t seed,
                                 const ParkingParameters &given)
    {
        if (scenario.grid)
            throw Error("scenario " + scenario.name + ": obstacles appear in worlds of polygons only");
        Random random(seed * 2654435761U + static_cast<std::uint64_t>(trouble));
        TroubledDrive report;
        report.trouble = trouble;
        ParkingParameters parameters = given;
        const ParkingResult calm = AutomaticParking(parameters).park(scenario);
        report.status = calm.status;
        report.message = calm.message;
        if (!calm.parked() || calm.trajectory.back().t == 0.0)
            return report;
        parameters.drive.disturbances = disturbancesOf(trouble, calm.trajectory.back().t, random);
        const ParkingResult undisturbed = AutomaticParking(parameters).park(scenario);
        const Trajectory &expected = undisturbed.trajectory;

        std::optional<Surprise> surprise;
        if (random.chance(0.6))
            surprise = surpriseFor(scenario, expected, random);
        AutomaticParking parking(parameters);
        bool reported = false;
        parking.setMapUpdate(
            [&](double time, const Pose &) -> std::optional<Scenario>
            {
                if (!surprise || reported || time < surprise->time - 1e-9)
                    return std::nullopt;
                reported = true;
                Scenario changed = scenario;
                changed.polygons.push_back(surprise->obstacle);
                return changed;
            });
        const ParkingResult result = surprise ? parking.park(scenario) : undisturbed;

        report.status = result.status;
        report.message = result.message;
        report.events = result.events;
        if (surprise)
            report.events.push_back(rounded(surprise->time) + " s: an obstacle appears " + rounded(surprise->ahead) +
                                    " m ahead");
        const Vehicle &car = scenario.vehicle;
        report.brokenLimit = brokenLimit(result, car, parameters.drive.tracking.mpc.step);
        for (const ParkingLeg &leg : result.legs)
            for (const DriveRecord &record : leg.drive.log)
                report.fastest = std::max(report.fastest, std::abs(record.measurement.speed) / car.maxSpeed);
        if (result.trajectory.empty())
            return report;
        report.stands = result.trajectory.back().v == 0.0;
        report.duration = result.trajectory.back().t;
        // An event at the begin of a period can affect the brake in the next one.
        const Disturbances &odds = parameters.drive.disturbances;
        const double period = parameters.drive.tracking.mpc.step, reaction = period + odds.delay;
        const PolygonOracle before(scenario);
        const auto touchesKnown = [&](const Touch &touch, const PolygonOracle &oracle, const std::string &what)
        {
            const std::optional<double> seen = wheelsSeenToStick(result, odds, touch.time);
            const bool avoidable = !seen || isFree(brakingWay(result.trajectory, car, odds, *seen, *seen + reaction),
                                                   car, oracle, SPARE_BESIDE);
            report.otherAvoidable = report.otherAvoidable || avoidable;
            report.hitOther = true;
            report.impactSpeed = std::max(report.impactSpeed, touch.speed);
            report.events.push_back(rounded(touch.time) + " s: touches " + what);
        };
        if (const std::optional<Touch> touch = firstTouch(result.trajectory, car, before, 0.0))
            touchesKnown(*touch, before, "an obstacle of the scenario");
        if (!surprise)
            return report;
        report.appeared = true;
        report.ahead = surprise->ahead;
        report.avoidable = isFree(brakingWay(expected, car, odds, surprise->time, surprise->time + reaction), car,
                                  alone(surprise->obstacle), SPARE);
        const std::optional<Touch> touch =
            firstTouch(result.trajectory, car, alone(surprise->obstacle), surprise->time);
        // A drive planned around it is no longer unprepared.
        if (touch && legAt(result, touch->time).begin > surprise->time)
            touchesKnown(*touch, alone(surprise->obstacle), "the appeared obstacle");
        else if (touch)
        {
            report.hitAppeared = true;
            report.events.push_back(rounded(touch->time) + " s: touches the appeared obstacle");
            report.impactSpeed = std::max(report.impactSpeed, touch->speed);
        }
        return report;
    }
}  // namespace parking

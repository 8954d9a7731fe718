#include "benchmarks/studies/TroubledDrives.h"

#include "benchmarks/studies/Surprise.h"
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
        /** Minimum distance in metres to obstacles of the scenario, beside which cars park. */
        constexpr double SPARE_BESIDE = 0.01;
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
            const bool avoidable = !seen || isFree(brakingPath(result.trajectory, car, odds, *seen, *seen + reaction),
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
        report.avoidable = isFree(brakingPath(expected, car, odds, surprise->time, surprise->time + reaction), car,
                                  alone(surprise->obstacle), SPARE_AT_STOP);
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

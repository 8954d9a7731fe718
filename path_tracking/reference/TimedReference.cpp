#include "path_tracking/reference/TimedReference.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace parking
{
    namespace
    {
        constexpr double STEP = 0.02;         // seconds between two moments of a motion
        constexpr double WAY = 0.05;          // metres between two moments
        constexpr double LIMIT_SLACK = 1e-6;  // share of a limit reserved for rounding

        void check(const TimedMotion &motion, const Vehicle &vehicle)
        {
            vehicle.validate();
            const std::string what = "timed motion: ";
            if (motion.knots.size() < 2)
                throw Error(what + "it has " + std::to_string(motion.knots.size()) +
                            " knots; at least two are required");
            if (!isFinite(motion.start))
                throw Error(what + "its start is not finite");
            if (motion.knots.front().v != 0.0 || motion.knots.back().v != 0.0)
                throw Error(what + "it does not begin and end at rest");
            const auto most = [](double limit)
            {
                return limit * (1.0 + LIMIT_SLACK);
            };
            for (std::size_t i = 0; i < motion.knots.size(); ++i)
            {
                const MotionKnot &knot = motion.knots[i];
                const std::string where = what + "at knot " + std::to_string(i + 1) + " ";
                if (!std::isfinite(knot.t) || !std::isfinite(knot.v) || !std::isfinite(knot.steering))
                    throw Error(where + "a number is not finite");
                if (std::abs(knot.v) > most(vehicle.maxSpeed))
                    throw Error(where + "the speed is " + formatNumber(knot.v) + " m/s; the car's limit is " +
                                formatNumber(vehicle.maxSpeed));
                if (std::abs(knot.steering) > most(vehicle.maxSteeringAngle))
                    throw Error(where + "the steering angle is " + formatNumber(knot.steering) +
                                " rad; the car's limit is " + formatNumber(vehicle.maxSteeringAngle));
                if (i == 0)
                    continue;
                const MotionKnot &before = motion.knots[i - 1];
                const double h = knot.t - before.t;
                if (!(h > 0.0))
                    throw Error(where + "the time does not increase");
                if (before.v * knot.v < 0.0)
                    throw Error(where + "the direction changes without standstill");
                if (std::abs(knot.v - before.v) > most(vehicle.maxAcceleration) * h + LIMIT_SLACK)
                    throw Error(where + "the acceleration is beyond the car's " +
                                formatNumber(vehicle.maxAcceleration) + " m/s^2");
                if (std::abs(knot.steering - before.steering) > most(vehicle.maxSteeringRate) * h + LIMIT_SLACK)
                    throw Error(where + "the steering rate is beyond the car's " +
                                formatNumber(vehicle.maxSteeringRate) + " rad/s");
            }
            if (!(motion.duration() <= LONGEST_MOTION))
                throw Error(what + "it takes " + formatNumber(std::round(motion.duration())) + " s; at most " +
                            formatNumber(LONGEST_MOTION) + " s are supported");
        }
    }  // namespace

    TimedReference::TimedReference(const ReferencePath &path, const SpeedLimits &limits, double initialSteering)
      : steeringRate_(limits.steeringRate),
        cornerDeviation_(path.drivable().deviation)
    {
        limits.validate();
        const double most = path.vehicle().maxSteeringAngle;
        if (!(std::abs(initialSteering) <= most + 1e-9))
            throw Error("speed profile: the initial steering angle is " + formatNumber(initialSteering) +
                        " rad; the car steers up to " + formatNumber(most) + " rad");
        finalSteering_ = initialSteering;
        for (std::size_t i = 0; i < path.legs().size(); ++i)
        {
            const ReferenceLeg &leg = path.legs()[i];
            const std::vector<SpeedPoint> drive = fastestDrive(leg.steering, limits, path.vehicle());
            const double angle = leg.steering.front().angle;
            legs_.push_back({leg.direction, leg.beginLength, leg.endLength,
                             std::abs(angle - finalSteering_) / limits.steeringRate, drive.back().t, angle});
            finalSteering_ = leg.steering.back().angle;
            std::vector<TimedState> &moments = moments_.emplace_back();
            const auto add = [&](const SpeedPoint &at)
            {
                moments.push_back({at.t, at.s, at.speed, path.steering(i, at.s), path.pose(i, at.s)});
            };
            add(drive.front());
            for (std::size_t k = 1; k < drive.size(); ++k)
            {
                const SpeedPoint &a = drive[k - 1], &b = drive[k];
                const double duration = b.t - a.t;
                const double parts = std::ceil(duration * std::max(a.speed, b.speed) / WAY);
                for (double p = 1.0; p < parts; p += 1.0)
                {
                    const double time = duration * p / parts, speed = a.speed + (b.speed - a.speed) * p / parts;
                    add({a.t + time, a.s + 0.5 * time * (a.speed + speed), speed});
                }
                add(b);
            }
        }
    }

    TimedReference::TimedReference(const TimedMotion &motion, const Vehicle &vehicle)
      : steeringRate_((check(motion, vehicle), vehicle.maxSteeringRate))
    {
        double standstill = 0.0, s = 0.0, begin = 0.0;
        bool drives = false;
        visitParts(
            motion, vehicle, STEP, WAY,
            [&](const MotionPart &part)
            {
                const double length = part.length();
                if (length == 0.0)
                {
                    standstill += part.duration();
                    finalSteering_ = part.to.steering;
                    return true;
                }
                if (!drives)
                {
                    legs_.push_back({length > 0.0 ? 1 : -1, s, s, standstill, 0.0, part.from.steering});
                    moments_.push_back({{0.0, s, 0.0, part.from.steering, part.before}});
                    begin = part.from.t;
                    standstill = 0.0;
                }
                s += std::abs(length);
                moments_.back().push_back({part.to.t - begin, s, std::abs(part.to.v), part.to.steering, part.after});
                legs_.back().endLength = s;
                legs_.back().duration = part.to.t - begin;
                finalSteering_ = part.to.steering;
                drives = part.to.v != 0.0;
                return true;
            });
        if (legs_.empty())
            throw Error("timed motion: it never drives");
        finalStandstill_ = standstill;
    }

    double TimedReference::beginOf(std::size_t leg) const
    {
        double sum = legs_[leg].standstill;
        for (std::size_t i = 0; i < leg; ++i)
            sum += legs_[i].standstill + legs_[i].duration;
        return sum;
    }

    double TimedReference::duration() const
    {
        return beginOf(legs_.size() - 1) + legs_.back().duration + finalStandstill_;
    }

    Pose TimedReference::poseBetween(const TimedState &a, const TimedState &b, double s) const
    {
        const Pose chord = relativeTo(a.pose, b.pose);
        const double length = std::copysign(b.s - a.s, chord.x);
        Pose pose = b.s > a.s ? advance(a.pose, chord.yaw / length, length * (s - a.s) / (b.s - a.s)) : b.pose;
        pose.yaw = wrapAngle(pose.yaw);
        return pose;
    }

    TimedState TimedReference::at(std::size_t leg, double time) const
    {
        const std::vector<TimedState> &moments = moments_[leg];
        const auto next = std::upper_bound(moments.begin() + 1, moments.end() - 1, time,
                                           [](double value, const TimedState &moment) { return value < moment.t; });
        const TimedState &a = *(next - 1), &b = *next;
        const double h = b.t - a.t, part = h > 0.0 ? std::clamp((time - a.t) / h, 0.0, 1.0) : 1.0;
        TimedState state;
        state.t = a.t + part * h;
        state.speed = a.speed + part * (b.speed - a.speed);
        state.steering = a.steering + part * (b.steering - a.steering);
        state.s = std::clamp(a.s + 0.5 * part * h * (a.speed + state.speed), a.s, b.s);
        state.pose = poseBetween(a, b, state.s);
        return state;
    }

    /** The first moment of a leg at or after \e s, except its very first. */
    const TimedState &TimedReference::behind(std::size_t leg, double s) const
    {
        const std::vector<TimedState> &moments = moments_[leg];
        return *std::lower_bound(moments.begin() + 1, moments.end() - 1, s,
                                 [](const TimedState &moment, double value) { return moment.s < value; });
    }

    double TimedReference::steering(std::size_t leg, double s) const
    {
        const TimedState *b = &behind(leg, s), *a = b - 1;
        const double part = b->s > a->s ? std::clamp((s - a->s) / (b->s - a->s), 0.0, 1.0) : 1.0;
        return a->steering + part * (b->steering - a->steering);
    }

    PathProjection TimedReference::project(std::size_t leg, const Pose &pose, double from, double to) const
    {
        const TimedLeg &l = legs_[leg];
        from = std::clamp(from, l.beginLength, l.endLength);
        to = std::clamp(to, from, l.endLength);
        double best = std::numeric_limits<double>::infinity(), s = from;
        for (const TimedState *b = &behind(leg, from); b <= &moments_[leg].back(); ++b)
        {
            const TimedState *a = b - 1;
            const double length = b->s - a->s;
            const double dx = b->pose.x - a->pose.x, dy = b->pose.y - a->pose.y, squared = dx * dx + dy * dy;
            const double lowest = length > 0.0 ? std::clamp((from - a->s) / length, 0.0, 1.0) : 0.0;
            const double highest = length > 0.0 ? std::clamp((to - a->s) / length, lowest, 1.0) : 1.0;
            const double part =
                squared > 0.0
                    ? std::clamp(((pose.x - a->pose.x) * dx + (pose.y - a->pose.y) * dy) / squared, lowest, highest)
                    : lowest;
            const double apart = std::hypot(pose.x - a->pose.x - part * dx, pose.y - a->pose.y - part * dy);
            if (apart < best)
            {
                best = apart;
                s = a->s + part * length;
            }
            if (b->s >= to)
                break;
        }
        // From the chord to the arc: one step along it.
        const auto offset = [&]
        {
            const TimedState &b = behind(leg, s);
            return relativeTo(poseBetween(*(&b - 1), b, s), pose);
        };
        s = std::clamp(s + l.direction * offset().x, from, to);
        const Pose off = offset();
        return {s, off.y, wrapAngle(off.yaw), l.direction * off.x, std::hypot(off.x, off.y)};
    }

    Pose TimedReference::end() const
    {
        Pose pose = moments_.back().back().pose;
        pose.yaw = wrapAngle(pose.yaw);
        return pose;
    }
}  // namespace parking

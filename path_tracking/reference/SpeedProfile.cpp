#include "path_tracking/reference/SpeedProfile.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Require.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace parking
{
    namespace
    {
        /** With less than this of any limit no drive ends within sensible time. */
        constexpr double LEAST_LIMIT = 0.01;
        /** Points of a sampled profile. */
        constexpr double MOST_POINTS = 1e7;

        /** A part of a leg with one cap on the squared speed. */
        struct CapInterval
        {
            double begin;
            double end;
            double cap;
        };

        void checkLimit(const char *field, double value, const char *unit)
        {
            Require("speed limits")
                .that(std::isfinite(value) && value >= LEAST_LIMIT, field, value,
                      "at least " + formatNumber(LEAST_LIMIT) + " " + unit);
        }

        void checkSteering(const char *which, double angle, const Vehicle &vehicle)
        {
            if (!(std::abs(angle) <= vehicle.maxSteeringAngle + 1e-9))
                throw Error(std::string("speed profile: the ") + which + " steering angle is " + formatNumber(angle) +
                            " rad; the car steers up to " + formatNumber(vehicle.maxSteeringAngle) + " rad");
        }

        std::vector<CapInterval> capIntervals(const ReferenceLeg &leg, const Vehicle &vehicle,
                                              const SpeedLimits &limits)
        {
            std::vector<CapInterval> intervals;
            for (std::size_t i = 1; i < leg.steering.size(); ++i)
            {
                const SteeringKnot &a = leg.steering[i - 1], &b = leg.steering[i];
                const double slope = std::abs(b.angle - a.angle) / (b.s - a.s);
                double speed = limits.speed;
                if (slope > 0.0)
                    speed = std::min(speed, limits.steeringRate / slope);
                double cap = speed * speed;
                const double angle = std::max(std::abs(a.angle), std::abs(b.angle));
                if (angle > 0.0)
                    cap = std::min(cap, limits.lateralAcceleration / vehicle.curvature(angle));
                intervals.push_back({a.s, b.s, cap});
            }
            return intervals;
        }
    }  // namespace

    SpeedLimits SpeedLimits::of(const Vehicle &vehicle)
    {
        SpeedLimits limits;
        limits.speed = vehicle.maxSpeed;
        limits.acceleration = vehicle.maxAcceleration;
        limits.steeringRate = vehicle.maxSteeringRate;
        return limits;
    }

    void SpeedLimits::validate() const
    {
        checkLimit("speed", speed, "m/s");
        checkLimit("acceleration", acceleration, "m/s^2");
        checkLimit("steeringRate", steeringRate, "rad/s");
        checkLimit("lateralAcceleration", lateralAcceleration, "m/s^2");
    }

    SpeedProfile::SpeedProfile(const Path &path, const Vehicle &vehicle)
      : SpeedProfile(ReferencePath(path, vehicle), SpeedLimits::of(vehicle))
    {
    }

    SpeedProfile::SpeedProfile(ReferencePath reference, const SpeedLimits &limits, double initialSteering,
                               std::optional<double> finalSteering)
      : reference_(std::move(reference)),
        limits_(limits)
    {
        limits.validate();
        checkSteering("initial", initialSteering, reference_.vehicle());
        double steering = initialSteering;
        timelines_.reserve(reference_.legs().size());
        for (std::size_t leg = 0; leg < reference_.legs().size(); ++leg)
        {
            timelines_.push_back(makeTimeline(leg));
            Timeline &timeline = timelines_.back();
            timeline.steeringFrom = steering;
            timeline.steeringTime =
                std::abs(reference_.legs()[leg].steering.front().angle - steering) / limits.steeringRate;
            steering = reference_.legs()[leg].steering.back().angle;
        }
        lastSteering_ = steering;
        finalSteering_ = finalSteering.value_or(steering);
        checkSteering("final", finalSteering_, reference_.vehicle());
        finalSteeringTime_ = std::abs(finalSteering_ - lastSteering_) / limits.steeringRate;
    }

    SpeedProfile::Timeline SpeedProfile::makeTimeline(std::size_t leg) const
    {
        const std::vector<CapInterval> intervals = capIntervals(reference_.legs()[leg], reference_.vehicle(), limits_);
        const std::size_t n = intervals.size();
        const double doubled = 2.0 * limits_.acceleration;
        // Squared speed at the borders: at rest at both ends, within both neighbouring caps, reachable from both sides.
        std::vector<double> squared(n + 1, 0.0);
        for (std::size_t i = 1; i < n; ++i)
            squared[i] = std::min({intervals[i - 1].cap, intervals[i].cap,
                                   squared[i - 1] + doubled * (intervals[i - 1].end - intervals[i - 1].begin)});
        for (std::size_t i = n; i-- > 0;)
            squared[i] = std::min(squared[i], squared[i + 1] + doubled * (intervals[i].end - intervals[i].begin));

        Timeline timeline;
        timeline.phases.reserve(3 * n);
        double time = 0.0;
        const auto add = [&](double s, double length, double from, double to)
        {
            if (length <= 0.0)
                return;
            const double a = std::sqrt(from), b = std::sqrt(to);
            const double acceleration = from == to ? 0.0 : to > from ? limits_.acceleration : -limits_.acceleration;
            if (timeline.phases.empty() || timeline.phases.back().acceleration != acceleration)
                timeline.phases.push_back({time, s, a, acceleration});
            time += 2.0 * length / (a + b);
        };
        for (std::size_t i = 0; i < n; ++i)
        {
            const CapInterval &interval = intervals[i];
            const double length = interval.end - interval.begin;
            const double from = squared[i], to = squared[i + 1];
            const double peak = std::min(interval.cap, 0.5 * (from + to + doubled * length));
            const double rise = std::max(0.0, (peak - from) / doubled);
            const double fall = std::max(0.0, (peak - to) / doubled);
            const double cruise = length - rise - fall;
            add(interval.begin, rise, from, peak);
            if (cruise > 1e-12)
                add(interval.begin + rise, cruise, peak, peak);
            add(interval.end - fall, fall, peak, to);
        }
        timeline.duration = time;
        return timeline;
    }

    double SpeedProfile::duration() const
    {
        double sum = finalSteeringTime_;
        for (const Timeline &timeline : timelines_)
            sum += timeline.steeringTime + timeline.duration;
        return sum;
    }

    ProfilePoint SpeedProfile::at(std::size_t leg, double time) const
    {
        const Timeline &timeline = timelines_[leg];
        if (time <= 0.0)
            return {reference_.legs()[leg].beginLength, 0.0, 0.0};
        if (time >= timeline.duration)
            return {reference_.legs()[leg].endLength, 0.0, 0.0};
        const auto next = std::upper_bound(timeline.phases.begin() + 1, timeline.phases.end(), time,
                                           [](double value, const Phase &phase) { return value < phase.time; });
        const Phase &phase = *(next - 1);
        const double t = time - phase.time;
        return {std::min(phase.s + t * (phase.speed + 0.5 * t * phase.acceleration), reference_.legs()[leg].endLength),
                std::max(0.0, phase.speed + t * phase.acceleration), phase.acceleration};
    }

    double SpeedProfile::timeAt(std::size_t leg, double s) const
    {
        const Timeline &timeline = timelines_[leg];
        if (s <= reference_.legs()[leg].beginLength)
            return 0.0;
        if (s >= reference_.legs()[leg].endLength)
            return timeline.duration;
        const auto next = std::upper_bound(timeline.phases.begin() + 1, timeline.phases.end(), s,
                                           [](double value, const Phase &phase) { return value < phase.s; });
        const Phase &phase = *(next - 1);
        const double way = s - phase.s;
        const double reached = std::sqrt(std::max(0.0, phase.speed * phase.speed + 2.0 * phase.acceleration * way));
        return std::min(phase.time + (phase.speed + reached > 0.0 ? 2.0 * way / (phase.speed + reached) : 0.0),
                        timeline.duration);
    }

    Trajectory SpeedProfile::sample(double step) const
    {
        if (!(std::isfinite(step) && step > 0.0))
            throw Error("speed profile: the step is " + formatNumber(step) +
                        "; it must be a positive number of seconds");
        Trajectory trajectory;
        const double total = duration();
        if (total / step > MOST_POINTS)
            throw Error("speed profile: a step of " + formatNumber(step) + " s makes more than " +
                        formatNumber(MOST_POINTS) + " points of " + formatNumber(total) + " s");
        trajectory.reserve(static_cast<std::size_t>(total / step) + 2);
        std::size_t leg = 0;
        double legBegin = 0.0;  // time at which the standstill before the leg begins
        const auto standing = [&](double t, const Pose &pose, double from, double to, double since)
        {
            const double rate = to == from ? 0.0 : std::copysign(limits_.steeringRate, to - from);
            trajectory.push_back({t, pose.x, pose.y, pose.yaw, 0.0, 0.0, from + rate * since, rate});
        };
        for (std::size_t i = 0;; ++i)
        {
            const double t = std::min(static_cast<double>(i) * step, total);
            while (leg < timelines_.size() && t >= legBegin + timelines_[leg].steeringTime + timelines_[leg].duration)
            {
                legBegin += timelines_[leg].steeringTime + timelines_[leg].duration;
                ++leg;
            }
            if (t >= total)
            {
                const Pose pose = reference_.end();
                trajectory.push_back({total, pose.x, pose.y, pose.yaw, 0.0, 0.0, finalSteering_, 0.0});
                return trajectory;
            }
            if (leg == timelines_.size())
            {
                standing(t, reference_.end(), lastSteering_, finalSteering_, t - legBegin);
                continue;
            }
            const ReferenceLeg &l = reference_.legs()[leg];
            const double since = t - legBegin - timelines_[leg].steeringTime;
            if (since < 0.0)
            {
                standing(t, reference_.pose(leg, l.beginLength), timelines_[leg].steeringFrom, l.steering.front().angle,
                         t - legBegin);
                continue;
            }
            const ProfilePoint point = at(leg, since);
            const Pose pose = reference_.pose(leg, point.s);
            trajectory.push_back({t, pose.x, pose.y, pose.yaw, l.direction * point.speed,
                                  l.direction * point.acceleration, reference_.steering(leg, point.s),
                                  reference_.steeringSlope(leg, point.s) * point.speed});
        }
    }
}  // namespace parking

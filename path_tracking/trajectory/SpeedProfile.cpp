#include "path_tracking/trajectory/SpeedProfile.h"

#include "parking_geometry/text/Require.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace parking
{
    namespace
    {
        /** Below this value of any limit, drives take unreasonably long. */
        constexpr double MIN_LIMIT = 0.01;

        /** Maximum squared speed between two knots. */
        double capBetween(const SteeringKnot &a, const SteeringKnot &b, const SpeedLimits &limits,
                          const Vehicle &vehicle)
        {
            const double change = std::abs(b.angle - a.angle);
            double speed = limits.speed;
            if (change > 0.0)
                speed = std::min(speed, limits.steeringRate * (b.s - a.s) / change);
            const double angle = std::max(std::abs(a.angle), std::abs(b.angle));
            if (angle == 0.0)
                return speed * speed;
            return std::min(speed * speed, limits.lateralAcceleration / vehicle.curvature(angle));
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
        const Require require("speed limits");
        const auto check = [&require](const char *field, double value, const char *unit)
        {
            require.that(std::isfinite(value) && value >= MIN_LIMIT, field, value,
                         "at least " + formatNumber(MIN_LIMIT) + " " + unit);
        };
        check("speed", speed, "m/s");
        check("acceleration", acceleration, "m/s^2");
        check("steeringRate", steeringRate, "rad/s");
        check("lateralAcceleration", lateralAcceleration, "m/s^2");
    }

    double steeringAt(const std::vector<SteeringKnot> &knots, double s)
    {
        const auto next = std::upper_bound(knots.begin() + 1, knots.end() - 1, s,
                                           [](double value, const SteeringKnot &knot) { return value < knot.s; });
        const SteeringKnot &a = *(next - 1), &b = *next;
        return a.angle + std::clamp((s - a.s) / (b.s - a.s), 0.0, 1.0) * (b.angle - a.angle);
    }

    std::vector<double> squaredSpeeds(const std::vector<double> &lengths, const std::vector<double> &caps,
                                      double acceleration, double initial)
    {
        const std::size_t n = lengths.size();
        std::vector<double> squared(n + 1, 0.0);
        squared.front() = initial;
        for (std::size_t i = 1; i < n; ++i)
            squared[i] = std::min({caps[i - 1], caps[i], squared[i - 1] + 2.0 * acceleration * lengths[i - 1]});
        for (std::size_t i = n; i-- > 0;)
            squared[i] = std::min(squared[i], squared[i + 1] + 2.0 * acceleration * lengths[i]);
        return squared;
    }

    std::vector<SpeedPoint> fastestDrive(const std::vector<SteeringKnot> &leg, const SpeedLimits &limits,
                                         const Vehicle &vehicle)
    {
        std::vector<double> lengths, caps;
        for (std::size_t i = 1; i < leg.size(); ++i)
        {
            lengths.push_back(leg[i].s - leg[i - 1].s);
            caps.push_back(capBetween(leg[i - 1], leg[i], limits, vehicle));
        }
        const double doubled = 2.0 * limits.acceleration;
        const std::vector<double> squared = squaredSpeeds(lengths, caps, limits.acceleration);
        std::vector<SpeedPoint> points{{0.0, leg.front().s, 0.0}};
        const auto driveTo = [&points](double s, double squaredSpeed)
        {
            const SpeedPoint &from = points.back();
            const double speed = std::sqrt(squaredSpeed), length = s - from.s;
            if (length > 0.0)
                points.push_back({from.t + 2.0 * length / (from.speed + speed), s, speed});
        };
        for (std::size_t i = 0; i < lengths.size(); ++i)
        {
            const double from = squared[i], to = squared[i + 1];
            const double peak = std::max({from, to, std::min(caps[i], 0.5 * (from + to + doubled * lengths[i]))});
            driveTo(leg[i].s + (peak - from) / doubled, peak);
            driveTo(leg[i + 1].s - (peak - to) / doubled, peak);
            driveTo(leg[i + 1].s, to);
        }
        return points;
    }
}  // namespace parking

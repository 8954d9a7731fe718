#include "path_tracking/trajectory/TimedMotion.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        /** Speeds below this, in m/s, do not define a gear. */
        constexpr double STANDING = 1e-6;
        /** Negligible duration in seconds. */
        constexpr double NO_TIME = 1e-9;

        Pose step(const Pose &pose, const MotionKnot &from, const MotionKnot &to, double wheelbase)
        {
            const double h = to.t - from.t;
            const MotionKnot middle = between(from, to, 0.5);
            const double w0 = from.v * std::tan(from.steering) / wheelbase;
            const double wm = middle.v * std::tan(middle.steering) / wheelbase;
            const double w1 = to.v * std::tan(to.steering) / wheelbase;
            // The yaw depends on time only, so that its stages need no poses.
            const double yawMiddle = pose.yaw + h * (5.0 * w0 + 8.0 * wm - w1) / 24.0;
            const double yaw = pose.yaw + h * (w0 + 4.0 * wm + w1) / 6.0;
            const auto simpson = [&](double at0, double atMiddle, double at1)
            {
                return h * (from.v * at0 + 4.0 * middle.v * atMiddle + to.v * at1) / 6.0;
            };
            return {pose.x + simpson(std::cos(pose.yaw), std::cos(yawMiddle), std::cos(yaw)),
                    pose.y + simpson(std::sin(pose.yaw), std::sin(yawMiddle), std::sin(yaw)), yaw};
        }
    }  // namespace

    MotionKnot between(const MotionKnot &a, const MotionKnot &b, double part)
    {
        return {a.t + part * (b.t - a.t), a.v + part * (b.v - a.v), a.steering + part * (b.steering - a.steering)};
    }

    void TimedMotion::append(double after, double v, double steering)
    {
        if (knots.empty())
        {
            knots.push_back({after, v, steering});
            return;
        }
        if (after > NO_TIME)
            knots.push_back({knots.back().t + after, v, steering});
        else
            knots.back() = {knots.back().t, v, steering};
    }

    bool visitParts(const TimedMotion &motion, const Vehicle &vehicle, double longest, double length,
                    const std::function<bool(const MotionPart &)> &visit)
    {
        Pose pose = motion.start;
        for (std::size_t i = 1; i < motion.knots.size(); ++i)
        {
            const MotionKnot &a = motion.knots[i - 1], &b = motion.knots[i];
            const double h = b.t - a.t, driven = h * 0.5 * (std::abs(a.v) + std::abs(b.v));
            const double fastest = h * std::max(std::abs(a.v), std::abs(b.v));
            const double parts =
                driven == 0.0 ? 1.0 : std::max({1.0, std::ceil(h / longest), std::ceil(fastest / length)});
            MotionKnot from = a;
            for (double k = 1.0; k <= parts; k += 1.0)
            {
                const MotionKnot to = k == parts ? b : between(a, b, k / parts);
                const Pose after = driven == 0.0 ? pose : step(pose, from, to, vehicle.wheelbase);
                if (!visit({from, to, pose, after}))
                    return false;
                from = to;
                pose = after;
            }
        }
        return true;
    }

    Pose endOf(const TimedMotion &motion, const Vehicle &vehicle)
    {
        Pose end = motion.start;
        visitParts(motion, vehicle, 0.02, 0.05,
                   [&end](const MotionPart &part)
                   {
                       end = part.after;
                       return true;
                   });
        return end;
    }

    TimedMotion restOf(const TimedMotion &motion, const Vehicle &vehicle, double driven)
    {
        TimedMotion rest{motion.start, {}};
        double s = 0.0;
        visitParts(motion, vehicle, 0.02, 0.05,
                   [&](const MotionPart &part)
                   {
                       s += std::abs(part.length());
                       if (s < driven)
                           return true;
                       if (rest.knots.empty())
                       {
                           rest.start = part.before;
                           rest.knots.push_back(part.from);
                       }
                       rest.knots.push_back(part.to);
                       return true;
                   });
        return rest;
    }

    Trajectory sample(const TimedMotion &motion, const Vehicle &vehicle, double step)
    {
        Trajectory trajectory;
        const auto add = [&trajectory](const MotionKnot &at, const Pose &pose, double a, double w)
        {
            trajectory.push_back({at.t, pose.x, pose.y, wrapAngle(pose.yaw), at.v, a, at.steering, w});
        };
        visitParts(motion, vehicle, std::min(step, 0.05), 0.05,
                   [&](const MotionPart &part)
                   {
                       const double h = part.duration();
                       const double a = (part.to.v - part.from.v) / h;
                       const double w = (part.to.steering - part.from.steering) / h;
                       if (trajectory.empty())
                           add(part.from, part.before, a, w);
                       trajectory.back().acceleration = a;
                       trajectory.back().steeringRate = w;
                       add(part.to, part.after, a, w);
                       return true;
                   });
        if (trajectory.empty() && !motion.knots.empty())
            add(motion.knots.front(), motion.start, 0.0, 0.0);
        return trajectory;
    }

    TpcapCost tpcapCost(const TimedMotion &motion)
    {
        TpcapCost cost;
        cost.time = motion.duration();
        int gear = 0;
        for (std::size_t i = 1; i < motion.knots.size(); ++i)
        {
            const MotionKnot &a = motion.knots[i - 1], &b = motion.knots[i];
            const double h = b.t - a.t, dv = b.v - a.v, dw = b.steering - a.steering;
            // Squares of functions that are linear over the interval.
            const double meanSquareSpeed = (a.v * a.v + a.v * b.v + b.v * b.v) / 3.0;
            cost.controlEffort += (dv * dv + meanSquareSpeed * dw * dw) / h;
            cost.steeringIntegral +=
                h * (a.steering * a.steering + a.steering * b.steering + b.steering * b.steering) / 3.0;
            const double mean = 0.5 * (a.v + b.v);
            const int now = mean > STANDING ? 1 : mean < -STANDING ? -1 : 0;
            cost.gearChanges += now != 0 && gear != 0 && now != gear ? 1 : 0;
            gear = now != 0 ? now : gear;
        }
        return cost;
    }
}  // namespace parking

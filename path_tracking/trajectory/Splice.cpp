#include "path_tracking/trajectory/Splice.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        constexpr double STEP = 0.02, WAY = 0.05;  // seconds and metres of a part
        constexpr double NO_TIME = 1e-9;           // seconds
    }                                              // namespace

    TimedMotion beginOf(const TimedMotion &motion, double time)
    {
        TimedMotion begin{motion.start, {motion.knots.front()}};
        const double end = motion.knots.front().t + std::max(0.0, time);
        for (std::size_t i = 1; i < motion.knots.size(); ++i)
        {
            const MotionKnot &a = motion.knots[i - 1], &b = motion.knots[i];
            if (b.t <= end)
            {
                begin.knots.push_back(b);
                continue;
            }
            if (end - a.t > NO_TIME)
                begin.knots.push_back(between(a, b, (end - a.t) / (b.t - a.t)));
            break;
        }
        return begin;
    }

    TimedMotion stopAfter(const TimedMotion &motion, const Vehicle &vehicle, double time, double deceleration)
    {
        TimedMotion stopping = beginOf(motion, time);
        const MotionKnot last = stopping.knots.back();
        if (last.v == 0.0)
            return stopping;
        TimedMotion rest{{}, {last}};  // the braking depends on lengths, not on poses
        for (const MotionKnot &knot : motion.knots)
            if (knot.t > last.t + NO_TIME)
                rest.knots.push_back(knot);
        double squared = last.v * last.v;
        visitParts(rest, vehicle, STEP, WAY,
                   [&](const MotionPart &part)
                   {
                       const double length = std::abs(part.length());
                       const double speed = std::sqrt(squared);
                       const double left = squared - 2.0 * deceleration * length;
                       const double sign = part.from.v + part.to.v < 0.0 ? -1.0 : 1.0;
                       if (left <= 0.0)
                       {
                           const double share = length > 0.0 ? squared / (2.0 * deceleration * length) : 0.0;
                           stopping.append(speed / deceleration, 0.0, between(part.from, part.to, share).steering);
                           squared = 0.0;
                           return false;
                       }
                       const double next = std::min(std::sqrt(left), std::abs(part.to.v));
                       stopping.append(2.0 * length / (speed + next), sign * next, part.to.steering);
                       squared = next * next;
                       return squared > 0.0;
                   });
        return stopping;
    }

    TimedMotion joined(TimedMotion begin, const TimedMotion &next)
    {
        const double shift = begin.knots.back().t - next.knots.front().t;
        for (std::size_t i = 1; i < next.knots.size(); ++i)
        {
            begin.knots.push_back(next.knots[i]);
            begin.knots.back().t += shift;
        }
        return begin;
    }
}  // namespace parking

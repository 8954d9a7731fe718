#include "path_tracking/trajectory/JerkLimit.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Require.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace parking
{
    namespace
    {
        constexpr double LIMITS_LEFT = 1e-4;         // share of the limits that is left for rounding
        constexpr int JERK_BISECTIONS = 12;          // to find how much jerk a step may have
        constexpr int BISECTIONS = 24;               // to find when a step passes a bend
        constexpr double LEFT_OVER = 1e-5;           // share of a way that is too short to be driven
        constexpr double LEAST_SHARE = 1e-3;         // of a step or a jerk, that is tried
        constexpr double LOOK = 0.02;                // seconds between two looks at how it would stop
        constexpr double SHORTEST = 1e-6;            // seconds of a phase of braking
        constexpr double LEAST_STEP = 2e-3;          // seconds between two knots
        constexpr double CREEPING = 5e-4;            // m/s of a knot that count as a standstill
        constexpr double AT_REST = 1e-9;             // m/s, and m/s^2, that count as none
        constexpr std::size_t MOST_STEPS = 1000000;  // of a stretch: more never happens

        /** How far a stretch has been driven, how fast, and with which acceleration. */
        struct Progress
        {
            double s{0.0}, v{0.0}, a{0.0};

            /** After \e time with constant \e jerk. */
            Progress after(double time, double jerk) const
            {
                return {s + time * (v + time * (a / 2.0 + time * jerk / 6.0)), v + time * (a + time * jerk / 2.0),
                        a + time * jerk};
            }
        };

        /** A time with constant jerk. */
        struct Phase
        {
            double time, jerk;
        };

        /** What is driven between two standstills: speed and steering angle by the way. */
        class DrivenWay
        {
        public:
            DrivenWay(const std::vector<MotionKnot> &knots, std::size_t first, std::size_t last)
            {
                double s = 0.0;
                for (std::size_t k = first; k <= last; ++k)
                {
                    const double v = k > first && k < last ? std::abs(knots[k].v) : 0.0;
                    if (k > first)
                        s += 0.5 * (knots_.back().v + v) * (knots[k].t - knots[k - 1].t);
                    knots_.push_back({knots[k].t, v, knots[k].steering});
                    way_.push_back(s);
                }
            }

            double length() const
            {
                return way_.back();
            }

            /** Speed and steering angle at \e s; the time is that of the motion as it was. */
            MotionKnot at(double s) const
            {
                std::size_t k = knotAt(s);
                const double speed = std::sqrt(std::max(0.0, squaredSpeed(s, k)));
                const MotionKnot &a = knots_[k], &b = knots_[k + 1];
                const double duration = b.t - a.t, off = std::clamp(s - way_[k], 0.0, way_[k + 1] - way_[k]);
                const double time = a.v + speed > 0.0 ? std::min(duration, 2.0 * off / (a.v + speed)) : 0.0;
                return {a.t + time, speed, a.steering + (b.steering - a.steering) * time / duration};
            }

            /** The last knot before \e s that another one comes after. */
            std::size_t knotAt(double s) const
            {
                return static_cast<std::size_t>(std::upper_bound(way_.begin() + 1, way_.end() - 1, s) - way_.begin()) -
                       1;
            }

            /** Square of the speed at \e s, (m/s)^2. \param knot the last one before \e s is looked for from here on */
            double squaredSpeed(double s, std::size_t &knot) const
            {
                while (knot + 2 < way_.size() && way_[knot + 1] <= s)
                    ++knot;
                while (knot > 0 && way_[knot] > s)
                    --knot;
                const MotionKnot &a = knots_[knot], &b = knots_[knot + 1];
                const double off = std::clamp(s - way_[knot], 0.0, way_[knot + 1] - way_[knot]);
                return a.v * a.v + 2.0 * (b.v - a.v) / (b.t - a.t) * off;
            }

            /** The steering angle at its end. */
            double lastAngle() const
            {
                return knots_.back().steering;
            }

            /** The highest speed on it. */
            double top() const
            {
                double most = 0.0;
                for (const MotionKnot &knot : knots_)
                    most = std::max(most, knot.v);
                return most;
            }

            /** The ways to the knots. */
            const std::vector<double> &knots() const
            {
                return way_;
            }

        private:
            std::vector<MotionKnot> knots_;  // speeds without a sign
            std::vector<double> way_;        // metres from the first knot
        };

        /** Drives a way from rest to rest: at any time as fast as is possible if it has to be able to brake from there
            without ever being faster than allowed. */
        class Driver
        {
        public:
            Driver(const DrivenWay &way, double acceleration, double jerk, double step)
              : way_(way),
                acceleration_((1.0 - LIMITS_LEFT) * acceleration),
                // More would be over within a step.
                jerk_(std::min((1.0 - LIMITS_LEFT) * jerk, 0.5 * acceleration_ / step)),
                step_(step),
                look_(std::max(step, LOOK))
            {
            }

            /** The phases of the drive; none when there are too many of them. */
            std::vector<Phase> drive() const
            {
                std::vector<Phase> phases;
                Progress now;
                while (phases.size() < MOST_STEPS)
                {
                    if (way_.length() - stopOf(now).s < LEFT_OVER * way_.length())
                    {
                        for (const Phase &phase : braking(now))
                            for (double left = phase.time; left > 0.0; left -= step_)
                                phases.push_back({std::min(step_, left), phase.jerk});
                        return phases;
                    }
                    phases.push_back(next(now));
                    now = now.after(phases.back().time, phases.back().jerk);
                    if (now.v < AT_REST && std::abs(now.a) < AT_REST)
                        now.v = now.a = 0.0;  // but for rounding
                }
                return {};
            }

        private:
            /** How the car stops soonest: the brake is pressed, held and released. */
            std::array<Phase, 3> braking(const Progress &from) const
            {
                const double most =
                    std::min(acceleration_, std::sqrt(std::max(0.0, jerk_ * from.v + 0.5 * from.a * from.a)));
                const double press = std::max(0.0, (from.a + most) / jerk_);
                const double left = from.v + (from.a * from.a - 2.0 * most * most) / (2.0 * jerk_);
                return {Phase{press, -jerk_}, Phase{most > 0.0 ? std::max(0.0, left / most) : 0.0, 0.0},
                        Phase{most / jerk_, jerk_}};
            }

            /** Where that ends. */
            Progress stopOf(Progress at) const
            {
                for (const Phase &phase : braking(at))
                    at = at.after(phase.time, phase.jerk);
                return at;
            }

            bool isAllowed(const Progress &at, std::size_t &knot) const
            {
                if (at.s > way_.length())
                    return false;
                const double speed = std::max(0.0, at.v - AT_REST);
                return speed * speed <= way_.squaredSpeed(at.s, knot);
            }

            /** Can the car stop from here before the end, and without being too fast on its way? */
            bool isSafe(const Progress &from, std::size_t knot) const
            {
                if (std::abs(from.a) > acceleration_ || from.v < 0.0 ||
                    (from.a < 0.0 && 2.0 * jerk_ * from.v < from.a * from.a) || !isAllowed(from, knot))
                    return false;
                if (stopOf(from).s > way_.length())
                    return false;
                Progress begin = from;
                for (const Phase &phase : braking(from))
                {
                    // The steps that are driven are looked at one by one, when they are.
                    for (double time = look_; time < phase.time; time += look_)
                        if (!isAllowed(begin.after(time, phase.jerk), knot))
                            return false;
                    begin = begin.after(phase.time, phase.jerk);
                    if (begin.v > AT_REST && !isAllowed(begin, knot))
                        return false;
                }
                return true;
            }

            /** What is done next: a step with as much jerk as is safe, or a step of braking. */
            Phase next(const Progress &now) const
            {
                // Near rest, and below a speed that rises slowly, a whole step is too much for any jerk.
                for (double step = step_; step > LEAST_SHARE * step_; step *= 0.25)
                    if (const auto jerk = greatestJerk(now, step))
                        return {step, *jerk};
                for (const Phase &phase : braking(now))
                    if (phase.time > SHORTEST)
                        return {std::min(step_, phase.time), phase.jerk};
                return {step_, 0.0};
            }

            /** The greatest jerk after a step of which the car can brake; none when there is none. */
            std::optional<double> greatestJerk(const Progress &now, double step) const
            {
                const std::size_t knot = way_.knotAt(now.s);
                const auto isSafeWith = [&](double jerk)
                {
                    return isSafe(now.after(step, jerk), knot);
                };
                if (isSafeWith(jerk_))
                    return jerk_;
                // At rest it is safe to stay there, and useless.
                const double least = now.v < AT_REST ? LEAST_SHARE * jerk_ : -jerk_;
                if (!isSafeWith(least))
                    return std::nullopt;
                double safe = least, unsafe = jerk_;
                for (int i = 0; i < JERK_BISECTIONS; ++i)
                {
                    const double middle = 0.5 * (safe + unsafe);
                    (isSafeWith(middle) ? safe : unsafe) = middle;
                }
                return safe;
            }

            const DrivenWay &way_;
            double acceleration_, jerk_, step_, look_;
        };

        /** Appends the drive along a way, with \e direction for the sign of its speeds; slower where it would be faster
            than before, or turn the wheels faster than \e steeringRate, by what straight lines between its knots leave
            or add. */
        void appendDrive(const DrivenWay &way, const std::vector<Phase> &phases, double direction, double steeringRate,
                         TimedMotion &motion)
        {
            // Knots where the steps end, and where the motion had some: its steering angle has a bend there.
            std::vector<MotionKnot> knots{{0.0, 0.0, 0.0}};
            const auto add = [&knots](double t, double v)
            {
                if (t - knots.back().t >= LEAST_STEP)
                    knots.push_back({t, std::max(0.0, v), 0.0});  // never the other way by rounding
            };
            Progress now;
            double begin = 0.0;
            std::size_t bend = 1;
            for (const Phase &phase : phases)
            {
                const Progress end = now.after(phase.time, phase.jerk);
                for (double low = 0.0; bend + 1 < way.knots().size() && way.knots()[bend] <= end.s; ++bend)
                {
                    double high = phase.time;
                    for (int i = 0; i < BISECTIONS; ++i)
                    {
                        const double middle = 0.5 * (low + high);
                        (now.after(middle, phase.jerk).s < way.knots()[bend] ? low : high) = middle;
                    }
                    add(begin + high, now.after(high, phase.jerk).v);
                }
                now = end;
                begin += phase.time;
                add(begin, now.v);
            }
            if (knots.size() > 1 && begin - knots.back().t < LEAST_STEP)
                knots.pop_back();
            knots.push_back({begin, 0.0, 0.0});
            // Where the speed is linear between knots the way is another one by some micrometres: the angles go by
            // that.
            std::vector<double> ways{0.0};
            for (std::size_t k = 1; k < knots.size(); ++k)
                ways.push_back(ways.back() + 0.5 * (knots[k].t - knots[k - 1].t) * (knots[k].v + knots[k - 1].v));
            const double scale = way.length() / ways.back();
            double slower = std::max(1.0, scale);
            for (std::size_t k = 0; k < knots.size(); ++k)
            {
                knots[k].v *= scale;
                knots[k].steering = k + 1 < knots.size() ? way.at(scale * ways[k]).steering : way.lastAngle();
                slower = std::max(slower, knots[k].v / way.top());
                if (k > 0)
                    slower = std::max(slower, std::abs(knots[k].steering - knots[k - 1].steering) /
                                                  ((knots[k].t - knots[k - 1].t) * steeringRate));
            }
            for (std::size_t k = 1; k < knots.size(); ++k)
                motion.append(slower * (knots[k].t - knots[k - 1].t), direction * knots[k].v / slower,
                              knots[k].steering);
        }
    }  // namespace

    TimedMotion withJerkLimit(const TimedMotion &motion, const Vehicle &vehicle, double jerk, double step)
    {
        const Require require("jerk limit");
        require.positive("jerk", jerk, "m/s^3");
        require.positive("step", step, "seconds");
        const std::vector<MotionKnot> &knots = motion.knots;
        const auto rests = [&knots](std::size_t k)
        {
            return std::abs(knots[k].v) < CREEPING;
        };
        if (knots.empty() || !rests(0) || !rests(knots.size() - 1))
            throw Error("jerk limit: the motion does not begin and end at rest");
        TimedMotion limited;
        limited.start = motion.start;
        limited.knots.push_back(knots.front());
        for (std::size_t first = 0; first + 1 < knots.size();)
        {
            std::size_t last = first + 1;
            while (last + 1 < knots.size() && !rests(last))
                ++last;
            if (last == first + 1 && rests(last))
                limited.append(knots[last].t - knots[first].t, 0.0, knots[last].steering);
            else
            {
                const DrivenWay way(knots, first, last);
                const std::vector<Phase> phases = Driver(way, vehicle.maxAcceleration, jerk, step).drive();
                if (phases.empty())
                    throw Error("jerk limit: " + formatNumber(jerk) + " m/s^3 is too little to get anywhere");
                appendDrive(way, phases, knots[first + 1].v + knots[first].v > 0.0 ? 1.0 : -1.0,
                            vehicle.maxSteeringRate, limited);
            }
            first = last;
        }
        return limited;
    }
}  // namespace parking

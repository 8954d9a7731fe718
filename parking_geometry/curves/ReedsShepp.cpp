#include "parking_geometry/curves/ReedsShepp.h"

#include "parking_geometry/Error.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        // Angles so close below zero are rounding errors, not full turns.
        constexpr double ZERO = 1e-10;
        constexpr double HALF_PI = 0.5 * PI;

        enum Turn : signed char
        {
            R = -1,
            S = 0,
            L = 1
        };

        /** A word with its lengths in units of the turning radius (angles for turns), signed by direction. */
        struct Word
        {
            const Turn *turns;
            std::size_t count;
            std::array<double, 5> lengths;
            bool mirrored;  // left and right swapped
        };

        constexpr Turn LSL[] = {L, S, L};
        constexpr Turn LSR[] = {L, S, R};
        constexpr Turn LRL[] = {L, R, L};
        constexpr Turn RLR[] = {R, L, R};
        constexpr Turn LRLR[] = {L, R, L, R};
        constexpr Turn LRSL[] = {L, R, S, L};
        constexpr Turn LRSR[] = {L, R, S, R};
        constexpr Turn LSRL[] = {L, S, R, L};
        constexpr Turn RSRL[] = {R, S, R, L};
        constexpr Turn LRSLR[] = {L, R, S, L, R};

        /** The equivalent angle in [-pi, pi]. Arguments stay within a few turns, where this is faster than
            std::remainder. */
        double wrap(double angle)
        {
            if (angle > PI)
                return angle > 3.0 * PI ? std::remainder(angle, 2.0 * PI) : angle - 2.0 * PI;
            if (angle < -PI)
                return angle < -3.0 * PI ? std::remainder(angle, 2.0 * PI) : angle + 2.0 * PI;
            return angle;
        }

        /** Position of the turning centre of the last piece relative to that of the first one, in units of the turning
            radius, and derived quantities. All symmetric forms of a word share them. */
        struct Centres
        {
            double distance;
            double angle;
            double square;
            double tangent;       // length of the tangent of two opposite turns: sqrt(square - 4); negative: none
            double tangentAngle;  // between it and the line through the centres

            Centres(double x, double y)
              : distance(0.0),
                angle(std::atan2(y, x)),
                square(x * x + y * y),
                tangent(-1.0),
                tangentAngle(0.0)
            {
                distance = std::sqrt(square);
                if (square < 4.0)
                    return;
                tangent = std::sqrt(square - 4.0);
                tangentAngle = std::atan2(2.0, tangent);
            }
        };

        /** Quantities for the words whose outer turns have the same direction. */
        struct SameTurns : Centres
        {
            double middleTurn;  // 8.3, 8.4: of L R L; negative; 0 where the circles are too far apart

            SameTurns(double x, double y) : Centres(x, y), middleTurn(0.0)
            {
                if (distance <= 4.0)
                    middleTurn = -2.0 * std::asin(0.25 * distance);
            }
        };

        /** Two turns of L R L R (8.7, 8.8), without the symmetries. The middle turns are u and -u, or u and u, which
            simplifies the article's formulas. */
        struct OuterTurns
        {
            bool exist{false};
            double u{0.0};
            double turn{0.0};  // of the first piece, relative to the angle of the centres
        };

        /** Quantities for the words whose outer turns have opposite directions. */
        struct OppositeTurns : Centres
        {
            OuterTurns between;  // 8.7: the cusp between the middle turns
            OuterTurns twice;    // 8.8: cusps before and after them

            OppositeTurns(double x, double y) : Centres(x, y)
            {
                if (const double cosine = 0.25 * (2.0 + distance); cosine <= 1.0)
                {
                    const double u = std::acos(cosine);
                    between = {true, u, HALF_PI + u};
                }
                if (const double cosine = (20.0 - square) / 16.0; cosine >= 0.0 && cosine <= 1.0)
                    twice = {true, -std::acos(cosine), std::atan2(2.0 - cosine, -std::sqrt(1.0 - cosine * cosine))};
            }
        };

        /** Calls emit(word, length) for each word; words longer than emit.cap() are not required.

            The words begin with a forward left turn. The symmetries of the article yield the others: driven backwards
            in time (x -> -x, phi -> -phi), mirrored (y -> -y, phi -> -phi) and both. Words that are not their own
            reverse are also driven from the goal to the start. Each symmetry changes the angles of the centres in a
            simple way. */
        template <class Emit>
        void enumerate(double x, double y, double phiGiven, Emit &emit)
        {
            const double s = std::sin(phiGiven), c = std::cos(phiGiven);
            const SameTurns same[2] = {{x - s, y - 1.0 + c}, {x + s, -y - 1.0 + c}};
            const OppositeTurns opposite[2] = {{x + s, y - 1.0 - c}, {x - s, -y - 1.0 - c}};
            for (int symmetry = 0; symmetry < 4; ++symmetry)
            {
                const bool flipped = (symmetry & 1) != 0, mirrored = (symmetry & 2) != 0;
                const double f = flipped ? -1.0 : 1.0;  // direction of travel of the first piece
                const double phi = flipped != mirrored ? -phiGiven : phiGiven;
                auto give = [&](const Turn *turns, std::size_t count, std::array<double, 5> lengths)
                {
                    double sum = 0.0;
                    for (std::size_t i = 0; i < count; ++i)
                        sum += std::abs(lengths[i]);
                    emit(Word{turns, count, lengths, mirrored}, sum);
                };

                const SameTurns &ll = same[mirrored ? 1 : 0];
                const double angle = flipped ? PI - ll.angle : ll.angle;
                const double angleBack = phi - angle;  // of the reverse problem
                // 8.1: L+ S+ L+
                if (ll.distance <= emit.cap())
                {
                    const double t = wrap(angle);
                    if (t >= -ZERO)
                        if (const double v = wrap(phi - t); v >= -ZERO)
                            give(LSL, 3, {f * t, f * ll.distance, f * v});
                }
                // 8.3 and 8.4: L+ R- L+ and L+ R- L-, and their reverse
                if (ll.distance <= 4.0 && -ll.middleTurn <= emit.cap())
                {
                    const double u = ll.middleTurn;
                    if (const double t = wrap(angle + 0.5 * u + PI); t >= -ZERO)
                        give(LRL, 3, {f * t, f * u, f * wrap(phi - t + u)});
                    if (const double t = wrap(angleBack + 0.5 * u + PI); t >= -ZERO)
                        give(LRL, 3, {f * wrap(phi - t + u), f * u, f * t});
                }
                // 8.9: L+ R-(pi/2) S- L-, and its reverse
                if (const double u = 2.0 - ll.tangent; ll.tangent >= 2.0 && HALF_PI - u <= emit.cap())
                {
                    if (const double t = wrap(angle + HALF_PI + ll.tangentAngle); t >= -ZERO)
                        if (const double v = wrap(phi - HALF_PI - t); v <= ZERO)
                            give(LRSL, 4, {f * t, -f * HALF_PI, f * u, f * v});
                    if (const double t = wrap(angleBack + HALF_PI + ll.tangentAngle); t >= -ZERO)
                        if (const double v = wrap(phi - HALF_PI - t); v <= ZERO)
                            give(LSRL, 4, {f * v, f * u, -f * HALF_PI, f * t});
                }

                const OppositeTurns &lr = opposite[mirrored ? 1 : 0];
                const double angleAcross = flipped ? PI - lr.angle : lr.angle;
                // 8.2: L+ S+ R+
                if (lr.tangent >= 0.0 && lr.tangent <= emit.cap())
                {
                    const double t = wrap(angleAcross + lr.tangentAngle);
                    if (t >= -ZERO)
                        if (const double v = wrap(t - phi); v >= -ZERO)
                            give(LSR, 3, {f * t, f * lr.tangent, f * v});
                }
                // 8.7: L+ R+ L- R-
                if (lr.between.exist && 2.0 * lr.between.u <= emit.cap())
                {
                    const double u = lr.between.u;
                    const double t = wrap(angleAcross + lr.between.turn);
                    if (t >= -ZERO)
                        if (const double v = wrap(t - 2.0 * u - phi); v <= ZERO)
                            give(LRLR, 4, {f * t, f * u, -f * u, f * v});
                }
                // 8.8: L+ R- L- R+
                if (lr.twice.exist && -2.0 * lr.twice.u <= emit.cap())
                {
                    const double u = lr.twice.u;
                    const double t = wrap(angleAcross + lr.twice.turn);
                    if (t >= -ZERO)
                        if (const double v = wrap(t - phi); v >= -ZERO)
                            give(LRLR, 4, {f * t, f * u, f * u, f * v});
                }
                // 8.11: L+ R-(pi/2) S- L-(pi/2) R+
                if (const double u = 4.0 - lr.tangent; lr.tangent >= 4.0 && PI - u <= emit.cap())
                {
                    const double t = wrap(angleAcross + HALF_PI + lr.tangentAngle);
                    if (t >= -ZERO)
                        if (const double v = wrap(t - phi); v >= -ZERO)
                            give(LRSLR, 5, {f * t, -f * HALF_PI, f * u, -f * HALF_PI, f * v});
                }
                // 8.10: L+ R-(pi/2) S- R-
                if (const double u = 2.0 - lr.distance; u <= 0.0 && HALF_PI - u <= emit.cap())
                {
                    const double t = wrap(angleAcross + HALF_PI);
                    if (t >= -ZERO)
                        if (const double v = wrap(t + HALF_PI - phi); v <= ZERO)
                            give(LRSR, 4, {f * t, -f * HALF_PI, f * u, f * v});
                }
                // 8.10 from the goal to the start, with the other pair of turns
                const OppositeTurns &rl = opposite[mirrored ? 0 : 1];
                if (const double u = 2.0 - rl.distance; u <= 0.0 && HALF_PI - u <= emit.cap())
                {
                    const double across = flipped ? PI - rl.angle : rl.angle;
                    const double t = wrap(phi + across + HALF_PI);
                    if (t >= -ZERO)
                        if (const double v = wrap(t + HALF_PI - phi); v <= ZERO)
                            give(RSRL, 4, {f * v, f * u, -f * HALF_PI, f * t});
                }
            }
        }

        double positiveTurn(double angle)
        {
            const double turn = angle - 2.0 * PI * std::floor(angle / (2.0 * PI));
            // Slightly less than a whole circle counts as no turn.
            return turn > 2.0 * PI - ZERO ? 0.0 : turn;
        }

        /** The goal in the start's frame, in units of the turning radius. */
        struct Target
        {
            double x, y, phi;
            double sinPhi, cosPhi;
        };

        template <class Emit>
        void enumerateDubins(double x, double y, double phi, Emit &emit)
        {
            const double sinPhi = std::sin(phi), cosPhi = std::cos(phi);
            for (const bool mirrored : {false, true})
            {
                const double sign = mirrored ? -1.0 : 1.0;
                const Target g{x, sign * y, sign * phi, sign * sinPhi, cosPhi};
                auto give = [&](const Turn *turns, double t, double u, double v)
                {
                    emit(Word{turns, 3, {t, u, v}, mirrored}, t + u + v);
                };
                {
                    const double xi = g.x - g.sinPhi, eta = g.y - 1.0 + g.cosPhi;
                    const double u = std::hypot(xi, eta);
                    const double t = positiveTurn(u > ZERO ? std::atan2(eta, xi) : 0.0);
                    give(LSL, t, u, positiveTurn(g.phi - t));
                }
                const double xi = g.x + g.sinPhi, eta = g.y - 1.0 - g.cosPhi;
                const double square = xi * xi + eta * eta;
                if (square >= 4.0)
                {
                    const double u = std::sqrt(square - 4.0);
                    const double t = positiveTurn(std::atan2(eta, xi) + std::atan2(2.0, u));
                    give(LSR, t, u, positiveTurn(t - g.phi));
                }
                // R L R with the middle turn longer than half a circle; centres of the outer turns are `d` apart.
                const double xr = g.x + g.sinPhi, yr = g.y + 1.0 - g.cosPhi;
                const double d = std::hypot(xr, yr);
                if (d <= 4.0)
                {
                    const double u = 2.0 * PI - std::acos((8.0 - d * d) / 8.0);
                    const double t = positiveTurn(0.5 * u - std::atan2(yr, xr));
                    give(RLR, t, u, positiveTurn(-g.phi - t + u));
                }
            }
        }

        ReedsSheppCurve toCurve(const Word &word, double radius)
        {
            ReedsSheppCurve curve;
            curve.length = 0.0;
            const double curvature = (word.mirrored ? -1.0 : 1.0) / radius;
            for (std::size_t i = 0; i < word.count; ++i)
            {
                const double length = word.lengths[i] * radius;
                if (std::abs(length) < 1e-12)
                    continue;
                curve.pieces[curve.count++] = {word.turns[i] * curvature, length};
                curve.length += std::abs(length);
            }
            return curve;
        }

        struct ShortestLength
        {
            double best{std::numeric_limits<double>::infinity()};
            double cap() const
            {
                return best;
            }
            void operator()(const Word & /*word*/, double length)
            {
                best = std::min(best, length);
            }
        };

        struct ShortestWord
        {
            double best{std::numeric_limits<double>::infinity()};
            Word word{nullptr, 0, {}, false};
            double cap() const
            {
                return best;
            }
            void operator()(const Word &candidate, double length)
            {
                if (length < best)
                {
                    best = length;
                    word = candidate;
                }
            }
        };

        struct AllWords
        {
            std::vector<ReedsSheppCurve> &curves;
            double radius;
            double maxLength;
            double cap() const
            {
                return maxLength;
            }
            void operator()(const Word &word, double length)
            {
                if (length <= maxLength)
                    curves.push_back(toCurve(word, radius));
            }
        };

        template <class Emit>
        void solve(const Pose &from, const Pose &to, double radius, CurveFamily family, Emit &emit)
        {
            const Pose goal = relativeTo(from, to);
            if (family == CurveFamily::ReedsShepp)
                enumerate(goal.x / radius, goal.y / radius, goal.yaw, emit);
            else
                enumerateDubins(goal.x / radius, goal.y / radius, goal.yaw, emit);
        }
    }  // namespace

    std::size_t ReedsSheppCurve::cusps() const
    {
        std::size_t changes = 0;
        for (std::size_t i = 1; i < count; ++i)
            if (pieces[i].length * pieces[i - 1].length < 0.0)
                ++changes;
        return changes;
    }

    ReedsShepp::ReedsShepp(double turningRadius, CurveFamily family) : radius_(turningRadius), family_(family)
    {
        if (!(turningRadius > 0.0) || !std::isfinite(turningRadius))
            throw Error("turning radius must be a positive number of metres, not " + std::to_string(turningRadius));
    }

    double ReedsShepp::distance(const Pose &from, const Pose &to) const
    {
        ShortestLength shortest;
        solve(from, to, radius_, family_, shortest);
        return shortest.best * radius_;
    }

    ReedsSheppCurve ReedsShepp::shortest(const Pose &from, const Pose &to) const
    {
        ShortestWord shortest;
        solve(from, to, radius_, family_, shortest);
        return toCurve(shortest.word, radius_);
    }

    void ReedsShepp::candidates(const Pose &from, const Pose &to, std::vector<ReedsSheppCurve> &curves,
                                double maxLength) const
    {
        curves.clear();
        AllWords all{curves, radius_, maxLength / radius_};
        solve(from, to, radius_, family_, all);
        std::sort(curves.begin(), curves.end(),
                  [](const ReedsSheppCurve &a, const ReedsSheppCurve &b) { return a.length < b.length; });
    }
}  // namespace parking

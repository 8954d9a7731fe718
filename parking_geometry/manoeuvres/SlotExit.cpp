#include "parking_geometry/manoeuvres/SlotExit.h"

#include "parking_geometry/Pose.h"

#include <algorithm>
#include <cmath>

namespace parking
{
    namespace
    {
        /** Largest angle of the arcs out of a parallel slot: a right angle, with a margin for rounding. */
        constexpr double MAX_TURN = 0.5 * PI + 1e-9;

        /** Number of second radii to attempt if the required one exceeds the largest turn, and the ratio of successive
            radii. */
        constexpr int MAX_RADII = 64;
        constexpr double LARGER = 1.06;

        /** Largest radius as a multiple of the smallest one; larger arcs are nearly straight within a car park. */
        constexpr double MAX_RADIUS_FACTOR = 40.0;

        /** The argument in [low, high] with the smallest value. Samples in geometric progression are followed by a
            golden section search between the neighbours of the best. This tolerates kinks at a change of the active
            constraint. */
        template <class Function>
        double argMin(const Function &value, double low, double high)
        {
            constexpr int SAMPLES = 32;
            const double ratio = std::pow(high / low, 1.0 / SAMPLES);
            double best = low, bestValue = value(low);
            for (double x = low * ratio, i = 1; i <= SAMPLES; x *= ratio, ++i)
                if (const double there = value(x); there < bestValue)
                {
                    best = x;
                    bestValue = there;
                }
            constexpr double GOLDEN = 0.6180339887498949;
            double a = std::max(low, best / ratio), b = std::min(high, best * ratio);
            double c = b - GOLDEN * (b - a), d = a + GOLDEN * (b - a), atC = value(c), atD = value(d);
            while (b - a > 1e-5 * low)
            {
                if (atC < atD)
                {
                    b = d;
                    d = c;
                    atD = atC;
                    c = b - GOLDEN * (b - a);
                    atC = value(c);
                }
                else
                {
                    a = c;
                    c = d;
                    atC = atD;
                    d = a + GOLDEN * (b - a);
                    atD = value(d);
                }
            }
            const double refined = 0.5 * (a + b);
            return value(refined) < bestValue ? refined : best;
        }

        double unitClamp(double value)
        {
            return std::clamp(value, -1.0, 1.0);
        }

        /** Range of angles of the first arc for which the tangent second arc keeps P within its inner circle. P lies at
            `distance` from the first centre, in the direction `bearing` from straight down. */
        struct PassingTurns
        {
            double smallest, largest;
        };

        PassingTurns passingTurns(const KerbSlot &slot, const ExitBody &body, double first, double second)
        {
            const double down = first - slot.aisleSide, between = first + second, inner = second - body.halfWidth;
            const double distance = std::hypot(slot.front, down);
            // Law of cosines in the triangle of both centres and P, whose side P - second centre is the inner radius.
            const double half = std::acos(
                unitClamp((between * between + distance * distance - inner * inner) / (2.0 * between * distance)));
            const double bearing = std::atan2(slot.front, down);
            return {bearing - half, bearing + half};
        }

        double turnForOffset(double offset, double radii)
        {
            return std::acos(unitClamp(1.0 - offset / radii));
        }
    }  // namespace

    double straightBeforeTurn(const Bay &bay, const ExitBody &body, double radius)
    {
        // Inner side. `below` is how far C lies towards the aisle's side of O, `ahead` how far ahead of O it may lie.
        const double inner = radius - body.halfWidth, below = radius - bay.nearGap;
        const double bearing = std::acos(unitClamp(below / inner));
        const double ahead = bearing <= bay.angle ? std::sqrt(std::max(0.0, inner * inner - below * below))
                                                  : (inner - below * std::cos(bay.angle)) / std::sin(bay.angle);
        double centre = std::max(0.0, bay.nearX - ahead);
        // Outer side: where the trailing corner first swings past the neighbour's side, if it does within the turn.
        const double outer = radius + body.halfWidth, side = radius + bay.farGap;
        const double corner = std::hypot(outer, body.trail);
        if (corner > side && bay.angle > std::atan2(body.trail, outer) - std::acos(side / corner))
            centre = std::max(centre, bay.farX + std::sqrt(corner * corner - side * side));
        return centre;
    }

    double aisleNeeded(const Bay &bay, const ExitBody &body, double radius, double straight)
    {
        const double outer = radius + body.halfWidth;
        // The leading outer corner is highest when it is abeam of O across the aisle or at the beginning of the turn.
        const double highest = bay.angle >= std::atan2(body.lead, outer)
                                   ? std::hypot(outer, body.lead)
                                   : body.lead * std::sin(bay.angle) + outer * std::cos(bay.angle);
        return highest - (bay.nearX - straight) * std::sin(bay.angle) - (radius - bay.nearGap) * std::cos(bay.angle);
    }

    double narrowestAisleRadius(const Bay &bay, const ExitBody &body, double minRadius)
    {
        return argMin([&](double radius)
                      { return aisleNeeded(bay, body, radius, straightBeforeTurn(bay, body, radius)); },
                      minRadius, MAX_RADIUS_FACTOR * minRadius);
    }

    double kerbRadius(const KerbSlot &slot, const ExitBody &body)
    {
        // (R + w/2)^2 + trail^2 <= (R + w/2 + gap)^2
        if (body.trail <= slot.kerbGap)
            return 0.0;
        return slot.kerbGap <= 0.0
                   ? HUGE_VAL
                   : (body.trail * body.trail - slot.kerbGap * slot.kerbGap) / (2.0 * slot.kerbGap) - body.halfWidth;
    }

    double cornerRadius(const KerbSlot &slot, const ExitBody &body)
    {
        // |OA| = |OP|: (R + w/2)^2 + lead^2 = front^2 + (R - aisleSide)^2
        const double squares = slot.front * slot.front + slot.aisleSide * slot.aisleSide -
                               body.halfWidth * body.halfWidth - body.lead * body.lead;
        const double radius = squares / (2.0 * (body.halfWidth + slot.aisleSide));
        if (radius >= slot.aisleSide)
            return radius;
        // In a deep slot A passes the neighbour's face before it is as high as P. Its circle must not reach the face.
        const double reach = slot.front * slot.front - body.lead * body.lead;
        return reach > 0.0 ? std::min(std::sqrt(reach) - body.halfWidth, slot.aisleSide) : 0.0;
    }

    double frontNeeded(const KerbSlot &slot, const ExitBody &body, double radius)
    {
        const double corner = std::hypot(radius + body.halfWidth, body.lead);
        const double down = std::max(0.0, radius - slot.aisleSide);
        return std::sqrt(std::max(body.lead * body.lead, corner * corner - down * down));
    }

    double LaneExit::offset() const
    {
        return (first + second) * (1.0 - std::cos(turn));
    }

    bool passes(const KerbSlot &slot, const ExitBody &body, const LaneExit &exit)
    {
        // Beyond this angle the car drives back into the neighbour.
        if (exit.turn > MAX_TURN)
            return false;
        if ((exit.first + exit.second) * std::sin(exit.turn) <= slot.front)
            return true;
        const PassingTurns turns = passingTurns(slot, body, exit.first, exit.second);
        return exit.turn >= turns.smallest && exit.turn <= turns.largest;
    }

    LaneExit shallowestExit(const KerbSlot &slot, const ExitBody &body, double first, double second)
    {
        const double offset = slot.aisleSide + body.halfWidth;
        LaneExit exit{first, std::max(second, offset - first), 0.0};
        for (int tried = 1;; ++tried, exit.second *= LARGER)
        {
            exit.turn = turnForOffset(offset, first + exit.second);
            if (!passes(slot, body, exit))
                exit.turn = std::max(exit.turn, passingTurns(slot, body, first, exit.second).smallest);
            if (exit.turn <= MAX_TURN || tried == MAX_RADII)
                return exit;
        }
    }

    LaneExit widened(const LaneExit &exit, double extra)
    {
        LaneExit wider = exit;
        wider.turn = turnForOffset(exit.offset() + extra, exit.first + exit.second);
        return wider;
    }

    double laneNeeded(const KerbSlot &slot, const ExitBody &body, const LaneExit &exit)
    {
        const double outer = exit.second + body.halfWidth;
        // The leading outer corner of the second arc is highest abeam of its centre, or where the arcs meet.
        const double highest = exit.turn >= std::atan2(body.lead, outer)
                                   ? exit.offset() - exit.second + std::hypot(outer, body.lead)
                                   : exit.first * (1.0 - std::cos(exit.turn)) + body.lead * std::sin(exit.turn) +
                                         body.halfWidth * std::cos(exit.turn);
        return highest - slot.aisleSide;
    }

    LaneExit narrowestLaneExit(const KerbSlot &slot, const ExitBody &body, double first, double minRadius)
    {
        const double second =
            argMin([&](double radius) { return laneNeeded(slot, body, shallowestExit(slot, body, first, radius)); },
                   minRadius, MAX_RADIUS_FACTOR * minRadius);
        return shallowestExit(slot, body, first, second);
    }
}  // namespace parking

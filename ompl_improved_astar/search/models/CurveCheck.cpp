#include "ompl_improved_astar/search/models/CurveCheck.h"

#include "parking_geometry/curves/Path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

namespace parking::search
{
    namespace
    {
        constexpr double FAR_APART = 6.0;  // metres, about a car's length: poses nearer to each other are swept only

        /** Are some poses in the middle of a long motion free? Asking for these, those that halve it first, finds most
            obstacles on it long before a sweep would get there. */
        bool hasFreeMiddle(MotionEnvironment &environment, const Pose &from, const Arc &motion)
        {
            for (double parts = 2.0; std::abs(motion.length) > FAR_APART * parts; parts *= 2.0)
                for (double i = 1.0; i < parts; i += 2.0)
                    if (!environment.isPassable(advance(from, motion.curvature, motion.length * i / parts)))
                        return false;
            return true;
        }

        /** Where a curve begins, where each of its pieces ends. */
        using Joints = std::array<Pose, std::tuple_size_v<decltype(ReedsSheppCurve::pieces)> + 1>;

        /** Says what hasFreePoses() says, and where the pieces end if that is yes. */
        bool findJoints(MotionEnvironment &environment, const Pose &from, const ReedsSheppCurve &curve, const Pose &to,
                        Joints &joints)
        {
            joints[0] = from;
            for (std::size_t k = 0; k + 1 < curve.count; ++k)
            {
                joints[k + 1] = advance(joints[k], curve.pieces[k].curvature, curve.pieces[k].length);
                if (!environment.isPassable(joints[k + 1]))
                    return false;
            }
            joints[curve.count] = to;
            for (std::size_t k = 0; k < curve.count; ++k)
                if (!hasFreeMiddle(environment, joints[k], curve.pieces[k]))
                    return false;
            return true;
        }

        /** Calls visit(from, piece, to) for each piece, from the given end of the curve on, until that says no. Says
            whether all said yes. */
        template <class Visit>
        bool visitPieces(const ReedsSheppCurve &curve, const Joints &joints, CurveEnd first, const Visit &visit)
        {
            for (std::size_t n = 0; n < curve.count; ++n)
            {
                const std::size_t k = first == CurveEnd::Start ? n : curve.count - 1 - n;
                if (!visit(joints[k], curve.pieces[k], joints[k + 1]))
                    return false;
            }
            return true;
        }

        bool isPieceFree(MotionEnvironment &environment, const Pose &from, const Arc &piece, const Pose &to,
                         CurveEnd first)
        {
            return (first == CurveEnd::Start
                        ? environment.freeLength(from, piece.curvature, piece.length)
                        : environment.freeLength(to, piece.curvature, -piece.length)) >= std::abs(piece.length);
        }

        /** What the obstacles near a free curve cost; infinite where it is not free, or where that is above most. */
        double closenessOfFree(MotionEnvironment &environment, const CostModel &cost, const Pose &from,
                               const ReedsSheppCurve &curve, const Pose &to, CurveEnd first, double most)
        {
            constexpr double INFINITE = std::numeric_limits<double>::infinity();
            if (!cost.prefersClearance())
                return isCurveFree(environment, from, curve, to, first)
                           ? curveCloseness(cost, from, curve, environment, most)
                           : INFINITE;
            Joints joints;
            if (!findJoints(environment, from, curve, to, joints))
                return INFINITE;
            double sum = 0.0;
            const auto add = [&](const Pose &start, const Arc &piece, const Pose &end)
            {
                double clear = 0.0;
                environment.clearLengths(start, &piece, 1, cost.preferredClearance, &clear);
                const auto isFree = [&]
                {
                    if (clear <= 0.0)
                        return isPieceFree(environment, start, piece, end, first);
                    // Of what is clear at its beginning the rest is left.
                    const Pose at = advance(start, piece.curvature, std::copysign(clear, piece.length));
                    const Arc rest{piece.curvature, std::copysign(std::abs(piece.length) - clear, piece.length)};
                    return isPieceFree(environment, at, rest, end, first);
                };
                // What keeps the preferred clearance to its end is free, too. Of the rest few samples show that most
                // are dear; but where nothing is too dear, or nothing known to be clear, sampling is the longer way to
                // find out that a piece is not free.
                const bool isClear = clear >= std::abs(piece.length), isPricedFirst = clear > 0.0 && most < INFINITE;
                if (!isClear && !isPricedFirst && !isFree())
                    return false;
                sum += cost.closeness(start, piece, environment, clear, most - sum);
                return sum <= most && (isClear || !isPricedFirst || isFree());
            };
            return visitPieces(curve, joints, first, add) ? sum : INFINITE;
        }
    }  // namespace

    bool hasFreePoses(MotionEnvironment &environment, const Pose &from, const ReedsSheppCurve &curve, const Pose &to)
    {
        Joints joints;
        return findJoints(environment, from, curve, to, joints);
    }

    bool isCurveFree(MotionEnvironment &environment, const Pose &from, const ReedsSheppCurve &curve, const Pose &to,
                     CurveEnd first)
    {
        Joints joints;
        return findJoints(environment, from, curve, to, joints) &&
               visitPieces(curve, joints, first,
                           [&](const Pose &start, const Arc &piece, const Pose &end)
                           { return isPieceFree(environment, start, piece, end, first); });
    }

    bool offerFreeCurves(MotionEnvironment &environment, const CostModel &cost, const Pose &from, const Pose &to,
                         std::vector<PricedCurve> &curves, CurveEnd first, double bound, const CurveOffer &offer)
    {
        std::sort(curves.begin(), curves.end());
        // Free curves whose turn has not come, since another may turn out to be cheaper.
        std::vector<PricedCurve> waiting;
        const auto offerUpTo = [&](double most)
        {
            while (!waiting.empty())
            {
                const auto next = std::min_element(waiting.begin(), waiting.end());
                if (next->first > most)
                    return false;
                const auto [whole, curve] = *next;
                waiting.erase(next);
                if (offer(*curve, whole))
                    return true;
            }
            return false;
        };
        for (const auto &[sum, curve] : curves)
        {
            if (offerUpTo(sum))
                return true;
            if (sum >= bound)
                break;
            const double closeness = closenessOfFree(environment, cost, from, *curve, to, first, bound - sum);
            if (const double whole = sum + closeness; whole < bound)
                waiting.emplace_back(whole, curve);
        }
        return offerUpTo(bound);
    }
}  // namespace parking::search

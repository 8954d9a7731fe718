#include "ompl_improved_astar/search/models/FreeCurves.h"

#include <array>
#include <cmath>
#include <tuple>

namespace parking::search
{
    namespace
    {
        constexpr double CAR_LENGTH = 6.0;  // metres, about: poses nearer to each other are only swept

        /** Where a curve begins, where each of its pieces ends. */
        using Joints = std::array<Pose, std::tuple_size_v<decltype(ReedsSheppCurve::pieces)> + 1>;

        /** Are some poses in the middle of a long motion free? Those that halve it first find most obstacles on it long
            before a sweep would get there. */
        bool hasFreeMiddle(MotionEnvironment &environment, const Pose &from, const Arc &motion)
        {
            for (double parts = 2.0; std::abs(motion.length) > CAR_LENGTH * parts; parts *= 2.0)
                for (double i = 1.0; i < parts; i += 2.0)
                    if (!environment.isFree(advance(from, motion.curvature, motion.length * i / parts)))
                        return false;
            return true;
        }

        bool findFreeJoints(MotionEnvironment &environment, const FreeCurves::Gap &gap, const ReedsSheppCurve &curve,
                            Joints &joints)
        {
            joints[0] = gap.from;
            for (std::size_t k = 0; k + 1 < curve.count; ++k)
            {
                joints[k + 1] = advance(joints[k], curve.pieces[k].curvature, curve.pieces[k].length);
                if (!environment.isFree(joints[k + 1]))
                    return false;
            }
            joints[curve.count] = gap.to;
            for (std::size_t k = 0; k < curve.count; ++k)
                if (!hasFreeMiddle(environment, joints[k], curve.pieces[k]))
                    return false;
            return true;
        }
    }  // namespace

    /** Extra cost of a curve because of the obstacles nearby; infinite where it collides or that is above \e max. */
    double FreeCurves::proximityOfFree(const Gap &gap, const ReedsSheppCurve &curve, double max)
    {
        Joints joints;
        if (!findFreeJoints(environment_, gap, curve, joints))
            return HUGE_VAL;
        double sum = 0.0;
        for (std::size_t n = 0; n < curve.count; ++n)
        {
            const std::size_t k = gap.end == SweepEnd::Start ? n : curve.count - 1 - n;
            const Arc &piece = curve.pieces[k];
            const double length = std::abs(piece.length);
            // What keeps the preferred clearance is free, too: only the rest of it is swept.
            const double clear =
                cost_.prefersClearance() ? environment_.freeLength(joints[k], piece, cost_.preferredClearance) : 0.0;
            if (clear >= length)
                continue;
            const Pose at = advance(joints[k], piece.curvature, std::copysign(clear, piece.length));
            const double rest = std::copysign(length - clear, piece.length);
            const auto isRestFree = [&]
            {
                return (gap.end == SweepEnd::Start
                            ? environment_.freeLength(at, {piece.curvature, rest})
                            : environment_.freeLength(joints[k + 1], {piece.curvature, -rest})) >= std::abs(rest);
            };
            // Few samples show that most of what is left is too costly; where nothing is known to be clear a sweep
            // shows sooner that most of it collides.
            const bool isPricedFirst = clear > 0.0;
            if (!isPricedFirst && !isRestFree())
                return HUGE_VAL;
            sum += cost_.proximity(joints[k], piece, environment_, clear, max - sum);
            if (sum > max || (isPricedFirst && !isRestFree()))
                return HUGE_VAL;
        }
        return sum;
    }

    bool FreeCurves::connect(const Gap &gap, const CurveOffer &offer)
    {
        curves_.candidates(gap.from, gap.to, words_, gap.maxCost);
        candidates_.clear();
        for (const ReedsSheppCurve &curve : words_)
            if (const double cost = curveCost(cost_, curve, gap.before, gap.after); cost < gap.maxCost)
                candidates_.push_back({cost, &curve});
        std::sort(candidates_.begin(), candidates_.end());
        if (candidates_.size() > gap.maxCurves)
            candidates_.resize(gap.maxCurves);
        // Free curves wait until none that is left can be cheaper.
        free_.clear();
        const auto offerUpTo = [&](double max)
        {
            while (!free_.empty())
            {
                const auto next = std::min_element(free_.begin(), free_.end());
                if (next->cost > max)
                    return false;
                const Candidate cheapest = *next;
                free_.erase(next);
                if (offer(*cheapest.curve, cheapest.cost))
                    return true;
            }
            return false;
        };
        for (const Candidate &candidate : candidates_)
        {
            if (offerUpTo(candidate.cost))
                return true;
            const double cost = candidate.cost + proximityOfFree(gap, *candidate.curve, gap.maxCost - candidate.cost);
            if (cost < gap.maxCost)
                free_.push_back({cost, candidate.curve});
        }
        return offerUpTo(gap.maxCost);
    }
}  // namespace parking::search

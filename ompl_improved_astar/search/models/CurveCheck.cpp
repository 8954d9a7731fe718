#include "ompl_improved_astar/search/models/CurveCheck.h"

#include "parking_geometry/curves/Path.h"

#include <algorithm>
#include <cmath>

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
    }  // namespace

    bool isCurveFree(MotionEnvironment &environment, const Pose &from, const ReedsSheppCurve &curve, const Pose &to,
                     CurveEnd first)
    {
        Pose pose = from;
        for (std::size_t k = 0; k + 1 < curve.count; ++k)
        {
            pose = advance(pose, curve.pieces[k].curvature, curve.pieces[k].length);
            if (!environment.isPassable(pose))
                return false;
        }
        pose = from;
        for (std::size_t k = 0; k < curve.count; ++k)
        {
            if (!hasFreeMiddle(environment, pose, curve.pieces[k]))
                return false;
            pose = advance(pose, curve.pieces[k].curvature, curve.pieces[k].length);
        }
        const bool forwards = first == CurveEnd::Start;
        pose = forwards ? from : to;
        for (std::size_t k = 0; k < curve.count; ++k)
        {
            const Arc &segment = curve.pieces[forwards ? k : curve.count - 1 - k];
            const double length = forwards ? segment.length : -segment.length;
            if (environment.freeLength(pose, segment.curvature, length) < std::abs(length))
                return false;
            pose = advance(pose, segment.curvature, length);
        }
        return true;
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
            if (!isCurveFree(environment, from, *curve, to, first))
                continue;
            if (const double whole = sum + curveCloseness(cost, from, *curve, environment, bound - sum); whole < bound)
                waiting.emplace_back(whole, curve);
        }
        return offerUpTo(bound);
    }
}  // namespace parking::search

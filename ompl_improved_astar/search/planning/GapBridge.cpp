#include "ompl_improved_astar/search/planning/GapBridge.h"

#include "ompl_improved_astar/search/models/CurveCheck.h"

#include <utility>

namespace parking::search
{
    GapBridge::Gap GapBridge::cutOut(const PricedPath &priced, double begin, double end)
    {
        const Path &path = priced.path, untilEnd = path.first(end), part = untilEnd.rest(begin);
        Gap gap{path.first(begin), path.rest(end), part.start, costWithoutCloseness(cost_, part)};
        const std::size_t first = untilEnd.pieces.size() - part.pieces.size();
        Pose pose = part.start;
        for (std::size_t i = 0; i < part.pieces.size(); ++i)
        {
            const PathPiece &piece = part.pieces[i], &uncut = path.pieces[first + i];
            const bool isWhole = piece.length == uncut.length && piece.curvature == uncut.curvature;
            gap.cost += isWhole ? priced.closeness[first + i] : cost_.closeness(pose, piece, environment_);
            pose = advance(pose, piece.curvature, piece.length);
        }
        // Nothing is left of what is shorter than what a path is cut at.
        if (part.pieces.empty())
            return gap;
        if (!gap.before.pieces.empty())
            gap.cost += cost_.join(gap.before.pieces.back(), part.pieces.front());
        if (!gap.after.pieces.empty())
            gap.cost += cost_.join(part.pieces.back(), gap.after.pieces.front());
        return gap;
    }

    std::optional<GapBridge::Leg> GapBridge::cheapest(const Pose &from, const Pose &to, const PathPiece *before,
                                                      const PathPiece *after, double bound)
    {
        ++connectionCount_;
        curves_.candidates(from, to, candidates_, bound);
        std::optional<Leg> best;
        for (const ReedsSheppCurve &curve : candidates_)
        {
            if (curve.count == 0)
                continue;
            const double cost = curveCost(cost_, curve, before, after);
            if (cost < (best ? best->cost : bound))
                best = Leg{cost, curve};
        }
        return best;
    }

    bool GapBridge::canCostLess(const Gap &gap, double bound)
    {
        return cheapest(gap.from, gap.after.start, gap.pieceBefore(), gap.pieceAfter(), bound).has_value();
    }

    std::optional<GapBridge::Bridged> GapBridge::lead(const Gap &gap, const Pose &pose, double bound,
                                                      std::size_t mostCusps)
    {
        const Pose &from = gap.from, &to = gap.after.start;
        const double radius = curves_.turningRadius(), least = leastCurveLength(pose, to, radius);
        if (leastCurveLength(from, pose, radius) + least >= bound)
            return std::nullopt;
        const std::optional<Leg> there = cheapest(from, pose, gap.pieceBefore(), nullptr, bound - least);
        if (!there || !hasFreePoses(environment_, from, there->curve, pose))
            return std::nullopt;
        const std::optional<Leg> onward = cheapest(pose, to, nullptr, gap.pieceAfter(), bound - there->cost);
        if (!onward || !hasFreePoses(environment_, pose, onward->curve, to))
            return std::nullopt;
        Bridged bridged{gap.before, 0.0, 0.0};
        for (std::size_t k = 0; k < there->curve.count; ++k)
            bridged.path.append(there->curve.pieces[k]);
        bridged.reach = bridged.path.length();
        for (std::size_t k = 0; k < onward->curve.count; ++k)
            bridged.path.append(onward->curve.pieces[k]);
        bridged.path.extend(gap.after);
        if (bridged.path.cusps() > mostCusps)
            return std::nullopt;
        const double join = cost_.join(there->curve.pieces[there->curve.count - 1], onward->curve.pieces[0]);
        std::vector<PricedCurve> one{{there->cost, &there->curve}}, other{{onward->cost + join, &onward->curve}};
        const auto isCheapAndFree = [&](const ReedsSheppCurve &, double spent)
        {
            return offerFreeCurves(environment_, cost_, pose, to, other, CurveEnd::Start, bound - spent,
                                   [&](const ReedsSheppCurve &, double rest)
                                   {
                                       bridged.cost = spent + rest;
                                       return true;
                                   });
        };
        if (!offerFreeCurves(environment_, cost_, from, pose, one, CurveEnd::Start, bound - other.front().first,
                             isCheapAndFree))
            return std::nullopt;
        return bridged;
    }
}  // namespace parking::search

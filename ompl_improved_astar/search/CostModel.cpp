#include "ompl_improved_astar/search/CostModel.h"

#include "ompl_improved_astar/search/planning/Parameters.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace parking::search
{
    namespace
    {
        constexpr double MAX_SAMPLES = 512.0;  // of one piece, between two polls of a stop function
        constexpr double MIN_NEARER =
            0.25;  // metres that count as nearer than preferred where the clearance is not kept
    }              // namespace

    double CostModel::proximity(const Pose &from, const PathPiece &piece, MotionEnvironment &environment, double clear,
                                double max) const
    {
        if (!prefersClearance())
            return 0.0;
        const double length = std::abs(piece.length);
        if (clear < 0.0)
            clear = environment.freeLength(from, {piece.curvature, piece.length}, preferredClearance);
        if (clear >= length)
            return 0.0;
        const double samples = std::min(MAX_SAMPLES, std::ceil((length - clear) / sampleSpacing)),
                     spacing = (length - clear) / samples;
        // It is nearer beyond what is known to be clear, or at its beginning, if only between two samples.
        const bool isNearer = clear > 0.0 || !environment.keeps(from, preferredClearance);
        const double floor = isNearer ? std::min(MIN_NEARER, length - clear) : 0.0;
        double nearer = 0.0;
        for (double i = 0.5; i < samples && clearanceCost * std::max(floor, nearer) <= max; i += 1.0)
            if (!environment.keeps(advance(from, piece.curvature, std::copysign(clear + i * spacing, piece.length)),
                                   preferredClearance))
                nearer += spacing;
        return clearanceCost * std::max(floor, nearer);
    }

    CostModel costModel(const PlannerParameters &parameters, double turningRadius)
    {
        CostModel cost;
        cost.reversePenalty = parameters.reversePenalty;
        cost.gearChangePenalty = parameters.gearChangePenalty;
        cost.steeringChangePenalty = parameters.steeringChangePenalty;
        cost.fullLockCurvature = 1.0 / turningRadius;
        cost.preferredClearance = parameters.preferredClearance;
        cost.clearanceCost = parameters.clearanceCost;
        return cost;
    }

    double curveCost(const CostModel &model, const ReedsSheppCurve &curve, const PathPiece *before,
                     const PathPiece *after)
    {
        double cost = 0.0;
        for (std::size_t i = 0; i < curve.count; ++i)
            cost += model.drive(curve.pieces[i]) + (i > 0 ? model.join(curve.pieces[i - 1], curve.pieces[i]) : 0.0);
        if (before != nullptr && curve.count > 0)
            cost += model.join(*before, curve.pieces[0]);
        if (after != nullptr && curve.count > 0)
            cost += model.join(curve.pieces[curve.count - 1], *after);
        return cost;
    }

    double PricedPath::totalProximity() const
    {
        return std::accumulate(proximity.begin(), proximity.end(), 0.0);
    }

    std::optional<PricedPath> price(const CostModel &model, Path path, MotionEnvironment &environment,
                                    const StopFunction &stop)
    {
        PricedPath priced{std::move(path), {}, 0.0};
        Pose pose = priced.path.start;
        const std::vector<PathPiece> &pieces = priced.path.pieces;
        for (std::size_t i = 0; i < pieces.size(); ++i)
        {
            // Long pieces in parts, so that the clock is looked at in between.
            const double parts = std::max(1.0, std::ceil(pieces[i].driven() / (MAX_SAMPLES * model.sampleSpacing)));
            double proximity = 0.0;
            for (double part = 0.0; part < parts && model.prefersClearance(); part += 1.0)
            {
                if (stop && stop())
                    return std::nullopt;
                const Pose begin = advance(pose, pieces[i], pieces[i].driven() * part / parts);
                proximity += model.proximity(begin, {pieces[i].curvature, pieces[i].length / parts}, environment);
            }
            priced.proximity.push_back(proximity);
            priced.cost += model.drive(pieces[i]) + proximity + (i > 0 ? model.join(pieces[i - 1], pieces[i]) : 0.0);
            pose = advance(pose, pieces[i]);
        }
        return environment.wasInterrupted() && stop ? std::nullopt : std::optional(std::move(priced));
    }

    PricedPath price(const CostModel &model, Path path, MotionEnvironment &environment)
    {
        return *price(model, std::move(path), environment, {});
    }
}  // namespace parking::search

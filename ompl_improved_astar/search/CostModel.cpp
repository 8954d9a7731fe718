#include "ompl_improved_astar/search/CostModel.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace parking::search
{
    namespace
    {
        constexpr double INFINITE = std::numeric_limits<double>::infinity();

        std::vector<double> closenessOfPieces(const CostModel &model, const Path &path, MotionEnvironment &environment,
                                              Patience *patience)
        {
            std::vector<double> closeness(path.pieces.size(), 0.0);
            Pose pose = path.start;
            const auto isOver = [patience]
            {
                return patience != nullptr && patience->wasOver();
            };
            for (std::size_t i = 0; i < path.pieces.size() && model.pricesCloseness() && !isOver(); ++i)
            {
                closeness[i] = model.closeness(pose, path.pieces[i], environment, -1.0, INFINITE, patience);
                pose = advance(pose, path.pieces[i].curvature, path.pieces[i].length);
            }
            return closeness;
        }

        /** The same; none for want of time. */
        std::optional<std::vector<double>> closenessOfPieces(const CostModel &model, const Path &path,
                                                             MotionEnvironment &environment, const StopFunction &stop)
        {
            Patience patience(stop, LOOKS_BETWEEN_STOPS);
            std::vector<double> closeness = closenessOfPieces(model, path, environment, &patience);
            if (patience.wasOver() || (model.pricesCloseness() && environment.wasInterrupted()))
                return std::nullopt;
            return closeness;
        }

        double sumOf(const std::vector<double> &costs)
        {
            return std::accumulate(costs.begin(), costs.end(), 0.0);
        }
    }  // namespace

    double CostModel::closeness(const Pose &from, const PathPiece &segment, MotionEnvironment &environment,
                                double clear, double most, Patience *patience) const
    {
        const double length = std::abs(segment.length);
        double cost = 0.0;
        if (clearanceWeight > 0.0)
        {
            const double samples = std::max(1.0, std::ceil(length / clearanceRange));
            for (double i = 0.5; i < samples; i += 1.0)
            {
                if (patience != nullptr && patience->isOver())
                    return cost;
                const Pose pose = advance(from, segment.curvature, segment.length * i / samples);
                const double nearness = 1.0 - environment.clearance(pose) / clearanceRange;
                cost += clearanceWeight * std::max(0.0, nearness) * length / samples;
            }
        }
        if (!prefersClearance())
            return cost;
        if (clear < 0.0)
        {
            const Arc arc{segment.curvature, segment.length};
            environment.clearLengths(from, &arc, 1, preferredClearance, &clear);
        }
        if (clear >= length)
            return cost;
        const double rest = length - clear, samples = std::ceil(rest / samplesApart);
        const double apart = rest / samples, perSample = clearanceCost * apart;
        const double affordable = std::clamp((most - cost) / perSample, 0.0, samples);
        const auto count = static_cast<std::size_t>(samples), enough = static_cast<std::size_t>(affordable);
        const std::size_t atOnce = patience != nullptr ? std::min(count, LOOKS_BETWEEN_STOPS) : count;
        std::size_t nearer = 0;
        for (std::size_t done = 0; done < count && nearer <= enough; done += atOnce)
        {
            if (patience != nullptr && patience->isOver(atOnce))
                break;
            nearer += environment.countNearer(from, {segment.curvature, segment.length},
                                              clear + apart * (0.5 + static_cast<double>(done)), apart,
                                              std::min(atOnce, count - done), preferredClearance, enough - nearer);
        }
        // Where the environment knows how far it is clear, it is nearer beyond, if only between two samples.
        return cost + perSample * std::max(clear > 0.0 ? 1.0 : 0.0, static_cast<double>(nearer));
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

    double curveCloseness(const CostModel &model, const Pose &from, const ReedsSheppCurve &curve,
                          MotionEnvironment &environment, double most)
    {
        double cost = 0.0;
        Pose pose = from;
        for (std::size_t i = 0; i < curve.count && cost <= most && model.pricesCloseness(); ++i)
        {
            cost += model.closeness(pose, curve.pieces[i], environment, -1.0, most - cost);
            pose = advance(pose, curve.pieces[i].curvature, curve.pieces[i].length);
        }
        return cost;
    }

    double costWithoutCloseness(const CostModel &model, const Path &path)
    {
        double cost = 0.0;
        for (std::size_t i = 0; i < path.pieces.size(); ++i)
            cost += model.drive(path.pieces[i]) + (i > 0 ? model.join(path.pieces[i - 1], path.pieces[i]) : 0.0);
        return cost;
    }

    double pathCloseness(const CostModel &model, const Path &path, MotionEnvironment &environment)
    {
        return sumOf(closenessOfPieces(model, path, environment, nullptr));
    }

    std::optional<double> pathCloseness(const CostModel &model, const Path &path, MotionEnvironment &environment,
                                        const StopFunction &stop)
    {
        const std::optional<std::vector<double>> closeness = closenessOfPieces(model, path, environment, stop);
        return closeness ? std::optional(sumOf(*closeness)) : std::nullopt;
    }

    double pathCost(const CostModel &model, const Path &path, MotionEnvironment &environment)
    {
        return pathCloseness(model, path, environment) + costWithoutCloseness(model, path);
    }

    std::optional<PricedPath> pricePath(const CostModel &model, Path path, MotionEnvironment &environment,
                                        const StopFunction &stop)
    {
        std::optional<std::vector<double>> closeness = closenessOfPieces(model, path, environment, stop);
        if (!closeness)
            return std::nullopt;
        const double cost = sumOf(*closeness) + costWithoutCloseness(model, path);
        return PricedPath{std::move(path), std::move(*closeness), cost};
    }
}  // namespace parking::search

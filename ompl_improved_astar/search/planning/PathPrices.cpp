#include "ompl_improved_astar/search/planning/PathPrices.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace parking::search
{
    namespace
    {
        bool isSame(const Path &a, const Path &b)
        {
            return a.start.x == b.start.x && a.start.y == b.start.y && a.start.yaw == b.start.yaw &&
                   std::equal(a.pieces.begin(), a.pieces.end(), b.pieces.begin(), b.pieces.end(),
                              [](const PathPiece &one, const PathPiece &other)
                              {
                                  return one.length == other.length && one.curvature == other.curvature &&
                                         one.sharpness == other.sharpness && one.turn == other.turn;
                              });
        }
    }  // namespace

    void PathPrices::begin(MotionEnvironment &environment, const CostModel &model)
    {
        environment_ = &environment;
        model_ = model;
        priced_.clear();
    }

    std::optional<double> PathPrices::closeness(const Path &path, const StopFunction &stop)
    {
        if (!model_.pricesCloseness())
            return 0.0;
        const auto found = std::find_if(priced_.begin(), priced_.end(),
                                        [&path](const Priced &each) { return isSame(each.path, path); });
        if (found != priced_.end())
        {
            std::rotate(priced_.begin(), found, found + 1);
            return priced_.front().closeness;
        }
        const std::optional<double> closeness = pathCloseness(model_, path, *environment_, stop);
        if (closeness)
            remember({path, *closeness});
        return closeness;
    }

    std::optional<double> PathPrices::cost(const Path &path, const StopFunction &stop)
    {
        const std::optional<double> near = closeness(path, stop);
        return near ? std::optional(*near + costWithoutCloseness(model_, path)) : std::nullopt;
    }

    void PathPrices::remember(const PricedPath &priced)
    {
        remember({priced.path, std::accumulate(priced.closeness.begin(), priced.closeness.end(), 0.0)});
    }

    void PathPrices::remember(Priced priced)
    {
        if (priced_.size() == REMEMBERED)
            priced_.pop_back();
        priced_.insert(priced_.begin(), std::move(priced));
    }
}  // namespace parking::search

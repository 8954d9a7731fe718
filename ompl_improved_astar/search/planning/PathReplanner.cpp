#include "ompl_improved_astar/search/planning/PathReplanner.h"

#include "ompl_improved_astar/search/planning/GapBridge.h"
#include "ompl_improved_astar/search/planning/PathShortener.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace parking::search
{
    namespace
    {
        constexpr double INFINITE = std::numeric_limits<double>::infinity();
    }  // namespace

    void PathReplanner::begin(MotionEnvironment &environment, const SearchParameters &parameters)
    {
        environment_ = &environment;
        parameters_ = besideKnownWay(parameters);
        side_.forget();
        connections_ = 0;
    }

    bool PathReplanner::canLeaveWithRoom(const Pose &pose)
    {
        const double clearance = parameters_.cost.preferredClearance, radius = parameters_.turningRadius;
        const Arc arcs[2]{{0.0, radius}, {0.0, -radius}};
        double clear[2]{0.0, 0.0};
        if (environment_->keeps(pose, clearance))
            environment_->clearLengths(pose, arcs, 2, clearance, clear);
        return clear[0] > 0.0 || clear[1] > 0.0;
    }

    std::optional<double> PathReplanner::placeWithRoom(const Path &path, double place, double end)
    {
        const double length = path.length(),
                     step = end > place ? parameters_.turningRadius : -parameters_.turningRadius;
        for (std::size_t k = 0; k < parameters_.tuning.placesForRoom; ++k, place += step)
        {
            place = std::clamp(place, 0.0, length);
            if (canLeaveWithRoom(path.at(place)))
                return place;
            if (place == end)
                break;
        }
        return std::nullopt;
    }

    std::optional<Path> PathReplanner::replan(const Path &path, const ClosePart &part, const Effort &effort,
                                              const StopFunction &stop)
    {
        const double reach = parameters_.tuning.reachForRoom * parameters_.turningRadius, length = path.length();
        const std::optional<double> begin = placeWithRoom(path, part.begin - reach, 0.0);
        const std::optional<double> end = begin ? placeWithRoom(path, part.end + reach, length) : std::nullopt;
        if (!end || (stop && stop()))
            return std::nullopt;
        SearchParameters parameters = parameters_;
        parameters.maxMemory = effort.memory;
        roomy_.emplace(*environment_, parameters.cost.preferredClearance);
        Search &search = side_.begin(*roomy_, parameters);
        const ReedsShepp &curves = *search.model().curves();
        const CostModel &cost = search.cost();
        const std::optional<PricedPath> priced = pricePath(cost, path, *environment_, stop);
        if (!priced)
            return std::nullopt;
        const GapBridge::Gap gap = GapBridge(*environment_, curves, cost).cutOut(*priced, *begin, *end);
        if (stop && stop())
            return std::nullopt;
        search.setCostBound(gap.cost);
        search.addStart(gap.from);
        search.addGoal(gap.after.start);
        if (search.run(stop, effort.expansions) != SearchOutcome::Improved)
            return std::nullopt;
        Path way = search.bestPath();
        const SearchTuning &tuning = parameters.tuning;
        const double spacing = std::max(tuning.knotSpacing * parameters.turningRadius, way.length() / tuning.mostKnots);
        PathShortener shortener(*environment_, curves, cost);
        shortener.pass(way, spacing, 0.0, INFINITE, CurveChoice::Cheapest, stop);
        connections_ += shortener.connections();
        Path whole = gap.before;
        whole.extend(way);
        whole.extend(gap.after);
        return (stop && stop()) || !environment_->acceptPath(whole) ? std::nullopt : std::optional(std::move(whole));
    }

    SearchStatistics PathReplanner::statistics() const
    {
        SearchStatistics sum = side_.statistics();
        sum.connections += connections_;
        return sum;
    }
}  // namespace parking::search

// What the planner does with a path that it has: shortens it, drives parts of it the other way round, moves its poses
// and leads it past obstacles.

#include "ompl_improved_astar/search/planning/PathPlanner.h"

#include "ompl_improved_astar/search/planning/CloseParts.h"
#include "ompl_improved_astar/search/planning/PathRelaxer.h"
#include "ompl_improved_astar/search/planning/PathTurner.h"
#include "ompl_improved_astar/search/planning/PathWidener.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace parking::search
{
    namespace
    {
        constexpr double INFINITE = std::numeric_limits<double>::infinity();
    }  // namespace

    bool PathPlanner::shorten(PathPrices &prices, Path &path, double &cost, double spacing, double offset,
                              double widest, CurveChoice choice)
    {
        PathShortener shortener(*environment_, *search_.model().curves(), prices.model());
        Path shorter = path;
        const bool isShorter = shortener.pass(shorter, spacing, offset, widest, choice, stop_);
        shortenerConnections_ += shortener.connections();
        if (!isShorter)
            return false;
        // Clearance is sampled, so that the cost of the whole is not quite the sum of its parts'.
        const std::optional<double> less = prices.cost(shorter, stop_);
        if (!less || !(*less < cost))
            return false;
        path = std::move(shorter);
        cost = *less;
        return true;
    }

    bool PathPlanner::shortenWhole(Path &path, double &cost, double coarsest)
    {
        const double spacing = parameters_.search.tuning.knotSpacing * parameters_.search.turningRadius;
        return shorten(prices_, path, cost, std::max(spacing, coarsest), 0.0, INFINITE, CurveChoice::Cheapest);
    }

    bool PathPlanner::shortenByOtherKnots(PathPrices &prices, Path &path, double &cost, double coarsest)
    {
        const SearchTuning &tuning = parameters_.search.tuning;
        const double radius = parameters_.search.turningRadius;
        return shorten(prices, path, cost, std::max(tuning.otherKnotSpacing * radius, coarsest),
                       tuning.otherKnotOffset * radius, tuning.widestSpan * radius, CurveChoice::Cheapest);
    }

    void PathPlanner::shortenTwice(Path &path, double &cost)
    {
        const double coarsest = path.length() / parameters_.search.tuning.mostKnots;
        shortenWhole(path, cost, coarsest);
        shortenByOtherKnots(prices_, path, cost, coarsest);
    }

    bool PathPlanner::shortenBest(double spacing, double offset)
    {
        const SearchTuning &tuning = parameters_.search.tuning;
        Path path = bestPath_;
        double cost = bestCost_;
        const double widest = tuning.widestSpan * parameters_.search.turningRadius;
        return shorten(prices_, path, cost, spacing, offset, widest, CurveChoice::All) && take(path, cost);
    }

    bool PathPlanner::turnRound(Path &path, double &cost)
    {
        const SearchTuning &tuning = parameters_.search.tuning;
        // What has been tried is not tried again. A car that drives forwards only has no cusps.
        if (!(cost < costWhenTurned_) || path.cusps() == 0 || isTimeUp())
            return false;
        PathTurner turner(*environment_, *search_.model().curves(), search_.cost(), tuning);
        Path turned = path;
        const bool isTurned = turner.pass(turned, cost, stop_);
        if (!isTimeUp())
            costWhenTurned_ = cost;
        shortenerConnections_ += turner.connections();
        if (!isTurned)
            return false;
        std::optional<double> costOfTurned = prices_.cost(turned, stop_);
        if (costOfTurned && !isTimeUp())
            shortenTwice(turned, *costOfTurned);
        if (!costOfTurned || !(*costOfTurned < cost) || turned.cusps() > mostCuspsOf(path))
            return false;
        path = std::move(turned);
        cost = *costOfTurned;
        return true;
    }

    std::size_t PathPlanner::mostCuspsOf(const Path &path) const
    {
        return std::max<std::size_t>(path.cusps(), parameters_.search.mostCusps);
    }

    bool PathPlanner::relax(Path &path, double &cost, double step, std::size_t cusps)
    {
        if (isTimeUp())
            return false;
        PathRelaxer relaxer(*environment_, *search_.model().curves(), search_.cost(), parameters_.search.tuning);
        const PathRelaxer::Pass pass{step * parameters_.search.turningRadius, cusps};
        const bool isCheaper = relaxer.pass(path, pass, mostCuspsOf(path), stop_);
        shortenerConnections_ += relaxer.connections();
        if (!isCheaper)
            return false;
        prices_.remember(relaxer.priced());
        cost = relaxer.priced().cost;
        return true;
    }

    void PathPlanner::relaxAndShorten(Path &path, double &cost)
    {
        const SearchTuning &tuning = parameters_.search.tuning;
        double step = tuning.relaxStep;
        bool isCheaper = false;
        for (std::size_t k = 0; k < tuning.relaxations; ++k, step *= tuning.relaxDecay)
            isCheaper = relax(path, cost, step, std::min(k, tuning.relaxCusps)) || isCheaper;
        if (isCheaper && !isTimeUp())
            shortenTwice(path, cost);
    }

    void PathPlanner::relaxFirst(Path &path, double &cost, double dearness)
    {
        const SearchTuning &tuning = parameters_.search.tuning;
        if (!(path.length() < tuning.longestToRelax * parameters_.search.turningRadius))
            return;
        if (dearness > tuning.dearToRelax)
            relaxAndShorten(path, cost);
        else if (dearness > tuning.dearToRelaxOnce && relax(path, cost, tuning.onlyStep, 0) && !isTimeUp())
            shortenTwice(path, cost);
    }

    bool PathPlanner::relaxBest()
    {
        const SearchTuning &tuning = parameters_.search.tuning;
        if (relaxations_ == tuning.relaxationsOfBest && bestCost_ < costWhenRelaxed_)
            relaxations_ = 0;
        if (relaxations_ == tuning.relaxationsOfBest)
            return false;
        if (relaxations_ == 0)
            costWhenRelaxed_ = bestCost_;
        Path path = bestPath_;
        double cost = bestCost_;
        const double step = tuning.relaxStep * std::pow(tuning.relaxDecayOfBest, static_cast<double>(relaxations_++));
        return relax(path, cost, step, tuning.relaxCusps) && take(path, cost);
    }

    bool PathPlanner::takeForRoom(const Path &other, double most, Path &path, double &cost)
    {
        const std::optional<double> costOfOther = prices_.cost(other, stop_);
        if (!costOfOther || *costOfOther > most || other.cusps() > mostCuspsOf(path))
            return false;
        path = other;
        cost = *costOfOther;
        return true;
    }

    bool PathPlanner::widen(Path &path, double &cost)
    {
        const SearchTuning &tuning = parameters_.search.tuning;
        PathWidener widener(*environment_, *search_.model().curves(), search_.cost(), tuning);
        // Between its samples a path may be nearer than its cost tells, so that what keeps the room may look dearer.
        const double most = cost * (parameters_.anytime ? 1.0 : tuning.dearerForRoom);
        Path wider = path;
        bool isTaken = true;  // what the widener has come to
        if (widener.pass(wider, stop_))
        {
            isTaken = takeForRoom(wider, most, path, cost);
            double strict = widener.priced().cost;
            PathPrices strictPrices;
            strictPrices.begin(*environment_, widener.strictCost());
            // Shorter, it may be near to something again, for a moment that costs little and can be helped for less.
            if (isTaken && shortenByOtherKnots(strictPrices, wider, strict, wider.length() / tuning.mostKnots) &&
                takeForRoom(wider, most, path, cost) && widener.pass(wider, stop_))
                isTaken = takeForRoom(wider, most, path, cost);
        }
        shortenerConnections_ += widener.connections();
        return isTaken && !widener.isTooNear();
    }

    bool PathPlanner::findWayWithRoom(Path &path, double &cost)
    {
        const SearchTuning &tuning = parameters_.search.tuning;
        if (search_.isFull() || isTimeUp() || !passesClosely(path, cost))
            return false;
        const double length = path.length(), expansions = static_cast<double>(search_.expanded());
        const auto most =
            static_cast<std::uint64_t>(std::clamp(expansions, tuning.leastForRoom, tuning.mostForAnother));
        std::optional<Path> other =
            replanner_.replan(path, {0.0, length, 0.5 * length, 0.0}, {most, memoryLeft()}, stop_);
        std::optional<double> costOfOther = other ? prices_.cost(*other, stop_) : std::nullopt;
        if (!costOfOther || isTimeUp())
            return false;
        shortenTwice(*other, *costOfOther);
        relaxFirst(*other, *costOfOther, *costOfOther / expectedLength());
        if (!(*costOfOther < cost) || other->cusps() > mostCuspsOf(path))
            return false;
        path = std::move(*other);
        cost = *costOfOther;
        return true;
    }

    void PathPlanner::findRoom(Path &best, double &cost, OtherWay otherWay)
    {
        const SearchTuning &tuning = parameters_.search.tuning;
        const double clearance = search_.cost().preferredClearance, radius = parameters_.search.turningRadius;
        const auto closePartsOfBest = [&]
        {
            return closeParts(*environment_, best, 0.0, clearance, radius, stop_);
        };
        bool hasRoom = isTimeUp() || widen(best, cost);
        if (!hasRoom && otherWay == OtherWay::Allowed && findWayWithRoom(best, cost))
            hasRoom = isTimeUp() || widen(best, cost);
        const std::uint64_t before = replanner_.expanded();
        std::vector<ClosePart> parts;
        if (!hasRoom)
            parts = closePartsOfBest();
        double left = 0.0;  // metres along the path: what is too near before that is left as it is
        for (std::size_t k = 0; k < tuning.partsForRoom && !hasRoom && !search_.isFull() && !isTimeUp(); ++k)
        {
            const auto part =
                std::find_if(parts.begin(), parts.end(), [&](const ClosePart &each) { return each.begin > left; });
            if (part == parts.end())
                return;
            // All parts share what the effort for the path is worth, but each is worth a little.
            const double unspent = tuning.shareForRoom * static_cast<double>(search_.expanded()) -
                                   static_cast<double>(replanner_.expanded() - before);
            const auto most = static_cast<std::uint64_t>(std::clamp(unspent, tuning.leastForRoom, tuning.mostForRoom));
            const std::optional<Path> replanned = replanner_.replan(best, *part, {most, memoryLeft()}, stop_);
            const double costBefore = cost;
            if (!replanned || !takeForRoom(*replanned, cost, best, cost))
            {
                left = part->end;
                continue;
            }
            Path wider = best;
            double costOfWider = cost;
            hasRoom = widen(wider, costOfWider) && costOfWider < costBefore;
            if (costOfWider < costBefore)
            {
                best = std::move(wider);
                cost = costOfWider;
            }
            if (!hasRoom)
                parts = closePartsOfBest();
        }
    }
}  // namespace parking::search

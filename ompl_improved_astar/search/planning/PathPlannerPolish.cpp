// What the planner does with a path that it has: shortens it, drives parts of it the other way round, moves its poses
// and leads it past obstacles.

#include "ompl_improved_astar/search/planning/PathPlanner.h"

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

    bool PathPlanner::widen(Path &path, double &cost)
    {
        const SearchTuning &tuning = parameters_.search.tuning;
        PathWidener widener(*environment_, *search_.model().curves(), search_.cost(), tuning);
        Path wider = path;
        const bool isWider = widener.pass(wider, stop_);
        shortenerConnections_ += widener.connections();
        if (!isWider)
            return !widener.isTooNear();
        // Between its samples a path may be nearer than its cost tells, so that what keeps the room may look dearer.
        const double most = cost * (parameters_.anytime ? 1.0 : tuning.dearerForRoom);
        const auto takeIfCheap = [&](const Path &other)
        {
            const std::optional<double> costOfOther = prices_.cost(other, stop_);
            if (!costOfOther || *costOfOther > most)
                return false;
            path = other;
            cost = *costOfOther;
            return true;
        };
        if (!takeIfCheap(wider))
            return false;
        double strict = widener.priced().cost;
        PathPrices strictPrices;
        strictPrices.begin(*environment_, widener.strictCost());
        if (shortenByOtherKnots(strictPrices, wider, strict, wider.length() / tuning.mostKnots))
            takeIfCheap(wider);
        return !widener.isTooNear();
    }

    bool PathPlanner::canLeaveWithRoom(const Pose &pose)
    {
        const double clearance = search_.cost().preferredClearance, radius = parameters_.search.turningRadius;
        const Arc arcs[2]{{0.0, radius}, {0.0, -radius}};
        double clear[2]{0.0, 0.0};
        if (environment_->keeps(pose, clearance))
            environment_->clearLengths(pose, arcs, 2, clearance, clear);
        return clear[0] > 0.0 || clear[1] > 0.0;
    }

    void PathPlanner::findRoom(Path &best, double &cost)
    {
        const SearchTuning &tuning = parameters_.search.tuning;
        if (isTimeUp() || widen(best, cost))
            return;
        if (best.length() > tuning.longestForRoom * parameters_.search.turningRadius || search_.isFull() ||
            !canLeaveWithRoom(best.start) || !canLeaveWithRoom(best.end()) || isTimeUp())
            return;
        // Where both ends have room there may be a way that has it everywhere. A search for such a way finds it sooner
        // than one that may come nearer.
        SearchParameters parameters = parameters_.search;
        parameters.eagerObstacles = false;
        parameters.maxMemory = memoryLeft();
        roomy_.emplace(*environment_, search_.cost().preferredClearance);
        if (!roomySearch_)
            roomySearch_ = std::make_unique<Search>();
        roomySearch_->begin(*roomy_, parameters);
        hasRoomySearch_ = true;
        roomySearch_->setCostBound(cost);
        roomySearch_->addStart(best.start);
        roomySearch_->addGoal(best.end());
        const std::uint64_t most = std::clamp(search_.expanded(), tuning.leastForRoom, tuning.mostForRoom);
        if (roomySearch_->run(stop_, most) != SearchOutcome::Improved)
            return;
        Path other = roomySearch_->bestPath();
        std::optional<double> costOfOther = prices_.cost(other, stop_);
        if (!costOfOther)
            return;
        shortenWhole(other, *costOfOther, other.length() / tuning.mostKnots);
        widen(other, *costOfOther);
        if (*costOfOther < cost)
        {
            best = std::move(other);
            cost = *costOfOther;
        }
    }
}  // namespace parking::search

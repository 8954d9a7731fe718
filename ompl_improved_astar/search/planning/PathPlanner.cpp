#include "ompl_improved_astar/search/planning/PathPlanner.h"

#include "ompl_improved_astar/search/planning/Knots.h"
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

    void PathPlanner::begin(MotionEnvironment &environment, const PathPlannerParameters &parameters)
    {
        environment_ = &environment;
        parameters_ = parameters;
        search_.begin(environment, parameters_.search);
        parameters_.shorten = parameters.shorten && search_.model().curves() != nullptr;
        parameters_.anytime = parameters.anytime && search_.model().curves() != nullptr;
        restarts_.begin(environment, parameters_.search);
        starts_.clear();
        bestPath_ = {};
        bestCost_ = INFINITE;
        costWhenTurned_ = costWhenRelaxed_ = INFINITE;
        relaxations_ = 0;
        shortenerConnections_ = 0;
        hasRoomySearch_ = hasApproach_ = false;
        approaches_ = {};
        goodEnough_ = false;
        round_ = 0;
        weights_ = parameters.search.weights;
    }

    bool PathPlanner::take(const Path &path, double cost)
    {
        if (!(cost < bestCost_ - 1e-9) || (hasSolution() && !isCheaperAtACloserLook(path)))
            return false;
        bestPath_ = path;
        bestCost_ = cost;
        search_.setCostBound(cost);
        if (improved_ && improved_(bestPath_, bestCost_))
            goodEnough_ = true;
        return true;
    }

    bool PathPlanner::isCheaperAtACloserLook(const Path &path)
    {
        // What looks cheaper and cheaper may do so by being near to obstacles where nobody looks, between the samples.
        CostModel model = search_.cost();
        if (!model.prefersClearance())
            return true;
        model.samplesApart = parameters_.search.tuning.closerSamples;
        return pathCost(model, path, *environment_) < pathCost(model, bestPath_, *environment_);
    }

    bool PathPlanner::shorten(const CostModel &model, Path &path, double &cost, double spacing, double offset,
                              double widest, CurveChoice choice)
    {
        PathShortener shortener(*environment_, *search_.model().curves(), model);
        Path shorter = path;
        const bool isShorter = shortener.pass(shorter, spacing, offset, widest, choice, stop_);
        shortenerConnections_ += shortener.connections();
        if (!isShorter)
            return false;
        // Clearance is sampled, so that the cost of the whole is not quite the sum of its parts'.
        const double less = pathCost(model, shorter, *environment_);
        if (!(less < cost))
            return false;
        path = std::move(shorter);
        cost = less;
        return true;
    }

    bool PathPlanner::shortenWhole(Path &path, double &cost, double coarsest)
    {
        const double spacing = parameters_.search.tuning.knotSpacing * parameters_.search.turningRadius;
        return shorten(search_.cost(), path, cost, std::max(spacing, coarsest), 0.0, INFINITE, CurveChoice::Cheapest);
    }

    bool PathPlanner::shortenByOtherKnots(const CostModel &model, Path &path, double &cost, double coarsest)
    {
        const SearchTuning &tuning = parameters_.search.tuning;
        const double radius = parameters_.search.turningRadius;
        return shorten(model, path, cost, std::max(tuning.otherKnotSpacing * radius, coarsest),
                       tuning.otherKnotOffset * radius, tuning.widestSpan * radius, CurveChoice::Cheapest);
    }

    void PathPlanner::shortenTwice(Path &path, double &cost)
    {
        const double coarsest = path.length() / parameters_.search.tuning.mostKnots;
        shortenWhole(path, cost, coarsest);
        shortenByOtherKnots(search_.cost(), path, cost, coarsest);
    }

    bool PathPlanner::shortenBest(double spacing, double offset)
    {
        const SearchTuning &tuning = parameters_.search.tuning;
        Path path = bestPath_;
        double cost = bestCost_;
        const double widest = tuning.widestSpan * parameters_.search.turningRadius;
        return shorten(search_.cost(), path, cost, spacing, offset, widest, CurveChoice::All) && take(path, cost);
    }

    bool PathPlanner::isShortestPossible(const Path &path, double cost) const
    {
        // The bare curve is as short as any drivable path, whatever the obstacles. What it costs beyond its length may
        // be worth a longer way when it is more than a few changes of gear and steering come to.
        const double shortest = search_.shortestMotion();
        return path.length() <= shortest * (1.0 + 1e-9) && cost <= shortest + parameters_.search.turningRadius &&
               closeness(path) <= 0.0;
    }

    double PathPlanner::closeness(const Path &path) const
    {
        return pathCloseness(search_.cost(), path, *environment_);
    }

    PathPlanner::Outcome PathPlanner::solve(const StopFunction &stop, const ImprovementFunction &improved)
    {
        stop_ = stop;
        improved_ = improved;
        goodEnough_ = false;
        if (!hasSolution())
        {
            const SearchOutcome outcome = search_.run(stop);
            if (outcome != SearchOutcome::Improved)
                return outcome == SearchOutcome::Stopped ? Outcome::Stopped : Outcome::Exhausted;
            takeFirst();
        }
        else
        {
            // Roots were added, or the caller wants the old solution again.
            while (search_.run([] { return true; }) == SearchOutcome::Improved)
                take(search_.bestPath(), search_.bestCost());
        }
        if (goodEnough_ || !parameters_.anytime || isShortestPossible(bestPath_, bestCost_))
            return Outcome::Solved;
        return improve();
    }

    void PathPlanner::takeFirst()
    {
        const SearchTuning &tuning = parameters_.search.tuning;
        // A single curve that cannot be beaten ends the matter, and little can be gained by going on with a path that
        // is hardly longer than the shortest curve.
        if (isShortestPossible(search_.bestPath(), search_.bestCost()))
        {
            take(search_.bestPath(), search_.bestCost());
            return;
        }
        const double shortest = search_.shortestMotion(), little = tuning.hardlyLonger * shortest;
        const bool isShort = search_.bestPath().length() < little &&
                             search_.bestCost() < little + parameters_.search.turningRadius &&
                             closeness(search_.bestPath()) <= 0.0;
        const bool isShortest = search_.bestPath().length() <= shortest * (1.0 + 1e-9);
        const double expected = std::max(shortest, search_.estimate());
        // Nor with the shortest curve itself, dear as it may be, nor with what costs little more than it promised.
        const bool isBare = isShortest && search_.expanded() == 0;
        const bool isCheap =
            search_.bestCost() < tuning.hardlyDearer * expected && search_.bestPath().cusps() <= tuning.fewCusps;
        if (!isShort && !isBare && !isCheap)
            thinkAgain(expected);
        Path best = search_.bestPath();
        double cost = search_.bestCost();
        // A bare curve is shortened no more.
        if (parameters_.shorten && !(isShort && isShortest))
        {
            const double radius = parameters_.search.turningRadius, coarsest = best.length() / tuning.mostKnots;
            const bool isShorter = shortenWhole(best, cost, coarsest);
            // Near to obstacles, too, other knots find more; but hardly anything where the first found nothing.
            if (best.length() > (1.0 + tuning.stillLong) * expected || (isShorter && closeness(best) > 0.0))
                shortenByOtherKnots(search_.cost(), best, cost, coarsest);
            // A long path of many short pieces that is far from what it looked is often held by nothing but its knots.
            const bool isLong = !isBare && best.length() > tuning.shortToShortenAgain * radius;
            for (std::uint64_t k = 0; k < tuning.mostShortenings && isLong && cost > tuning.muchDearer * expected; ++k)
            {
                const Knots knots = otherKnots(k + 1, tuning.leastSpacing * radius, tuning.spacings * radius);
                shorten(search_.cost(), best, cost, std::max(knots.spacing, best.length() / tuning.mostKnots),
                        knots.offset, tuning.widestSpan * radius, CurveChoice::Cheapest);
            }
        }
        if (parameters_.shorten && cost > tuning.dearTurns * expected)
            turnRound(best, cost);
        if (parameters_.shorten && !isBare)
            relaxFirst(best, cost, cost / expected);
        if (parameters_.shorten && search_.cost().prefersClearance())
            findRoom(best, cost);
        take(best, cost);
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
        double costOfTurned = pathCost(search_.cost(), turned, *environment_);
        if (!isTimeUp())
            shortenTwice(turned, costOfTurned);
        if (!(costOfTurned < cost) || turned.cusps() > mostCuspsOf(path))
            return false;
        path = std::move(turned);
        cost = costOfTurned;
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
        if (isCheaper)
            cost = pathCost(search_.cost(), path, *environment_);
        return isCheaper;
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
            const double costOfOther = pathCost(search_.cost(), other, *environment_);
            if (costOfOther > most)
                return false;
            path = other;
            cost = costOfOther;
            return true;
        };
        if (!takeIfCheap(wider))
            return false;
        double strict = pathCost(widener.strictCost(), wider, *environment_);
        if (shortenByOtherKnots(widener.strictCost(), wider, strict, wider.length() / tuning.mostKnots))
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
        double costOfOther = pathCost(search_.cost(), other, *environment_);
        shortenWhole(other, costOfOther, other.length() / tuning.mostKnots);
        widen(other, costOfOther);
        if (costOfOther < cost)
        {
            best = std::move(other);
            cost = costOfOther;
        }
    }

    void PathPlanner::goOn(std::uint64_t expansions)
    {
        const std::uint64_t end = search_.expanded() + expansions;
        while (search_.run(stop_, end) == SearchOutcome::Improved)
        {
        }
    }

    void PathPlanner::thinkAgain(double expected)
    {
        const SearchTuning &tuning = parameters_.search.tuning;
        weights_ = weights_.lowered(tuning.weightsOfAfterthought);
        search_.setWeights(weights_);
        const double excess = search_.bestPath().length() / expected - 1.0;
        const double more = tuning.afterthought * static_cast<double>(search_.expanded()) +
                            tuning.afterthoughtPerExcess * std::clamp(excess, 0.0, tuning.mostExcess);
        goOn(tuning.leastAfterthought + static_cast<std::uint64_t>(more));
        if (search_.bestCost() > tuning.stillDear * expected)
            goOn(tuning.secondAfterthought);
    }

    bool PathPlanner::searchAnew()
    {
        const SearchTuning &tuning = parameters_.search.tuning;
        const double factor = parameters_.shorten ? tuning.dearerToBeShortened : 1.0;
        const std::uint64_t expansions = restarts_.expanded() + tuning.expansionsPerRound;
        const std::uint64_t searches = restarts_.searches() + tuning.restartsPerRound;
        bool progress = false;
        while (!goodEnough_ && restarts_.run(stop_, expansions, searches, factor * bestCost_))
        {
            Path path = restarts_.path();
            double cost = restarts_.cost();
            if (parameters_.shorten && !isTimeUp())
                shortenTwice(path, cost);
            if (parameters_.shorten && cost < factor * bestCost_)
                relaxAndShorten(path, cost);
            progress = take(path, cost) || progress;
        }
        return progress;
    }

    PathPlanner::Outcome PathPlanner::improve()
    {
        const SearchTuning &tuning = parameters_.search.tuning;
        bool searching = true;
        const double radius = parameters_.search.turningRadius;
        // From now on there are two searches that take memory.
        const std::size_t memory = parameters_.search.maxMemory;
        const auto share = static_cast<std::size_t>(tuning.memoryOfRestarts * static_cast<double>(memory));
        restarts_.setMaxMemory(std::min(share, memoryLeft()));
        search_.setMaxMemory(memory - share);
        for (;; ++round_)
        {
            if (goodEnough_)
                return Outcome::Solved;
            if (isTimeUp())
                return Outcome::Stopped;
            bool progress = false;
            if (parameters_.shorten)
                for (std::uint64_t k = 0; k < tuning.shorteningsPerRound && !goodEnough_ && !isTimeUp(); ++k)
                {
                    const Knots knots = otherKnots(3 * round_ + k + 1, 0.2 * radius, 0.6 * radius);
                    progress = shortenBest(knots.spacing, knots.offset) || progress;
                }
            if (parameters_.shorten)
                for (std::size_t k = 0; k < tuning.relaxationsPerRound && !goodEnough_ && !isTimeUp(); ++k)
                    progress = relaxBest() || progress;
            if (parameters_.shorten && !goodEnough_)
            {
                Path path = bestPath_;
                double cost = bestCost_;
                progress = (turnRound(path, cost) && take(path, cost)) || progress;
            }
            if (searching && !goodEnough_)
            {
                if (weights_.far > 1.0 || weights_.near > 1.0)
                {
                    weights_ = weights_.lowered(tuning.weightDecay);
                    search_.setWeights(weights_);
                }
                const std::uint64_t end = search_.expanded() + tuning.expansionsPerRound;
                SearchOutcome outcome;
                while ((outcome = search_.run(stop_, end)) == SearchOutcome::Improved && !goodEnough_)
                    progress = take(search_.bestPath(), search_.bestCost()) || progress;
                searching = outcome != SearchOutcome::Exhausted;
            }
            if (!goodEnough_ && !isTimeUp())
                progress = searchAnew() || progress;
            if (isShortestPossible(bestPath_, bestCost_) || (!searching && !progress && round_ > tuning.leastRounds))
                return Outcome::Solved;
        }
    }

    bool PathPlanner::approximate(const Pose &target, const StopFunction &stop, Path &path)
    {
        Search *search = &search_;
        if (search_.hasGoal() && !search_.hasSeenAllFromStart())
        {
            // The frontiers grew towards the goal itself. What is left of the time goes into coming near to it; but
            // where memory is short, another search would take as much again.
            if (starts_.empty() || search_.isFull() || (stop && stop()))
                return search_.nearestPath(target, path);
            if (!approach_)
                approach_ = std::make_unique<Search>();
            search = approach_.get();
            if (std::exchange(hasApproach_, true))
                approaches_ += approach_->statistics();
            SearchParameters parameters = parameters_.search;
            parameters.maxMemory = memoryLeft();
            search->begin(*environment_, parameters);
            for (const Pose &start : starts_)
                search->addStart(start);
        }
        if (search != &search_ || !search_.hasGoal())
        {
            search->setTarget(target);
            while (search->run(stop) == SearchOutcome::Improved)
            {
            }
        }
        if (!search->nearestPath(target, path))
            return false;
        Path other;
        if (search != &search_ && search_.nearestPath(target, other) &&
            positionDistance(other.end(), target) < positionDistance(path.end(), target))
            path = std::move(other);
        return true;
    }

    double PathPlanner::suboptimalityBound(double cost)
    {
        if (!hasSolution())
            return INFINITE;
        const double bound = search_.lowerBound();
        return bound > 0.0 ? std::max(1.0, cost / bound) : INFINITE;
    }

    SearchStatistics PathPlanner::statistics() const
    {
        SearchStatistics sum = search_.statistics();
        sum += restarts_.statistics();
        sum += approaches_;
        if (hasApproach_)
            sum += approach_->statistics();
        if (hasRoomySearch_)
            sum += roomySearch_->statistics();
        sum.connections += shortenerConnections_;
        return sum;
    }
}  // namespace parking::search

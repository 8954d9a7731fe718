#include "ompl_improved_astar/search/planning/PathPlanner.h"

#include "ompl_improved_astar/search/planning/Knots.h"

#include <algorithm>
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
        replanner_.begin(environment, parameters_.search);
        CostModel closer = search_.cost();
        closer.samplesApart = parameters_.search.tuning.closerSamples;
        prices_.begin(environment, search_.cost());
        closerPrices_.begin(environment, closer);
        starts_.clear();
        bestPath_ = {};
        bestCost_ = INFINITE;
        costWhenTurned_ = costWhenRelaxed_ = INFINITE;
        relaxations_ = 0;
        shortenerConnections_ = 0;
        approach_.forget();
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
        if (!search_.cost().prefersClearance())
            return true;
        const std::optional<double> cost = closerPrices_.cost(path, stop_);
        const std::optional<double> best = cost ? closerPrices_.cost(bestPath_, stop_) : std::nullopt;
        return best && *cost < *best;
    }

    bool PathPlanner::isShortestPossible(const Path &path, double cost)
    {
        // The bare curve is as short as any drivable path, whatever the obstacles. What it costs beyond its length may
        // be worth a longer way when it is more than a few changes of gear and steering come to.
        const double shortest = search_.shortestMotion();
        return path.length() <= shortest * (1.0 + 1e-9) && cost <= shortest + parameters_.search.turningRadius &&
               isKnownToBeClear(path);
    }

    bool PathPlanner::isKnownToBeClear(const Path &path)
    {
        const std::optional<double> closeness = prices_.closeness(path, stop_);
        return closeness && *closeness <= 0.0;
    }

    double PathPlanner::closenessOfBest()
    {
        const std::optional<double> closeness = prices_.closeness(bestPath_, stop_);
        return closeness ? *closeness : std::max(0.0, bestCost_ - costWithoutCloseness(search_.cost(), bestPath_));
    }

    double PathPlanner::closenessShare(const Path &path, double cost) const
    {
        return cost > 0.0 ? (cost - costWithoutCloseness(search_.cost(), path)) / cost : 0.0;
    }

    bool PathPlanner::passesClosely(const Path &path, double cost)
    {
        const double share = parameters_.search.tuning.dearlyClose, length = path.length(),
                     end = parameters_.search.tuning.closeToEnds * parameters_.search.turningRadius;
        if (length <= 2.0 * end || closenessShare(path, cost) <= share)
            return false;
        const std::optional<double> closeness =
            pathCloseness(search_.cost(), path.first(length - end).rest(end), *environment_, stop_);
        return closeness && *closeness > share * cost;
    }

    double PathPlanner::expectedLength()
    {
        return std::max(search_.shortestMotion(), search_.estimate());
    }

    PathPlanner::Outcome PathPlanner::solve(const StopFunction &stop, const ImprovementFunction &improved)
    {
        stop_ = stop;
        improved_ = improved;
        const Outcome outcome = goOnSolving();
        // Whom stop asks may be gone from now on.
        stop_ = []
        {
            return true;
        };
        return outcome;
    }

    PathPlanner::Outcome PathPlanner::goOnSolving()
    {
        goodEnough_ = false;
        if (!hasSolution())
        {
            const SearchOutcome outcome = search_.run(stop_);
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
                             isKnownToBeClear(search_.bestPath());
        const bool isShortest = search_.bestPath().length() <= shortest * (1.0 + 1e-9);
        const double expected = expectedLength();
        // Nor with the shortest curve itself, unless it is very near to something, nor with what costs little more than
        // it promised.
        const bool isBare = isShortest && search_.expanded() == 0 &&
                            closenessShare(search_.bestPath(), search_.bestCost()) <= tuning.dearlyClose;
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
            if (best.length() > (1.0 + tuning.stillLong) * expected || (isShorter && !isKnownToBeClear(best)))
                shortenByOtherKnots(prices_, best, cost, coarsest);
            // A long path of many short pieces that is far from what it looked is often held by nothing but its knots.
            const bool isLong = !isBare && best.length() > tuning.shortToShortenAgain * radius;
            for (std::uint64_t k = 0; k < tuning.mostShortenings && isLong && cost > tuning.muchDearer * expected; ++k)
            {
                const Knots knots = otherKnots(k + 1, tuning.leastSpacing * radius, tuning.spacings * radius);
                shorten(prices_, best, cost, std::max(knots.spacing, best.length() / tuning.mostKnots), knots.offset,
                        tuning.widestSpan * radius, CurveChoice::Cheapest);
            }
        }
        if (parameters_.shorten && cost > tuning.dearTurns * expected)
            turnRound(best, cost);
        if (parameters_.shorten && !isBare)
            relaxFirst(best, cost, cost / expected);
        if (parameters_.shorten && search_.cost().prefersClearance())
            findRoom(best, cost, OtherWay::Allowed);
        take(best, cost);
        if (parameters_.shorten && !goodEnough_ && !search_.isFull() && passesClosely(best, cost))
        {
            restarts_.setMaxMemory(memoryLeft());
            searchAnew(ENDLESS, 1, Room::Sought);
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
        search_.setWeights(weights_, stop_);
        const double excess = search_.bestPath().length() / expected - 1.0;
        const double more = tuning.afterthought * static_cast<double>(search_.expanded()) +
                            tuning.afterthoughtPerExcess * std::clamp(excess, 0.0, tuning.mostExcess);
        goOn(tuning.leastAfterthought + static_cast<std::uint64_t>(more));
        if (search_.bestCost() > tuning.stillDear * expected)
            goOn(tuning.secondAfterthought);
    }

    bool PathPlanner::searchAnew(std::uint64_t expansions, std::uint64_t searches, Room room)
    {
        const SearchTuning &tuning = parameters_.search.tuning;
        const double factor = parameters_.shorten ? tuning.dearerToBeShortened : 1.0;
        const std::uint64_t mostExpansions = restarts_.expanded() + expansions;
        const std::uint64_t mostSearches = restarts_.searches() + searches;
        bool progress = false;
        while (!goodEnough_ && restarts_.run(stop_, mostExpansions, mostSearches, factor * bestCost_))
        {
            Path path = restarts_.path();
            double cost = restarts_.cost();
            if (parameters_.shorten && !isTimeUp())
                shortenTwice(path, cost);
            if (parameters_.shorten && cost < factor * bestCost_)
                relaxAndShorten(path, cost);
            if (room == Room::Sought && search_.cost().prefersClearance() && cost < factor * bestCost_)
                findRoom(path, cost, OtherWay::Excluded);
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
                    search_.setWeights(weights_, stop_);
                }
                const std::uint64_t end = search_.expanded() + tuning.expansionsPerRound;
                SearchOutcome outcome;
                while ((outcome = search_.run(stop_, end)) == SearchOutcome::Improved && !goodEnough_)
                    progress = take(search_.bestPath(), search_.bestCost()) || progress;
                searching = outcome != SearchOutcome::Exhausted;
            }
            if (!goodEnough_ && !isTimeUp())
                progress = searchAnew(tuning.expansionsPerRound, tuning.restartsPerRound, Room::AsItIs) || progress;
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
            SearchParameters parameters = parameters_.search;
            parameters.maxMemory = memoryLeft();
            search = &approach_.begin(*environment_, parameters);
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
        sum += approach_.statistics();
        sum += replanner_.statistics();
        sum.connections += shortenerConnections_;
        return sum;
    }
}  // namespace parking::search

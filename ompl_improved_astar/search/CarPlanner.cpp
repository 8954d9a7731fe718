#include "ompl_improved_astar/search/CarPlanner.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace parking::search
{
    namespace
    {
        // After the first solution the search goes on for this part of its expansions, and at least so many.
        constexpr double AFTERTHOUGHT = 0.3;
        constexpr std::uint64_t LEAST_AFTERTHOUGHT = 8;
        // And so many more when the solution is twice as long as the way looked, or more; in proportion when it is
        // less.
        constexpr double AFTERTHOUGHT_PER_EXCESS = 35.0;
        constexpr double MOST_EXCESS = 1.0;
        // It looks at what is cheap so far rather than at what is near: the part of the weights that remains.
        constexpr double WEIGHTS_OF_AFTERTHOUGHT = 0.7;
        constexpr double SHORT = 1.03;  // hardly longer than the bare curve: nothing to look for
        // Knots of the first shortening: their distance in turning radii, and no more than so many on long paths.
        constexpr double SPACING = 0.5;
        constexpr double MOST_KNOTS = 20.0;
        // A path still longer than it looked by this part is shortened once more, with other knots.
        constexpr double LONG = 0.15;
        constexpr double OTHER_SPACING = 0.48, OTHER_OFFSET = 0.15;
        // Later ones look at parts of the path up to so many turning radii long.
        constexpr double WIDEST = 12.0;
        // Expansions between two rounds of shortening while improving, and how the weights fall from round to round.
        constexpr std::uint64_t EXPANSIONS_PER_ROUND = 200;
        constexpr double WEIGHT_DECAY = 0.8;
        constexpr std::uint64_t SHORTENINGS_PER_ROUND = 3;
        constexpr double INFINITE = std::numeric_limits<double>::infinity();

        double positionDistance(const Pose &a, const Pose &b)
        {
            return std::hypot(a.x - b.x, a.y - b.y);
        }
    }  // namespace

    void CarPlanner::begin(MotionEnvironment &environment, const CarPlannerParameters &parameters)
    {
        environment_ = &environment;
        parameters_ = parameters;
        parameters_.search.cost.fullLockCurvature = 1.0 / parameters.search.turningRadius;
        search_.begin(environment, parameters_.search);
        starts_.clear();
        bestPath_ = {};
        bestCost_ = std::numeric_limits<double>::infinity();
        shortenerConnections_ = 0;
        goodEnough_ = false;
        round_ = 0;
        weights_ = parameters.search.weights;
    }

    bool CarPlanner::take(const Path &path, double cost)
    {
        if (!(cost < bestCost_ - 1e-9))
            return false;
        bestPath_ = path;
        bestCost_ = cost;
        search_.setCostBound(cost);
        if (improved_ && improved_(bestPath_, bestCost_))
            goodEnough_ = true;
        return true;
    }

    bool CarPlanner::shorten(Path &path, double &cost, double spacing, double offset, double widest, CurveChoice choice)
    {
        PathShortener shortener(*environment_, search_.curves(), parameters_.search.cost);
        Path shorter = path;
        const bool isShorter = shortener.pass(shorter, spacing, offset, widest, choice, stop_);
        shortenerConnections_ += shortener.connections();
        if (!isShorter)
            return false;
        // Clearance is sampled, so that the cost of the whole is not quite the sum of its parts'.
        const double less = pathCost(parameters_.search.cost, shorter, *environment_);
        if (!(less < cost))
            return false;
        path = std::move(shorter);
        cost = less;
        return true;
    }

    bool CarPlanner::shortenBest(double spacing, double offset)
    {
        Path path = bestPath_;
        double cost = bestCost_;
        const double widest = WIDEST * parameters_.search.turningRadius;
        return shorten(path, cost, spacing, offset, widest, CurveChoice::All) && take(path, cost);
    }

    bool CarPlanner::isShortestPossible(const Path &path, double cost) const
    {
        // The bare curve is as short as any drivable path, whatever the obstacles. What it costs beyond its length may
        // be worth a longer way when it is more than a few changes of gear and steering come to.
        const double shortest = search_.shortestCurve();
        return path.length() <= shortest * (1.0 + 1e-9) && cost <= shortest + parameters_.search.turningRadius;
    }

    CarPlanner::Outcome CarPlanner::solve(const StopFunction &stop, const ImprovementFunction &improved)
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

    void CarPlanner::takeFirst()
    {
        // A single curve that cannot be beaten ends the matter, and little can be gained by going on with a path that
        // is hardly longer than the shortest curve.
        if (isShortestPossible(search_.bestPath(), search_.bestCost()))
        {
            take(search_.bestPath(), search_.bestCost());
            return;
        }
        const double little = SHORT * search_.shortestCurve();
        const bool isShort =
            search_.bestPath().length() < little && search_.bestCost() < little + parameters_.search.turningRadius;
        const double expected = std::max(search_.shortestCurve(), search_.estimate());
        if (!isShort)
            thinkAgain(search_.bestPath().length() / expected - 1.0);
        Path best = search_.bestPath();
        double cost = search_.bestCost();
        if (parameters_.shorten)
        {
            const double radius = parameters_.search.turningRadius, coarsest = best.length() / MOST_KNOTS;
            shorten(best, cost, std::max(SPACING * radius, coarsest), 0.0, INFINITE, CurveChoice::Cheapest);
            if (best.length() > (1.0 + LONG) * expected)
                shorten(best, cost, std::max(OTHER_SPACING * radius, coarsest), OTHER_OFFSET * radius, WIDEST * radius,
                        CurveChoice::Cheapest);
        }
        take(best, cost);
    }

    void CarPlanner::thinkAgain(double excess)
    {
        const auto lower = [](double weight)
        {
            return weight > 1.0 ? std::max(1.0, WEIGHTS_OF_AFTERTHOUGHT * weight) : weight;
        };
        weights_.far = lower(weights_.far);
        weights_.near = lower(weights_.near);
        search_.setWeights(weights_);
        const std::uint64_t spent = search_.statistics().expanded;
        const double more =
            AFTERTHOUGHT * static_cast<double>(spent) + AFTERTHOUGHT_PER_EXCESS * std::clamp(excess, 0.0, MOST_EXCESS);
        const std::uint64_t end = spent + LEAST_AFTERTHOUGHT + static_cast<std::uint64_t>(more);
        const StopFunction enough = [this, end]
        {
            return search_.statistics().expanded >= end || (stop_ && stop_());
        };
        while (search_.run(enough) == SearchOutcome::Improved)
        {
        }
    }

    CarPlanner::Outcome CarPlanner::improve()
    {
        bool searching = true;
        const double radius = parameters_.search.turningRadius;
        for (;; ++round_)
        {
            if (goodEnough_)
                return Outcome::Solved;
            if (stop_ && stop_())
                return Outcome::Stopped;
            bool progress = false;
            if (parameters_.shorten)
                for (std::uint64_t k = 0; k < SHORTENINGS_PER_ROUND && !goodEnough_ && !(stop_ && stop_()); ++k)
                {
                    // Spacings and offsets that do not repeat for long: the golden ratio's multiples fill the interval.
                    const double fraction = std::fmod(0.618033988749895 * static_cast<double>(3 * round_ + k + 1), 1.0);
                    const double spacing = radius * (0.2 + 0.6 * fraction);
                    progress = shortenBest(spacing, spacing * std::fmod(7.0 * fraction, 1.0)) || progress;
                }
            if (searching && !goodEnough_)
            {
                const double least = std::max(1.0, weights_.far * WEIGHT_DECAY);
                if (weights_.far > 1.0 || weights_.near > 1.0)
                {
                    weights_.far = least;
                    weights_.near = std::max(1.0, weights_.near * WEIGHT_DECAY);
                    search_.setWeights(weights_);
                }
                const std::uint64_t end = search_.statistics().expanded + EXPANSIONS_PER_ROUND;
                const StopFunction enough = [&]
                {
                    return search_.statistics().expanded >= end || (stop_ && stop_());
                };
                SearchOutcome outcome;
                while ((outcome = search_.run(enough)) == SearchOutcome::Improved && !goodEnough_)
                    progress = take(search_.bestPath(), search_.bestCost()) || progress;
                searching = outcome != SearchOutcome::Exhausted;
            }
            if (isShortestPossible(bestPath_, bestCost_) || (!searching && !progress && round_ > 50))
                return Outcome::Solved;
        }
    }

    bool CarPlanner::approximate(const Pose &target, const StopFunction &stop, Path &path)
    {
        CarSearch *search = &search_;
        if (search_.hasGoal())
        {
            // The trees were after the goal itself. What is left of the time goes into coming near to it.
            if (starts_.empty() || (stop && stop()))
                return search_.nearestPath(target, path);
            if (!approach_)
                approach_ = std::make_unique<CarSearch>();
            search = approach_.get();
            search->begin(*environment_, parameters_.search);
            for (const Pose &start : starts_)
                search->addStart(start);
        }
        search->setTarget(target);
        while (search->run(stop) == SearchOutcome::Improved)
        {
        }
        if (!search->nearestPath(target, path))
            return false;
        Path other;
        if (search != &search_ && search_.nearestPath(target, other) &&
            positionDistance(other.end(), target) < positionDistance(path.end(), target))
            path = std::move(other);
        return true;
    }

    double CarPlanner::suboptimalityBound()
    {
        if (!hasSolution())
            return std::numeric_limits<double>::infinity();
        // No path is shorter than the bare curve, and no motion costs less than its length.
        const double bound = std::max(search_.lowerBound(), search_.shortestCurve());
        return bound > 0.0 ? std::max(1.0, bestCost_ / bound) : std::numeric_limits<double>::infinity();
    }

    SearchStatistics CarPlanner::statistics() const
    {
        SearchStatistics sum = search_.statistics();
        sum.connections += shortenerConnections_;
        return sum;
    }
}  // namespace parking::search

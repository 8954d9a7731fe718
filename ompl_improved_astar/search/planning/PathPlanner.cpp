#include "ompl_improved_astar/search/planning/PathPlanner.h"

#include "ompl_improved_astar/search/Tuning.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace parking::search
{
    namespace
    {
        constexpr double FINE_SAMPLES = 0.02;  // metres between the poses at which the clearance is sampled finely
        constexpr std::size_t CURVES_TO_SHORTEN = 2;   // tried between two poses of a first path
        constexpr double KNOT_SHIFT = 0.3;             // of the knots in a second pass, in spacings
        constexpr std::uint64_t PASSES_PER_ROUND = 9;  // of anytime, one of which turns the car
        constexpr std::size_t MAX_ESCAPES = 6;         // from a start, roots of the search
        constexpr std::uint64_t MIN_PASSES = 450;      // that find nothing, before planning ends while there is time

        /** The multiples of these, without their whole parts, fill the unit cube evenly (after M. Roberts, "The
            unreasonable effectiveness of quasirandom sequences", 2018). */
        double fraction(std::uint64_t number, std::size_t dimension)
        {
            constexpr double STEPS[3]{0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
            return std::fmod(0.5 + STEPS[dimension] * static_cast<double>(number), 1.0);
        }
    }  // namespace

    void PathPlanner::begin(MotionEnvironment &environment, const PlannerParameters &parameters, const CarInSpace &car)
    {
        environment_ = &environment;
        parameters_ = parameters;
        car_ = car;
        search_.begin(environment, parameters, car);
        improver_.reset();
        if (const ReedsShepp *curves = search_.model().curves())
            improver_.emplace(environment, *curves, search_.cost(), car.centreOffset);
        approach_.reset();
        starts_.clear();
        goals_.clear();
        isGoodEnough_ = false;
        best_ = {};
        best_.cost = HUGE_VAL;
        whole_ = best_;
        first_ = last_ = {};
        passes_ = 0;
    }

    void PathPlanner::addStart(const Pose &pose)
    {
        const double straight = improver_ ? parameters_.initialStraight : 0.0;
        for (const Pose &root :
             starts_.add(pose, straight, parameters_.preferredClearance, false, car_.forwardOnly, *environment_))
            search_.addStart(root);
    }

    void PathPlanner::addGoal(const Pose &pose)
    {
        const double straight = improver_ ? parameters_.finalStraight : 0.0;
        for (const Pose &root :
             goals_.add(pose, straight, parameters_.preferredClearance, true, car_.forwardOnly, *environment_))
            search_.addGoal(root);
    }

    bool PathPlanner::addEscapes(const Pose &pose)
    {
        if (!parameters_.escape || !improver_ || !isFinite(pose))
            return false;
        std::size_t count = 0;
        for (const Escape &escape :
             environment_->escapes(pose, parameters_.maxEscapeDepth, car_.turningRadius, car_.forwardOnly))
            if (environment_->isFree(escape.end()) && ++count <= MAX_ESCAPES)
            {
                starts_.add(escape);
                search_.addStart(escape.end());
            }
        return count > 0;
    }

    PathPlanner::Outcome PathPlanner::solve(const StopFunction &stop, const ImprovementFunction &improved)
    {
        stop_ = stop;
        improved_ = improved;
        isGoodEnough_ = false;
        Outcome outcome = Outcome::Solved;
        if (takeStay())
            return outcome;
        if (!hasSolution())
        {
            const SearchOutcome found = search_.run(stop);
            if (found == SearchOutcome::Improved)
                planFirst();
            else
                outcome = found == SearchOutcome::Stopped ? Outcome::Stopped : Outcome::Exhausted;
        }
        else if (search_.bestCost() < best_.cost)  // roots were added
            take(priced(search_.bestPath(), search_.bestCost()));
        if (hasSolution() && !isGoodEnough_ && parameters_.anytime && improver_ && !isShortestPossible(best_))
            outcome = planAnytime();
        endCall();
        return outcome;
    }

    void PathPlanner::endCall()
    {
        // stop may refer to what is gone from now on.
        stop_ = []
        {
            return true;
        };
    }

    void PathPlanner::offer(const Path &path, const StopFunction &stop, const ImprovementFunction &improved)
    {
        stop_ = stop;
        improved_ = improved;
        PricedPath candidate = priced(path, path.length());
        if (improver_ && parameters_.shortening)
            improveFirst(candidate, search_.expectedCost());
        take(candidate);
        endCall();
    }

    void PathPlanner::planFirst()
    {
        PricedPath path = priced(search_.bestPath(), search_.bestCost());
        const double expected = search_.expectedCost(), radius = car_.turningRadius;
        const double nearOptimal =
            std::min(tuning::NEAR_OPTIMAL * expected, expected + tuning::NEAR_OPTIMAL_EXCESS * radius);
        if (!isShortestPossible(path) && path.cost > nearOptimal)
        {
            // Searching on is cheap when the search was, and the more worthwhile the longer the path.
            const double excess =
                std::clamp((path.path.length() - expected) / std::min(expected, tuning::MAX_EXCESS * radius), 0.0, 1.0);
            const double more = tuning::POST_SEARCH_PER_EXCESS * excess +
                                tuning::POST_SEARCH_SHARE * static_cast<double>(search_.expanded());
            search_.lowerWeights(tuning::WEIGHT_DECAY);
            const std::uint64_t end = search_.expanded() + static_cast<std::uint64_t>(more);
            while (search_.run(stop_, end) == SearchOutcome::Improved)
            {
            }
            path = priced(search_.bestPath(), search_.bestCost());
        }
        if (improver_ && parameters_.shortening && !isShortestPossible(path))
            improveFirst(path, expected);
        take(path);
    }

    PathPlanner::Outcome PathPlanner::planAnytime()
    {
        bool isSearching = true;
        std::uint64_t improvedAt = passes_;
        while (!isGoodEnough_ && !isShortestPossible(best_))
        {
            if (isStopped())
                return Outcome::Stopped;
            for (std::uint64_t i = 0; i < PASSES_PER_ROUND && parameters_.shortening && !isGoodEnough_ && !isStopped();
                 ++i)
                if (improveBest())
                    improvedAt = passes_;
            if (isSearching && !isGoodEnough_)
            {
                search_.lowerWeights(tuning::WEIGHT_DECAY);
                const std::uint64_t end = search_.expanded() + tuning::ROUND_EXPANSIONS;
                SearchOutcome outcome;
                while ((outcome = search_.run(stop_, end)) == SearchOutcome::Improved && !isGoodEnough_)
                    if (take(priced(search_.bestPath(), search_.bestCost())))
                        improvedAt = passes_;
                isSearching = outcome != SearchOutcome::Exhausted;
            }
            if (!isSearching && (passes_ > improvedAt + MIN_PASSES || !parameters_.shortening))
                break;
        }
        return Outcome::Solved;
    }

    /** A path of the search with its costs, which are those that the search has summed up if there is no time. */
    PricedPath PathPlanner::priced(const Path &path, double cost) const
    {
        if (std::optional<PricedPath> result = price(search_.cost(), path, *environment_, stop_))
            return *result;
        CostModel bare = search_.cost();
        bare.clearanceCost = 0.0;
        PricedPath result = price(bare, path, *environment_);
        if (!result.proximity.empty())
            result.proximity.front() = std::max(0.0, cost - result.cost);
        result.cost = cost;
        return result;
    }

    bool PathPlanner::isAtGoal(const Pose &start) const
    {
        return std::any_of(goals_.motions().begin(), goals_.motions().end(),
                           [&](const EndMotion &goal)
                           { return isSamePose(start, goal.pose, parameters_.goalTolerance); });
    }

    /** Takes the path without motion of a start at a goal. */
    bool PathPlanner::takeStay()
    {
        for (const EndMotion &start : starts_.motions())
            if (!start.escape && isAtGoal(start.pose))
            {
                if (best_.cost > 0.0)
                {
                    best_ = whole_ = {{start.pose, {}}, {}, 0.0};
                    first_ = last_ = {};
                    if (improved_)
                        improved_(whole_.path, whole_.cost);
                }
                return true;
            }
        return false;
    }

    /** A path of the search with the motions at its ends. */
    PricedPath PathPlanner::withEnds(const PricedPath &path) const
    {
        const EndMotion *first = starts_.at(path.path.start), *last = goals_.at(path.path.end());
        const bool hasFirst = first != nullptr && first->arc.length != 0.0;
        const bool hasLast = last != nullptr && last->arc.length != 0.0;
        if (!hasFirst && !hasLast)
            return path;
        Path whole = path.path;
        if (hasFirst)
        {
            whole = {first->pose, {first->arc}};
            whole.extend(path.path);
        }
        if (hasLast)
            whole.append(last->arc);
        return priced(whole, path.cost + (hasFirst ? std::abs(first->arc.length) : 0.0) +
                                 (hasLast ? std::abs(last->arc.length) : 0.0));
    }

    bool PathPlanner::take(const PricedPath &path)
    {
        if (!(path.cost < best_.cost) || (hasSolution() && !isCheaperFinelySampled(path.path)))
            return false;
        PricedPath whole = withEnds(path);
        if (!(whole.cost < whole_.cost))
            return false;
        best_ = path;
        whole_ = std::move(whole);
        first_ = *starts_.at(path.path.start);
        last_ = *goals_.at(path.path.end());
        search_.setCostBound(best_.cost);
        isGoodEnough_ = (improved_ && improved_(whole_.path, whole_.cost)) || isGoodEnough_;
        return true;
    }

    /** Is a path cheaper than the best one where both are sampled finely? What looks cheaper and cheaper may do so by
        being near to obstacles between the samples. Not if there is no time to find out. */
    bool PathPlanner::isCheaperFinelySampled(const Path &path) const
    {
        CostModel fine = search_.cost();
        fine.sampleSpacing = FINE_SAMPLES;
        if (!fine.prefersClearance())
            return true;
        const std::optional<PricedPath> other = price(fine, path, *environment_, stop_),
                                        best = other ? price(fine, best_.path, *environment_, stop_) : std::nullopt;
        return best && other->cost < best->cost;
    }

    bool PathPlanner::isShortestPossible(const PricedPath &path) const
    {
        // The bare curve is as short as any drivable path, whatever the obstacles. Its cost beyond its length may be
        // worth a longer path when it is more than a few changes of gear and steering come to.
        const double shortest = search_.shortestMotion();
        return path.path.length() <= shortest * (1.0 + 1e-9) && path.cost <= shortest + car_.turningRadius &&
               path.totalProximity() <= 0.0;
    }

    bool PathPlanner::improve(PricedPath &path, const PathImprover::Pass &pass)
    {
        return !isStopped() &&
               improver_->improve(path, pass, std::max<std::size_t>(path.path.cusps(), car_.maxCusps), stop_);
    }

    void PathPlanner::improveFirst(PricedPath &path, double expected)
    {
        const double radius = car_.turningRadius;
        const auto passOf = [&](double spacing)
        {
            return PathImprover::Pass{std::max(spacing * radius, path.path.length() / tuning::MAX_KNOTS)};
        };
        // What the search has cost is worth as much improving: tight places take long to improve by little.
        const double effort = tuning::IMPROVEMENT_EFFORT +
                              tuning::IMPROVEMENT_EFFORT_PER_EXPANSION * static_cast<double>(search_.expanded());
        const std::uint64_t end = improver_->connections() + static_cast<std::uint64_t>(effort);
        const auto isCostly = [&](double ratio)
        {
            return path.cost > ratio * expected && improver_->connections() < end;
        };
        const auto shorten = [&]
        {
            PathImprover::Pass pass = passOf(tuning::KNOT_SPACING);
            pass.maxCurves = CURVES_TO_SHORTEN;
            if (!improve(path, pass) || !isCostly(tuning::NEAR_OPTIMAL))
                return;
            // Near to obstacles other knots find more; hardly anything where the first found nothing.
            pass.offset = KNOT_SHIFT * pass.spacing;
            improve(path, pass);
        };
        shorten();
        if (path.path.cusps() > 0 && isCostly(tuning::COSTLY_RATIO))
        {
            PathImprover::Pass turn = passOf(2.0 * tuning::KNOT_SPACING);
            turn.turnsCar = true;
            if (improve(path, turn))
                shorten();
        }
        for (const double step : {tuning::MOVE_STEP, 0.25 * tuning::MOVE_STEP})
            for (int i = 0; i < tuning::MAX_MOVES && isCostly(tuning::COSTLY_RATIO); ++i)
            {
                PathImprover::Pass pass = passOf(2.0 * tuning::KNOT_SPACING);
                pass.reach = tuning::MOVE_REACH * radius;
                pass.step = step * radius;
                if (!improve(path, pass))
                    break;
            }
    }

    /** One pass over the best path, each with other knots and steps than the ones before. */
    bool PathPlanner::improveBest()
    {
        const double radius = car_.turningRadius;
        const std::uint64_t number = ++passes_;
        PricedPath path = best_;
        PathImprover::Pass pass{
            std::max((0.2 + 0.6 * fraction(number, 0)) * radius, path.path.length() / (2.0 * tuning::MAX_KNOTS))};
        pass.offset = pass.spacing * fraction(number, 1);
        pass.reach = 3.0 * tuning::TURN_REACH * radius;
        if (number % PASSES_PER_ROUND == 0)
        {
            pass.spacing *= 2.0;
            pass.turnsCar = true;
        }
        else if (number % 2 == 0)
        {
            pass.reach = tuning::TURN_REACH * radius;
            pass.step = 0.3 * std::pow(0.1, fraction(number, 2)) * radius;
        }
        return improve(path, pass) && take(path);
    }

    bool PathPlanner::approximate(const Pose &target, const StopFunction &stop, Path &path)
    {
        if (!approach(target, stop, path))
            return false;
        first_ = *starts_.at(path.start);
        last_ = {};
        if (first_.arc.length != 0.0)
        {
            Path whole{first_.pose, {first_.arc}};
            whole.extend(path);
            path = std::move(whole);
        }
        return true;
    }

    bool PathPlanner::approach(const Pose &target, const StopFunction &stop, Path &path)
    {
        const auto search = [&](Search &towards)
        {
            towards.setTarget(target);
            while (towards.run(stop) == SearchOutcome::Improved)
            {
            }
        };
        const bool hasGoal = !goals_.motions().empty();
        if (!hasGoal)
            search(search_);
        const bool isStuck =
            starts_.motions().empty() || search_.isFull() || (stop && stop()) || search_.hasSeenAllFromStart();
        if (!hasGoal || isStuck)
            return search_.nearestPath(target, path);
        // The frontiers grew towards the goal itself. What is left of the time goes into coming near to it.
        if (!approach_)
            approach_ = std::make_unique<Search>();
        approach_->begin(*environment_, parameters_, car_);
        const std::size_t memory = std::size_t{parameters_.maxMemoryMb} << 20;
        approach_->setMaxMemory(memory - std::min(memory, search_.memory()));
        for (const EndMotion &start : starts_.motions())
            approach_->addStart(start.root);
        search(*approach_);
        Path other;
        if (!approach_->nearestPath(target, path) || !search_.nearestPath(target, other))
            return false;
        if (positionDistance(other.end(), target) < positionDistance(path.end(), target))
            path = std::move(other);
        return true;
    }

    double PathPlanner::suboptimalityBound(double cost)
    {
        if (hasSolution() && cost == 0.0)
            return 1.0;
        const double bound = hasSolution() ? search_.lowerBound() + starts_.minLength() + goals_.minLength() : 0.0;
        return bound > 0.0 ? std::max(1.0, cost / bound) : HUGE_VAL;
    }

    std::string PathPlanner::notice() const
    {
        std::string text;
        if (first_.escape)
        {
            const double length = first_.arc.length;
            text = "the start is in contact with obstacles, " + formatNumber(100.0 * first_.escape->depth, 1) +
                   " cm deep; the path leaves it by an escape of " + formatNumber(std::abs(length), 2) + " m " +
                   (length > 0.0 ? "forwards" : "in reverse");
        }
        const auto compare = [&](const char *name, double required, const EndMotion &motion)
        {
            const double length = std::abs(motion.arc.length);
            if (required > length)
                text +=
                    (text.empty() ? "" : "; ") + std::string(name) + ": " +
                    (improver_ ? "only " + formatNumber(length, 2) + " of " + formatNumber(required, 2) + " m are free"
                               : "kept by motion models of curves only, such as car");
        };
        if (!hasSolution() && parameters_.initialStraight + parameters_.finalStraight > 0.0)
            text += (text.empty() ? "" : "; ") +
                    std::string("initial_straight or final_straight may leave no room for a path: try shorter ones");
        if (whole_.path.pieces.empty())
            return text;
        if (!first_.escape)
            compare("initial_straight", parameters_.initialStraight, first_);
        compare("final_straight", parameters_.finalStraight, last_);
        return text;
    }

    SearchStatistics PathPlanner::statistics() const
    {
        SearchStatistics sum = search_.statistics();
        if (approach_)
            sum += approach_->statistics();
        sum.connections += improver_ ? improver_->connections() : 0;
        return sum;
    }
}  // namespace parking::search

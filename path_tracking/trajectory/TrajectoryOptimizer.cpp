#include "path_tracking/trajectory/TrajectoryOptimizer.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Require.h"
#include "parking_geometry/text/Text.h"
#include "path_tracking/trajectory/MotionCheck.h"
#include "path_tracking/trajectory/MotionSolver.h"
#include "path_tracking/trajectory/StopAndSteer.h"
#include "path_tracking/trajectory/program/MotionGuess.h"
#include "path_tracking/trajectory/program/MotionOutline.h"
#include "state_validity/sweeps/PathSweep.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace parking
{
    namespace
    {
        constexpr double RANGE = 1.5;           // metres within which obstacles are considered in the first round
        constexpr double ENOUGH_GAIN = 3e-3;    // share of the cost that another round must gain
        constexpr double PROMISING = 1.05;      // ratio to the best cost up to which a solution is improved
        constexpr double LIKELY = 1.02;         // ratio to the best cost up to which the lower bound of a path is tried
        constexpr double ALIKE = 1.2;           // metres between paths that share one program
        constexpr double SAME_COST = 1e-3;      // relative difference of cost below which two solutions are equal
        constexpr std::size_t MAX_RETRIES = 2;  // of an invalid motion that is faster than the best valid one
        constexpr double LONGEST_DROPPED = 0.5;  // maximum length in metres of a stretch that is dropped
        constexpr std::size_t MAX_DROPS = 4;     // attempts to drop stretches
        constexpr double LIMITS_LEFT = 2e-5;     // share of the limits reserved for rounding
        constexpr double MAX_INTERVALS = 1e4;    // of an optimised motion: 8 kB and 0.2 ms each
        /** Options of programs that start from a guess, and of those without a stretch, which succeed soon or never. */
        constexpr InteriorPointOptions FROM_GUESS{}, DROPPING{5e-3, 2e-5, 40};

        /** Whether two paths are near each other at equal shares of their lengths. */
        bool isNear(const Path &a, const Path &b)
        {
            constexpr double LONGEST_STEP = 2.0;  // metres between two comparisons
            constexpr double FEWEST_STEPS = 4.0;
            const double lengthA = a.length(), lengthB = b.length();
            const double steps = std::max(FEWEST_STEPS, std::ceil(std::max(lengthA, lengthB) / LONGEST_STEP));
            for (double k = 0.0; k <= steps; ++k)
                if (positionDistance(a.at(lengthA * k / steps), b.at(lengthB * k / steps)) > ALIKE)
                    return false;
            return true;
        }

        /** Whether two paths have equal numbers of cusps and all of their stretches are near each other. */
        bool areAlike(const Path &a, const Path &b)
        {
            const std::vector<Stretch> ofA = a.stretches(), ofB = b.stretches();
            if (ofA.size() != ofB.size())
                return false;
            for (std::size_t i = 0; i < ofA.size(); ++i)
                if (ofA[i].direction != ofB[i].direction ||
                    !isNear(a.part(ofA[i].first, ofA[i].last), b.part(ofB[i].first, ofB[i].last)))
                    return false;
            return true;
        }
    }  // namespace

    void TrajectoryOptions::validate() const
    {
        const Require require("trajectory");
        require.notNegative("time weight", weights.time);
        require.notNegative("effort weight", weights.effort);
        require.notNegative("steering weight", weights.steering);
        require.notNegative("nearness weight", weights.nearness);
        require.notNegative("preferred clearance", preferredClearance, "metres");
        require.positive("time weight", weights.time);
        require.notNegative("margin", margin, "metres");
        const auto share = [&require](const char *what, double value)
        {
            require.that(value > 0.0 && value <= 1.0, what, value, "above 0 and up to 1");
        };
        share("share of the speed", speedShare);
        share("share of the acceleration", accelerationShare);
        share("share of the steering angle", steeringShare);
        share("share of the steering rate", steeringRateShare);
        require.that(step >= 0.02 && step <= 2.0, "step", step, "from 0.02 to 2 seconds");
        require.notNegative("initial speed", initialSpeed, "m/s");
        if (initialSteering)
            require.finite("initial steering angle", *initialSteering, "radians");
        else
            require.that(initialSpeed == 0.0, "initial speed", initialSpeed, "0 without an initial steering angle");
        if (finalSteering)
            require.finite("final steering angle", *finalSteering, "radians");
    }

    TrajectoryOptimizer::TrajectoryOptimizer(const FootprintChecker &checker, TrajectoryOptions options)
      : checker_(checker),
        options_(std::move(options)),
        vehicle_(checker.vehicle()),
        body_(partsOf(checker.body())),
        pieces_(convexPieces(checker.obstacles()))
    {
        options_.validate();
        vehicle_.validate();
        for (const auto &angle : {options_.initialSteering, options_.finalSteering})
            Require("trajectory")
                .that(!angle || std::abs(*angle) <= vehicle_.maxSteeringAngle, "steering angle at an end",
                      angle.value_or(0.0), "within the car's " + formatNumber(vehicle_.maxSteeringAngle) + " radians");
        vehicle_.maxSpeed *= options_.speedShare;
        vehicle_.maxAcceleration *= options_.accelerationShare;
        vehicle_.maxSteeringAngle *= options_.steeringShare;
        vehicle_.maxSteeringRate *= options_.steeringRateShare;
    }

    double TrajectoryOptimizer::costOf(const TimedMotion &motion) const
    {
        const TpcapCost cost = tpcapCost(motion);
        return options_.weights.time * cost.time + options_.weights.effort * cost.controlEffort +
               options_.weights.steering * cost.steeringIntegral;
    }

    MotionOutline TrajectoryOptimizer::outline(std::vector<StretchGuess> stretches, double step) const
    {
        return {std::move(stretches),   vehicle_,         step, options_.initialSteering,
                options_.finalSteering, options_.sharpest};
    }

    /** One optimisation: solves programs one after another until a motion is found and improves no further. */
    class TrajectoryOptimizer::Search
    {
    public:
        Search(const TrajectoryOptimizer &owner, const std::function<bool()> &interrupted)
          : owner_(owner),
            world_{owner.checker_, owner.vehicle_, owner.body_, owner.pieces_, interrupted},
            solver_(world_)
        {
        }

        /** Searches a motion near one of the paths \e which with a cost below \e limit, and the index of its path. */
        std::optional<MotionSolution> run(const std::vector<Path> &paths, const std::vector<std::size_t> &which,
                                          double limit)
        {
            std::vector<Attempt> attempts;
            for (const std::size_t i : which)
                attempts.emplace_back(owner_, world_, paths[i], i);
            // The path with the lowest bound comes first, so that the others may be skipped.
            std::stable_sort(attempts.begin(), attempts.end(),
                             [](const Attempt &a, const Attempt &b) { return a.minCost < b.minCost; });
            std::vector<MotionSolution> solutions;
            for (std::size_t round = 0; round < owner_.options_.maxRounds && solutions.empty(); ++round)
                solveEach(attempts, limit, solutions);
            std::stable_sort(solutions.begin(), solutions.end(),
                             [](const MotionSolution &a, const MotionSolution &b) { return a.cost < b.cost; });
            std::optional<MotionSolution> found = improveBest(solutions);
            if (found && owner_.options_.initialSpeed == 0.0)
                dropStretches(*found);
            if (found && owner_.options_.sharpest)
                refine(*found);
            return found;
        }

        /** Statistics of the search. */
        const MotionSolver &solver() const
        {
            return solver_;
        }

    private:
        /** A path, with the settings of its next program after failures. */
        struct Attempt
        {
            Attempt(const TrajectoryOptimizer &owner, const MotionWorld &world, const Path &from, std::size_t index)
              : local(from),
                step(owner.options_.step)
            {
                local.start = world.toLocal(from.start);
                view.path = index;
                view.start = from.start;
                view.goal = from.end();
                view.separation.margin = owner.options_.margin;
                view.separation.range = RANGE;
                addOutline(owner);
                minCost = owner.options_.weights.time * outline->duration();
            }

            void addOutline(const TrajectoryOptimizer &owner)
            {
                outline.emplace(owner.outline(guessesAlong(local, owner.vehicle_, owner.options_.initialSpeed), step));
            }

            Path local;  // in the coordinates of the pieces
            MotionView view;
            double step;
            std::optional<MotionOutline> outline;
            double minCost;  // lower bound: of driving along it with instant steering
        };

        /** The directions of travel of consecutive stretches. */
        static std::vector<int> directionsOf(const MotionProblem &problem)
        {
            std::vector<int> directions;
            for (const int direction : problem.directions)
                if (direction != 0 && (directions.empty() || directions.back() != direction))
                    directions.push_back(direction);
            return directions;
        }

        static double minCost(const std::vector<MotionSolution> &solutions)
        {
            double least = solutions.front().cost;
            for (const MotionSolution &solution : solutions)
                least = std::min(least, solution.cost);
            return least;
        }

        /** Solves a program near each path that may be the best and differs from the solved ones. */
        void solveEach(std::vector<Attempt> &attempts, double limit, std::vector<MotionSolution> &solutions)
        {
            std::vector<const Path *> solved;
            for (Attempt &attempt : attempts)
            {
                if (!solver_.mayContinue() ||
                    attempt.minCost > (solutions.empty() ? limit : LIKELY * minCost(solutions)))
                    return;
                if (std::any_of(solved.begin(), solved.end(),
                                [&attempt](const Path *path) { return areAlike(*path, attempt.local); }))
                    continue;
                if (auto solution = solve(attempt, solutions.empty() ? limit : minCost(solutions)))
                {
                    solver_.lowerBudget();
                    solved.push_back(&attempt.local);
                    solutions.push_back(std::move(*solution));
                }
            }
        }

        MotionOutcome solveAlong(const MotionOutline &outline, const MotionView &view,
                                 const InteriorPointOptions &options = FROM_GUESS)
        {
            MotionProblem problem;
            problem.vehicle = owner_.vehicle_;
            problem.vehicle.maxAcceleration *= 1.0 - LIMITS_LEFT;
            problem.vehicle.maxSteeringRate *= 1.0 - LIMITS_LEFT;
            problem.vehicle.maxSpeed *= 1.0 - LIMITS_LEFT;
            problem.weights = owner_.options_.weights;
            problem.clearance = owner_.options_.preferredClearance - view.separation.margin;
            if (problem.clearance <= 0.0)
                problem.weights.nearness = 0.0;
            outline.write(problem);
            return solver_.solve(
                std::move(problem), options,
                [&outline](std::size_t interval, double fraction) { return outline.poseAt(interval, fraction); }, view);
        }

        /** A solution near a path; without one the attempt becomes more careful. If a motion below \e limit collides
            with an obstacle that was not considered, the program is solved again from that motion. */
        std::optional<MotionSolution> solve(Attempt &attempt, double limit)
        {
            MotionOutcome found = solveAlong(*attempt.outline, attempt.view);
            // An invalid solution requires more obstacles: first those it touched, and if these were considered
            // already, a larger range and finer checkpoints. Without a solution it needs a smaller margin and more
            // nodes.
            if (found.holds || found.hasLearnt)
                return rightOf(std::move(found), limit, [&] { return solveAlong(*attempt.outline, attempt.view); });
            attempt.view.spacing *= 0.5;
            if (found.solution)
                attempt.view.separation.range *= 1.5;
            else
            {
                attempt.view.separation.margin *= 0.25;
                attempt.step = std::max(0.7 * attempt.step, attempt.outline->duration() / MAX_INTERVALS);
                attempt.addOutline(owner_);
            }
            return std::nullopt;
        }

        /** The valid solution. After a collision that adds obstacles, the program is solved again: from the last
            motion, or with \e restart if that cannot serve as a guess. */
        std::optional<MotionSolution> rightOf(MotionOutcome found, double limit,
                                              const std::function<MotionOutcome()> &restart)
        {
            for (std::size_t i = 0; i < MAX_RETRIES && !found.holds && found.hasLearnt && solver_.mayContinue(); ++i)
            {
                if (found.solution->cost >= limit)
                    break;
                found = found.hasStrayed ? restart() : solver_.solveAgain(*found.solution);
            }
            return found.holds ? std::move(found.solution) : std::nullopt;
        }

        /** Improves the solutions found, cheapest first, and returns the best. Equal solutions are improved once. */
        std::optional<MotionSolution> improveBest(std::vector<MotionSolution> &solutions)
        {
            std::optional<MotionSolution> found;
            std::vector<std::pair<double, std::vector<int>>> done;  // costs and directions before the improvement
            for (MotionSolution &solution : solutions)
            {
                if (found && (!solver_.mayContinue() || solution.cost > PROMISING * found->cost))
                    break;
                const double cost = solution.cost;
                std::vector<int> directions = directionsOf(solution.problem);
                if (std::any_of(done.begin(), done.end(),
                                [&](const auto &other)
                                { return cost - other.first < SAME_COST * cost && directions == other.second; }))
                    continue;
                improve(solution);
                done.emplace_back(cost, std::move(directions));
                if (!found || solution.cost < found->cost)
                    found = std::move(solution);
            }
            return found;
        }

        /** Chooses the lines again along the solution while that gains enough. */
        void improve(MotionSolution &best)
        {
            for (std::size_t round = 0; round < owner_.options_.maxRounds && solver_.mayContinue(); ++round)
            {
                MotionOutcome found = solver_.solveAgain(best);
                const double gain = found.holds ? best.cost - found.solution->cost : 0.0;
                if (gain > 0.0)
                    best = std::move(*found.solution);
                if (gain < ENOUGH_GAIN * best.cost)
                    return;
            }
        }

        /** Attempts to drop stretches, the shortest first. A short stretch costs more time than its length saves, and
            the program can move a cusp but not remove it. */
        void dropStretches(MotionSolution &best)
        {
            std::size_t attempts = 0;
            for (bool again = true; again;)
            {
                again = false;
                const std::vector<StretchGuess> stretches = stretchesOf(best.problem, owner_.vehicle_);
                std::vector<std::size_t> order(stretches.size());
                std::iota(order.begin(), order.end(), std::size_t{0});
                std::stable_sort(order.begin(), order.end(),
                                 [&stretches](std::size_t a, std::size_t b)
                                 { return stretches[a].length() < stretches[b].length(); });
                for (const std::size_t index : order)
                {
                    if (attempts >= MAX_DROPS || !solver_.mayContinue() || stretches[index].length() > LONGEST_DROPPED)
                        return;
                    const std::vector<StretchGuess> rest = withoutStretch(stretches, index, owner_.vehicle_);
                    if (rest.empty())
                        return;
                    ++attempts;
                    MotionOutcome found = solveAlong(owner_.outline(rest, owner_.options_.step), best.view, DROPPING);
                    if (!found.holds || found.solution->cost >= best.cost)
                        continue;
                    best = std::move(*found.solution);
                    improve(best);
                    again = true;
                    break;
                }
            }
        }

        /** Moves nodes to where accelerations and steering rates change. */
        void refine(MotionSolution &best)
        {
            if (!solver_.mayContinue())
                return;
            auto found = rightOf(solver_.refine(best), best.cost, [] { return MotionOutcome(); });
            if (found && found->cost < best.cost)
                best = std::move(*found);
        }

        const TrajectoryOptimizer &owner_;
        const MotionWorld world_;
        MotionSolver solver_;
    };

    OptimizedTrajectory TrajectoryOptimizer::optimize(const Path &path, const std::function<bool()> &interrupted) const
    {
        return optimizeBest({path}, interrupted);
    }

    OptimizedTrajectory TrajectoryOptimizer::optimizeBest(const std::vector<Path> &paths,
                                                          const std::function<bool()> &interrupted) const
    {
        if (paths.empty())
            throw Error("trajectory: there is no path");
        OptimizedTrajectory result;
        result.fallback = true;
        // Within the requested limits, except that the paths may need the full steering angle.
        Vehicle used = vehicle_;
        used.maxSteeringAngle = checker_.vehicle().maxSteeringAngle;
        std::vector<std::size_t> searched;  // of the paths
        for (std::size_t i = 0; i < paths.size(); ++i)
        {
            TimedMotion motion = stopAndSteer(paths[i], used, options_.initialSteering, options_.finalSteering);
            if (!touchesNothing(checker_, paths[i]))
                throw Error("trajectory: the path collides");
            if (motion.duration() <= MAX_INTERVALS * options_.step)
                searched.push_back(i);
            if (i > 0 && costOf(motion) >= costOf(result.motion))
                continue;
            result.motion = std::move(motion);
            result.path = i;
        }
        if (options_.initialSpeed > 0.0)
            result.motion = {};  // a moving car cannot stop at once to steer
        if (interrupted && interrupted())
            result.reason = "interrupted";
        else if (searched.empty())
            result.reason =
                "driving takes more than " + formatNumber(MAX_INTERVALS) + " steps, the limit of the optimisation";
        else
            improve(paths, searched, interrupted, result);
        return result;
    }

    void TrajectoryOptimizer::improve(const std::vector<Path> &paths, const std::vector<std::size_t> &which,
                                      const std::function<bool()> &interrupted, OptimizedTrajectory &result) const
    {
        Search search(*this, interrupted);
        const double limit =
            result.motion.knots.empty() ? std::numeric_limits<double>::infinity() : costOf(result.motion);
        auto found = search.run(paths, which, limit);
        result.rounds = search.solver().rounds();
        result.iterations = search.solver().iterations();
        // If even instant steering would cost as much, no program was solved, and the solver has no reason.
        const bool isPointless = !found && search.solver().reason().empty();
        if (isPointless || (found && costOf(found->motion) >= limit))
            result.reason = "stopping to steer is equally fast";
        else if (!found)
            result.reason = search.solver().reason();
        else
        {
            result.motion = std::move(found->motion);
            result.path = found->view.path;
            result.fallback = false;
        }
    }
}  // namespace parking

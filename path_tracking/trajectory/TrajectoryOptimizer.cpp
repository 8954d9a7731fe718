#include "path_tracking/trajectory/TrajectoryOptimizer.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Require.h"
#include "parking_geometry/text/Text.h"
#include "path_tracking/trajectory/MotionCheck.h"
#include "path_tracking/trajectory/StopAndSteer.h"
#include "path_tracking/trajectory/program/DrivenStretch.h"
#include "path_tracking/trajectory/program/InteriorPoint.h"
#include "path_tracking/trajectory/program/MotionOutline.h"
#include "path_tracking/trajectory/program/Separation.h"
#include "path_tracking/trajectory/program/SolvedMotion.h"
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
        constexpr double SPACING = 0.2;             // metres between checkpoints, in the first round
        constexpr double RANGE = 1.5;               // metres within which obstacles matter, in the first round
        constexpr double FIRST_BARRIER = 5e-3;      // seconds, of rounds that begin with a guess
        constexpr double AGAIN_BARRIER = 1e-3;      // of rounds that begin with a solution
        constexpr double ENOUGH_GAIN = 3e-3;        // share of the cost for which another round is worth its time
        constexpr double PROMISING = 1.05;          // share of the best cost that improving a solution may make up for
        constexpr double LIKELY = 1.02;             // share of it up to which driving along a path may cost at least
        constexpr double LEAST_WORK = 4.5e4;        // that may be done for any path, see Search
        constexpr double LEAST_ITERATIONS = 200.0;  // that may be done for any path, of programs of the first's size
        constexpr double WORK_TO_FIND = 2.5;        // times as much work as long as nothing is found
        constexpr double LONGEST_DROPPED = 0.5;     // metres of a stretch that is tried to do without
        constexpr std::size_t MOST_DROPS = 4;       // such attempts
        constexpr std::size_t MOST_DROP_ITERATIONS = 40;  // of each: where it works it works soon
        constexpr double LIMITS_LEFT = 2e-5;              // share of the limits that is left for rounding
        constexpr double NEAR_HIT = 0.05;                 // metres within which obstacles are to blame for a hit
        constexpr std::size_t MOST_HITS = 50;             // that are looked into
        constexpr double GOAL_TOLERANCE = 2e-3;           // metres and radians that integration may miss the goal by
        constexpr int MOST_CORRECTIONS = 2;               // of where the intervals of a program lead
        constexpr double PATH_STEP = 0.01;                // metres between poses of a path that is looked at

        bool isFree(const FootprintChecker &checker, const Path &path)
        {
            if (isPathFree(checker, path))
                return true;
            const SampledPath states = path.sample(PATH_STEP);
            return std::all_of(states.begin(), states.end(),
                               [&checker](const PathState &state) { return checker.isFree(state.pose); });
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
        if (initialSteering)
            require.finite("initial steering angle", *initialSteering, "radians");
        if (finalSteering)
            require.finite("final steering angle", *finalSteering, "radians");
    }

    TrajectoryOptimizer::TrajectoryOptimizer(const FootprintChecker &checker, TrajectoryOptions options)
      : checker_(checker),
        options_(std::move(options)),
        body_(checker.vehicle()),
        pieces_(convexPieces(checker.obstacles()))
    {
        options_.validate();
        body_.validate();
        for (const auto &angle : {options_.initialSteering, options_.finalSteering})
            Require("trajectory")
                .that(!angle || std::abs(*angle) <= body_.maxSteeringAngle, "steering angle at an end",
                      angle.value_or(0.0), "within the car's " + formatNumber(body_.maxSteeringAngle) + " radians");
        body_.frontOverhang += checker.margin();
        body_.rearOverhang += checker.margin();
        body_.width += 2.0 * checker.margin();
        body_.maxSpeed *= options_.speedShare;
        body_.maxAcceleration *= options_.accelerationShare;
        body_.maxSteeringAngle *= options_.steeringShare;
        body_.maxSteeringRate *= options_.steeringRateShare;
    }

    Pose TrajectoryOptimizer::toLocal(const Pose &pose) const
    {
        Pose local = checker_.obstacles().toLocal(pose);
        local.yaw = pose.yaw - checker_.obstacles().frame().yaw;  // not wrapped
        return local;
    }

    double TrajectoryOptimizer::costOf(const TimedMotion &motion) const
    {
        const TpcapCost cost = tpcapCost(motion);
        return options_.weights.time * cost.time + options_.weights.effort * cost.controlEffort +
               options_.weights.steering * cost.steeringIntegral;
    }

    /** One optimisation: programs are solved one after another until a motion is found and no longer gets better. */
    class TrajectoryOptimizer::Search
    {
    public:
        Search(const TrajectoryOptimizer &owner, const std::function<bool()> &interrupted, OptimizedTrajectory &report)
          : owner_(owner),
            interrupted_(interrupted),
            report_(report)
        {
        }

        /** Looks for a motion near one of the paths that costs less than \e limit. */
        std::optional<TimedMotion> run(const std::vector<Path> &paths, double limit)
        {
            std::vector<Attempt> attempts;
            for (std::size_t i = 0; i < paths.size(); ++i)
                attempts.emplace_back(owner_, paths[i], i);
            // What promises to be quick comes first, so that the rest need not be looked at.
            std::stable_sort(attempts.begin(), attempts.end(),
                             [](const Attempt &a, const Attempt &b) { return a.leastCost < b.leastCost; });
            std::vector<Solution> solutions;
            for (std::size_t round = 0; round < owner_.options_.mostRounds && solutions.empty(); ++round)
                for (Attempt &attempt : attempts)
                {
                    if (!mayGoOn() || attempt.leastCost > (solutions.empty() ? limit : LIKELY * leastCost(solutions)))
                        break;
                    if (auto solution = solve(attempt))
                    {
                        isFound_ = true;
                        solutions.push_back(std::move(*solution));
                    }
                }
            std::stable_sort(solutions.begin(), solutions.end(),
                             [](const Solution &a, const Solution &b) { return a.cost < b.cost; });
            std::optional<Solution> found;
            for (Solution &solution : solutions)
            {
                if (found && (!mayGoOn() || solution.cost > PROMISING * found->cost))
                    break;
                improve(solution);
                if (!found || solution.cost < found->cost)
                    found = std::move(solution);
            }
            if (found)
                dropStretches(*found);
            report_.path = found ? found->path : 0;
            if (!found)
                return std::nullopt;
            const bool isBetter = owner_.costOf(found->motion) < limit;
            report_.reason = isBetter ? "" : "stopping to steer is as quick";
            if (!isBetter)
                return std::nullopt;
            return std::move(found->motion);
        }

    private:
        /** A motion that holds, and the program with the nodes that it has. */
        struct Solution
        {
            MotionProblem problem;
            TimedMotion motion;
            double cost;
            std::size_t path{0};

            // What solving it again depends on.
            SeparationOptions separation;
            double spacing{SPACING};
            Pose start, goal;
        };

        /** A path, and what has been learnt about it where it could not be solved. */
        struct Attempt
        {
            Attempt(const TrajectoryOptimizer &owner, const Path &from, std::size_t index)
              : local(from),
                start(from.start),
                goal(from.end()),
                path(index),
                step(owner.options_.step)
            {
                local.start = owner.toLocal(start);
                separation.margin = owner.options_.margin;
                separation.range = RANGE;
                outline.emplace(outlineOf(owner));
                leastCost = owner.options_.weights.time * outline->duration();
            }

            MotionOutline outlineOf(const TrajectoryOptimizer &owner) const
            {
                return {local, owner.body_, step, owner.options_.initialSteering, owner.options_.finalSteering};
            }

            Path local;  // in the coordinates of the pieces
            Pose start, goal;
            std::size_t path;
            SeparationOptions separation;
            double spacing{SPACING}, step;
            std::optional<MotionOutline> outline;
            double leastCost;  // of driving along it if the wheels needed no time to turn
        };

        static double leastCost(const std::vector<Solution> &solutions)
        {
            double least = solutions.front().cost;
            for (const Solution &solution : solutions)
                least = std::min(least, solution.cost);
            return least;
        }

        /** Work that may still be done; more while there is nothing yet. */
        double left() const
        {
            return (isFound_ ? 1.0 : WORK_TO_FIND) * budget_ - work_;
        }

        void stop()
        {
            stopped_ = true;
            report_.reason = "interrupted";
        }

        bool mayGoOn() const
        {
            return !stopped_ && (budget_ == 0.0 || left() > 0.0);
        }

        std::optional<Solution> solveAlong(const MotionOutline &outline)
        {
            MotionProblem problem;
            problem.vehicle = owner_.body_;
            problem.vehicle.maxAcceleration *= 1.0 - LIMITS_LEFT;
            problem.vehicle.maxSteeringRate *= 1.0 - LIMITS_LEFT;
            problem.vehicle.maxSpeed *= 1.0 - LIMITS_LEFT;
            problem.weights = owner_.options_.weights;
            problem.clearance = owner_.options_.preferredClearance - separation_.margin;
            if (problem.clearance <= 0.0)
                problem.weights.nearness = 0.0;
            outline.write(problem);
            return solve(std::move(problem), FIRST_BARRIER,
                         [&outline](std::size_t interval, double fraction)
                         { return outline.poseAt(interval, fraction); });
        }

        /** A solution near a path; none leaves the attempt more careful than it was. */
        std::optional<Solution> solve(Attempt &attempt)
        {
            separation_ = attempt.separation;
            spacing_ = attempt.spacing;
            start_ = attempt.start;
            goal_ = attempt.goal;
            auto found = solveAlong(*attempt.outline);
            if (found)
            {
                found->path = attempt.path;
                return found;
            }
            // What had a solution, but a wrong one, needs to see more: at first what it ran into, and where that was
            // known already, more of everything. What had none needs more room.
            attempt.separation = separation_;
            if (wrong_ && learnt_)
                return std::nullopt;
            attempt.spacing *= 0.5;
            if (wrong_)
                attempt.separation.range *= 1.5;
            else
            {
                attempt.separation.margin *= 0.25;
                attempt.step *= 0.7;
                attempt.outline.emplace(attempt.outlineOf(owner_));
            }
            return std::nullopt;
        }

        /** Solves what follows with what is known of \e solution. */
        void useFrom(const Solution &solution)
        {
            separation_ = solution.separation;
            spacing_ = solution.spacing;
            start_ = solution.start;
            goal_ = solution.goal;
        }

        /** Chooses the lines anew along what was found, as often as that is worth it. */
        void improve(Solution &best)
        {
            useFrom(best);
            for (std::size_t round = 0; round < owner_.options_.mostRounds && mayGoOn(); ++round)
            {
                auto found = solveFrom(best.problem, AGAIN_BARRIER);
                const double gain = found ? best.cost - found->cost : 0.0;
                if (gain > 0.0)
                {
                    found->path = best.path;
                    best = std::move(*found);
                }
                if (gain < ENOUGH_GAIN * best.cost)
                    return;
            }
        }

        /** Tries to do without a stretch, again and again, the shortest first: a short one costs more time than its
            way is worth, and the program can move a cusp, but never do away with it. */
        void dropStretches(Solution &best)
        {
            std::size_t tries = 0;
            for (bool again = true; again;)
            {
                again = false;
                const std::vector<DrivenStretch> stretches = stretchesOf(best.problem);
                std::vector<std::size_t> order(stretches.size());
                std::iota(order.begin(), order.end(), std::size_t{0});
                std::stable_sort(order.begin(), order.end(),
                                 [&stretches](std::size_t a, std::size_t b)
                                 { return stretches[a].length < stretches[b].length; });
                for (const std::size_t index : order)
                {
                    if (tries >= MOST_DROPS || !mayGoOn() || stretches[index].length > LONGEST_DROPPED)
                        return;
                    const std::vector<DrivenStretch> rest = withoutStretch(stretches, index);
                    if (rest.empty())
                        return;
                    ++tries;
                    useFrom(best);
                    mostIterations_ = MOST_DROP_ITERATIONS;
                    auto found = solveAlong({guessesAlong(rest, owner_.body_), owner_.body_, owner_.options_.step,
                                             owner_.options_.initialSteering, owner_.options_.finalSteering});
                    mostIterations_ = std::numeric_limits<std::size_t>::max();
                    if (!found || found->cost >= best.cost)
                        continue;
                    found->path = best.path;
                    best = std::move(*found);
                    improve(best);
                    again = true;
                    break;
                }
            }
        }

        std::optional<Solution> solveFrom(MotionProblem problem, double barrier)
        {
            const MotionProblem guess = problem;
            return solve(std::move(problem), barrier,
                         [&guess](std::size_t interval, double fraction) { return guess.poseAt(interval, fraction); });
        }

        /** Solves a program with lines along \e poseAt. \return nothing when the motion does not hold */
        std::optional<Solution> solve(MotionProblem problem, double barrier,
                                      const std::function<Pose(std::size_t, double)> &poseAt)
        {
            wrong_ = learnt_ = false;
            separation_.known = touched_;
            const SeparationPlan lines(owner_.pieces_, owner_.body_, separation_,
                                       checkpointsAlong(problem.directions, owner_.body_.wheelbase, spacing_, poseAt),
                                       poseAt, interrupted_);
            if (!lines.isComplete())
            {
                stop();
                return std::nullopt;
            }
            lines.write(problem);
            auto cost = minimize(problem, barrier);
            if (!cost)
                return std::nullopt;
            TimedMotion motion = motionOf(problem, start_);
            // Along hundreds of metres the small errors of collocation add up.
            for (int i = 0; i < MOST_CORRECTIONS && !reachesGoal(motion); ++i)
            {
                correctIntervals(problem);
                cost = minimize(problem, AGAIN_BARRIER);
                if (!cost)
                    return std::nullopt;
                motion = motionOf(problem, start_);
            }
            if (!holds(motion))
                return std::nullopt;
            return Solution{std::move(problem), std::move(motion), *cost, 0, separation_, spacing_, start_, goal_};
        }

        /** Solves the program itself, and gives its nodes to \e problem. \return the cost */
        std::optional<double> minimize(MotionProblem &problem, double barrier)
        {
            MotionProgram program(problem);
            InteriorPointOptions options;
            options.firstBarrier = barrier;
            const double size =
                static_cast<double>(problem.nodes.size()) + static_cast<double>(problem.rows.size()) / 12.0;
            if (budget_ == 0.0)
                budget_ = std::max(LEAST_WORK, LEAST_ITERATIONS * size);
            const double affordable = std::max(0.0, left() / size);
            options.mostIterations =
                std::min({options.mostIterations, mostIterations_, 1 + static_cast<std::size_t>(affordable)});
            InteriorPointResult solved = solveMotion(program, options, interrupted_);
            work_ += size * static_cast<double>(solved.iterations);
            ++report_.rounds;
            report_.iterations += solved.iterations;
            report_.reason = "no motion found that holds all limits";
            if (solved.status == InteriorPointStatus::Interrupted)
                stop();
            if (solved.status != InteriorPointStatus::Converged && solved.status != InteriorPointStatus::Feasible)
                return std::nullopt;
            problem.nodes = std::move(solved.nodes);
            return solved.cost;
        }

        bool reachesGoal(const TimedMotion &motion) const
        {
            return isSamePose(endOf(motion, owner_.checker_.vehicle()), goal_, GOAL_TOLERANCE);
        }

        /** Does the motion reach the goal and touch nothing? Notes what it touches, and that it is wrong. */
        bool holds(const TimedMotion &motion)
        {
            wrong_ = true;
            report_.reason = "the goal was missed";
            if (!reachesGoal(motion))
                return false;
            report_.reason = "the motions found touch obstacles";
            const std::vector<Pose> hits = collisionsOf(motion, owner_.checker_, MOST_HITS);
            for (const Pose &pose : hits)
                for (const std::size_t piece : piecesNear(owner_.pieces_, owner_.body_, owner_.toLocal(pose), NEAR_HIT))
                    if (std::find(touched_.begin(), touched_.end(), piece) == touched_.end())
                    {
                        touched_.push_back(piece);
                        learnt_ = true;
                    }
            wrong_ = !hits.empty();
            return hits.empty();
        }

        const TrajectoryOptimizer &owner_;
        const std::function<bool()> &interrupted_;
        OptimizedTrajectory &report_;
        Pose start_, goal_;
        double spacing_{SPACING};
        SeparationOptions separation_;
        std::vector<std::size_t> touched_;  // pieces that motions touched: what one ran into is in the way of others
        std::size_t mostIterations_{std::numeric_limits<std::size_t>::max()};  // of the next program
        bool wrong_{false};    // the last program had a solution, which did not hold
        bool learnt_{false};   // and touched what was not known to be in the way
        bool stopped_{false};  // by the caller
        bool isFound_{false};  // something that holds
        /** Iterations, each by the nodes of its program and a twelfth of its rows, which is what takes the time:
           about 1.5 microseconds. Counted instead of time, so that equal input gives equal output. @{ */
        double work_{0.0}, budget_{0.0};
        /** @} */
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
        for (std::size_t i = 0; i < paths.size(); ++i)
        {
            TimedMotion motion =
                stopAndSteer(paths[i], checker_.vehicle(), options_.initialSteering, options_.finalSteering);
            if (!isFree(checker_, paths[i]))
                throw Error("trajectory: the path collides");
            if (i > 0 && costOf(motion) >= costOf(result.motion))
                continue;
            result.motion = std::move(motion);
            result.path = i;
        }
        if (interrupted && interrupted())
        {
            result.reason = "interrupted";
            return result;
        }
        if (auto motion = Search(*this, interrupted, result).run(paths, costOf(result.motion)))
        {
            result.motion = std::move(*motion);
            result.fallback = false;
        }
        return result;
    }
}  // namespace parking

#include "path_tracking/trajectory/MotionSolver.h"

#include "path_tracking/trajectory/MotionCheck.h"
#include "path_tracking/trajectory/program/MotionOutline.h"
#include "path_tracking/trajectory/program/MotionProgram.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace parking
{
    namespace
    {
        /** Options of programs that start from a solution, and of those that refine phases. Ending at 2e-5 s costs 0.02
            % of the driven time; only the last program uses a smaller barrier. */
        constexpr InteriorPointOptions AGAIN{3e-4, 2e-5}, REFINING{5e-5, 3e-6};
        constexpr double MIN_WORK = 4.5e4;        // minimum budget for any path
        constexpr double MIN_ITERATIONS = 120.0;  // minimum for any path, of programs of the size of the first
        constexpr double WORK_TO_FIND = 5.0;      // factor of the budget until a motion is found
        constexpr double NEAR_HIT = 0.05;         // metres within which obstacles may cause a collision
        constexpr std::size_t MAX_HITS = 50;      // that are examined; a motion with more cannot serve as a guess
        constexpr std::size_t ANY_HITS = std::numeric_limits<std::size_t>::max();
        constexpr double GOAL_TOLERANCE =
            2e-3;                           // metres and radians, maximum error of the integrated motion at the goal
        constexpr int MAX_CORRECTIONS = 2;  // of where the intervals of a program lead
    }                                       // namespace

    Pose MotionWorld::toLocal(const Pose &pose) const
    {
        Pose local = checker.obstacles().toLocal(pose);
        local.yaw = pose.yaw - checker.obstacles().frame().yaw;
        return local;
    }

    double MotionSolver::left() const
    {
        return (isBudgetLowered_ ? 1.0 : WORK_TO_FIND) * budget_ - work_;
    }

    bool MotionSolver::mayContinue() const
    {
        return !isStopped_ && (budget_ == 0.0 || left() > 0.0);
    }

    void MotionSolver::stop()
    {
        isStopped_ = true;
        reason_ = "interrupted";
    }

    MotionOutcome MotionSolver::solveAgain(const MotionSolution &solution)
    {
        return solveFrom(solution, AGAIN);
    }

    MotionOutcome MotionSolver::refine(MotionSolution solution)
    {
        endPhasesAtChanges(solution.problem);
        return solveFrom(solution, REFINING);
    }

    MotionOutcome MotionSolver::solveFrom(const MotionSolution &solution, const InteriorPointOptions &options)
    {
        const MotionProblem &guess = solution.problem;
        return solve(
            guess, options,
            [&guess](std::size_t interval, double fraction) { return guess.poseAt(interval, fraction); },
            solution.view);
    }

    MotionOutcome MotionSolver::solve(MotionProblem problem, const InteriorPointOptions &options, const Guess &guess,
                                      const MotionView &view)
    {
        SeparationOptions separation = view.separation;
        separation.known = touched_;
        const SeparationPlan lines(world_.pieces, world_.body, separation,
                                   checkpointsAlong(problem.directions, world_.vehicle.wheelbase, view.spacing, guess),
                                   guess, world_.interrupted);
        if (!lines.isComplete())
        {
            stop();
            return {};
        }
        lines.write(problem);
        auto cost = minimize(problem, options);
        if (!cost)
            return {};
        TimedMotion motion = motionOf(problem, view.start);
        InteriorPointOptions again = options;
        again.firstBarrier = AGAIN.firstBarrier;
        // Along hundreds of metres the small errors of collocation add up.
        for (int i = 0; i < MAX_CORRECTIONS && !reachesGoal(motion, view); ++i)
        {
            correctIntervals(problem);
            cost = minimize(problem, again);
            if (!cost)
                return {};
            motion = motionOf(problem, view.start);
        }
        MotionOutcome outcome;
        outcome.solution = MotionSolution{std::move(problem), std::move(motion), *cost, view};
        check(outcome);
        return outcome;
    }

    /** Solves the program and writes its nodes to \e problem. \return the cost */
    std::optional<double> MotionSolver::minimize(MotionProblem &problem, InteriorPointOptions options)
    {
        MotionProgram program(problem);
        const double size = static_cast<double>(problem.nodes.size()) + static_cast<double>(problem.rows.size()) / 12.0;
        if (budget_ == 0.0)
            budget_ = std::max(MIN_WORK, MIN_ITERATIONS * size);
        const double affordable = std::max(0.0, left() / size);
        options.maxIterations = std::min(options.maxIterations, 1 + static_cast<std::size_t>(affordable));
        InteriorPointResult solved = solveMotion(program, options, world_.interrupted);
        work_ += size * static_cast<double>(solved.iterations);
        ++rounds_;
        iterations_ += solved.iterations;
        reason_ = "no motion within all limits was found";
        if (solved.status == InteriorPointStatus::Interrupted)
            stop();
        if (solved.status != InteriorPointStatus::Converged && solved.status != InteriorPointStatus::Feasible)
            return std::nullopt;
        problem.nodes = std::move(solved.nodes);
        return solved.cost;
    }

    bool MotionSolver::reachesGoal(const TimedMotion &motion, const MotionView &view) const
    {
        return isSamePose(endOf(motion, world_.checker.vehicle()), view.goal, GOAL_TOLERANCE);
    }

    /** Checks whether the motion reaches the goal without collision, and records the pieces it touches. */
    void MotionSolver::check(MotionOutcome &outcome)
    {
        const TimedMotion &motion = outcome.solution->motion;
        reason_ = "the goal was missed";
        if (!reachesGoal(motion, outcome.solution->view))
            return;
        reason_ = "the motions found touch obstacles";
        const std::vector<Pose> hits = collisionsOf(motion, world_.checker, ANY_HITS);
        outcome.holds = hits.empty();
        outcome.hasStrayed = hits.size() > MAX_HITS;
        // Along the whole motion: collisions at its end should not wait for those at its start.
        const std::size_t stride = 1 + hits.size() / MAX_HITS;
        for (std::size_t i = 0; i < hits.size(); i += stride)
            for (const std::size_t piece : piecesNear(world_.pieces, world_.body, world_.toLocal(hits[i]), NEAR_HIT))
                if (std::find(touched_.begin(), touched_.end(), piece) == touched_.end())
                {
                    touched_.push_back(piece);
                    outcome.hasLearnt = true;
                }
    }
}  // namespace parking

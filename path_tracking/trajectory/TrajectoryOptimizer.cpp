#include "path_tracking/trajectory/TrajectoryOptimizer.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Require.h"
#include "parking_geometry/text/Text.h"
#include "path_tracking/trajectory/MotionCheck.h"
#include "path_tracking/trajectory/StopAndSteer.h"
#include "path_tracking/trajectory/program/InteriorPoint.h"
#include "path_tracking/trajectory/program/MotionOutline.h"
#include "path_tracking/trajectory/program/Separation.h"
#include "state_validity/sweeps/PathSweep.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace parking
{
    namespace
    {
        constexpr double SPACING = 0.2;          // metres between checkpoints, in the first round
        constexpr double RANGE = 1.5;            // metres within which obstacles matter, in the first round
        constexpr double AGAIN_BARRIER = 1e-3;   // of rounds that begin with a solution
        constexpr double ENOUGH_GAIN = 3e-3;     // share of the cost for which another round is worth its time
        constexpr double NEAR_HIT = 0.05;        // metres within which obstacles are to blame for a hit
        constexpr std::size_t MOST_HITS = 50;    // that are looked into
        constexpr double GOAL_TOLERANCE = 2e-3;  // metres and radians that integration may miss the goal by
        constexpr double PATH_STEP = 0.01;       // metres between poses of a path that is looked at

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
        require.positive("time weight", weights.time);
        require.notNegative("margin", margin, "metres");
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
        Search(const TrajectoryOptimizer &owner, const Path &path, const std::function<bool()> &interrupted)
          : owner_(owner),
            path_(path),
            goal_(path.end()),
            interrupted_(interrupted),
            step_(owner.options_.step)
        {
            separation_.margin = owner.options_.margin;
            separation_.range = RANGE;
        }

        /** Looks for a motion that costs less than \e limit. */
        std::optional<TimedMotion> run(double limit, OptimizedTrajectory &report)
        {
            std::optional<TimedMotion> best;
            double bestCost = limit;
            bool again = false;  // goes on from what was found
            for (std::size_t round = 0; round < owner_.options_.mostRounds; ++round)
            {
                if (!again)
                    begin();
                const InteriorPointResult solved = solve(again);
                report.rounds += 1;
                report.iterations += solved.iterations;
                if (solved.status == InteriorPointStatus::Interrupted)
                {
                    report.reason = "interrupted";
                    return best;
                }
                const bool holds = solved.status != InteriorPointStatus::Infeasible;
                const std::optional<TimedMotion> motion = holds ? checked(solved.nodes, report) : std::nullopt;
                if (!holds)
                    report.reason = "no motion found that holds all limits";
                if (!motion && best)
                    return best;
                if (!motion)
                {
                    tighten(holds);
                    continue;
                }
                const double cost = owner_.costOf(*motion), gain = bestCost - cost;
                if (cost < bestCost)
                {
                    best = motion;
                    bestCost = cost;
                }
                report.reason = "stopping to steer is as quick";
                if (gain < ENOUGH_GAIN * bestCost)
                    return best;
                problem_.nodes = solved.nodes;
                again = true;
            }
            return best;
        }

    private:
        /** Begins with what the path suggests. */
        void begin()
        {
            Path local = path_;
            local.start = owner_.toLocal(path_.start);
            outline_.emplace(local, owner_.body_, step_, owner_.options_.initialSteering,
                             owner_.options_.finalSteering);
            problem_ = {};
            problem_.vehicle = owner_.body_;
            problem_.weights = owner_.options_.weights;
            outline_->write(problem_);
        }

        InteriorPointResult solve(bool again)
        {
            const auto poseAt = [this, again](std::size_t interval, double fraction)
            {
                return again ? problem_.poseAt(interval, fraction) : outline_->poseAt(interval, fraction);
            };
            SeparationPlan(owner_.pieces_, owner_.body_, separation_,
                           checkpointsAlong(problem_.directions, owner_.body_.wheelbase, spacing_, poseAt), poseAt)
                .write(problem_);
            MotionProgram program(problem_);
            InteriorPointOptions options;
            if (again)
                options.firstBarrier = AGAIN_BARRIER;
            return solveMotion(program, options, interrupted_);
        }

        /** The motion of \e nodes; nothing when it touches an obstacle or misses the goal, which is noted. */
        std::optional<TimedMotion> checked(const std::vector<NodeVector> &nodes, OptimizedTrajectory &report)
        {
            TimedMotion motion{path_.start, {}};
            for (std::size_t k = 0; k < nodes.size(); ++k)
            {
                const int direction = k == 0                            ? problem_.directions[0]
                                      : problem_.directions[k - 1] != 0 ? problem_.directions[k - 1]
                                      : k < problem_.directions.size()  ? problem_.directions[k]
                                                                        : 0;
                motion.append(k > 0 ? nodes[k - 1][NODE_DURATION] : 0.0, direction * nodes[k][NODE_SPEED],
                              nodes[k][NODE_STEERING]);
            }
            if (!isSamePose(endOf(motion, owner_.checker_.vehicle()), goal_, GOAL_TOLERANCE))
            {
                report.reason = "the goal was missed";
                return std::nullopt;
            }
            const std::vector<Pose> hits = collisionsOf(motion, owner_.checker_, MOST_HITS);
            if (hits.empty())
                return motion;
            report.reason = "the motions found touch obstacles";
            for (const Pose &pose : hits)
                for (const std::size_t piece : piecesNear(owner_.pieces_, owner_.body_, owner_.toLocal(pose), NEAR_HIT))
                    if (std::find(separation_.always.begin(), separation_.always.end(), piece) ==
                        separation_.always.end())
                        separation_.always.push_back(piece);
            return std::nullopt;
        }

        /** Makes the next program one that should not fail like the last. \param hit it had a solution, a wrong one */
        void tighten(bool hit)
        {
            spacing_ *= 0.5;
            if (hit)
                separation_.range *= 1.5;
            else
            {
                separation_.margin *= 0.25;
                step_ *= 0.7;
            }
        }

        const TrajectoryOptimizer &owner_;
        const Path &path_;
        Pose goal_;
        const std::function<bool()> &interrupted_;
        double step_;
        double spacing_{SPACING};
        SeparationOptions separation_;
        std::optional<MotionOutline> outline_;
        MotionProblem problem_;
    };

    OptimizedTrajectory TrajectoryOptimizer::optimize(const Path &path, const std::function<bool()> &interrupted) const
    {
        OptimizedTrajectory result;
        result.motion = stopAndSteer(path, checker_.vehicle(), options_.initialSteering, options_.finalSteering);
        if (!isFree(checker_, path))
            throw Error("trajectory: the path collides");
        result.fallback = true;
        if (interrupted && interrupted())
        {
            result.reason = "interrupted";
            return result;
        }
        if (auto motion = Search(*this, path, interrupted).run(costOf(result.motion), result))
        {
            result.motion = std::move(*motion);
            result.fallback = false;
            result.reason.clear();
        }
        return result;
    }
}  // namespace parking

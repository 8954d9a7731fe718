#include "automatic_parking/scenario/ScenarioPlanner.h"

#include "automatic_parking/ParkingWorld.h"
#include "automatic_parking/Stopwatch.h"
#include "ompl_improved_astar/search/MotionModel.h"
#include "ompl_improved_astar/search/planning/FootprintEnvironment.h"
#include "ompl_improved_astar/search/planning/GridSmoothing.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/Require.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace parking
{
    namespace
    {
        constexpr double SAMPLING = 0.1;  // metres between states
        constexpr double SAME = 1e-4;     // metres and radians: rounding of long paths

        /** The world of the grid models: the paper's circle, which has no heading. */
        class CircleEnvironment final : public search::MotionEnvironment
        {
        public:
            CircleEnvironment(const CircleChecker &checker, const Box &bounds) : checker_(checker), bounds_(bounds)
            {
            }

            bool isFree(const Pose &pose) override
            {
                return bounds_.contains(pose.x, pose.y) && checker_.isFree(pose.x, pose.y);
            }

            bool isMotionFree(const Pose &from, const Pose &to) override
            {
                return isFree(to) && checker_.freeShare(from, to) >= 1.0;
            }

            void freeLengths(const Pose & /*from*/, const Arc * /*arcs*/, std::size_t count, double /*clearance*/,
                             double *lengths) override
            {
                std::fill_n(lengths, count, 0.0);  // the grid models drive no arcs
            }

            double roomAt(double /*x*/, double /*y*/) override
            {
                return HUGE_VAL;
            }

            bool knowsClearance() const override
            {
                return false;
            }

            bool headingMatters() const override
            {
                return false;
            }

            Box bounds() const override
            {
                return bounds_;
            }

        private:
            const CircleChecker &checker_;
            Box bounds_;
        };
    }  // namespace

    std::string statusName(search::PlanOutcome outcome)
    {
        switch (outcome)
        {
            case search::PlanOutcome::Solved:
                return "exact";
            case search::PlanOutcome::Approximate:
                return "approximate";
            case search::PlanOutcome::Infeasible:
                return "infeasible";
            case search::PlanOutcome::InvalidStart:
                return "invalid_start";
            case search::PlanOutcome::InvalidGoal:
                return "invalid_goal";
            case search::PlanOutcome::Escaped:
                return "escaped";
            case search::PlanOutcome::Timeout:
                break;
        }
        return "timeout";
    }

    ScenarioPlanner::ScenarioPlanner(Scenario scenario, ContactTestMaker contact)
      : scenario_(std::move(scenario)),
        footprint_(ObstacleSet::fromScenario(scenario_), scenario_.vehicle, 0.0, std::move(contact))
    {
    }

    const CircleChecker &ScenarioPlanner::circle() const
    {
        std::call_once(circleOnce_, [this]
                       { circle_ = std::make_unique<const CircleChecker>(footprint_.obstacles(), circleRadius()); });
        return *circle_;
    }

    search::PlanRequest ScenarioPlanner::request(const PlannerParameters &parameters) const
    {
        search::PlanRequest request;
        request.starts = {scenario_.start};
        request.goals = scenario_.goals;
        request.car = search::carInSpace(scenario_.vehicle, 0.0, scenario_.bounds);
        request.parameters = parameters;
        if (search::turnsOnTheSpot(parameters.motionModel))
            request.car.inscribedRadius = 0.0;  // circles, which turn on the spot
        return request;
    }

    std::unique_ptr<search::MotionEnvironment> ScenarioPlanner::environment(const PlannerParameters &parameters) const
    {
        if (search::turnsOnTheSpot(parameters.motionModel))
            return std::make_unique<CircleEnvironment>(circle(), scenario_.bounds);
        return std::make_unique<FootprintEnvironment>(footprint_, scenario_.bounds, FootprintEnvironment::TOLERANCE);
    }

    ScenarioPlan ScenarioPlanner::plan(const PlannerParameters &parameters, const PlanLimits &limits) const
    {
        if (!(limits.time > 0.0))
            Require("limits").positive("time_limit", limits.time, "seconds");
        checkParameters(parameters);
        search::PlanRequest request = this->request(parameters);
        request.maxExpansions = limits.expansions;
        request.improved = limits.improved;
        const Stopwatch watch;
        const bool endless = std::isinf(limits.time);
        request.stop = [&limits, watch, endless]
        {
            return (!endless && watch.seconds() > limits.time) || (limits.interrupted && limits.interrupted());
        };

        const std::unique_ptr<search::MotionEnvironment> environment = this->environment(parameters);
        ScenarioPlan result;
        static_cast<search::PlanResult &>(result) = search::plan(*environment, request);
        result.isDisc = search::turnsOnTheSpot(parameters.motionModel);
        if (result.isDisc && result.hasPath() && parameters.smoothing == "bspline")
            search::smoothGridPath(result.path, *environment, request.car.turningRadius, request.stop);
        if (const auto *footprint = dynamic_cast<const FootprintEnvironment *>(environment.get()))
            result.checks = footprint->counts();
        result.planningTime = std::max(0.0, watch.seconds() - result.loadingTime);
        return result;
    }

    SampledPath ScenarioPlanner::states(const ScenarioPlan &plan) const
    {
        if (!plan.hasPath())
            return {};
        SampledPath states = plan.path.sample(SAMPLING);
        states.front().pose.yaw = wrapAngle(states.front().pose.yaw);
        const Pose &goal = scenario_.goals.at(plan.goal);
        Pose &end = states.back().pose;
        if (plan.outcome != search::PlanOutcome::Approximate && isSamePose(goal, end, SAME))
            end = {goal.x, goal.y, wrapAngle(goal.yaw)};
        return states;
    }

    double ScenarioPlanner::clearance(const ScenarioPlan &plan) const
    {
        if (!plan.hasPath())
            return HUGE_VAL;
        if (!plan.isDisc)
            return minClearance(footprint_, plan.path);
        double least = HUGE_VAL;
        for (const PathState &state : plan.path.sample(SAMPLING))
            least = std::min(least, circle().clearance(state.pose.x, state.pose.y));
        return least;
    }

    QuickestTrajectory ScenarioPlanner::trajectory(const ScenarioPlan &plan, const QuickestTrajectoryOptions &options,
                                                   const std::function<bool()> &interrupted) const
    {
        if (!plan.hasPath() || plan.path.pieces.empty())
            throw Error("there is no path, which a trajectory requires");
        QuickestTrajectoryOptions own = options;
        own.alternatives = options.alternatives && plan.outcome == search::PlanOutcome::Solved && !plan.isDisc;
        return quickestTrajectory(footprint_, scenario_.bounds, plan.path, own, interrupted);
    }
}  // namespace parking

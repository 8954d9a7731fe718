#include "ompl_improved_astar/search/planning/Plan.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>

namespace parking::search
{
    PathPlannerParameters plannerParameters(const PlannerParameters &parameters, const CarInSpace &car)
    {
        PathPlannerParameters result;
        result.shorten = parameters.shortening;
        result.anytime = parameters.anytime;
        SearchParameters &search = result.search;
        search.motionModel = parameters.motionModel;
        search.heuristic = parameters.heuristic;
        search.openList = parameters.openList;
        search.turningRadius = car.turningRadius;
        search.forwardOnly = car.forwardOnly;
        search.inscribedRadius = car.inscribedRadius;
        search.bounds = car.bounds;
        search.steeringAngles = parameters.steeringAngles;
        search.xyResolution = parameters.xyResolution;
        search.headingBins = parameters.headingBins;
        search.weights = parameters.weights();
        search.bidirectional = parameters.bidirectional;
        search.searchFromGoal = parameters.searchFrom == "goal";
        search.adaptiveResolution = parameters.adaptiveResolution;
        search.analyticExpansion = parameters.analyticExpansion;
        search.obstacleHeuristic = parameters.obstacleHeuristic;
        search.eagerObstacles = parameters.obstacleLoading == "eager";
        search.cost.reversePenalty = parameters.reversePenalty;
        search.cost.gearChangePenalty = parameters.gearChangePenalty;
        search.cost.steeringChangePenalty = parameters.steeringChangePenalty;
        search.cost.clearanceWeight = parameters.clearanceWeight;
        search.cost.fullLockCurvature = 1.0 / car.turningRadius;
        return result;
    }

    std::string reasonOf(Exhaustion exhaustion, const CarInSpace &car)
    {
        switch (exhaustion)
        {
            case Exhaustion::WalledIn:
                return "obstacles are in the way: not even a disc of " + formatNumber(car.inscribedRadius) +
                       " m, which is smaller than the car, gets from the start to the goal";
            case Exhaustion::SearchedOut:
                return "nothing is left to try: every motion of the motion model, down to its finest resolution, has "
                       "been followed from one end";
            case Exhaustion::NoProgress:
                return "the search has not come nearer to the goal for long";
            case Exhaustion::None:
                break;
        }
        return {};
    }

    PlanResult plan(MotionEnvironment &environment, const PlanRequest &request)
    {
        checkParameters(request.parameters);
        if (request.starts.empty() || request.goals.empty())
            throw Error("a plan needs at least one start and one goal");
        PlanResult result;
        PathPlanner planner;
        planner.begin(environment, plannerParameters(request.parameters, request.car));
        const auto addFree = [&](const std::vector<Pose> &poses, auto add)
        {
            bool any = false;
            for (const Pose &pose : poses)
                if (isFinite(pose) && environment.isFree(pose))
                {
                    add(pose);
                    any = true;
                }
            return any;
        };
        if (!addFree(request.starts, [&](const Pose &pose) { planner.addStart(pose); }))
        {
            result.outcome = PlanOutcome::InvalidStart;
            result.reason = "no start is free of obstacles";
            return result;
        }
        const StopFunction stop = [&]
        {
            return (request.maxExpansions > 0 && planner.statistics().expanded >= request.maxExpansions) ||
                   (request.stop && request.stop());
        };
        const bool hasGoal = addFree(request.goals, [&](const Pose &pose) { planner.addGoal(pose); });
        if (!hasGoal)
        {
            result.outcome = PlanOutcome::InvalidGoal;
            result.reason = "no goal is free of obstacles";
            if (!request.parameters.approximate)
                return result;
        }
        else if (planner.solve(stop, request.improved) == PathPlanner::Outcome::Exhausted)
        {
            result.outcome = PlanOutcome::Infeasible;
            result.reason = reasonOf(planner.search().exhaustion(), request.car);
        }
        if (planner.hasSolution())
        {
            result.outcome = PlanOutcome::Solved;
            result.reason.clear();
            result.path = planner.bestPath();
            result.cost = planner.bestCost();
            result.suboptimalityBound = planner.suboptimalityBound();
            const Pose end = result.path.end();
            const auto off = [&end](const Pose &goal)
            {
                return positionDistance(goal, end) + std::abs(wrapAngle(goal.yaw - end.yaw));
            };
            result.goal = static_cast<std::size_t>(std::min_element(request.goals.begin(), request.goals.end(),
                                                                    [&off](const Pose &a, const Pose &b)
                                                                    { return off(a) < off(b); }) -
                                                   request.goals.begin());
        }
        else if (request.parameters.approximate && planner.approximate(request.goals.front(), stop, result.path))
            result.outcome = PlanOutcome::Approximate;
        result.statistics = planner.statistics();
        result.loadingTime = planner.search().loadingTime();
        return result;
    }
}  // namespace parking::search

#include "ompl_improved_astar/search/planning/Plan.h"

#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace parking::search
{
    namespace
    {
        std::vector<Pose> freeOf(const std::vector<Pose> &poses, MotionEnvironment &environment)
        {
            std::vector<Pose> result;
            for (const Pose &pose : poses)
                if (isFinite(pose) && environment.isFree(pose))
                    result.push_back(pose);
            return result;
        }

        std::size_t nearest(const std::vector<Pose> &poses, const Pose &to)
        {
            const auto off = [&to](const Pose &pose)
            {
                return isFinite(pose) ? positionDistance(pose, to) + std::abs(wrapAngle(pose.yaw - to.yaw))
                                      : std::numeric_limits<double>::infinity();
            };
            const auto found = std::min_element(poses.begin(), poses.end(),
                                                [&off](const Pose &a, const Pose &b) { return off(a) < off(b); });
            return static_cast<std::size_t>(found - poses.begin());
        }
    }  // namespace

    CarInSpace carInSpace(const Vehicle &vehicle, double margin, const Box &bounds)
    {
        CarInSpace car;
        car.turningRadius = vehicle.minTurningRadius();
        car.inscribedRadius = vehicle.inscribedRadius(margin);
        car.bodyRadius = vehicle.bodyRadius(margin);
        car.turningLane = vehicle.turningLane(margin);
        car.centreOffset = vehicle.centreOffset();
        car.bounds = bounds;
        return car;
    }

    std::string reasonOf(Exhaustion exhaustion, const CarInSpace &car)
    {
        switch (exhaustion)
        {
            case Exhaustion::WalledIn:
                // Rounded up: what holds for a disc holds for every larger one.
                return "obstacles are in the way: not even a disc with a radius of " +
                       formatNumber(std::ceil(1e3 * car.inscribedRadius) / 1e3) +
                       " m, which is smaller than the car, gets from the start to the goal";
            case Exhaustion::Enclosed:
                return "obstacles are in the way: even if it could move sideways and turn on the spot, the car would "
                       "not get from the start to the goal";
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

    std::string invalidStart(const PlannerParameters &parameters)
    {
        if (!parameters.escape)
            return "no start is free of obstacles";
        return "no start is free of obstacles, and no escape leads out of a contact of at most " +
               formatNumber(parameters.maxEscapeDepth) + " m (max_escape_depth)";
    }

    std::string outOfMemory(const PlannerParameters &parameters)
    {
        return "the search has used up its " + std::to_string(parameters.maxMemoryMb) + " MB of memory (max_memory_mb)";
    }

    PlanResult plan(MotionEnvironment &environment, const PlanRequest &request)
    {
        checkParameters(request.parameters);
        if (request.starts.empty() || request.goals.empty())
            throw Error("a plan needs at least one start and one goal");
        PlanResult result;
        PathPlanner planner;
        planner.begin(environment, request.parameters, request.car);
        const std::vector<Pose> starts = freeOf(request.starts, environment),
                                goals = freeOf(request.goals, environment);
        for (const Pose &start : starts)
            planner.addStart(start);
        for (const Pose &goal : goals)
            planner.addGoal(goal);
        bool hasStart = !starts.empty();
        if (!hasStart)
            for (const Pose &start : request.starts)
                hasStart = planner.addEscapes(start) || hasStart;
        if (!hasStart)
        {
            result.outcome = PlanOutcome::InvalidStart;
            result.reason = invalidStart(request.parameters);
            return result;
        }
        const StopFunction stop = [&]
        {
            return (request.maxExpansions > 0 && planner.expanded() >= request.maxExpansions) ||
                   (request.stop && request.stop());
        };
        if (goals.empty())
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
        else if (planner.search().isFull())
            result.reason = outOfMemory(request.parameters);
        if (planner.hasSolution())
        {
            result.outcome = planner.escape() ? PlanOutcome::Escaped : PlanOutcome::Solved;
            result.reason.clear();
            result.path = planner.bestPath();
            result.cost = planner.bestCost();
            result.suboptimalityBound = planner.suboptimalityBound(result.cost);
            result.goal = nearest(request.goals, result.path.end());
        }
        else if (request.parameters.approximate && planner.approximate(request.goals.front(), stop, result.path))
            result.outcome = PlanOutcome::Approximate;
        result.notice = planner.notice();
        result.escape = planner.escape();
        result.statistics = planner.statistics();
        result.loadingTime = planner.search().statistics().loadingTime;
        return result;
    }
}  // namespace parking::search

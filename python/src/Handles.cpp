#include "python/src/Handles.h"

#include "parking_geometry/Error.h"
#include "python/src/Background.h"

#include <chrono>

namespace parking::python
{
    namespace
    {
        constexpr double SAMPLING = 0.1;          // metres between the states of a path
        constexpr double TRAJECTORY_STEP = 0.05;  // seconds between the points of a trajectory

        double now()
        {
            return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
        }
    }  // namespace

    ScenarioHandle::Loaded::Loaded(const Scenario &scenario) : begin(now()), planner(scenario), seconds(now() - begin)
    {
    }

    const ScenarioPlanner *ScenarioHandle::planner(const std::function<bool()> &interrupted) const
    {
        std::shared_future<LoadedPointer> loaded;
        {
            const std::lock_guard<std::mutex> lock(mutex_);
            if (!loaded_.valid())
                loaded_ = resultInBackground<LoadedPointer>([scenario = scenario_]
                                                            { return std::make_shared<const Loaded>(*scenario); });
            loaded = loaded_;
        }
        if (!await(loaded, interrupted))
            return nullptr;
        try
        {
            return &loaded.get()->planner;
        }
        catch (...)
        {
            // There may be enough memory the next time.
            const std::lock_guard<std::mutex> lock(mutex_);
            loaded_ = {};
            throw;
        }
    }

    double ScenarioHandle::loadingTime() const
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        const bool known = loaded_.valid() && loaded_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
        return known ? loaded_.get()->seconds : 0.0;
    }

    const std::vector<double> &PathHandle::rows() const
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (!rows_)
        {
            const SampledPath sampled = states();
            std::vector<double> rows;
            rows.reserve(5 * sampled.size());
            for (const PathState &state : sampled)
            {
                const Pose pose = scenario().scenario().toWorld(state.pose);
                for (const double value :
                     {pose.x, pose.y, wrapAngle(pose.yaw), static_cast<double>(state.direction), state.curvature})
                    rows.push_back(value);
            }
            rows_ = std::move(rows);
        }
        return *rows_;
    }

    double PathHandle::clearance() const
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (!clearance_)
            clearance_ = measureClearance();
        return *clearance_;
    }

    const TrajectoryHandle &PathHandle::trajectory(const std::function<bool()> &interrupted) const
    {
        const std::lock_guard<std::mutex> lock(trajectoryMutex_);
        if (!trajectory_)
        {
            const OptimizedTrajectory optimized = optimize(interrupted).trajectory;
            if (interrupted && interrupted())
                throw Error("interrupted");
            const Scenario &scenario = this->scenario().scenario();
            TrajectoryHandle result;
            result.points = sample(optimized.motion, scenario.vehicle, TRAJECTORY_STEP);
            for (TrajectoryPoint &point : result.points)
            {
                const Pose pose = scenario.toWorld({point.x, point.y, point.yaw});
                point.x = pose.x;
                point.y = pose.y;
            }
            result.duration = optimized.motion.duration();
            result.fallback = optimized.fallback;
            result.reason = optimized.reason;
            result.cost = tpcapCost(optimized.motion);
            trajectory_ = std::move(result);
        }
        return *trajectory_;
    }

    PlanHandle::PlanHandle(ScenarioPointer scenario, ScenarioPlan plan, PlannerParameters parameters)
      : PathHandle(std::move(scenario)),
        plan_(std::move(plan)),
        parameters_(std::move(parameters))
    {
        hasPath_ = plan_.hasPath();
        path_ = plan_.path;
    }

    SampledPath PlanHandle::states() const
    {
        return scenario().planner().states(plan_);
    }

    double PlanHandle::measureClearance() const
    {
        return scenario().planner().clearance(plan_);
    }

    QuickestTrajectory PlanHandle::optimize(const std::function<bool()> &interrupted) const
    {
        return scenario().planner().trajectory(plan_, {}, interrupted);
    }

    ParkingHandle::ParkingHandle(ScenarioPointer scenario, ParkingPlan plan)
      : PathHandle(std::move(scenario)),
        plan_(std::move(plan))
    {
        hasPath_ = plan_.found;
        path_ = plan_.path;
    }

    SampledPath ParkingHandle::states() const
    {
        return hasPath() ? plan_.path.sample(SAMPLING) : SampledPath();
    }

    double ParkingHandle::measureClearance() const
    {
        return plan_.clearance;
    }

    QuickestTrajectory ParkingHandle::optimize(const std::function<bool()> &interrupted) const
    {
        // From the arcs: the optimiser makes steering continuous by itself, and finds better paths than the smoother's.
        ScenarioPlan plan;
        plan.outcome = hasPath() ? search::PlanOutcome::Solved : search::PlanOutcome::Timeout;
        plan.path = plan_.arcs;
        return scenario().planner().trajectory(plan, {}, interrupted);
    }
}  // namespace parking::python

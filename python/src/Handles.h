#pragma once

#include "automatic_parking/ParkingPlanner.h"
#include "automatic_parking/scenario/ScenarioPlanner.h"
#include "parking_geometry/Scenario.h"
#include "parking_geometry/curves/Path.h"
#include "path_tracking/trajectory/Trajectory.h"

#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

// What the Python objects hold. Everything is immutable, or made once when it is first asked for.
namespace parking::python
{
    /** \brief A scenario, and the planner with its distance field, which is made when something is first planned or
        asked: by then the interpreter's lock must have been given back. */
    class ScenarioHandle
    {
    public:
        explicit ScenarioHandle(Scenario scenario) : scenario_(std::make_shared<const Scenario>(std::move(scenario)))
        {
        }

        const Scenario &scenario() const
        {
            return *scenario_;
        }

        /** \brief The planner; null when \e interrupted, asked every 2 ms while it is made, says so. */
        const ScenarioPlanner *planner(const std::function<bool()> &interrupted) const;

        const ScenarioPlanner &planner() const
        {
            return *planner({});
        }

        /** \brief Seconds that making the planner took; 0 before. */
        double loadingTime() const;

    private:
        struct Loaded
        {
            explicit Loaded(const Scenario &scenario);

            double begin;
            ScenarioPlanner planner;
            double seconds;
        };
        using LoadedPointer = std::shared_ptr<const Loaded>;

        std::shared_ptr<const Scenario> scenario_;
        mutable std::mutex mutex_;
        mutable std::shared_future<LoadedPointer> loaded_;
    };

    using ScenarioPointer = std::shared_ptr<const ScenarioHandle>;

    /** \brief A trajectory in world coordinates, with what is known of it. */
    struct TrajectoryHandle
    {
        Trajectory points;
        double duration{0.0};
        bool fallback{false};
        std::string reason;
        TpcapCost cost;
    };

    /** \brief What plan() and ParkingPlanner return have in common: a path in a scenario. */
    class PathHandle
    {
    public:
        virtual ~PathHandle() = default;

        const ScenarioHandle &scenario() const
        {
            return *scenario_;
        }
        const ScenarioPointer &scenarioPointer() const
        {
            return scenario_;
        }

        bool hasPath() const
        {
            return hasPath_;
        }
        /** \brief In the scenario's local coordinates. */
        const Path &path() const
        {
            return path_;
        }

        /** \brief Rows x, y, yaw, direction, curvature, in world coordinates. */
        const std::vector<double> &rows() const;

        /** \brief Metres, made when first asked for. */
        double clearance() const;

        /** \brief Optimised when first asked for. \param interrupted as for TrajectoryOptimizer::optimize() */
        const TrajectoryHandle &trajectory(const std::function<bool()> &interrupted) const;

    protected:
        explicit PathHandle(ScenarioPointer scenario) : scenario_(std::move(scenario))
        {
        }
        virtual SampledPath states() const = 0;
        virtual double measureClearance() const = 0;
        virtual QuickestTrajectory optimize(const std::function<bool()> &interrupted) const = 0;

        ScenarioPointer scenario_;
        bool hasPath_{false};
        Path path_;

    private:
        mutable std::mutex mutex_;            // of what is made without asking for signals
        mutable std::mutex trajectoryMutex_;  // its holder may wait for the interpreter's lock
        mutable std::optional<std::vector<double>> rows_;
        mutable std::optional<double> clearance_;
        mutable std::optional<TrajectoryHandle> trajectory_;
    };

    /** \brief What plan() came to. */
    class PlanHandle final : public PathHandle
    {
    public:
        PlanHandle(ScenarioPointer scenario, ScenarioPlan plan, PlannerParameters parameters);

        const ScenarioPlan &plan() const
        {
            return plan_;
        }
        const PlannerParameters &parameters() const
        {
            return parameters_;
        }

    private:
        SampledPath states() const override;
        double measureClearance() const override;
        QuickestTrajectory optimize(const std::function<bool()> &interrupted) const override;

        ScenarioPlan plan_;
        PlannerParameters parameters_;
    };

    /** \brief What a ParkingPlanner came to. */
    class ParkingHandle final : public PathHandle
    {
    public:
        ParkingHandle(ScenarioPointer scenario, ParkingPlan plan);

        const ParkingPlan &plan() const
        {
            return plan_;
        }

    private:
        SampledPath states() const override;
        double measureClearance() const override;
        QuickestTrajectory optimize(const std::function<bool()> &interrupted) const override;

        ParkingPlan plan_;
    };
}  // namespace parking::python

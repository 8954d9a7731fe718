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

// Data of the Python objects. Everything is immutable or computed once, on first use.
namespace parking::python
{
    /** \brief A scenario and its planner with the distance field. The planner is created on first use; release the
        interpreter's lock before that. */
    class ScenarioHandle
    {
    public:
        /** \brief Stores the scenario; the planner is created later. */
        explicit ScenarioHandle(Scenario scenario) : scenario_(std::make_shared<const Scenario>(std::move(scenario)))
        {
        }

        /** \brief Obstacles, car, start and goals, in local coordinates. */
        const Scenario &scenario() const
        {
            return *scenario_;
        }

        /** \brief The planner; null once \e interrupted, polled every 2 ms during its creation, returns true. */
        const ScenarioPlanner *planner(const std::function<bool()> &interrupted) const;

        /** \brief The planner, created on the first call. Several threads may call it at once. */
        const ScenarioPlanner &planner() const
        {
            return *planner({});
        }

        /** \brief Seconds spent creating the planner; 0 if it was not created yet. */
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

    /** \brief A scenario shared by all results, which may outlive its Python object. */
    using ScenarioPointer = std::shared_ptr<const ScenarioHandle>;

    /** \brief A trajectory in world coordinates with its properties. */
    struct TrajectoryHandle
    {
        Trajectory points;     ///< in world coordinates, 0.05 s apart
        double duration{0.0};  ///< seconds
        bool fallback{false};  ///< whether the car stops to steer along the path
        std::string reason;    ///< why no better trajectory was found; empty otherwise
        TpcapCost cost;        ///< TPCAP's
    };

    /** \brief Common base of the results of plan() and ParkingPlanner: a path in a scenario. */
    class PathHandle
    {
    public:
        virtual ~PathHandle() = default;

        /** \brief The scenario of the path. */
        const ScenarioHandle &scenario() const
        {
            return *scenario_;
        }

        /** \brief The scenario of the path, as a shared pointer. */
        const ScenarioPointer &scenarioPointer() const
        {
            return scenario_;
        }

        /** \brief Whether there is a path, exact or not. */
        bool hasPath() const
        {
            return hasPath_;
        }
        /** \brief The path in the scenario's local coordinates. */
        const Path &path() const
        {
            return path_;
        }

        /** \brief Rows x, y, yaw, direction, curvature, in world coordinates. */
        const std::vector<double> &rows() const;

        /** \brief Minimum clearance in metres, computed on first use. */
        double clearance() const;

        /** \brief The trajectory, optimised on first use. \param interrupted as for TrajectoryOptimizer::optimize() */
        const TrajectoryHandle &trajectory(const std::function<bool()> &interrupted) const;

    protected:
        /** \brief The derived class sets \e hasPath_ and \e path_. */
        explicit PathHandle(ScenarioPointer scenario) : scenario_(std::move(scenario))
        {
        }

        /** \brief The path in states at most 0.1 m apart, in local coordinates; empty without a path. */
        virtual SampledPath states() const = 0;

        /** \brief Minimum distance in metres between body (or circle) and obstacles along the path. */
        virtual double measureClearance() const = 0;

        /** \brief Computes the result of trajectory(), in local coordinates. */
        virtual QuickestTrajectory optimize(const std::function<bool()> &interrupted) const = 0;

        ScenarioPointer scenario_;  ///< never null
        bool hasPath_{false};       ///< see hasPath()
        Path path_;                 ///< in local coordinates, see path()

    private:
        mutable std::mutex mutex_;            // of what is made without asking for signals
        mutable std::mutex trajectoryMutex_;  // its holder may wait for the interpreter's lock
        mutable std::optional<std::vector<double>> rows_;
        mutable std::optional<double> clearance_;
        mutable std::optional<TrajectoryHandle> trajectory_;
    };

    /** \brief Result of plan(). */
    class PlanHandle final : public PathHandle
    {
    public:
        /** \param parameters of the planner */
        PlanHandle(ScenarioPointer scenario, ScenarioPlan plan, PlannerParameters parameters);

        /** \brief The result of the search. */
        const ScenarioPlan &plan() const
        {
            return plan_;
        }

        /** \brief The parameters of the planner. */
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

    /** \brief Result of a ParkingPlanner. */
    class ParkingHandle final : public PathHandle
    {
    public:
        /** \brief Stores \e plan, which was made in \e scenario. */
        ParkingHandle(ScenarioPointer scenario, ParkingPlan plan);

        /** \brief The result of planning, stage by stage. */
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

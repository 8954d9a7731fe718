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
    /** \brief A scenario, and the planner with its distance field, which is made when something is first planned or
        asked: by then the interpreter's lock must have been given back. */
    class ScenarioHandle
    {
    public:
        /** \brief Nothing is built yet. */
        explicit ScenarioHandle(Scenario scenario) : scenario_(std::make_shared<const Scenario>(std::move(scenario)))
        {
        }

        /** \brief Obstacles, car, start and goals, in local coordinates. */
        const Scenario &scenario() const
        {
            return *scenario_;
        }

        /** \brief The planner; null when \e interrupted, asked every 2 ms while it is made, says so. */
        const ScenarioPlanner *planner(const std::function<bool()> &interrupted) const;

        /** \brief Made on the first call, which takes its time; from several threads it is made once. */
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

    /** \brief Shared by all results, which outlive the Python object of their scenario. */
    using ScenarioPointer = std::shared_ptr<const ScenarioHandle>;

    /** \brief A trajectory in world coordinates, with what is known of it. */
    struct TrajectoryHandle
    {
        Trajectory points;     ///< in world coordinates, 0.05 s apart
        double duration{0.0};  ///< seconds
        bool fallback{false};  ///< is it the path with standstills?
        std::string reason;    ///< why there is none better; empty otherwise
        TpcapCost cost;        ///< TPCAP's
    };

    /** \brief What plan() and ParkingPlanner return have in common: a path in a scenario. */
    class PathHandle
    {
    public:
        virtual ~PathHandle() = default;

        /** \brief The scenario of the path. */
        const ScenarioHandle &scenario() const
        {
            return *scenario_;
        }

        /** \brief The same, to be kept. */
        const ScenarioPointer &scenarioPointer() const
        {
            return scenario_;
        }

        /** \brief Is there a path, exact or not? */
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
        /** \brief The derived class sets \e hasPath_ and \e path_. */
        explicit PathHandle(ScenarioPointer scenario) : scenario_(std::move(scenario))
        {
        }

        /** \brief The path in states at most 0.1 m apart, in local coordinates; empty without a path. */
        virtual SampledPath states() const = 0;

        /** \brief Metres between body (or circle) and obstacles, the least along the path. */
        virtual double measureClearance() const = 0;

        /** \brief What trajectory() keeps, in local coordinates. */
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

    /** \brief What plan() came to. */
    class PlanHandle final : public PathHandle
    {
    public:
        /** \brief \param parameters that were planned with */
        PlanHandle(ScenarioPointer scenario, ScenarioPlan plan, PlannerParameters parameters);

        /** \brief What the search came to. */
        const ScenarioPlan &plan() const
        {
            return plan_;
        }

        /** \brief What was planned with. */
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
        /** \brief \e plan was made in \e scenario. */
        ParkingHandle(ScenarioPointer scenario, ParkingPlan plan);

        /** \brief What planning came to, stage by stage. */
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

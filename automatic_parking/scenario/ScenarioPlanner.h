#pragma once

#include "automatic_parking/QuickestTrajectory.h"
#include "ompl_improved_astar/search/planning/Parameters.h"
#include "ompl_improved_astar/search/planning/Plan.h"
#include "parking_geometry/Scenario.h"
#include "parking_geometry/curves/Path.h"
#include "state_validity/CircleChecker.h"
#include "state_validity/FootprintChecker.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

namespace parking
{
    /** \brief Limits of planning. */
    struct PlanLimits
    {
        double time{1.0};             ///< seconds, positive; infinite: no limit
        std::uint64_t expansions{0};  ///< of the search, independent of any clock; 0: no limit
        /** Polled at every expansion; true ends planning. May be empty. */
        std::function<bool()> interrupted;
        search::ImprovementFunction improved;  ///< called at every improvement; may be empty
    };

    /** \brief Result of planning in a scenario: a PlanResult with times and numbers of checks. */
    struct ScenarioPlan : search::PlanResult
    {
        /** Whether it was planned for the paper's circle (grid models) instead of the car's rectangle. */
        bool isDisc{false};
        double planningTime{0.0};  ///< seconds, excluding loadingTime
        CheckCounts checks;        ///< number of poses decided by each tier, for the rectangle

        /** \brief Whether there is a path, to a goal or only towards one. */
        bool hasPath() const
        {
            return outcome == search::PlanOutcome::Solved || outcome == search::PlanOutcome::Approximate ||
                   outcome == search::PlanOutcome::Escaped;
        }
    };

    /** \brief Names of outcomes in results: exact, approximate, infeasible, timeout, invalid_start, invalid_goal,
        escaped. */
    std::string statusName(search::PlanOutcome outcome);

    /** \brief Plans in a scenario without OMPL: from scenario to path, and from path to trajectory.

        It corresponds to parking_plan with improved_astar. The car model plans for the car's rectangle, the grid models
        for the paper's circle of half the car's width. The turning radius is that of the vehicle; the parameter
        turning_radius is ignored. Const calls from several threads are safe. */
    class ScenarioPlanner
    {
    public:
        /** \brief Reads the obstacles. \param contact see FootprintChecker

            Throws what FootprintChecker throws. */
        explicit ScenarioPlanner(Scenario scenario, ContactTestMaker contact = {});

        /** \brief The scenario as given. */
        const Scenario &scenario() const
        {
            return scenario_;
        }

        /** \brief The checker of the car's rectangle, without a margin. */
        const FootprintChecker &footprint() const
        {
            return footprint_;
        }
        /** \brief Radius in metres of the circle for which the grid models plan. */
        double circleRadius() const
        {
            return 0.5 * scenario_.vehicle.width;
        }
        /** \brief The checker of the circle of the grid models, created lazily. */
        const CircleChecker &circle() const;

        /** \brief Plans from the start to a goal. Equal inputs give equal paths if the time suffices. Throws
            parking::Error for parameters and limits out of range. */
        ScenarioPlan plan(const PlannerParameters &parameters, const PlanLimits &limits = {}) const;

        /** \brief The request that plan() passes to the search. */
        search::PlanRequest request(const PlannerParameters &parameters) const;

        /** \brief The world in which plan() searches. */
        std::unique_ptr<search::MotionEnvironment> environment(const PlannerParameters &parameters) const;

        /** \brief States at most 0.1 m apart, from the start. The last state of an exact plan is exactly the goal,
            without rounding. Empty without a path. */
        SampledPath states(const ScenarioPlan &plan) const;

        /** \brief Minimum distance in metres between body (or circle) and obstacles along the path. It is accurate to a
            millimetre or one percent; for the circle it is measured at states 0.1 m apart. Infinite without a path. */
        double clearance(const ScenarioPlan &plan) const;

        /** \brief The quickest trajectory near the path. Throws parking::Error for a plan without a path, and what
            TrajectoryOptimizer::optimize() throws. */
        QuickestTrajectory trajectory(const ScenarioPlan &plan, const QuickestTrajectoryOptions &options = {},
                                      const std::function<bool()> &interrupted = {}) const;

    private:
        Scenario scenario_;
        FootprintChecker footprint_;
        mutable std::once_flag circleOnce_;
        mutable std::unique_ptr<const CircleChecker> circle_;
    };
}  // namespace parking

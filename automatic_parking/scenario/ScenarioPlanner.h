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
    /** \brief When planning ends at the latest. */
    struct PlanLimits
    {
        double time{1.0};             ///< seconds, positive; infinite: no limit
        std::uint64_t expansions{0};  ///< of the search, which depends on no clock; 0: no limit
        /** Asked at every expansion; true ends planning. May be empty. */
        std::function<bool()> interrupted;
        search::ImprovementFunction improved;  ///< told of every improvement; may be empty
    };

    /** \brief What planning in a scenario came to: a PlanResult, and how it came about. */
    struct ScenarioPlan : search::PlanResult
    {
        bool isDisc{false};        ///< planned for the paper's circle (grid models), and not for the car's rectangle
        double planningTime{0.0};  ///< seconds, without what is in loadingTime
        CheckCounts checks;        ///< which tier decided how many poses; of the rectangle

        /** \brief Is there a path, to a goal or only towards one? */
        bool hasPath() const
        {
            return outcome == search::PlanOutcome::Solved || outcome == search::PlanOutcome::Approximate;
        }
    };

    /** \brief The names of outcomes in results: exact, approximate, infeasible, timeout, invalid_start, invalid_goal.
     */
    std::string statusName(search::PlanOutcome outcome);

    /** \brief Plans in a scenario, without OMPL: from scenario to path, and from path to trajectory.

        The core's way of what parking_plan does with improved_astar: the car model plans for the car's rectangle, the
        grid models for the paper's circle of half the car's width. The car's turning radius is that of its vehicle,
        whatever the parameter turning_radius says. Const calls from several threads are safe. */
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
        /** \brief Metres: of the circle that the grid models plan for. */
        double circleRadius() const
        {
            return 0.5 * scenario_.vehicle.width;
        }
        /** \brief The checker of that circle; made lazily. */
        const CircleChecker &circle() const;

        /** \brief Plans from the start to a goal. Equal inputs give equal paths as long as the time suffices.

            Throws parking::Error for parameters and limits out of range. */
        ScenarioPlan plan(const PlannerParameters &parameters, const PlanLimits &limits = {}) const;

        /** \brief The question that plan() puts to the search. */
        search::PlanRequest request(const PlannerParameters &parameters) const;

        /** \brief The world that plan() asks. */
        std::unique_ptr<search::MotionEnvironment> environment(const PlannerParameters &parameters) const;

        /** \brief States no more than 0.1 m apart; the first one at the start, of an exact plan the last one at the
            goal, not up to rounding but exactly. Empty without a path. */
        SampledPath states(const ScenarioPlan &plan) const;

        /** \brief Least distance in metres between body (or circle) and obstacles along the path, to a millimetre or
            one percent (circle: at states 0.1 m apart). Infinite without a path. */
        double clearance(const ScenarioPlan &plan) const;

        /** \brief The quickest trajectory near the path. Throws parking::Error for a plan without one, and what
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

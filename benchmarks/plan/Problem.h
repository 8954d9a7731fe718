#pragma once

#include "benchmarks/planners/MeasuredPlanner.h"
#include "benchmarks/planners/PlannerRegistry.h"
#include "parking_geometry/Scenario.h"
#include "parking_geometry/referee/Referee.h"
#include "path_tracking/simulation/ClosedLoop.h"
#include "state_validity/FootprintChecker.h"
#include "state_validity/ObstacleSet.h"
#include "state_validity/ompl/CurveSpace.h"

#include <ompl/base/SpaceInformation.h>
#include <ompl/geometric/SimpleSetup.h>

#include <cstdint>
#include <memory>
#include <string>

namespace ompl::geometric
{
    class ImprovedAStar;
}

namespace parking
{
    /** \brief Shape that must stay free of obstacles. */
    enum class FootprintKind
    {
        Rectangle,  ///< the car's body
        Circle      ///< a disc round the rear axle at any heading: the paper's approximation
    };

    /** \brief Cost that planners minimise. */
    enum class ObjectiveKind
    {
        Unset,   ///< path length for planners that improve paths; others minimise what they minimise by themselves
        Length,  ///< path length
        Driving  ///< DrivingCostObjective with default weights
    };

    /** \brief State space and footprint in which a planner solves a scenario. */
    struct ProblemSettings
    {
        SpaceKind space{SpaceKind::ReedsShepp};             ///< curves that join states
        FootprintKind footprint{FootprintKind::Rectangle};  ///< shape that must stay free of obstacles
        double circleRadius{0.0};                           ///< radius in metres; 0: half of the car's width
        ObjectiveKind objective{ObjectiveKind::Unset};      ///< cost that planners minimise
        double threshold{0.0};  ///< metres; anytime planners stop at a path that costs less; 0: none
    };

    /** \brief Names in files and on command lines: reeds_shepp, dubins, se2; rectangle, circle; length, driving. The
        readers throw parking::Error listing the known names for any other. @{ */
    std::string toString(SpaceKind space);
    std::string toString(FootprintKind footprint);           ///< rectangle or circle
    SpaceKind spaceByName(const std::string &name);          ///< of reeds_shepp, dubins or se2
    FootprintKind footprintByName(const std::string &name);  ///< of rectangle or circle
    std::string toString(ObjectiveKind objective);           ///< length or driving; empty: unset
    ObjectiveKind objectiveByName(const std::string &name);  ///< of length or driving
    /** @} */

    /** \brief Radius of the disc in metres for this car; 0 for a rectangle. */
    double circleRadiusOf(const ProblemSettings &settings, const Vehicle &vehicle);

    /** \brief Throws parking::Error for a radius that is not positive, and for a circle in a space of curves. */
    void checkSettings(const ProblemSettings &settings);

    /** \brief A planner ready to solve a problem, with its own instances of everything that it changes. */
    struct PreparedPlanner
    {
        std::shared_ptr<ompl::geometric::SimpleSetup> setup;  ///< the planner's own problem definition
        std::shared_ptr<MeasuredPlanner> planner;             ///< the planner, set up with its settings

        /** \brief The measured planner, if it is this project's; otherwise null. */
        ompl::geometric::ImprovedAStar *improved() const;

        /** \brief The definition in which the planner stores its solutions. */
        const ompl::base::ProblemDefinitionPtr &problem() const
        {
            return setup->getProblemDefinition();
        }
    };

    /** \brief A scenario for OMPL's planners: space, bounds, validity and motion checks.

        FclFootprintChecker and SweptMotionValidator check bodies, CircleValidityChecker checks discs. States are in
        the scenario's local coordinates. */
    class Problem
    {
    public:
        /** \brief Builds obstacles and distance field, and measures the time.

            Throws parking::Error for settings out of range and for a car that does not fit into the world. */
        Problem(Scenario scenario, const ProblemSettings &settings);

        /** \brief The scenario as given. */
        const Scenario &scenario() const
        {
            return scenario_;
        }

        /** \brief The settings as given; the radius of a disc is circleRadius(). */
        const ProblemSettings &settings() const
        {
            return settings_;
        }

        /** \brief Radius of the disc in metres; 0 for a rectangle. */
        double circleRadius() const;

        /** \brief The objective of the settings, without the threshold; null if it is unset. */
        ompl::base::OptimizationObjectivePtr objective() const;

        /** \brief Whether the car can drive the space's motions. */
        bool isDrivable() const
        {
            return settings_.space != SpaceKind::SE2;
        }

        /** \brief Space, bounds and the checks of states and motions, shared by all planners. */
        const ompl::base::SpaceInformationPtr &spaceInformation() const
        {
            return si_;
        }

        /** \brief The space's curves as arcs. */
        const CurveSpace &curveSpace() const
        {
            return *curveSpace_;
        }

        /** \brief The checker of the car's body; also available when the footprint is a disc. */
        const FootprintChecker &footprint() const
        {
            return *footprint_;
        }

        /** \brief The independent checker that decides whether a path is valid, for the car or the disc. */
        const Referee &referee() const
        {
            return *referee_;
        }

        /** \brief Drives paths with the scenario's car among its obstacles and checks collisions.

            parking_plan and parking_benchmark use it, so that equal paths give equal drives. */
        ClosedLoop closedLoop() const;

        /** \brief Time in seconds to build obstacles and distance field. */
        double loadingTime() const
        {
            return loadingTime_;
        }

        /** \brief The reason why an exact solution cannot exist: start or all goals in collision or outside, with the
            place.

            Empty when the start and at least one goal are free. */
        std::string whyUnsolvable() const;

        /** \brief A new instance of a planner with a problem definition and a goal of its own.

            Planners that improve paths receive the objective of the settings, or path length if it is unset. So does
            improved A* with an objective of the settings, or with `anytime` and a threshold. Problem definitions are
            not shared: RRTstar::setup() stores an objective there, with which another planner would use up its time
            limit. The parameter `turning_radius` of planners that have it is set to the car's
            unless \e settings contain it. Then the settings of the entry and of the user are applied and the planner is
            set up.

            Throws parking::Error for settings that are unknown, out of range or without effect in the space, and for a
            planner that does not support the space. */
        PreparedPlanner prepare(const PlannerEntry &entry, const PlannerSettings &settings) const;

        /** \brief States checked since the last call of resetCounts(), poses along motions included. */
        CheckCounts checkCounts() const;

        /** \brief Resets the count of checked states. */
        void resetCounts() const;

    private:
        std::string troubleAt(const Pose &pose) const;
        Scenario scenario_;
        ProblemSettings settings_;
        std::shared_ptr<const ObstacleSet> obstacles_;
        std::shared_ptr<const FootprintChecker> footprint_;
        ompl::base::SpaceInformationPtr si_;
        std::unique_ptr<CurveSpace> curveSpace_;
        std::unique_ptr<const Referee> referee_;
        double loadingTime_{0.0};
    };

    /** \brief The settings that a planner requires, or the defaults.

        The grid models of improved A* require plain SE2 space and a circle, and reject spaces of curves.
        Throws the exceptions of applySettings(). */
    ProblemSettings suitableSettings(const PlannerEntry &entry, const PlannerSettings &settings);

    /** \brief Seeds the random numbers of all planners and samplers created from now on.

        OMPL seeds every generator from a global one. It warns about further calls in one process, since existing
        generators are not affected; here every run creates new ones. */
    void seedRandomNumbers(std::uint_fast32_t seed);
}  // namespace parking

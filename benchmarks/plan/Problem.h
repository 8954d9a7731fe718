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
    /** \brief What is asked to be free of obstacles. */
    enum class FootprintKind
    {
        Rectangle,  ///< the car's body
        Circle      ///< a disc round the rear axle, whatever the heading: the paper's approximation
    };

    /** \brief In which terms a scenario is put to a planner. */
    struct ProblemSettings
    {
        SpaceKind space{SpaceKind::ReedsShepp};             ///< by which states are joined
        FootprintKind footprint{FootprintKind::Rectangle};  ///< what is to stay free of obstacles
        double circleRadius{0.0};                           ///< metres; 0: half of the car's width
        double threshold{0.0};  ///< metres; optimising planners stop at a path that is shorter
    };

    /** \brief Names as in files and on command lines: reeds_shepp, dubins, se2; rectangle, circle. The readers throw
        parking::Error listing the known names for any other. @{ */
    std::string toString(SpaceKind space);
    std::string toString(FootprintKind footprint);           ///< rectangle or circle
    SpaceKind spaceByName(const std::string &name);          ///< of reeds_shepp, dubins or se2
    FootprintKind footprintByName(const std::string &name);  ///< of rectangle or circle
    /** @} */

    /** \brief Throws parking::Error for a radius that is none, and for a circle in a space of curves. */
    void checkSettings(const ProblemSettings &settings);

    /** \brief A planner ready to solve a problem, with everything that it changes being its own. */
    struct PreparedPlanner
    {
        std::shared_ptr<ompl::geometric::SimpleSetup> setup;  ///< with a problem definition of its own
        std::shared_ptr<MeasuredPlanner> planner;             ///< set up, with its settings

        /** \brief The planner that is measured, if it is the one of this project; otherwise null. */
        ompl::geometric::ImprovedAStar *improved() const;

        /** \brief Where the planner leaves its solutions. */
        const ompl::base::ProblemDefinitionPtr &problem() const
        {
            return setup->getProblemDefinition();
        }
    };

    /** \brief A scenario as OMPL's planners see it: space, bounds, validity and motion checks.

        Rectangles are checked by FclFootprintChecker and SweptMotionValidator, discs by CircleValidityChecker. States
        are in the scenario's local coordinates. */
    class Problem
    {
    public:
        /** \brief Builds obstacles and distance field, and measures that.

            Throws parking::Error for settings that are out of range and for a car that does not fit into the world. */
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

        /** \brief Are the space's motions ones that the car can drive? */
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

        /** \brief The checker of the car's rectangle; also there when planning is done for a disc. */
        const FootprintChecker &footprint() const
        {
            return *footprint_;
        }

        /** \brief Who has the last word on paths, for the car or the disc. */
        const Referee &referee() const
        {
            return *referee_;
        }

        /** \brief What drives planned paths with the scenario's car among its obstacles, collisions checked: the same
            drive follows wherever a path is driven. */
        ClosedLoop closedLoop() const;

        /** \brief Seconds that obstacles and distance field took to build. */
        double loadingTime() const
        {
            return loadingTime_;
        }

        /** \brief Why there can be no exact solution: a start or goal in collision or outside, and where it is; empty
            when both are free (of the goals: at least one). */
        std::string whyUnsolvable() const;

        /** \brief A new instance of a planner with a problem definition and a goal of its own.

            A problem definition is not shared: RRTstar::setup() stores an objective there, with which another planner
            would use up all of its time. The parameter `turning_radius`, where a planner has it, is set to the car's
            unless \e settings do; then the entry's and the user's settings are applied and the planner is set up.

            Throws parking::Error for settings that are unknown, out of range or without effect in the space, and for a
            planner that refuses the space. */
        PreparedPlanner prepare(const PlannerEntry &entry, const PlannerSettings &settings) const;

        /** \brief States and motions' poses checked since the last call of resetCounts(). */
        CheckCounts checkCounts() const;

        /** \brief Begins to count anew. */
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

    /** \brief The settings that a planner asks for: plain SE2 space and circle for the grid models of improved A*,
        which refuse a space of curves; otherwise the defaults. Throws what applySettings throws. */
    ProblemSettings suitableSettings(const PlannerEntry &entry, const PlannerSettings &settings);

    /** \brief Makes all planners and samplers made from now on repeat what they did after the same call before.

        OMPL seeds every generator from one global one. It complains when that is done more than once in a process,
        since generators that exist already are not affected; here everything random is made anew for each run. */
    void seedRandomNumbers(std::uint_fast32_t seed);
}  // namespace parking

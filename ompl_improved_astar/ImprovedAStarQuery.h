#pragma once

// Private to ImprovedAStar's own source files; not installed.

#include "ompl_improved_astar/ImprovedAStar.h"
#include "ompl_improved_astar/StateSpaceEnvironment.h"
#include "ompl_improved_astar/search/planning/FootprintEnvironment.h"
#include "ompl_improved_astar/search/planning/GridSmoothing.h"
#include "ompl_improved_astar/search/planning/PathPlanner.h"
#include "ompl_improved_astar/search/planning/Plan.h"
#include "state_validity/ompl/CurveSpace.h"
#include "state_validity/ompl/OmplPose.h"

#include <ompl/base/SpaceInformation.h>

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ompl::geometric
{
    /** \brief Between states of a path where OMPL does not interpolate along the path's own arcs, in turning radii: on
        a plain SE2 space a hundredth of the radius keeps the chord within a hundred-thousandth of the radius of the
        arc. */
    constexpr double DENSE_SPACING = 0.01;

    /** What belongs to one query, and the memory that outlives it. */
    struct ImprovedAStar::Query
    {
        std::optional<parking::CurveSpace> space;  ///< set by setup()

        /** \brief With an FclFootprintChecker and a model that does not turn on the spot; otherwise null. */
        std::unique_ptr<parking::FootprintEnvironment> footprintEnvironment;

        /** \brief The world where there is no footprintEnvironment, and for its last word. */
        std::unique_ptr<parking::StateSpaceEnvironment> stateEnvironment;

        parking::search::PathPlanner planner;         ///< does the planning
        parking::search::CarInSpace car;              ///< what the planner has to know of car and space
        bool turnsOnTheSpot{false};                   ///< the motion model's paths do
        bool begun{false};                            ///< whether the planner was told of this query
        parking::PlannerParameters parameters;        ///< those that the query was begun with
        base::GoalPtr goal;                           ///< the one that the query was begun for
        base::StateValidityCheckerPtr checker;        ///< likewise; the environments ask it
        base::MotionValidatorPtr validator;           ///< likewise
        std::vector<parking::Pose> starts,            ///< valid ones, as far as they were read
            goals;                                    ///< likewise
        unsigned int otherGoals{0};                   ///< asked of a region since none of the first can be reached
        std::optional<parking::Pose> fallbackTarget;  ///< a goal to come near to when none is valid
        parking::search::PlanOutcome outcome{parking::search::PlanOutcome::Timeout};  ///< of the last solve()
        std::string reason;                                            ///< why there is no solution, where known
        bool hasSolution{false};                                       ///< there is an exact one: path
        parking::Path path;                                            ///< the best one by the problem's objective
        double plannedCost{std::numeric_limits<double>::infinity()};   ///< of path, by the planner's own model
        double closeness{0.0};                                         ///< of that, for being near to obstacles
        std::vector<parking::Pose> states;                             ///< of it, for OMPL
        base::Cost bestCost{std::numeric_limits<double>::infinity()};  ///< of path
        base::OptimizationObjectivePtr objective;  ///< that bestCost is of; none: length and closeness, in metres
        std::vector<parking::Pose> solution;       ///< what was reported last, when it was exact
        base::SpaceInformationPtr si;              ///< that of the planner
        std::array<std::vector<base::State *>, 3> dataStates;  ///< of both frontiers and of the solution

        /** \brief A query that has not begun. */
        explicit Query(base::SpaceInformationPtr information) : si(std::move(information))
        {
        }

        Query(const Query &) = delete;
        Query &operator=(const Query &) = delete;

        ~Query()
        {
            freeDataStates();
        }

        /** \brief Is the space a plain SE2 space? */
        bool isPlain() const
        {
            return space->kind() == parking::SpaceKind::SE2;
        }

        /** \brief Smallest turning radius in metres: the space's own or, on a plain SE2 space, the parameter. */
        double turningRadius() const
        {
            return isPlain() ? parameters.turningRadius : space->turningRadius();
        }

        /** \brief How far apart the states of a path may be in this space. */
        parking::StateSpacing stateSpacing() const
        {
            const double radius = turningRadius();
            if (turnsOnTheSpot)
                return {parking::search::SMOOTH_STATE_SPACING, parking::search::SMOOTH_STATE_SPACING, 1.0 / radius,
                        &*space};
            return {isPlain() ? DENSE_SPACING * radius : 0.0, DENSE_SPACING * radius, 1.0 / radius, &*space};
        }

        /** \brief Ends the query; what depends on the space only is kept, and memory too. */
        void forget()
        {
            freeDataStates();
            begun = false;
            goal.reset();
            starts.clear();
            goals.clear();
            otherGoals = 0;
            fallbackTarget.reset();
            hasSolution = false;
            outcome = parking::search::PlanOutcome::Timeout;
            reason.clear();
            solution.clear();
            bestCost = base::Cost(std::numeric_limits<double>::infinity());
            objective.reset();
        }

        /** \brief Frees the states that planner data was given. */
        void freeDataStates()
        {
            for (std::vector<base::State *> &group : dataStates)
            {
                for (base::State *state : group)
                    if (state != nullptr)
                        si->freeState(state);
                group.clear();
            }
        }

        /** The state that stands for a node in planner data: the same one each time, so that data handed out before
            stays valid until the query ends. */
        base::State *dataState(std::size_t group, std::size_t index, const parking::Pose &pose)
        {
            std::vector<base::State *> &known = dataStates[group];
            if (known.size() <= index)
                known.resize(index + 1, nullptr);
            if (known[index] == nullptr)
                known[index] = si->allocState();
            parking::setPose(known[index], pose);
            return known[index];
        }
    };
}  // namespace ompl::geometric

#pragma once

#include "ompl_improved_astar/search/planning/Parameters.h"
#include "ompl_improved_astar/search/planning/Plan.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/Path.h"

#include <ompl/base/Planner.h>
#include <ompl/base/goals/GoalSampleableRegion.h>

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/** \namespace ompl
    \brief OMPL's own namespace, to which this project adds one planner. */

/** \namespace ompl::geometric
    \brief OMPL's planners of paths without time, ImprovedAStar among them. */
namespace ompl::geometric
{
    class PathGeometric;

    /** \anchor gImprovedAStar

        \par Short description

        Improved A* plans motions of a car among obstacles: the paths that it returns can be driven, forwards and in
        reverse, at or above a minimum turning radius. It searches from the goal and from the start at once, over motion
        primitives at a ladder of resolutions, and joins the two frontiers by Reeds-Shepp (or Dubins) curves. Every
        improvement of the paper that it is named after is a parameter, and so is the paper's own search on a grid of
        positions.

        \par Spaces

        ReedsSheppStateSpace (the turning radius is the space's), DubinsStateSpace (the car drives forwards only) and
        plain SE2StateSpace (parameter `turning_radius`; the states of the path lie densely enough for the straight
        interpolation between them). The grid models belong on a plain SE2StateSpace: a curve space would turn their
        paths into loops.

        \par Validity

        Any StateValidityChecker and MotionValidator is supported: the motion validator checks each path before it is
        returned. With parking::FclFootprintChecker the search sweeps the car's footprint exactly and checks no states,
        which is about ten times faster. A checker that replaces another in the SpaceInformation is used from the next
        query on.

        \par Goals

        Any GoalSampleableRegion with any number of goals. The path ends exactly at the goal that is cheapest to reach.
        If all goals collide or cannot be reached, the path ends as close to one as possible, and the solution is
        approximate (parameter `approximate`). A start within `goal_tolerance` of a goal yields an
        exact path of these two states, or of the start alone if the space would connect them by a longer curve.

        \par Starts in contact

        With the parameter `escape` and parking::FclFootprintChecker, a path may begin in shallow contact. It is
        reported as approximate, even if it ends at a goal, because its first states are invalid. outcome() is then
        Escaped, and escape() describes the motion.

        \par Several calls of solve()

        A call resumes the previous one, includes starts and goals that were added since, and returns a solution at
        least as good. Another problem definition, goal object, checker, motion validator or parameter value begins a
        new query, as clearQuery() does, and so do start states or goal states whose values have changed. Call
        clearQuery() if the obstacles of the same checker have changed.

        \par Objectives

        If the problem's objective is path length, a parking::DrivingCostObjective or a sum of these, the search
        minimises it; see parking::parametersFor(). Without `anytime` the planner then also searches with its own
        weights, so that the path costs at most as much as the one without an objective, unless the termination
        condition ends planning before. Any other objective, and each threshold, is evaluated for each path found. An
        objective with other weights begins a new query; any other one recomputes the cost of the solution.

        \par Threads

        A planner may be used by one thread at a time: calls of solve(), clear() and changes of parameters must not
        overlap. Several planners may run concurrently, also on one SpaceInformation. Progress properties may be read
        while solve() runs.

        \par Associated publication

        Y. Zhao, Automatic parking planning control method based on improved A* algorithm, arXiv:2406.15429, 2024. */

    /** \brief Improved A* for cars. */
    class ImprovedAStar : public base::Planner
    {
    public:
        /** \brief Creates a planner with default parameters for the space of \e si, which setup() checks. */
        explicit ImprovedAStar(const base::SpaceInformationPtr &si);
        ~ImprovedAStar() override;

        /** \brief Prepares the planner. Throws ompl::Exception for a space that is not SE2, Reeds-Shepp or Dubins, and
            for a motion model that is not compatible with it. */
        void setup() override;

        /** \brief Sets the problem. Another problem definition begins a new query. */
        void setProblemDefinition(const base::ProblemDefinitionPtr &pdef) override;

        using base::Planner::solve;

        /** \brief Plans until the problem is solved, no solution can be found, or \e ptc is met.

            A problem without a solution yields a status, not an exception. Throws ompl::Exception in the cases of
            setup(). */
        base::PlannerStatus solve(const base::PlannerTerminationCondition &ptc) override;

        /** \brief Discards the query, its memory and the set-up; parameters are kept. */
        void clear() override;

        /** \brief Discards starts, goals and frontiers, but keeps memory and all that depends on the space only. */
        void clearQuery() override;

        /** \brief Adds both frontiers and, if it is exact, the last solution; edges point in the direction of driving.
            The states remain valid until the query ends. */
        void getPlannerData(base::PlannerData &data) const override;

        /** \brief The parameters, also accessible by name in params(). parking::parameterTable() documents them. */
        const parking::PlannerParameters &parameters() const
        {
            return parameters_;
        }

        /** \brief Sets all parameters. If a value is out of range, throws ompl::Exception with parameter, value and
            range, and changes nothing. */
        void setParameters(const parking::PlannerParameters &parameters);

        /** \brief Seconds that solve() spent classifying cells before the search (obstacle_loading). */
        double mapLoadingTime() const;

        /** \brief Work of the last query. */
        parking::search::SearchStatistics statistics() const;

        /** \brief Number of states and motions checked. */
        std::uint64_t checkedStates() const;

        /** \brief Number of checkedStates() that FCL decided; 0 without parking::FclFootprintChecker. */
        std::uint64_t exactChecks() const;

        /** \brief The best solution in exact form; nullptr without one. */
        const parking::Path *solutionPath() const;

        /** \brief Outcome of the last solve(), more precise than a status before OMPL 1.6: Infeasible if nothing was
            left to try, even if an approximate path was reported. */
        parking::search::PlanOutcome outcome() const;

        /** \brief The escape with which the path of the last solve() begins, if any (parameter `escape`). */
        std::optional<parking::Escape> escape() const;

        /** \brief One line on an escape, or on straights shorter than the parameters require; empty otherwise. */
        std::string notice() const;

        /** \brief One line that explains why there is no solution; empty if unknown or if only the time limit was met.
         */
        const std::string &reason() const;

        /** \brief Best cost divided by a lower bound of all paths, at least 1; see
            parking::search::Search::lowerBound(). */
        double suboptimalityBound();

    private:
        struct Query;

        void declareParameters();
        void requireFittingModel() const;
        parking::PlannerParameters searchParameters() const;
        void prepareQuery();
        bool readInputs(const base::PlannerTerminationCondition &ptc, base::PlannerStatus &failure);
        bool readStarts();
        bool isSameQuery() const;
        enum class GoalReading
        {
            Some,
            NoneValid,
            TimeUp  // before all, or any, had been looked at
        };
        GoalReading readGoals(const base::GoalSampleableRegion &region, const base::PlannerTerminationCondition &ptc);
        bool addGoal(const parking::Pose &pose);
        bool mayHaveOtherGoals() const;
        bool readMoreGoals(const base::PlannerTerminationCondition &ptc);
        void offerPathOfOwnWeights(const parking::search::StopFunction &stop,
                                   const parking::search::ImprovementFunction &improved);
        base::PlannerStatus search(const base::PlannerTerminationCondition &ptc);
        base::PlannerStatus approach(const base::PlannerTerminationCondition &ptc,
                                     const parking::search::StopFunction &stop);
        parking::Path smoothed(const parking::Path &path, const base::PlannerTerminationCondition &ptc) const;
        std::shared_ptr<PathGeometric> geometricPath(const std::vector<parking::Pose> &poses) const;
        base::Cost costOf(const parking::Path &path, const PathGeometric &geometric, double closeness) const;
        void priceAnew();
        double differenceFromGoal(const base::State *state) const;
        bool takeImprovement(const parking::Path &path, double plannedCost,
                             const base::PlannerTerminationCondition &ptc);
        void endAtGoal(std::vector<parking::Pose> &poses) const;
        bool swerves(const parking::Pose &start, const parking::Pose &goal) const;
        base::PlannerStatus report(std::vector<parking::Pose> poses, bool approximate);

        parking::PlannerParameters parameters_;
        std::unique_ptr<Query> query_;
        std::atomic<double> bestCost_;
        std::atomic<std::uint64_t> expanded_{0};
    };
}  // namespace ompl::geometric

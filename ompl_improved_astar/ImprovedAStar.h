#pragma once

#include "ompl_improved_astar/search/planning/Parameters.h"
#include "ompl_improved_astar/search/planning/Plan.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/Path.h"

#include <ompl/base/Planner.h>
#include <ompl/base/goals/GoalSampleableRegion.h>

#include <atomic>
#include <memory>
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

        Any StateValidityChecker and MotionValidator will do: paths found are put to the motion validator before they
        are returned. With parking::FclFootprintChecker the search sweeps the car's footprint exactly and needs no
        states at all, which is some ten times faster. A checker given to the SpaceInformation later serves from the
        next query on.

        \par Goals

        Any GoalSampleableRegion with any number of goals, of which the cheapest to reach is reached exactly. Where a
        goal lies in an obstacle, or cannot be reached, the path ends as near to it as the car gets, and the solution is
        approximate (parameter `approximate`).

        \par Several calls of solve()

        A call goes on where the one before it ended, with starts and goals that were added since, and returns a
        solution at least as good. Another problem definition, goal object, checker or motion validator, or another
        value of a parameter, begins the query anew, as clearQuery() does; that is what to call when the obstacles of
        the same checker have changed. Another objective prices the solution anew.

        \par Threads

        A planner serves one thread at a time: no call of solve() may overlap with another on the same planner, nor with
        clear() or a change of parameters. Several planners may run at once, on one SpaceInformation too. Progress
        properties may be read while solve() runs.

        \par Associated publication

        Y. Zhao, Automatic parking planning control method based on improved A* algorithm, arXiv:2406.15429, 2024. */

    /** \brief Improved A* for cars. */
    class ImprovedAStar : public base::Planner
    {
    public:
        /** \brief A planner with the default parameters for the space of \e si, which setup() looks at. */
        explicit ImprovedAStar(const base::SpaceInformationPtr &si);
        ~ImprovedAStar() override;

        /** \brief Throws ompl::Exception for a space that is not SE2, Reeds-Shepp or Dubins, and for a motion model
            that does not go with it. */
        void setup() override;

        /** \brief Another problem definition than before begins a new query. */
        void setProblemDefinition(const base::ProblemDefinitionPtr &pdef) override;

        using base::Planner::solve;

        /** \brief Plans until the problem is solved, or shown to have no solution, or \e ptc says so.

            A problem without solution is a status, not an exception. Throws ompl::Exception where setup() does. */
        base::PlannerStatus solve(const base::PlannerTerminationCondition &ptc) override;

        /** \brief Forgets the query, and the memory and set-up with it; parameters stay. */
        void clear() override;

        /** \brief Forgets starts, goals and frontiers, but keeps memory and what depends on the space only. */
        void clearQuery() override;

        /** \brief Both frontiers and, when it is exact, the last solution; edges point in the direction of driving. The
            states stay valid until the query ends. */
        void getPlannerData(base::PlannerData &data) const override;

        /** \brief What the planner goes by; by name in params() too. parking::parameterTable() tells what each
            means. */
        const parking::PlannerParameters &parameters() const
        {
            return parameters_;
        }

        /** \brief Sets all parameters. Throws ompl::Exception, naming parameter, value and what is right, when one is
            out of its range, and then changes nothing. */
        void setParameters(const parking::PlannerParameters &parameters);

        /** \brief Seconds that solve() spent on finding out which cells are free before searching. */
        double mapLoadingTime() const;

        /** \brief What the last query did. */
        parking::search::SearchStatistics statistics() const;

        /** \brief States and motions that were checked. */
        std::uint64_t checkedStates() const;

        /** \brief How many of checkedStates() needed FCL; known with parking::FclFootprintChecker only, otherwise 0. */
        std::uint64_t exactChecks() const;

        /** \brief The best solution in exact form; nullptr without one. */
        const parking::Path *solutionPath() const;

        /** \brief How the last solve() ended, more exactly than its status can say before OMPL 1.6: Infeasible where
            nothing was left to try, whatever path was reported. */
        parking::search::PlanOutcome outcome() const;

        /** \brief One line on why there is no solution, when that is known and not only for want of time. */
        const std::string &reason() const;

        /** \brief Best cost over a bound that no path stays below, at least 1: see
            parking::search::Search::lowerBound(). */
        double suboptimalityBound();

    private:
        struct Query;

        void declareParameters();
        void requireFittingModel() const;
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
        bool readAnotherGoal(const base::PlannerTerminationCondition &ptc);
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
        base::PlannerStatus report(std::vector<parking::Pose> poses, bool approximate);

        parking::PlannerParameters parameters_;
        std::unique_ptr<Query> query_;
        std::atomic<double> bestCost_;
        std::atomic<std::uint64_t> expanded_{0};
    };
}  // namespace ompl::geometric

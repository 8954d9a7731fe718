#pragma once

#include "ompl_improved_astar/Parameters.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/Path.h"

#include <ompl/base/Planner.h>

#include <atomic>
#include <memory>
#include <string>
#include <vector>

namespace ompl::geometric
{
    /** \anchor gImprovedAStar

        \par Short description

        Improved A* plans motions of a car among obstacles: the paths that it returns can be driven, forwards and in
        reverse, at or above a minimum turning radius. It searches from the goal and from the start at once, over motion
        primitives at a ladder of resolutions, and joins the two trees by Reeds-Shepp (or Dubins) curves. Every
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
        solution at least as good. Another problem definition, another goal object or another value of a parameter
        begins the query anew, as clearQuery() does; that is also what to call when the obstacles have changed.

        \par Associated publication

        Y. Zhao, Automatic parking planning control method based on improved A* algorithm, arXiv:2406.15429, 2024. */

    /** \brief Improved A* for cars. */
    class ImprovedAStar : public base::Planner
    {
    public:
        explicit ImprovedAStar(const base::SpaceInformationPtr &si);
        ~ImprovedAStar() override;

        /** \brief Throws ompl::Exception for a space that is not SE2, Reeds-Shepp or Dubins, and for a motion model
           that does not go with it. */
        void setup() override;

        /** \brief Another problem definition than before begins a new query. */
        void setProblemDefinition(const base::ProblemDefinitionPtr &pdef) override;

        using base::Planner::solve;
        base::PlannerStatus solve(const base::PlannerTerminationCondition &ptc) override;

        void clear() override;

        /** \brief Forgets starts, goals and trees, but keeps memory and what depends on the space only. */
        void clearQuery() override;

        /** \brief Both trees and, when it is exact, the last solution; edges point in the direction of driving. The
            states stay valid until the query ends. */
        void getPlannerData(base::PlannerData &data) const override;

        /** \brief All parameters at once; throws as the setters below do, and then changes nothing. */
        const parking::PlannerParameters &parameters() const
        {
            return parameters_;
        }
        void setParameters(const parking::PlannerParameters &parameters);

        /** \name Parameters
            Each is also in params() under the name in brackets. Setters throw ompl::Exception for values out of range.
            @{ */

        /** \brief [motion_model] `car` drivable motions; `grid8`, `grid16` the paper's moves between grid cells. */
        void setMotionModel(const std::string &model);
        std::string getMotionModel() const;

        /** \brief [turning_radius] metres, on a plain SE2StateSpace only; curve spaces bring their own. */
        void setTurningRadius(double radius);
        double getTurningRadius() const;

        /** \brief [xy_resolution] side of a cell in metres: for the grid models of the grid, for the car model of cells
            at steps of a metre; 0 chooses (0.5 m on grids, a tenth of the turning radius for the car). */
        void setXyResolution(double resolution);
        double getXyResolution() const;

        /** \brief [heading_bins] cells of heading round the circle at steps of a metre. */
        void setHeadingBins(unsigned int bins);
        unsigned int getHeadingBins() const;

        /** \brief [steering_angles] odd number of steering angles of the car model, straight included. */
        void setSteeringAngles(unsigned int count);
        unsigned int getSteeringAngles() const;

        /** \brief [heuristic_weight_far] w of f = g + (w + p) h farther from the target than near_goal_distance. */
        void setHeuristicWeightFar(double weight);
        double getHeuristicWeightFar() const;

        /** \brief [heuristic_weight_near] w nearer to the target than near_goal_distance. */
        void setHeuristicWeightNear(double weight);
        double getHeuristicWeightNear() const;

        /** \brief [near_goal_distance] metres. */
        void setNearGoalDistance(double distance);
        double getNearGoalDistance() const;

        /** \brief [tie_break] p of f = g + (w + p) h. */
        void setTieBreak(double offset);
        double getTieBreak() const;

        /** \brief [open_list] `binary_heap` or `linear`. */
        void setOpenList(const std::string &kind);
        std::string getOpenList() const;

        /** \brief [bidirectional] search from both ends. */
        void setBidirectional(bool enable);
        bool getBidirectional() const;

        /** \brief [search_from] `goal` or `start`: the side of a search that is not bidirectional. */
        void setSearchFrom(const std::string &side);
        std::string getSearchFrom() const;

        /** \brief [adaptive_resolution] refine where coarse steps do not get through (car model). */
        void setAdaptiveResolution(bool enable);
        bool getAdaptiveResolution() const;

        /** \brief [obstacle_heuristic] guide the search round obstacles (car model). */
        void setObstacleHeuristic(bool enable);
        bool getObstacleHeuristic() const;

        /** \brief [obstacle_loading] `lazy`: cells are found free or blocked when the search asks; `eager`: all of them
            beforehand, reported by mapLoadingTime(). */
        void setObstacleLoading(const std::string &loading);
        std::string getObstacleLoading() const;

        /** \brief [smoothing] `bspline` or `none` (grid models). */
        void setSmoothing(const std::string &smoothing);
        std::string getSmoothing() const;

        /** \brief [shortening] replace parts of solutions by shorter curves (car model). */
        void setShortening(bool enable);
        bool getShortening() const;

        /** \brief [approximate] end as near to the goal as possible when it cannot be reached. */
        void setApproximate(bool enable);
        bool getApproximate() const;

        /** \brief [reverse_penalty] extra cost per metre in reverse. */
        void setReversePenalty(double penalty);
        double getReversePenalty() const;

        /** \brief [gear_change_penalty] cost of a change of direction, in metres. */
        void setGearChangePenalty(double penalty);
        double getGearChangePenalty() const;

        /** \brief [steering_change_penalty] cost of turning the wheels from straight to full lock, in metres. */
        void setSteeringChangePenalty(double penalty);
        double getSteeringChangePenalty() const;

        /** \brief [clearance_weight] extra cost per metre driven in touch with an obstacle, falling to none at a metre
           of clearance. Needs a checker that knows clearances. */
        void setClearanceWeight(double weight);
        double getClearanceWeight() const;

        /** \brief [analytic_expansion] join the trees by curves (car model). Without it nothing ends exactly. */
        void setAnalyticExpansion(bool enable);
        bool getAnalyticExpansion() const;

        /** \brief [anytime] go on improving until terminated. */
        void setAnytime(bool enable);
        bool getAnytime() const;

        /** \brief [parameter_set] sets all of the above to a named set, see parking::parameterSetNames(). */
        void setParameterSet(const std::string &name);
        std::string getParameterSet() const;
        /** @} */

        /** \brief Seconds that solve() spent on finding out which cells are free before searching. */
        double mapLoadingTime() const;

        /** \brief What the last query did. */
        parking::search::SearchStatistics statistics() const;

        /** \brief States and motions that were checked; of those, how many needed FCL (known with
            parking::FclFootprintChecker only). */
        std::uint64_t checkedStates() const;
        std::uint64_t exactChecks() const;

        /** \brief The best solution of the car model in exact form; nullptr without one or with a grid model. */
        const parking::Path *solutionArcs() const;

        /** \brief Best cost over the lower bound of any cost in the discretised problem; see heuristic weights. */
        double suboptimalityBound();

    private:
        struct Query;

        void declareParameters();
        void requireFittingModel() const;
        base::PlannerStatus solveCar(const base::PlannerTerminationCondition &ptc);
        base::PlannerStatus solveGrid(const base::PlannerTerminationCondition &ptc);
        void prepareQuery();
        bool readInputs(const base::PlannerTerminationCondition &ptc, base::PlannerStatus &failure);
        std::vector<parking::Pose> smoothed(const std::vector<parking::Pose> &poses,
                                            const base::PlannerTerminationCondition &ptc) const;
        base::PlannerStatus report(const std::vector<parking::Pose> &poses, bool approximate);
        base::Cost costOf(const base::PathPtr &path) const;

        parking::PlannerParameters parameters_;
        std::string parameterSet_{"default"};
        std::unique_ptr<Query> query_;
        std::atomic<double> bestCost_;
        std::atomic<std::uint64_t> expanded_{0};
    };
}  // namespace ompl::geometric

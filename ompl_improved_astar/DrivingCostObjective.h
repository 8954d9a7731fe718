#pragma once

#include "ompl_improved_astar/search/planning/DrivingCost.h"
#include "ompl_improved_astar/search/planning/Parameters.h"
#include "parking_geometry/curves/ReedsShepp.h"
#include "state_validity/ompl/CurveSpace.h"

#include <ompl/base/OptimizationObjective.h>
#include <ompl/geometric/PathGeometric.h>

#include <memory>
#include <optional>
#include <vector>

namespace parking
{
    /** \brief The cost that ImprovedAStar minimises, as an objective for any planner: length, driving in reverse,
        changes of direction, steering, and passing obstacles closely.

        The unit is a metre driven forwards with sufficient clearance (search::CostModel). A motion is the curve of the
        Reeds-Shepp or Dubins space. On a plain SE2 space it is a straight line, driven in reverse if the mean heading
        points backwards. Its curvature is the turn over its length, at most full lock. The distance to obstacles is
        that of the validity checker in the SpaceInformation; without one that computes clearances, proximity costs
        nothing.

        OMPL adds up the costs of motions, each of which includes the changes of direction and steering within it. An
        optimising planner therefore minimises a sum without the changes between two motions. pathCost() includes them.

        Const calls from several threads are safe if those of the validity checker are. */
    class DrivingCostObjective : public ompl::base::OptimizationObjective
    {
    public:
        /** \brief Uses the weights of \e weights: `reverse_penalty`, `gear_change_penalty`, `steering_change_penalty`,
            `preferred_clearance`, `clearance_cost`; on a plain SE2 space also its `turning_radius`.

            Throws ompl::Exception for parameters out of range and for a space that is not SE2, Reeds-Shepp or
            Dubins. */
        explicit DrivingCostObjective(const ompl::base::SpaceInformationPtr &si, const PlannerParameters &weights = {});

        /** \brief The weights as given. */
        const PlannerParameters &weights() const
        {
            return weights_;
        }

        /** \brief Zero: only motions cost. */
        ompl::base::Cost stateCost(const ompl::base::State *state) const override;

        /** \brief Cost of the motion between two states; infinite if one is not finite or beyond a
            thousand kilometres. Throws ompl::Exception if the SpaceInformation has no validity checker. */
        ompl::base::Cost motionCost(const ompl::base::State *from, const ompl::base::State *to) const override;

        /** \brief Length in metres of the shortest curve between two states, of the straight line on a plain SE2 space.
            No sequence of motions costs less, up to rounding. */
        ompl::base::Cost motionCostHeuristic(const ompl::base::State *from, const ompl::base::State *to) const override;

        /** \brief Whether motions cost the same in both directions. */
        bool isSymmetric() const override;

        /** \brief Cost of a whole path, with the changes of direction and steering between its motions. */
        ompl::base::Cost cost(const ompl::geometric::PathGeometric &path) const;

    private:
        double costAlong(const std::vector<const ompl::base::State *> &states) const;

        PlannerParameters weights_;
        CurveSpace space_;
        std::optional<search::DrivingCost> cost_;
        std::optional<ReedsShepp> curves_;  // none on a plain SE2 space
    };

    /** \brief Cost of a whole path under \e objective: PathGeometric::cost(), but with the changes between motions for
        a DrivingCostObjective, also within a sum. */
    ompl::base::Cost pathCost(const ompl::geometric::PathGeometric &path,
                              const ompl::base::OptimizationObjectivePtr &objective);

    /** \brief The parameters with which ImprovedAStar searches by \e objective: \e parameters with other weights.

        A path length or a DrivingCostObjective determines all weights, and so does a sum of these. Returns
        std::nullopt for any other objective, for classes derived from these, and for sums with a negative weight or two
        preferred clearances. */
    std::optional<PlannerParameters> parametersFor(const ompl::base::OptimizationObjectivePtr &objective,
                                                   const PlannerParameters &parameters);
}  // namespace parking

#include "ompl_improved_astar/DrivingCostObjective.h"

#include "ompl_improved_astar/ExactType.h"
#include "ompl_improved_astar/StateSpaceEnvironment.h"
#include "ompl_improved_astar/search/planning/FootprintEnvironment.h"
#include "parking_geometry/Error.h"
#include "state_validity/ompl/FclFootprintChecker.h"
#include "state_validity/ompl/OmplPose.h"

#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/util/Exception.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ob = ompl::base;

namespace parking
{
    namespace
    {
        using search::MotionEnvironment;

        std::unique_ptr<MotionEnvironment> environmentOf(const ob::SpaceInformationPtr &si)
        {
            const ob::StateValidityCheckerPtr &checker = si->getStateValidityChecker();
            if (!checker)
                throw ompl::Exception(
                    "the driving cost requires a validity checker: call setup() of the "
                    "SpaceInformation first");
            if (const auto *known = exactly<FclFootprintChecker>(checker))
                return std::make_unique<FootprintEnvironment>(known->footprint(), spaceBounds(*si->getStateSpace()),
                                                              FootprintEnvironment::TOLERANCE);
            // Only clearances are requested, so that the step between states does not matter.
            return std::make_unique<StateSpaceEnvironment>(si, 1.0, StateSpacing{}, true);
        }

        constexpr double PlannerParameters::*WEIGHTS[] = {
            &PlannerParameters::reversePenalty, &PlannerParameters::gearChangePenalty,
            &PlannerParameters::steeringChangePenalty, &PlannerParameters::clearanceCost};

        /** The weights of a sum of objectives. */
        struct Sum
        {
            double length{0.0};
            PlannerParameters weights;
            bool isKnown{true};  ///< whether all parts are, and can be summed up

            Sum()
            {
                for (const auto weight : WEIGHTS)
                    weights.*weight = 0.0;
                weights.preferredClearance = 0.0;
            }

            void add(const ob::OptimizationObjectivePtr &objective, double factor)
            {
                if (const auto *sum = exactly<ob::MultiOptimizationObjective>(objective))
                {
                    for (unsigned int i = 0; i < sum->getObjectiveCount(); ++i)
                        add(sum->getObjective(i), factor * sum->getObjectiveWeight(i));
                    return;
                }
                const auto *driving = exactly<DrivingCostObjective>(objective);
                const bool isLength = exactly<ob::PathLengthOptimizationObjective>(objective) != nullptr;
                isKnown = isKnown && factor >= 0.0 && (isLength || driving != nullptr);
                length += factor;
                if (driving != nullptr && factor > 0.0)
                    addWeights(driving->weights(), factor);
            }

            void addWeights(const PlannerParameters &part, double factor)
            {
                const bool isClear = weights.clearanceCost > 0.0;
                for (const auto weight : WEIGHTS)
                    weights.*weight += factor * part.*weight;
                if (part.clearanceCost <= 0.0)
                    return;
                // Two clearances in one sum are not a cost of the search.
                isKnown = isKnown && (!isClear || weights.preferredClearance == part.preferredClearance);
                weights.preferredClearance = part.preferredClearance;
            }
        };

        /** What a driving cost within a sum adds to OMPL's cost of a path. */
        double costBetweenMotions(const ompl::geometric::PathGeometric &path,
                                  const ob::OptimizationObjectivePtr &objective)
        {
            if (const auto *driving = exactly<DrivingCostObjective>(objective))
                return driving->cost(path).value() - path.cost(objective).value();
            const auto *sum = exactly<ob::MultiOptimizationObjective>(objective);
            double cost = 0.0;
            for (unsigned int i = 0; sum != nullptr && i < sum->getObjectiveCount(); ++i)
                cost += sum->getObjectiveWeight(i) * costBetweenMotions(path, sum->getObjective(i));
            return cost;
        }
    }  // namespace

    DrivingCostObjective::DrivingCostObjective(const ob::SpaceInformationPtr &si, const PlannerParameters &weights)
      : ob::OptimizationObjective(si),
        weights_(weights),
        space_(*si->getStateSpace())
    {
        description_ = "Driving Cost";
        const bool isPlain = space_.kind() == SpaceKind::SE2;
        try
        {
            cost_.emplace(weights, isPlain ? 0.0 : space_.turningRadius());
        }
        catch (const Error &error)
        {
            throw ompl::Exception("DrivingCostObjective", error.what());
        }
        // In a symmetric Dubins space a car may drive in both directions, one after the other.
        if (!isPlain)
            curves_.emplace(space_.turningRadius(), si->getStateSpace()->hasSymmetricInterpolate()
                                                        ? CurveFamily::ReedsShepp
                                                        : CurveFamily::Dubins);
    }

    ob::Cost DrivingCostObjective::stateCost(const ob::State * /*state*/) const
    {
        return identityCost();
    }

    double DrivingCostObjective::costAlong(const std::vector<const ob::State *> &states) const
    {
        std::vector<Pose> poses;
        for (const ob::State *state : states)
            poses.push_back(poseOf(state));
        const auto curve = [&](std::size_t i, Path &path)
        {
            space_.append(states[i - 1], states[i], path);
        };
        return cost_->along(poses, curve, *environmentOf(si_));
    }

    ob::Cost DrivingCostObjective::motionCost(const ob::State *from, const ob::State *to) const
    {
        return ob::Cost(costAlong({from, to}));
    }

    ob::Cost DrivingCostObjective::motionCostHeuristic(const ob::State *from, const ob::State *to) const
    {
        return ob::Cost(curves_ ? curves_->distance(poseOf(from), poseOf(to))
                                : positionDistance(poseOf(from), poseOf(to)));
    }

    bool DrivingCostObjective::isSymmetric() const
    {
        // Proximity is sampled from the beginning of a motion.
        return ob::OptimizationObjective::isSymmetric() && cost_->model().reversePenalty == 0.0 &&
               !cost_->model().prefersClearance();
    }

    ob::Cost DrivingCostObjective::cost(const ompl::geometric::PathGeometric &path) const
    {
        std::vector<const ob::State *> states;
        for (unsigned int i = 0; i < path.getStateCount(); ++i)
            states.push_back(path.getState(i));
        return ob::Cost(costAlong(states));
    }

    ob::Cost pathCost(const ompl::geometric::PathGeometric &path, const ob::OptimizationObjectivePtr &objective)
    {
        if (const auto *driving = exactly<DrivingCostObjective>(objective))
            return driving->cost(path);
        return ob::Cost(path.cost(objective).value() + costBetweenMotions(path, objective));
    }

    std::optional<PlannerParameters> parametersFor(const ob::OptimizationObjectivePtr &objective,
                                                   const PlannerParameters &parameters)
    {
        PlannerParameters result = parameters;
        Sum sum;
        sum.add(objective, 1.0);
        if (!sum.isKnown || !(sum.length > 0.0 && std::isfinite(sum.length)))
            return std::nullopt;
        for (const auto weight : WEIGHTS)
            result.*weight = sum.weights.*weight / sum.length;
        result.preferredClearance = sum.weights.preferredClearance;
        return result;
    }
}  // namespace parking

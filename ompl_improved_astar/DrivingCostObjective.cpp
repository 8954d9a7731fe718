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

        constexpr double INFINITE = std::numeric_limits<double>::infinity();
        constexpr double FARTHEST = 1e6;  // metres of a motion; clearances along it are sampled

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

        /** A straight line of a plain SE2 space, along which the heading changes linearly. */
        struct Line
        {
            Pose from;
            double x, y, turn, length;

            Line(const Pose &begin, const Pose &end)
              : from(begin),
                x(end.x - begin.x),
                y(end.y - begin.y),
                turn(wrapAngle(end.yaw - begin.yaw)),
                length(std::hypot(x, y))
            {
            }

            /** The piece of a car that turns as far on the same length. */
            PathPiece piece(double fullLock) const
            {
                const double mean = from.yaw + 0.5 * turn;
                const double driven = std::copysign(length, x * std::cos(mean) + y * std::sin(mean));
                return length > 0.0 ? PathPiece(std::clamp(turn / driven, -fullLock, fullLock), driven) : PathPiece();
            }

            double proximity(const search::CostModel &cost, MotionEnvironment &environment) const
            {
                const double samples = std::ceil(length / cost.sampleSpacing);
                double nearer = 0.0;
                for (double i = 0.5; i < samples; i += 1.0)
                {
                    const double share = i / samples;
                    if (!environment.keeps({from.x + share * x, from.y + share * y, from.yaw + share * turn},
                                           cost.preferredClearance))
                        nearer += length / samples;
                }
                return cost.clearanceCost * nearer;
            }
        };

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
        try
        {
            checkParameters(weights);
        }
        catch (const Error &error)
        {
            throw ompl::Exception("DrivingCostObjective", error.what());
        }
        const bool isPlain = space_.kind() == SpaceKind::SE2;
        const double radius = isPlain ? weights.turningRadius : space_.turningRadius();
        cost_ = search::costModel(weights, radius);
        // In a symmetric Dubins space a car may drive in both directions, one after the other.
        if (!isPlain)
            curves_.emplace(
                radius, si->getStateSpace()->hasSymmetricInterpolate() ? CurveFamily::ReedsShepp : CurveFamily::Dubins);
    }

    ob::Cost DrivingCostObjective::stateCost(const ob::State * /*state*/) const
    {
        return identityCost();
    }

    double DrivingCostObjective::costAlong(const std::vector<const ob::State *> &states) const
    {
        const std::unique_ptr<MotionEnvironment> environment = environmentOf(si_);
        search::CostModel cost = cost_;
        if (!environment->knowsClearance())
            cost.clearanceCost = 0.0;
        Path path;
        double proximityOfLines = 0.0;
        if (!states.empty())
            path.start = poseOf(states.front());
        for (std::size_t i = 1; i < states.size(); ++i)
        {
            const Line line(poseOf(states[i - 1]), poseOf(states[i]));
            if (!(line.length <= FARTHEST && std::isfinite(line.turn)))
                return INFINITE;
            if (curves_)
            {
                space_.append(states[i - 1], states[i], path);
                continue;
            }
            path.append(line.piece(cost.fullLockCurvature));
            if (cost.prefersClearance())
                proximityOfLines += line.proximity(cost, *environment);
        }
        if (!curves_)
            cost.clearanceCost = 0.0;
        return search::price(cost, std::move(path), *environment).cost + proximityOfLines;
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
        return ob::OptimizationObjective::isSymmetric() && cost_.reversePenalty == 0.0 && !cost_.prefersClearance();
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

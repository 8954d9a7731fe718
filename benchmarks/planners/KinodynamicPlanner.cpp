#include "benchmarks/planners/KinodynamicPlanner.h"

#include "benchmarks/planners/InputStates.h"
#include "benchmarks/planners/RangedParameter.h"
#include "parking_geometry/Pose.h"
#include "state_validity/ompl/CurveSpace.h"
#include "state_validity/ompl/OmplPose.h"

#include <ompl/base/goals/GoalStates.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/control/PathControl.h>
#include <ompl/control/spaces/RealVectorControlSpace.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/util/Exception.h>

#include <cmath>
#include <limits>

namespace ob = ompl::base;
namespace oc = ompl::control;

namespace parking
{
    namespace
    {
        constexpr unsigned LONGEST_CONTROL = 10;  // steps
        constexpr unsigned CURVATURE = 0, DIRECTION = 1;

        /** Curvature -1, 0 and 1 times the maximum, and direction -1 and 1. */
        class BangBang : public oc::ControlSampler
        {
        public:
            explicit BangBang(const oc::ControlSpace *space) : oc::ControlSampler(space)
            {
            }

            void sample(oc::Control *control) override
            {
                double *values = control->as<oc::RealVectorControlSpace::ControlType>()->values;
                values[CURVATURE] = rng_.uniformInt(-1, 1);
                values[DIRECTION] = rng_.uniformBool() ? 1.0 : -1.0;
            }
        };

        /** A goal region that contains every state from which the space's own curve to a goal is free and short
            enough. */
        class WithinReach : public ob::GoalStates
        {
        public:
            WithinReach(const ob::SpaceInformationPtr &si, double reach) : ob::GoalStates(si), reach_(reach)
            {
                setThreshold(reach);
            }

            const ob::State *drivableFrom(const ob::State *state) const
            {
                for (std::size_t i = 0; i < getStateCount(); ++i)
                    if (si_->distance(state, getState(i)) <= reach_ && si_->checkMotion(state, getState(i)))
                        return getState(i);
                return nullptr;
            }

            bool isSatisfied(const ob::State *state) const override
            {
                return drivableFrom(state) != nullptr;
            }

            bool isSatisfied(const ob::State *state, double *distance) const override
            {
                *distance = distanceGoal(state);
                return *distance <= reach_ && isSatisfied(state);
            }

        private:
            double reach_;
        };
    }  // namespace

    KinodynamicPlanner::KinodynamicPlanner(const ob::SpaceInformationPtr &si, const std::string &name,
                                           const Maker &maker)
      : ob::Planner(si, name)
    {
        specs_.recognizedGoal = ob::GOAL_SAMPLEABLE_REGION;
        specs_.directed = true;
        declareRanged(*this, "goal_reach", goalReach_, {0.01, 1000.0}, "0.5:0.5:20.");
        declareRanged(*this, "step", step_, {0.01, 10.0}, "0.05:0.05:1.");

        auto controls = std::make_shared<oc::RealVectorControlSpace>(si->getStateSpace(), 2);
        ob::RealVectorBounds bounds(2);
        bounds.setLow(-1.0);
        bounds.setHigh(1.0);
        controls->setBounds(bounds);
        controls->setControlSamplerAllocator([](const oc::ControlSpace *space)
                                             { return std::make_shared<BangBang>(space); });
        controls_ = std::make_shared<oc::SpaceInformation>(si->getStateSpace(), controls);
        planner_ = maker(controls_);
        params_.include(planner_->params());
    }

    ob::PlannerStatus KinodynamicPlanner::solve(const ob::PlannerTerminationCondition &ptc)
    {
        checkValidity();
        const CurveSpace space(*si_->getStateSpace());
        if (space.kind() != SpaceKind::ReedsShepp)
            throw ompl::Exception(getName(), "plans in a Reeds-Shepp space only");
        pis_.restart();
        auto problem = std::make_shared<ob::ProblemDefinition>(controls_);
        for (const ob::State *start : startsOf(pis_))
            problem->addStartState(start);
        if (problem->getStartStateCount() == 0)
            return ob::PlannerStatus::INVALID_START;
        auto goal = std::make_shared<WithinReach>(si_, goalReach_);
        for (const ob::State *state : goalsOf(pis_, ptc))
            goal->addState(state);
        if (!goal->hasStates())
            return ptc ? ob::PlannerStatus::TIMEOUT : ob::PlannerStatus::INVALID_GOAL;
        problem->setGoal(goal);
        // Satisfied with the first solution, if a planner queries the objective.
        auto objective = std::make_shared<ob::PathLengthOptimizationObjective>(controls_);
        objective->setCostThreshold(ob::Cost(std::numeric_limits<double>::infinity()));
        problem->setOptimizationObjective(objective);

        const double curvature = 1.0 / space.turningRadius();
        const double outside = si_->getStateSpace()->as<ob::SE2StateSpace>()->getBounds().high[0] + 1.0;
        const ob::SpaceInformation *geometric = si_.get();  // lives as long as this planner
        controls_->setStateValidityChecker([geometric](const ob::State *state) { return geometric->isValid(state); });
        controls_->setStatePropagator(
            [geometric, curvature, outside](const ob::State *from, const oc::Control *control, double length,
                                            ob::State *to)
            {
                const double *values = control->as<oc::RealVectorControlSpace::ControlType>()->values;
                Pose pose = advance(poseOf(from), std::round(values[CURVATURE]) * curvature,
                                    values[DIRECTION] < 0.0 ? -length : length);
                ob::State *reached = geometric->cloneState(from);
                setPose(reached, pose);
                // A step in collision ends outside of the bounds, in a state that is invalid for every planner.
                if (!geometric->satisfiesBounds(reached) || !geometric->checkMotion(from, reached))
                    pose.x = outside;
                geometric->freeState(reached);
                setPose(to, pose);
            });
        controls_->setPropagationStepSize(step_);
        controls_->setMinMaxControlDuration(1, LONGEST_CONTROL);
        controls_->setup();
        si_->setup();  // The space has received other projections, and the old ones, which the settings would print,
                       // are deleted.
        planner_->setProblemDefinition(problem);
        if (planner_->isSetup())  // PDST crashes when cleared before
            planner_->clear();
        planner_->setup();
        planner_->solve(ptc);

        const auto *found = dynamic_cast<const oc::PathControl *>(problem->getSolutionPath().get());
        if (found == nullptr || found->getStateCount() == 0)
            return ob::PlannerStatus::TIMEOUT;
        auto path = std::make_shared<ompl::geometric::PathGeometric>(si_);
        oc::PathControl steps(*found);
        steps.interpolate();  // One state per step: several arcs could have a shorter curve between their ends.
        for (const ob::State *state : steps.getStates())
            path->append(state);
        const ob::State *last = path->getStates().back();
        const ob::State *end = goal->drivableFrom(last);
        if (end != nullptr && si_->distance(last, end) > 0.0)
            path->append(end);
        pdef_->addSolutionPath(path, end == nullptr, end == nullptr ? goal->distanceGoal(last) : 0.0, getName());
        return end != nullptr ? ob::PlannerStatus::EXACT_SOLUTION : ob::PlannerStatus::APPROXIMATE_SOLUTION;
    }

    void KinodynamicPlanner::clear()
    {
        ob::Planner::clear();
        if (planner_->isSetup())
            planner_->clear();
    }

    void KinodynamicPlanner::getPlannerData(ob::PlannerData &data) const
    {
        ob::Planner::getPlannerData(data);
        if (planner_->getProblemDefinition())
            planner_->getPlannerData(data);
    }
}  // namespace parking

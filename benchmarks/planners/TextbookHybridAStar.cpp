#include "benchmarks/planners/TextbookHybridAStar.h"

#include "benchmarks/planners/RangedParameter.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/Pose.h"
#include "state_validity/ompl/CurveSpace.h"
#include "state_validity/ompl/FclFootprintChecker.h"
#include "state_validity/ompl/OmplPose.h"

#include <ompl/base/ScopedState.h>
#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/util/Exception.h>

#include <utility>
#include <vector>

namespace ob = ompl::base;

namespace parking
{
    TextbookHybridAStar::TextbookHybridAStar(const ob::SpaceInformationPtr &si)
      : ob::Planner(si, "textbook_hybrid_astar")
    {
        specs_.recognizedGoal = ob::GOAL_SAMPLEABLE_REGION;
        specs_.directed = true;
        declareRanged(*this, "xy_resolution", parameters_.xyResolution, {0.01, 10.0}, "0.05:0.05:1.");
        declareRanged(*this, "heading_bins", parameters_.headingBins, {1.0, 4000.0}, "16:8:360");
        declareRanged(*this, "steering_angles", parameters_.steeringAngles, {2.0, 1000.0}, "3:2:11");
        declareRanged(*this, "motion_length", parameters_.motionLength, {0.01, 100.0}, "0.1:0.1:2.");
        declareRanged(*this, "reverse_penalty", parameters_.reversePenalty, {0.0, 1000.0}, "0.:0.5:5.");
        declareRanged(*this, "gear_change_penalty", parameters_.gearChangePenalty, {0.0, 1000.0}, "0.:0.5:10.");
        declareRanged(*this, "steering_penalty", parameters_.steeringPenalty, {0.0, 1000.0}, "0.:0.1:2.");
        declareRanged(*this, "expansion_interval", parameters_.expansionInterval, {1.0, 1e6}, "1:1:100");
        declareRanged(*this, "heuristic_weight", parameters_.heuristicWeight, {0.0, 1000.0}, "0.:0.1:5.");
        declareRanged(*this, "obstacle_heuristic", parameters_.obstacleHeuristic, {0.0, 1.0}, "0,1");
    }

    ob::PlannerStatus TextbookHybridAStar::solve(const ob::PlannerTerminationCondition &ptc)
    {
        checkValidity();
        if (CurveSpace(*si_->getStateSpace()).kind() != SpaceKind::ReedsShepp)
            throw ompl::Exception(getName(), "plans in a Reeds-Shepp space only");
        pis_.restart();
        const ob::State *start = pis_.nextStart();
        if (start == nullptr)
            return ob::PlannerStatus::INVALID_START;
        const ob::State *goal = pis_.nextGoal(ptc);
        if (goal == nullptr)
            return ob::PlannerStatus::INVALID_GOAL;
        const auto *checker = dynamic_cast<const FclFootprintChecker *>(si_->getStateValidityChecker().get());
        const ob::RealVectorBounds bounds = si_->getStateSpace()->as<ob::SE2StateSpace>()->getBounds();
        ob::ScopedState<> from(si_), to(si_);
        TextbookProblem problem;
        problem.start = poseOf(start);
        problem.goal = poseOf(goal);
        problem.bounds = {{bounds.low[0], bounds.low[1]}, {bounds.high[0], bounds.high[1]}};
        problem.turningRadius = CurveSpace(*si_->getStateSpace()).turningRadius();
        problem.curveToGoal = [&](const Pose &pose)
        {
            setPose(to.get(), pose);
            return si_->distance(to.get(), goal);
        };
        problem.isMotionFree = [&](const Pose &begin, const Pose &end)
        {
            setPose(from.get(), begin);
            setPose(to.get(), end);
            return si_->satisfiesBounds(to.get()) && si_->checkMotion(from.get(), to.get());
        };
        problem.footprint = checker != nullptr ? &checker->footprint() : nullptr;
        problem.stop = [&ptc]
        {
            return ptc();
        };
        std::vector<Pose> poses;
        try
        {
            poses = TextbookSearch(std::move(problem), parameters_).run();
        }
        catch (const Error &error)
        {
            throw ompl::Exception(getName(), error.what());
        }
        if (poses.empty())
            return ob::PlannerStatus::TIMEOUT;
        auto path = std::make_shared<ompl::geometric::PathGeometric>(si_);
        ob::ScopedState<> state(si_);
        for (const Pose &pose : poses)
        {
            setPose(state.get(), pose);
            path->append(state.get());
        }
        pdef_->addSolutionPath(path, false, 0.0, getName());
        return ob::PlannerStatus::EXACT_SOLUTION;
    }
}  // namespace parking

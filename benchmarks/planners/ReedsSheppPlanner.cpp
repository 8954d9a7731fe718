#include "benchmarks/planners/ReedsSheppPlanner.h"

#include "benchmarks/planners/InputStates.h"

#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/geometric/PathGeometric.h>

#include <algorithm>
#include <tuple>
#include <vector>

namespace ob = ompl::base;

namespace parking
{
    ReedsSheppPlanner::ReedsSheppPlanner(const ob::SpaceInformationPtr &si) : ob::Planner(si, "ReedsShepp")
    {
        specs_.recognizedGoal = ob::GOAL_SAMPLEABLE_REGION;
        specs_.directed = true;
    }

    ob::PlannerStatus ReedsSheppPlanner::solve(const ob::PlannerTerminationCondition &ptc)
    {
        checkValidity();
        if (dynamic_cast<const ob::GoalSampleableRegion *>(pdef_->getGoal().get()) == nullptr)
            return ob::PlannerStatus::UNRECOGNIZED_GOAL_TYPE;
        pis_.restart();
        const std::vector<const ob::State *> starts = startsOf(pis_);
        if (starts.empty())
            return ob::PlannerStatus::INVALID_START;
        const std::vector<const ob::State *> goals = goalsOf(pis_, ptc);
        if (goals.empty())  // No goal is free, or there was no time to sample one.
            return ptc ? ob::PlannerStatus::TIMEOUT : ob::PlannerStatus::INVALID_GOAL;

        std::vector<std::tuple<double, const ob::State *, const ob::State *>> motions;
        for (const ob::State *start : starts)
            for (const ob::State *goal : goals)
                motions.emplace_back(si_->distance(start, goal), start, goal);
        std::stable_sort(motions.begin(), motions.end(),
                         [](const auto &a, const auto &b) { return std::get<0>(a) < std::get<0>(b); });
        for (const auto &[length, start, goal] : motions)
        {
            if (ptc)
                break;
            if (!si_->checkMotion(start, goal))
                continue;
            pdef_->addSolutionPath(std::make_shared<ompl::geometric::PathGeometric>(si_, start, goal), false, 0.0,
                                   getName());
            return ob::PlannerStatus::EXACT_SOLUTION;
        }
        return ob::PlannerStatus::TIMEOUT;
    }

    void ReedsSheppPlanner::getPlannerData(ob::PlannerData &data) const
    {
        ob::Planner::getPlannerData(data);
        if (!pdef_ || !pdef_->hasExactSolution())
            return;
        const auto *path = pdef_->getSolutionPath()->as<ompl::geometric::PathGeometric>();
        data.addStartVertex(ob::PlannerDataVertex(path->getState(0)));
        data.addGoalVertex(ob::PlannerDataVertex(path->getState(1)));
        data.addEdge(ob::PlannerDataVertex(path->getState(0)), ob::PlannerDataVertex(path->getState(1)));
    }
}  // namespace parking

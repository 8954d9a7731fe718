#include "benchmarks/planners/DelegatingPlanner.h"

#include <utility>

namespace ob = ompl::base;

namespace parking
{
    DelegatingPlanner::DelegatingPlanner(ob::PlannerPtr planner)
      : ob::Planner(planner->getSpaceInformation(), planner->getName()),
        planner_(std::move(planner))
    {
        specs_ = planner_->getSpecs();
        params_.include(planner_->params());
    }

    void DelegatingPlanner::setProblemDefinition(const ob::ProblemDefinitionPtr &problem)
    {
        ob::Planner::setProblemDefinition(problem);
        planner_->setProblemDefinition(problem);
    }

    ob::PlannerStatus DelegatingPlanner::solve(const ob::PlannerTerminationCondition &ptc)
    {
        return planner_->solve(ptc);
    }

    void DelegatingPlanner::setup()
    {
        ob::Planner::setup();
        planner_->setup();
    }

    void DelegatingPlanner::clear()
    {
        ob::Planner::clear();
        planner_->clear();
    }

    void DelegatingPlanner::clearQuery()
    {
        planner_->clearQuery();
    }

    void DelegatingPlanner::checkValidity()
    {
        ob::Planner::checkValidity();
        planner_->checkValidity();
    }

    void DelegatingPlanner::getPlannerData(ob::PlannerData &data) const
    {
        planner_->getPlannerData(data);
    }
}  // namespace parking

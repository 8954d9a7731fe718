// A planner in a separate library. It samples random poses until one connects the start and the goal by two free
// motions. parking_plan and parking_benchmark load it with --plugin; see docs/benchmarking.md.

#include <ompl_improved_astar/PlannerPlugin.h>

#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/geometric/PathGeometric.h>

#include <memory>

namespace ob = ompl::base;

namespace
{
    class ViaPlanner : public ob::Planner
    {
    public:
        explicit ViaPlanner(const ob::SpaceInformationPtr &si) : ob::Planner(si, "via")
        {
            specs_.recognizedGoal = ob::GOAL_SAMPLEABLE_REGION;
            declareParam<double>("radius", this, &ViaPlanner::setRadius, &ViaPlanner::getRadius, "1.:1.:100.");
        }

        void setRadius(double radius)
        {
            radius_ = radius;
        }

        double getRadius() const
        {
            return radius_;
        }

        ob::PlannerStatus solve(const ob::PlannerTerminationCondition &ptc) override
        {
            checkValidity();
            pis_.restart();
            const ob::State *start = pis_.nextStart();
            if (start == nullptr)
                return ob::PlannerStatus::INVALID_START;
            const ob::State *goal = pis_.nextGoal(ptc);
            if (goal == nullptr)
                return ob::PlannerStatus::INVALID_GOAL;
            const ob::StateSamplerPtr sampler = si_->allocStateSampler();
            ob::ScopedState<> via(si_);
            while (!ptc)
            {
                sampler->sampleUniformNear(via.get(), goal, radius_);
                // Check in the driving direction, because curves in opposite directions may differ.
                if (!si_->isValid(via.get()) || !si_->checkMotion(via.get(), goal) ||
                    !si_->checkMotion(start, via.get()))
                    continue;
                auto path = std::make_shared<ompl::geometric::PathGeometric>(si_, start, via.get());
                path->append(goal);
                pdef_->addSolutionPath(path, false, 0.0, getName());
                return ob::PlannerStatus::EXACT_SOLUTION;
            }
            return ob::PlannerStatus::TIMEOUT;
        }

    private:
        double radius_{15.0};
    };

    void addPlanners(parking::PluginPlanners &planners)
    {
        planners.add({"via", "through one random pose",
                      [](const ob::SpaceInformationPtr &si) { return std::make_shared<ViaPlanner>(si); }, false});
    }
}  // namespace

PARKING_PLANNER_PLUGIN(addPlanners);

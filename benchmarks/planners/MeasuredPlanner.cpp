#include "benchmarks/planners/MeasuredPlanner.h"

#include "benchmarks/planners/PythonPlanner.h"
#include "ompl_improved_astar/DrivingCostObjective.h"
#include "parking_geometry/text/Text.h"
#include "state_validity/ompl/OmplPose.h"

#include <ompl/geometric/PathGeometric.h>

#include <array>
#include <cmath>
#include <exception>
#include <new>
#include <utility>

namespace ob = ompl::base;

namespace parking
{
    namespace
    {
        constexpr double FARTHEST = 1e6;  // metres; assertions of OMPL about Reeds-Shepp curves fail far beyond

        /** The fault of a solution that is not a path: a state that is not finite or beyond a thousand kilometres. The
            referee checks everything else. */
        std::optional<PlannerFailure> failureOfAnswer(const ob::ProblemDefinition &problem, bool exact)
        {
            const auto invalid = [](const std::string &text)
            {
                return PlannerFailure{PlanStatus::InvalidAnswer, text};
            };
            const ob::PathPtr path = problem.getSolutionPath();
            if (!path && exact)
                return invalid("it reports an exact solution, but there is no path");
            if (!path)
                return std::nullopt;
            const auto *states = dynamic_cast<const ompl::geometric::PathGeometric *>(path.get());
            if (states == nullptr)
                return invalid("its path is of an unknown type");
            if (states->getStateCount() == 0)
                return invalid("its path has no states");
            for (unsigned int i = 0; i < states->getStateCount(); ++i)
            {
                const ob::State *state = states->getState(i);
                if (state == nullptr)
                    return invalid("state " + std::to_string(i) + " of its path is null");
                const Pose pose = poseOf(state);
                if (!(std::abs(pose.x) <= FARTHEST && std::abs(pose.y) <= FARTHEST && std::abs(pose.yaw) <= FARTHEST))
                    return invalid("state " + std::to_string(i) + " of its path is out of range: " +
                                   formatNumber(pose.x) + ", " + formatNumber(pose.y) + ", " + formatNumber(pose.yaw));
            }
            return std::nullopt;
        }
    }  // namespace

    std::string toString(PlanStatus status)
    {
        constexpr std::array<const char *, PLAN_STATUSES> NAMES{
            "exact",     "approximate", "timeout", "invalid_start", "invalid_goal",  "infeasible",
            "exception", "crash",       "hang",    "memory",        "invalid_answer"};
        return NAMES.at(static_cast<std::size_t>(status));
    }

    bool isFailure(PlanStatus status)
    {
        return status >= PlanStatus::Exception;
    }

    PlannerFailure currentFailure(const std::string &where)
    {
        try
        {
            throw;
        }
        catch (const std::bad_alloc &)
        {
            return {PlanStatus::Memory, where + " ran out of memory"};
        }
        catch (const std::exception &error)
        {
            return {PlanStatus::Exception, where + " threw: " + oneLine(error.what())};
        }
        catch (...)
        {
            return {PlanStatus::Exception, where + " threw an exception that is not a std::exception"};
        }
    }

    MeasuredPlanner::MeasuredPlanner(ob::PlannerPtr planner)
      : ob::Planner(planner->getSpaceInformation(), planner->getName()),
        planner_(std::move(planner))
    {
        specs_ = planner_->getSpecs();
        params_.include(planner_->params());
        addPlannerProgressProperty("best cost REAL", [record = record_] { return std::to_string(record->bestCost()); });
    }

    template <class Work>
    void MeasuredPlanner::guard(const char *where, Work work) const
    {
        try
        {
            work();
        }
        catch (...)
        {
            if (!failure_)
                failure_ = currentFailure(where);
        }
    }

    void MeasuredPlanner::setTimeLimit(double seconds)
    {
        timeLimit_ = seconds;
        if (auto *python = dynamic_cast<PythonPlanner *>(planner_.get()))
            python->setTimeLimit(seconds);
    }

    void MeasuredPlanner::setProblemDefinition(const ob::ProblemDefinitionPtr &problem)
    {
        ob::Planner::setProblemDefinition(problem);
        planner_->setProblemDefinition(problem);
    }

    ob::PlannerStatus MeasuredPlanner::solve(const ob::PlannerTerminationCondition &ptc)
    {
        planner_->setName(getName());  // for its solutions and messages
        record_->begin();
        if (failure_)
            return ob::PlannerStatus::CRASH;  // in clear()
        wasStopped_ = false;
        const ob::PlannerTerminationCondition timeUp(
            [&]
            {
                const bool stop = record_->isOver(timeLimit_) || ptc() ||
                                  (stop_ != nullptr && stop_->load(std::memory_order_relaxed));
                if (stop)
                    wasStopped_ = true;
                return stop;
            });
        ob::PlannerStatus::StatusType status = ob::PlannerStatus::CRASH;
        guard("solve()", [&] { status = planner_->solve(timeUp); });
        record_->end();
        const bool exact = status == ob::PlannerStatus::EXACT_SOLUTION;
        if (!failure_)
            failure_ = failureOfAnswer(*getProblemDefinition(), exact);
        if (failure_)
        {
            getProblemDefinition()->clearSolutionPaths();
            return ob::PlannerStatus::CRASH;
        }
        // BLIT* of OMPL 2.0.2 does so, and OMPL's benchmark throws if there is no path.
        if (status == ob::PlannerStatus::APPROXIMATE_SOLUTION && !getProblemDefinition()->getSolutionPath())
            return ob::PlannerStatus::TIMEOUT;
        if (exact)
        {
            const auto &path = static_cast<const ompl::geometric::PathGeometric &>(
                *getProblemDefinition()->getSolutionPath());  // see failureOfAnswer()
            record_->noteAtEnd(objective_ ? pathCost(path, objective_).value() : path.length());
        }
        return status;
    }

    void MeasuredPlanner::setup()
    {
        ob::Planner::setup();
        planner_->setup();
    }

    void MeasuredPlanner::clear()
    {
        ob::Planner::clear();
        guard("clear()", [this] { planner_->clear(); });
    }

    void MeasuredPlanner::checkValidity()
    {
        ob::Planner::checkValidity();
        planner_->checkValidity();
    }

    void MeasuredPlanner::getPlannerData(ob::PlannerData &data) const
    {
        guard("getPlannerData()", [&] { planner_->getPlannerData(data); });
        for (const auto &[name, property] : planner_->getPlannerProgressProperties())
            data.properties.erase(name);
        ob::Planner::getPlannerData(data);
    }
}  // namespace parking

#pragma once

#include <ompl/base/Planner.h>
#include <ompl/base/PlannerTerminationCondition.h>

#include <cstddef>
#include <vector>

namespace parking
{
    /** \brief All valid starts of a planner's problem. */
    inline std::vector<const ompl::base::State *> startsOf(ompl::base::PlannerInputStates &inputs)
    {
        std::vector<const ompl::base::State *> starts;
        while (const ompl::base::State *start = inputs.nextStart())
            starts.push_back(start);
        return starts;
    }

    /** \brief The valid goals of a planner's problem, at most 64: a region may sample ever more. Waits for the first
       one until \e ptc. */
    inline std::vector<const ompl::base::State *> goalsOf(ompl::base::PlannerInputStates &inputs,
                                                          const ompl::base::PlannerTerminationCondition &ptc)
    {
        constexpr std::size_t MAX_GOALS = 64;
        std::vector<const ompl::base::State *> goals;
        while (goals.size() < MAX_GOALS && !ptc)
        {
            const ompl::base::State *goal = goals.empty() ? inputs.nextGoal(ptc) : inputs.nextGoal();
            if (goal == nullptr)
                break;
            goals.push_back(goal);
        }
        return goals;
    }
}  // namespace parking

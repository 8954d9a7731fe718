#pragma once

#include "ompl_improved_astar/search/CarInSpace.h"
#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/planning/Parameters.h"
#include "ompl_improved_astar/search/planning/PathPlanner.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/Path.h"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace parking::search
{
    /** \brief A planning problem. */
    struct PlanRequest
    {
        std::vector<Pose> starts;      ///< one or more; those that are not free are left out
        std::vector<Pose> goals;       ///< likewise; the cheapest to reach is reached
        CarInSpace car;                ///< what cannot be said by the parameters
        PlannerParameters parameters;  ///< turning_radius among them is not looked at: car has it
        StopFunction stop;             ///< asked now and then; true ends planning
        /** Planning ends after so many expansions, which depends on no clock; 0: it does not. */
        std::uint64_t maxExpansions{0};
        ImprovementFunction improved;  ///< told of every improvement; may be empty
    };

    /** \brief How planning ended. */
    enum class PlanOutcome
    {
        Solved,        ///< from a start to a goal
        Approximate,   ///< as near to a goal as the car comes, or came in time
        Infeasible,    ///< there is no way, as far as the motion model goes
        Timeout,       ///< stopped without a path
        InvalidStart,  ///< no start is free
        InvalidGoal    ///< no goal is free, and only exact solutions are wanted
    };

    /** \brief What became of a request. */
    struct PlanResult
    {
        PlanOutcome outcome{PlanOutcome::Timeout};  ///< how it ended
        /** Why there is no solution, unless it is only for want of time; empty then, and when there is one. */
        std::string reason;
        Path path;            ///< of Solved and Approximate
        std::size_t goal{0};  ///< index into PlanRequest::goals: the one that is reached, or was aimed at
        double cost{std::numeric_limits<double>::infinity()};  ///< metres and penalties, of Solved
        /** cost over a bound that no path stays below, at least 1 (see Search::lowerBound()); infinite if unknown. */
        double suboptimalityBound{std::numeric_limits<double>::infinity()};
        SearchStatistics statistics;  ///< what was done
        double loadingTime{0.0};      ///< seconds spent on finding out beforehand what is free
    };

    /** \brief Plans in one call and without state: equal requests give equal results, from any thread.

        \e environment serves one call at a time. Paths of the grid models are not smoothed: see smoothGridPath().
        Throws parking::Error for parameters out of range and for a request without start or goal. */
    PlanResult plan(MotionEnvironment &environment, const PlanRequest &request);

    /** \brief Why a search has ended without a solution, in words. */
    std::string reasonOf(Exhaustion exhaustion, const CarInSpace &car);

    /** \brief Why a search that isFull() has ended, in words. */
    std::string outOfMemory(const PlannerParameters &parameters);
}  // namespace parking::search

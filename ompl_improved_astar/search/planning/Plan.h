#pragma once

#include "ompl_improved_astar/search/CarInSpace.h"
#include "ompl_improved_astar/search/MotionEnvironment.h"
#include "ompl_improved_astar/search/planning/Parameters.h"
#include "ompl_improved_astar/search/planning/PathPlanner.h"
#include "parking_geometry/Pose.h"
#include "parking_geometry/curves/Path.h"
#include "state_validity/sweeps/Escape.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace parking::search
{
    /** \brief A planning problem. */
    struct PlanRequest
    {
        std::vector<Pose> starts;  ///< one or more; colliding ones are ignored unless all do and escape is on
        std::vector<Pose>
            goals;       ///< one or more, of which the cheapest to reach is reached; colliding ones are ignored
        CarInSpace car;  ///< car and space
        PlannerParameters parameters;  ///< turning_radius is ignored in favour of car.turningRadius
        StopFunction stop;             ///< polled; true ends planning
        /** Limit of the number of expansions, independent of any clock; 0: no limit. */
        std::uint64_t maxExpansions{0};
        ImprovementFunction improved;  ///< receives every improvement; may be empty
    };

    /** \brief Outcome of planning. */
    enum class PlanOutcome
    {
        Solved,        ///< from a start to a goal
        Approximate,   ///< path to the nearest pose found
        Infeasible,    ///< no path exists for the motion model
        Timeout,       ///< stopped without a path
        InvalidStart,  ///< no start is free
        InvalidGoal,   ///< no goal is free, and `approximate` is off
        Escaped        ///< to a goal, but the path begins in contact and leaves it by an escape
    };

    /** \brief Result of a request. */
    struct PlanResult
    {
        PlanOutcome outcome{PlanOutcome::Timeout};  ///< kind of result
        /** Why there is no solution; empty with a solution, or if only the time ran out. */
        std::string reason;
        Path path;  ///< of Solved, Escaped and Approximate
        /** One line on an escape, or on straights shorter than the parameters require; empty otherwise. */
        std::string notice;
        std::optional<Escape> escape;  ///< with which the path begins, of Escaped and Approximate
        std::size_t goal{0};           ///< index into PlanRequest::goals: the goal that is reached or approached
        double cost{std::numeric_limits<double>::infinity()};  ///< metres and penalties, of Solved and Escaped
        /** Cost over Search::lowerBound(), at least 1; infinite if unknown. */
        double suboptimalityBound{std::numeric_limits<double>::infinity()};
        SearchStatistics statistics;  ///< work done
        double loadingTime{0.0};      ///< seconds spent classifying cells before the search
    };

    /** \brief Plans in one stateless call: equal requests give equal results, from any thread.

        \e environment may be used by one call at a time. Paths of grid models are not smoothed: see smoothGridPath().
        Throws parking::Error for parameters out of range and for a request without start or goal. */
    PlanResult plan(MotionEnvironment &environment, const PlanRequest &request);

    /** \brief Sentence that explains why a search ended without a solution. */
    std::string reasonOf(Exhaustion exhaustion, const CarInSpace &car);

    /** \brief Sentence that explains why there is no start to plan from. */
    std::string invalidStart(const PlannerParameters &parameters);

    /** \brief Sentence that explains why a search that isFull() ended. */
    std::string outOfMemory(const PlannerParameters &parameters);
}  // namespace parking::search

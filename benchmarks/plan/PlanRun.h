#pragma once

#include "benchmarks/plan/PlannedPath.h"
#include "benchmarks/plan/Problem.h"

#include <ompl/base/PlannerStatus.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace parking
{
    /** \brief Effort of a planner in one run. */
    struct SearchFigures
    {
        std::uint64_t expanded{0};     ///< nodes expanded; for OMPL's planners, vertices of their graph
        std::uint64_t generated{0};    ///< motions attempted; for OMPL's planners, edges of their graph
        std::uint64_t stateChecks{0};  ///< poses checked, those along motions included
        std::uint64_t exactChecks{0};  ///< poses decided by FCL, contained in stateChecks
        std::optional<std::uint64_t> openListOperations;   ///< entries pushed and popped; of improved A* only
        std::optional<std::uint64_t> openListComparisons;  ///< comparisons of entries; of improved A* only
    };

    /** \brief One run of a planner. */
    struct PlanRun
    {
        PlanStatus status{PlanStatus::Timeout};  ///< status reported by the planner; isSolved() is the checked result
        std::string reason;  ///< one line on why there is no exact solution, from planners that report it
        std::string notice;  ///< of improved A*: see ImprovedAStar::notice()
        bool escapes{
            false};  ///< whether the path begins with an escape from contact, which the second check leaves out
        double planningTime{0.0};       ///< wall-clock time in seconds, without map loading
        double cpuTime{0.0};            ///< processor time of all threads in seconds, with map loading
        double firstSolutionTime{0.0};  ///< time of the first solution in seconds; only with an exact solution
        double mapLoadingTime{0.0};     ///< time in seconds in which the planner computed which cells are free
        SearchFigures search;           ///< effort of the search
        /** Upper bound of the solution's cost relative to the optimum of the discretised problem. Only improved A* with
            both heuristic weights at 1 reports it; otherwise infinite. */
        double suboptimalityBound{std::numeric_limits<double>::infinity()};
        std::optional<PlannedPath> path;  ///< with an exact or approximate solution
        double goalDistance{0.0};         ///< distance in metres from the end of the path to the nearest goal

        /** \brief Whether the referee accepts the path. Planners may report invalid paths as solutions. */
        bool hasValidPath() const
        {
            return path && path->recheck.valid;
        }

        /** \brief Whether there is an exact solution that the referee accepts. */
        bool isSolved() const
        {
            return status == PlanStatus::Exact && hasValidPath();
        }
    };

    /** \brief Status, figures and path of a planner after solve(). */
    PlanRun evaluateRun(const Problem &problem, const PreparedPlanner &prepared, ompl::base::PlannerStatus status);

    /** \brief Runs a new instance of a planner once, from seed \e seed.

        Throws what Problem::prepare throws. */
    PlanRun planOnce(const Problem &problem, const PlannerEntry &entry, const PlannerSettings &settings,
                     double timeLimit, std::uint_fast32_t seed);
}  // namespace parking

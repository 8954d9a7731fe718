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
    /** \brief What a planner did in one run, whatever it is. */
    struct SearchFigures
    {
        std::uint64_t expanded{0};     ///< nodes expanded; for OMPL's planners, vertices of their graph
        std::uint64_t generated{0};    ///< motions tried; for OMPL's planners, edges of their graph
        std::uint64_t stateChecks{0};  ///< poses checked, those along motions included
        std::uint64_t exactChecks{0};  ///< of those, decided by FCL
        std::optional<std::uint64_t> openListOperations;   ///< entries pushed and popped; of improved A* only
        std::optional<std::uint64_t> openListComparisons;  ///< of entries with each other; of improved A* only
    };

    /** \brief One run of a planner. */
    struct PlanRun
    {
        PlanStatus status{PlanStatus::Timeout};  ///< what the planner says; isSolved() is what is true
        std::string reason;             ///< one line on why there is no exact solution, from planners that tell
        double planningTime{0.0};       ///< seconds of wall clock, map loading not included
        double cpuTime{0.0};            ///< seconds of processor time of all threads, map loading included
        double firstSolutionTime{0.0};  ///< seconds; only with an exact solution
        double mapLoadingTime{0.0};     ///< seconds that the planner itself spent on finding out which cells are free
        SearchFigures search;           ///< what the search took
        /** Cost of the solution over a lower bound of it in the discretised problem: of the improved A* with both
            heuristic weights at 1; infinite otherwise. */
        double suboptimalityBound{std::numeric_limits<double>::infinity()};
        std::optional<PlannedPath> path;  ///< with an exact or approximate solution
        double goalDistance{0.0};         ///< metres that the path ends from the nearest goal

        /** \brief Is there a path that the referee accepts? Planners may be wrong about theirs. */
        bool hasValidPath() const
        {
            return path && path->recheck.valid;
        }

        /** \brief An exact solution that the referee accepts. */
        bool isSolved() const
        {
            return status == PlanStatus::Exact && hasValidPath();
        }
    };

    /** \brief Status, figures and path of a planner that has just been run. */
    PlanRun evaluateRun(const Problem &problem, const PreparedPlanner &prepared, ompl::base::PlannerStatus status);

    /** \brief Runs a new instance of a planner once, from seed \e seed.

        Throws what Problem::prepare throws. */
    PlanRun planOnce(const Problem &problem, const PlannerEntry &entry, const PlannerSettings &settings,
                     double timeLimit, std::uint_fast32_t seed);
}  // namespace parking

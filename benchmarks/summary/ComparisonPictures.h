#pragma once

#include "benchmarks/plan/Problem.h"
#include "benchmarks/planners/SolveRecord.h"
#include "benchmarks/store/RunRecord.h"

#include <string>
#include <vector>

namespace parking
{
    /** \brief The run with the shortest valid path, or with the shortest path if none is valid; null without any
        path. */
    const RunRecord *bestRun(const std::vector<const RunRecord *> &records);

    /** \brief Picture (SVG) of a problem: the best path of all planners, cropped to it, and below it the best path of
        each planner that solved it in a panel of its own, all with the same view.

        The report finds the panels by their classes, best and planner, and the paths in them as groups with the
        attributes data-planner, data-run and data-body (the body's extent behind, ahead and beside the pose, in
       pixels).

        \param radius of the disc that moves, in metres; 0: the car
        \param best planners' names and best runs (null: none) */
    std::string comparisonSvg(const Scenario &scenario, const std::string &title, double radius,
                              const std::vector<std::pair<std::string, const RunRecord *>> &best);
}  // namespace parking

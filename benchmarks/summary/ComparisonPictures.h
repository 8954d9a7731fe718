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

    /** \brief Picture (SVG) of a problem with the best path of each planner.

        Each stretch between changes of direction is a line with the attributes data-planner, data-run and
        data-direction (forward or reverse), which the report uses to find it.

        \param best planners' names and best runs (null: none) */
    std::string comparisonSvg(const Scenario &scenario, const std::string &title,
                              const std::vector<std::pair<std::string, const RunRecord *>> &best);
}  // namespace parking

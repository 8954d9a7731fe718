#pragma once

#include "benchmarks/planners/PlannerRegistry.h"

#include <string>
#include <vector>

namespace parking
{
    /** \brief Adds the planners of plug-ins: Python files (`.py`, see PythonPlanner), and shared libraries with the
       entry point of PlannerPlugin.h. Libraries stay loaded until the program ends.

        Throws parking::Error naming the file when it cannot be loaded, has no entry point, or adds no planner. Other
        reasons are another version of the entry point or of OMPL, and a name that is taken. */
    void loadPlugins(PlannerRegistry &registry, const std::vector<std::string> &files);
}  // namespace parking

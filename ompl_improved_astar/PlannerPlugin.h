#pragma once

#include <ompl/base/Planner.h>
#include <ompl/config.h>

#include <string>

namespace parking
{
    /** \brief A planner that a plug-in offers to parking_plan and parking_benchmark. */
    struct PluginPlanner
    {
        std::string name;                       ///< in .cfg files and for --planner: letters, digits and _ . + -
        std::string summary;                    ///< one line for --help
        ompl::base::PlannerAllocator allocate;  ///< makes the planner; must not be empty
        /** Whether the planner improves its solution until the time limit. It then receives an objective, path
            length unless the comparison sets another one, and should call isSatisfied() for each better solution, which
           records cost over time. */
        bool optimizing{false};
    };

    /** \brief Receives the planners of a plug-in. */
    class PluginPlanners
    {
    public:
        virtual ~PluginPlanners() = default;

        /** \brief Adds a planner. Throws std::runtime_error for a name that is taken or invalid, and without an
        allocator. */
        virtual void add(const PluginPlanner &planner) = 0;
    };

    /** \brief The entry point of a plug-in, exported as `parking_planner_plugin`.

        The loader reads the first two members before it uses the library; their positions must not change. */
    struct PlannerPlugin
    {
        int interfaceVersion;                           ///< of this header
        int omplVersion;                                ///< that the plug-in was built with
        void (*addPlanners)(PluginPlanners &planners);  ///< called once, adds all planners of the library
    };

    /** \brief Changes whenever anything in this header does. */
    constexpr int PLANNER_PLUGIN_VERSION = 1;
}  // namespace parking

/** \brief Makes a shared library a plug-in: \a function, a `void (parking::PluginPlanners &)`, adds its planners.

    Use it once in a library, outside of any namespace. Programs load it with `--plugin libmine.so`; see
    docs/benchmarking.md. */
#define PARKING_PLANNER_PLUGIN(function)                                                                   \
    extern "C" __attribute__((visibility("default"))) const parking::PlannerPlugin parking_planner_plugin; \
    const parking::PlannerPlugin parking_planner_plugin                                                    \
    {                                                                                                      \
        parking::PLANNER_PLUGIN_VERSION, OMPL_VERSION_VALUE, &(function)                                   \
    }

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
        /** Does the planner go on improving its solution until the time is up? Then it is handed path length as its
            objective, whose isSatisfied() should be asked for each new best solution: that is how its cost over time is
            recorded. */
        bool optimizing{false};
    };

    /** \brief What a plug-in adds its planners to. */
    class PluginPlanners
    {
    public:
        virtual ~PluginPlanners() = default;

        /** \brief Throws std::runtime_error for a name that is taken or not allowed, and without an allocator. */
        virtual void add(const PluginPlanner &planner) = 0;
    };

    /** \brief What a plug-in exports, under the name `parking_planner_plugin`: the entry point.

        The first two members are looked at before anything else of the library is used, and must not move. */
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

    Once in a library, outside of any namespace. Programs load it with `--plugin libmine.so`; see docs/comparison.md. */
#define PARKING_PLANNER_PLUGIN(function)                                                                   \
    extern "C" __attribute__((visibility("default"))) const parking::PlannerPlugin parking_planner_plugin; \
    const parking::PlannerPlugin parking_planner_plugin                                                    \
    {                                                                                                      \
        parking::PLANNER_PLUGIN_VERSION, OMPL_VERSION_VALUE, &(function)                                   \
    }

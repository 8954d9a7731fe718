#include "benchmarks/planners/PluginLoader.h"

#include "benchmarks/planners/PythonPlanner.h"
#include "ompl_improved_astar/PlannerPlugin.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/Text.h"

#include <boost/dll/shared_library.hpp>

#include <exception>
#include <filesystem>
#include <memory>
#include <system_error>

#include <dlfcn.h>

namespace parking
{
    namespace
    {
        constexpr const char *ENTRY_POINT = "parking_planner_plugin";

        std::string dotted(int version)
        {
            return std::to_string(version / 1000000) + "." + std::to_string(version / 1000 % 1000) + "." +
                   std::to_string(version % 1000);
        }

        /** Adds the library's planners to the registry. */
        class Adder final : public PluginPlanners
        {
        public:
            Adder(PlannerRegistry &registry, std::string library) : registry_(registry), library_(std::move(library))
            {
            }

            void add(const PluginPlanner &planner) override
            {
                registry_.add({planner.name, planner.summary, planner.optimizing, planner.allocate, {}, library_});
                ++count_;
            }

            std::size_t count() const
            {
                return count_;
            }

        private:
            PlannerRegistry &registry_;
            std::string library_;
            std::size_t count_{0};
        };

        void addPythonPlanner(PlannerRegistry &registry, const std::string &file)
        {
            const PythonPlannerFile description = readPythonPlanner(file);
            registry.add({description.name,
                          description.summary,
                          description.improves,
                          [description](const ompl::base::SpaceInformationPtr &si)
                          { return std::make_shared<PythonPlanner>(si, description); },
                          {},
                          file});
        }

        void loadLibrary(PlannerRegistry &registry, const std::filesystem::path &file)
        {
            // Never unloaded, since it contains the code of allocators, planners and exceptions.
            static std::vector<boost::dll::shared_library> loaded;
            boost::system::error_code error;
            boost::dll::shared_library library;
            // Resolves all symbols immediately, so that a missing one is reported before any run.
            library.load(file.string(), boost::dll::load_mode::rtld_now, error);
            if (error)
            {
                const char *reason = dlerror();
                throw Error("cannot be loaded: " + oneLine(reason != nullptr ? reason : error.message()));
            }
            if (!library.has(ENTRY_POINT))
                throw Error(std::string("has no entry point '") + ENTRY_POINT +
                            "'; use PARKING_PLANNER_PLUGIN of ompl_improved_astar/PlannerPlugin.h");
            const auto &plugin = library.get<const PlannerPlugin>(ENTRY_POINT);
            if (plugin.interfaceVersion != PLANNER_PLUGIN_VERSION)
                throw Error("was built for version " + std::to_string(plugin.interfaceVersion) +
                            " of the entry point, this program has version " + std::to_string(PLANNER_PLUGIN_VERSION) +
                            "; build it again");
            if (plugin.omplVersion != OMPL_VERSION_VALUE)
                throw Error("was built against OMPL " + dotted(plugin.omplVersion) + ", this program against OMPL " +
                            dotted(OMPL_VERSION_VALUE) + "; build it again");
            Adder adder(registry, file.string());
            loaded.push_back(library);
            plugin.addPlanners(adder);
            if (adder.count() == 0)
                throw Error("adds no planner");
        }

        void loadPlugin(PlannerRegistry &registry, const std::string &name)
        {
            std::error_code ignored;
            const std::filesystem::path file = std::filesystem::absolute(name, ignored);
            if (!std::filesystem::exists(file, ignored))
                throw Error("there is no such file");
            if (!std::filesystem::is_regular_file(file, ignored))
                throw Error("is not a file; name the library or the Python file");
            if (file.extension() == ".py")
                addPythonPlanner(registry, file.string());
            else
                loadLibrary(registry, file);
        }
    }  // namespace

    void loadPlugins(PlannerRegistry &registry, const std::vector<std::string> &files)
    {
        for (const std::string &file : files)
            try
            {
                loadPlugin(registry, file);
            }
            catch (const std::exception &failure)
            {
                throw Error("plug-in " + file + ": " + oneLine(failure.what()));
            }
    }
}  // namespace parking

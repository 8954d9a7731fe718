// parking_benchmark: compares planners on parking problems. docs/benchmark-reference.md says how.

#include "benchmarks/compare/BenchmarkOptions.h"
#include "benchmarks/compare/Comparison.h"
#include "benchmarks/planners/PluginLoader.h"
#include "benchmarks/system/CommandLine.h"
#include "parking_geometry/Error.h"

#include <ompl/util/Console.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include <unistd.h>

namespace
{
    constexpr int DONE = 0, INCOMPLETE = 1, INTERRUPTED = 130;
    constexpr unsigned int PATIENCE = 3;  // seconds that a run may take to end after a signal

    std::atomic<bool> interrupted{false};

    extern "C" void interrupt(int signal)
    {
        interrupted = true;
        // A second time means it.
        std::signal(signal, SIG_DFL);
        alarm(PATIENCE);
    }

    /** What is finished is safe at any time, so that a planner that does not listen is no reason to stay. */
    extern "C" void endNow(int /*signal*/)
    {
        constexpr std::string_view TEXT =
            "Interrupted in the middle of something that did not end. What is finished is kept; "
            "the same command goes on from there.\n";
        if (write(STDERR_FILENO, TEXT.data(), TEXT.size()) < 0)
        {
        }  // nobody is listening
        _exit(INTERRUPTED);
    }

    /** Names files; of many in one folder only the folder. */
    void list(const std::string &title, const std::vector<std::string> &files)
    {
        constexpr std::size_t MANY = 4;
        const auto folderOf = [](const std::string &file)
        {
            return file.substr(0, file.rfind('/') + 1);
        };
        const bool oneFolder =
            std::all_of(files.begin(), files.end(),
                        [&](const std::string &file) { return folderOf(file) == folderOf(files.front()); });
        std::cout << title << ":\n";
        if (files.size() >= MANY && oneFolder)
            std::cout << "    " << folderOf(files.front()) << "*" << files.front().substr(files.front().rfind('.'))
                      << " (" << files.size() << ")\n";
        else
            for (const std::string &file : files)
                std::cout << "    " << file << "\n";
    }

    int compare(const std::vector<std::string> &arguments)
    {
        using namespace parking;
        const BenchmarkOptions options = readBenchmarkOptions(arguments);
        PlannerRegistry registry = PlannerRegistry::builtIn();
        loadPlugins(registry, options.plugins);
        if (options.help)
        {
            std::cout << benchmarkHelp(registry);
            return DONE;
        }
        Comparison comparison(options, registry);
        if (!options.merge)
        {
            std::signal(SIGINT, interrupt);
            std::signal(SIGTERM, interrupt);
            std::signal(SIGALRM, endNow);
            std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is told like a full disk
            if (!comparison.run(interrupted))
            {
                std::cerr << "Interrupted. What is finished is kept in " << comparison.database()
                          << "; the same command goes on from there." << std::endl;
                return INTERRUPTED;
            }
            if (options.shards > 1)
            {
                std::cout << "Part " << options.shard + 1 << " of " << options.shards
                          << " is done: " << comparison.database() << "\nWhen all are, --merge puts them together.\n";
                return DONE;
            }
        }
        const ComparisonFiles files = comparison.write();
        std::cout << comparison.summary() << "\n";
        list("Logs", files.logs);
        list("Database (Planner Arena opens it)", {files.database});
        list("Tables", {files.table, files.csv});
        list("Pictures", files.pictures);
        if (!files.report.empty())
            list("Report", {files.report});
        if (!std::cout.flush())
            throw Error("standard output cannot be written");
        if (!files.reportError.empty())
            std::cerr << "parking_benchmark: " << files.reportError << std::endl;
        if (files.missing > 0)
            std::cerr << "parking_benchmark: " << files.missing << " runs are missing; the results hold what there is"
                      << std::endl;
        return files.missing > 0 || !files.reportError.empty() ? INCOMPLETE : DONE;
    }
}  // namespace

int main(int argc, char **argv)
{
    // What planners have to tell is in the log.
    ompl::msg::noOutputHandler();
    return parking::runProgram("parking_benchmark", argc, argv, compare);
}

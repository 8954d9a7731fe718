// parking_benchmark: compares planners on parking problems. See docs/benchmark-reference.md.

#include "benchmarks/compare/BenchmarkOptions.h"
#include "benchmarks/compare/Comparison.h"
#include "benchmarks/planners/PluginLoader.h"
#include "benchmarks/system/CommandLine.h"
#include "parking_geometry/Error.h"

#include <ompl/util/Console.h>

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
    constexpr unsigned int STOP_LIMIT = 3;  // seconds that a run may take to end after a signal

    std::atomic<bool> interrupted{false};

    extern "C" void interrupt(int signal)
    {
        interrupted = true;
        // A second signal ends the program at once.
        std::signal(signal, SIG_DFL);
        alarm(STOP_LIMIT);
    }

    /** Ends the program although a planner ignores the signal. Finished runs are already stored. */
    extern "C" void endNow(int /*signal*/)
    {
        constexpr std::string_view TEXT =
            "Interrupted during a run that did not end. Finished runs are stored; rerun the command to "
            "resume.\n";
        if (write(STDERR_FILENO, TEXT.data(), TEXT.size()) < 0)
        {
        }  // no reader is left
        _exit(INTERRUPTED);
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
            std::signal(SIGXFSZ, SIG_IGN);  // Report an exceeded file size limit like a full disk.
            if (!comparison.run(interrupted))
            {
                std::cerr << "Interrupted. Finished runs are stored in " << comparison.database()
                          << "; rerun the command to resume." << std::endl;
                return INTERRUPTED;
            }
            if (options.shards > 1)
            {
                std::cout << "Part " << options.shard + 1 << " of " << options.shards
                          << " is done: " << comparison.database() << "\nAfter all parts, run --merge.\n";
                return DONE;
            }
        }
        const ComparisonResult result = comparison.write();
        std::cout << result.text;
        if (!std::cout.flush())
            throw Error("standard output cannot be written");
        if (!result.reportError.empty())
            std::cerr << "parking_benchmark: " << result.reportError << std::endl;
        if (result.missing > 0)
            std::cerr << "parking_benchmark: " << result.missing
                      << " runs are missing; the results contain only the finished ones" << std::endl;
        return result.missing > 0 || !result.reportError.empty() ? INCOMPLETE : DONE;
    }
}  // namespace

int main(int argc, char **argv)
{
    // The log contains all messages of planners.
    ompl::msg::noOutputHandler();
    return parking::runProgram("parking_benchmark", argc, argv, compare);
}

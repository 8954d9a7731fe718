#pragma once

#include "benchmarks/comparison/UnitRunner.h"
#include "benchmarks/planners/PlannerRegistry.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace parking
{
    /** \brief The command line of parking_benchmark. */
    struct BenchmarkOptions
    {
        bool help{false};
        std::string config;
        std::string output;  ///< folder; empty: what the configuration says, or results-NAME
        std::optional<double> timeLimit;
        std::optional<std::size_t> runCount;
        std::optional<std::uint_fast32_t> seed;
        std::vector<std::string> scenarios;  ///< instead of the configuration's
        std::vector<std::string> planners;   ///< of the configuration's, those to run; empty: all
        std::vector<std::string> plugins;
        std::size_t shard{0};  ///< from 0
        std::size_t shards{1};
        bool merge{false};                ///< only put together what is there
        std::vector<std::string> inputs;  ///< to merge: files or folders; empty: the output folder
        bool fresh{false};
        Isolation isolation{Isolation::Plugins};
        bool report{true};  ///< make the HTML report, too
        bool quiet{false};
    };

    /** \brief Reads a command line (without the program's name). Throws parking::Error with one line. */
    BenchmarkOptions readBenchmarkOptions(const std::vector<std::string> &arguments);

    /** \brief The text of --help. */
    std::string benchmarkHelp(const PlannerRegistry &registry);
}  // namespace parking
